"""A lag for each run: the phase between a sensor's frames and the loop that logs them.

A device sends a frame every 20 ms, and a robot program logs the latest one every 20 ms. The age of
a logged frame depends on the times at which the two loops started. It is up to a period, constant
in a run, and different in the next run. With one lag for all runs, each is early or late by some
milliseconds, which biases kS and kA.

The lag of run i is that of all runs plus d_i ~ N(0, λ²). λ is the standard deviation of a uniform
distribution over one period. Whether the runs differ is decided by their likelihood with the d_i
integrated out (Laplace's approximation):

    -2 log L + Σ (d_i/λ)² + Σ log(1 + λ² a_i)        a_i = |∂ (whitened innovations)/∂d_i|²

Source: N. Laird and J. Ware, "Random-effects models for longitudinal data", Biometrics 38, 1982.
"""

import math
from dataclasses import replace

import numpy as np

from sim.core.log import Array
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.optimize import levenberg_marquardt, make_joint_jacobian
from sim.estimation.random_friction import compute_laplace_correction
from sim.fit.search import ROUGHLY, STEPS, drop_outliers, fit_open_loop, fit_tracking, refine

WORTH = 8.0  # [of -2 log L] improvement from which on they are included
EARLY = 0.2  # [sample periods] by which the estimate of a lag may be negative
UNIFORM = math.sqrt(12.0)  # standard deviations in the width of a uniform distribution
JUMP = 0.5  # [V] a larger change is a step, after which a velocity is not compared
SLOPE_STEP = 1e-4  # [s] to both sides, for the slope of a reading
SHARED = "delay"


def fit_run_lags(
    problem: PredictionErrorProblem,
    point: Estimate,
    *,
    every: PredictionErrorProblem,
    period: float,
) -> tuple[PredictionErrorProblem, Estimate]:
    """Fit a lag for each run, if it improves the fit enough.

    Args:
        problem: the measurements.
        point: the best estimate with one lag, or none.
        every: the measurements with their outliers: an outlier of a model with one lag may show
            that the runs differ.
        period: [s] time between samples of the log.

    Returns:
        The problem with run lags and the new estimate, or both unchanged if the lags do not explain
        enough.
    """
    extended = replace(problem, lag_sd=period / UNIFORM)
    white = problem.whiten(point, point.innovations)
    joint = make_joint_jacobian(problem, point, fine=True)
    slopes = extended.compute_lag_jacobian(point)
    if not joint.compute_improvement(white, slopes, extended.lag_sd) > WORTH:
        return problem, point
    common = fit_tracking(every, point.structure, point.values)
    extended = replace(every, lag_sd=period / UNIFORM)
    begin = _with_shared_lag(extended, common, least=0.5 * period)
    tracked = levenberg_marquardt(extended, begin, steps=2 * STEPS, enough=ROUGHLY)
    lags = tracked.values["delay.lag"] + tracked.nuisance.lag_offset
    if lags.min() < -EARLY * period:
        return problem, point  # a reading cannot be newer than the voltage of its sample
    slopes = extended.compute_lag_jacobian(tracked)
    correction = compute_laplace_correction(extended.lag_sd, slopes)
    if not tracked.cost + correction < common.cost - WORTH:
        return problem, point
    extended = drop_outliers(extended, tracked)
    tracked = levenberg_marquardt(
        extended, _reevaluate(extended, tracked), steps=STEPS, enough=ROUGHLY
    )
    found = fit_open_loop(extended, tracked)
    framed = _correct_jitter(extended, found)
    if framed is extended:
        return extended, found
    regular = refine(framed, _reevaluate(framed, found))
    if not regular.cost < found.cost - WORTH:
        return extended, found
    framed = _correct_jitter(extended, regular)
    return framed, fit_open_loop(framed, _reevaluate(framed, regular))


def _with_shared_lag(problem: PredictionErrorProblem, point: Estimate, *, least: float) -> Estimate:
    """The estimate in a model with a common lag of ``least`` [s] or more."""
    structure = point.structure
    if SHARED not in structure.effects:
        structure += SHARED
    values = {**point.values, "delay.lag": max(point.values.get("delay.lag", 0.0), least)}
    return problem.evaluate(structure, values, point.nuisance, point.process_noise)


def _correct_jitter(problem: PredictionErrorProblem, point: Estimate) -> PredictionErrorProblem:
    """The measurements corrected for jitter of the loop, if frames are measured at even times.

    A device measures at even times, and the robot program logs the frame a little early or late.
    The jitter is the deviation of the sample times from even ones; a reading is corrected by the
    jitter times the slope that the model has there.
    """
    jitter = [_deviation_from_even(record.measurements.time) for record in problem.records]
    if max(float(np.abs(one).max()) for one in jitter) > 0.5 * problem.lag_sd * UNIFORM:
        return problem
    slopes = _reading_slopes(problem, point)
    records = []
    for record, own, first in zip(problem.records, jitter, problem.run_edges, strict=False):
        run = record.measurements
        measured = run.measured + slopes[first : first + own.size] * own[:, None]
        jumps = np.abs(np.diff(run.voltage, prepend=0.0)) > JUMP
        measured[1:][jumps[:-1], 1] = np.nan  # an average over a sudden change of slope
        records.append(replace(record, measurements=replace(run, measured=measured)))
    return replace(problem, records=tuple(records))


def _reading_slopes(problem: PredictionErrorProblem, point: Estimate) -> Array:
    """(n, 2) derivative of the simulated readings by time [unit/s, unit/s²]."""
    model = point.structure.model(point.values)
    base = problem.initial_nuisance.add_lag(point.nuisance.lag_offset)
    readings = [
        problem.simulate(model, base.add_lag(np.full(len(problem.records), by)))
        for by in (-SLOPE_STEP, SLOPE_STEP)
    ]
    early, late = (np.column_stack((one.expected, one.seen)) for one in readings)
    return np.asarray((early - late) / (2.0 * SLOPE_STEP))


def _deviation_from_even(time: Array) -> Array:
    """(n,) [s] times minus evenly spaced ones."""
    steps = np.diff(time)
    index = np.concatenate(([0.0], np.cumsum(np.round(steps / np.median(steps)))))
    line = np.polynomial.Polynomial.fit(index, time, 1)
    return np.asarray(time - line(index))


def _reevaluate(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """The estimate with the same values, evaluated on these measurements."""
    return problem.evaluate(point.structure, point.values, point.nuisance, point.process_noise)
