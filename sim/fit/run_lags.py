"""A lag of each run's own: the phase of a sensor's frames against the loop that logs them.

A device sends a frame every 20 ms, and a robot program logs the latest one every 20 ms. How old it
is then depends on when each of them was started: up to a period, the same throughout a run, and
another in the next, because a routine begins in any loop. One lag for all runs leaves each of them
early or late by some milliseconds, which kS and kA take up.

The lag of run i is that of all runs plus d_i ~ N(0, λ²). λ is the standard deviation of an age
that is anything between nothing and a period. Whether the runs differ is decided by their
likelihood with the d_i integrated out (Laplace's approximation):

    -2 log L + Σ (d_i/λ)² + Σ log(1 + λ² a_i)    a_i the square of how innovations change with d_i

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

WORTH = 8.0  # [of -2 log L] what they must explain together to be believed
EARLY = 0.2  # [sample periods] by which a lag may seem to be less than none
UNIFORM = math.sqrt(12.0)  # standard deviations in the width of an even distribution
JUMP = 0.5  # [V] a step: a velocity averaged over its arrival is interpolated poorly, not compared
SLOPE_STEP = 1e-4  # [s] to both sides, for the slope of a reading
SHARED = "delay"


def fit_run_lags(
    problem: PredictionErrorProblem,
    point: Estimate,
    *,
    every: PredictionErrorProblem,
    period: float,
) -> tuple[PredictionErrorProblem, Estimate]:
    """Fit a lag for each run, if the data ask for it.

    Args:
        problem: the measurements.
        point: the best estimate with one lag, or none.
        every: the same measurements, none left out: what a model with one lag took for an outlier
            may show that the runs differ.
        period: [s] between samples of the log.

    Returns:
        Both as they were if the runs' own lags do not explain enough.
    """
    extended = replace(problem, lag_sd=period / UNIFORM)
    white = problem.whiten(point, point.innovations)
    own = make_joint_jacobian(problem, point, fine=True)
    if (
        not own.compute_improvement(white, extended.compute_lag_jacobian(point), extended.lag_sd)
        > WORTH
    ):
        return problem, point
    alike = fit_tracking(every, point.structure, point.values)
    extended = replace(every, lag_sd=period / UNIFORM)
    begin = _with_shared_lag(extended, alike, least=0.5 * period)
    tracked = levenberg_marquardt(extended, begin, steps=2 * STEPS, enough=ROUGHLY)
    lags = tracked.values["delay.lag"] + tracked.nuisance.lag_offset
    if lags.min() < -EARLY * period:
        return problem, point  # no reading is newer than the voltage beside it
    own_lags = compute_laplace_correction(extended.lag_sd, extended.compute_lag_jacobian(tracked))
    if not tracked.cost + own_lags < alike.cost - WORTH:
        return problem, point
    extended = drop_outliers(extended, tracked)
    tracked = levenberg_marquardt(extended, _again(extended, tracked), steps=STEPS, enough=ROUGHLY)
    found = fit_open_loop(extended, tracked)
    framed = _at_frame_times(extended, found)
    if framed is extended:
        return extended, found
    regular = refine(framed, _again(framed, found))
    if not regular.cost < found.cost - WORTH:
        return extended, found
    framed = _at_frame_times(extended, regular)
    return framed, fit_open_loop(framed, _again(framed, regular))


def _with_shared_lag(problem: PredictionErrorProblem, point: Estimate, *, least: float) -> Estimate:
    """The estimate in a model that has a lag, of ``least`` [s] or more, so that runs may differ."""
    structure = point.structure
    if SHARED not in structure.effects:
        structure += SHARED
    values = {**point.values, "delay.lag": max(point.values.get("delay.lag", 0.0), least)}
    return problem.evaluate(structure, values, point.nuisance, point.process_noise)


def _at_frame_times(problem: PredictionErrorProblem, point: Estimate) -> PredictionErrorProblem:
    """The same readings as they would have been at their samples, if frames come at even times.

    A frame is measured by the device's clock, and logged when the program's loop has come around,
    a little early or late. How much, its times say: the reading is then moved by the slope that the
    model has there.
    """
    late = [_deviation_from_even(record.measurements.time) for record in problem.records]
    if max(float(np.abs(one).max()) for one in late) > 0.5 * problem.lag_sd * UNIFORM:
        return problem
    slopes = _reading_slopes(problem, point)
    records = []
    for record, own, first in zip(problem.records, late, problem.run_edges, strict=False):
        run = record.measurements
        measured = run.measured + slopes[first : first + own.size] * own[:, None]
        jumps = np.abs(np.diff(run.voltage, prepend=0.0)) > JUMP
        measured[1:][jumps[:-1], 1] = np.nan  # a mean over a sudden change of slope
        records.append(replace(record, measurements=replace(run, measured=measured)))
    return replace(problem, records=tuple(records))


def _reading_slopes(problem: PredictionErrorProblem, point: Estimate) -> Array:
    """(n, 2) change of position and velocity per second, as the sensor shows them."""
    model = point.structure.model(point.values)
    base = problem.initial_nuisance.add_lag(point.nuisance.lag_offset)
    readings = [
        problem.simulate(model, base.add_lag(np.full(len(problem.records), by)))
        for by in (-SLOPE_STEP, SLOPE_STEP)
    ]
    early, late = (np.column_stack((one.expected, one.seen)) for one in readings)
    return np.asarray((early - late) / (2.0 * SLOPE_STEP))


def _deviation_from_even(time: Array) -> Array:
    """(n,) [s] by which samples come later than evenly spaced ones."""
    steps = np.diff(time)
    index = np.concatenate(([0.0], np.cumsum(np.round(steps / np.median(steps)))))
    line = np.polynomial.Polynomial.fit(index, time, 1)
    return np.asarray(time - line(index))


def _again(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """The same values, with other measurements."""
    return problem.evaluate(point.structure, point.values, point.nuisance, point.process_noise)
