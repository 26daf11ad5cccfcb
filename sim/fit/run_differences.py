"""What differs from run to run: the phase of a sensor's frames, and the friction.

A device sends a frame every 20 ms, and a robot program logs the latest one every 20 ms. The age of
a logged frame depends on the times at which the two loops started. It is up to a period, constant
in a run, and different in the next run. A gear warms up, a chain lies differently: the friction of
a run differs by a few percent, too (``random_friction.py``). With one lag and one friction for all
runs, each run is early or late by some milliseconds, or too strong by some millivolts, which biases
kS and kA.

In a ramp the two are nearly the same: friction that is larger by ΔkS delays the motion by ΔkS over
the ramp rate. Only the dynamic tests tell them apart, and the priors. So they compete: no
difference, lags d_i ~ N(0, λ²), frictions δ_i ~ N(0, τ²), or both. λ is the standard deviation of a
uniform distribution over one period. The most likely wins, with d and δ integrated out (Laplace's
approximation):

    -2 log L + Σ (d_i/λ)² + Σ (δ_i/τ)² - log det Φ

Φ is the posterior covariance of all d and δ, divided by the variances of their priors. Where lags
and frictions are about as likely, both stay. The small effects that every mechanism has
(``everyday_effects.py``) compete, too: if they explain the log as well, no run differs. The gains'
errors come from the information with d and δ marginalized, so that what a ramp cannot tell apart
widens them.

Source: N. Laird and J. Ware, "Random-effects models for longitudinal data", Biometrics 38, 1982.
"""

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from sim.core.log import Array
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.optimize import (
    compute_gradient_and_information,
    invert_symmetric,
    levenberg_marquardt,
    make_joint_jacobian,
)
from sim.estimation.random_friction import get_friction_sd
from sim.estimation.run_nuisance import FRICTION, LAG
from sim.fit.everyday_effects import FIRST, WORTH, add_everyday_effects
from sim.fit.search import ROUGHLY, STEPS, drop_outliers, fit_open_loop, fit_tracking, refine

EARLY = 0.2  # [sample periods] by which the estimate of a lag may be negative
UNIFORM = math.sqrt(12.0)  # standard deviations in the width of a uniform distribution
JUMP = 0.5  # [V] a larger change is a step, after which a velocity is not compared
SLOPE_STEP = 1e-4  # [s] to both sides, for the slope of a reading
SHARED = "delay"


def fit_run_differences(
    problem: PredictionErrorProblem,
    point: Estimate,
    *,
    every: PredictionErrorProblem,
    period: float,
) -> tuple[PredictionErrorProblem, Estimate]:
    """Fit a lag, a friction, or both for each run, if it improves the fit enough.

    Args:
        problem: the measurements.
        point: the best estimate without differences between the runs.
        every: the measurements with their outliers: an outlier of a model with one lag may show
            that the runs differ.
        period: [s] time between samples of the log.

    Returns:
        The problem with these differences and the new estimate, or both unchanged if the
        differences do not explain enough.
    """
    lag_sd = period / UNIFORM
    white = problem.whiten(point, point.innovations)
    joint = make_joint_jacobian(problem, point, fine=True)
    lagged = replace(problem, lag_sd=lag_sd)
    hints = (
        joint.compute_improvement(white, lagged.compute_run_jacobian(point, LAG), lag_sd),
        joint.compute_improvement(
            white, problem.compute_run_jacobian(point, FRICTION), get_friction_sd(point.values)
        ),
    )
    if not max(hints) > WORTH:
        return problem, point
    common = fit_tracking(every, point.structure, point.values)
    lags, frictions, both = (
        _fit_differences(replace(every, lag_sd=sd, varying_friction=friction), common, period)
        for sd, friction in ((lag_sd, False), (0.0, True), (lag_sd, True))
    )
    small = _fit_rival(*add_everyday_effects(every, common, first=FIRST))
    unclear = abs(lags.evidence - frictions.evidence) < WORTH
    best = both if unclear else min(lags, frictions, both, key=lambda one: one.evidence)
    if not best.evidence < min(common.cost, small.evidence) - WORTH:
        return problem, point
    extended, tracked = best.problem, best.estimate
    extended = drop_outliers(extended, tracked)
    tracked = levenberg_marquardt(extended, extended.change(tracked), steps=STEPS, enough=ROUGHLY)
    found = fit_open_loop(extended, tracked)
    framed = _correct_jitter(extended, found) if extended.lag_sd else extended
    if framed is extended:
        return extended, found
    regular = refine(framed, framed.change(found))
    if not regular.cost < found.cost - WORTH:
        return extended, found
    framed = _correct_jitter(extended, regular)
    return framed, fit_open_loop(framed, framed.change(regular))


class _Rival(NamedTuple):
    """Runs that may differ in some way: -2 log L with the differences integrated out."""

    evidence: float
    problem: PredictionErrorProblem
    estimate: Estimate


def _fit_rival(problem: PredictionErrorProblem, begin: Estimate) -> _Rival:
    """The best estimate near a start, and its evidence: what has a prior is integrated out."""
    found = levenberg_marquardt(problem, begin, steps=2 * STEPS, enough=ROUGHLY)
    return _Rival(found.cost + _compute_occam_factor(problem, found), problem, found)


def _fit_differences(problem: PredictionErrorProblem, common: Estimate, period: float) -> _Rival:
    """Fit runs that may differ.

    Args:
        problem: the measurements, with the differences that are allowed.
        common: the best estimate without differences.
        period: [s] time between samples of the log.
    """
    if not problem.lag_sd:
        return _fit_rival(problem, problem.change(common))
    found = _fit_rival(problem, _add_shared_lag(problem, common, least=0.5 * period))
    lags = found.estimate.values["delay.lag"] + found.estimate.nuisance.lag_offset
    # a reading cannot be newer than its sample's voltage
    return found._replace(evidence=math.inf) if lags.min() < -EARLY * period else found


def _compute_occam_factor(problem: PredictionErrorProblem, point: Estimate) -> float:
    """-log det Φ, the correction of -2 log L for integrating over what has a prior."""
    _, information = compute_gradient_and_information(problem, point)
    names, runs = point.structure.searched_names, len(problem.records)
    known = problem.select_priors(point.structure)
    _, *own = problem.list_random_effects(point.values).values()  # all rivals have equal starts
    first = len(names) + runs
    chosen = [names.index(name) for name in known] + [*range(first, first + runs * len(own))]
    sds = np.array([*known.values(), *np.repeat(own, runs)])
    posterior = invert_symmetric(information)[np.ix_(chosen, chosen)] / np.outer(sds, sds)
    return -float(np.linalg.slogdet(posterior)[1])


def _add_shared_lag(problem: PredictionErrorProblem, point: Estimate, *, least: float) -> Estimate:
    """The estimate in a model with a common lag of ``least`` [s] or more."""
    structure = point.structure
    if SHARED not in structure.effects:
        structure += SHARED
    values = {**point.values, "delay.lag": max(point.values.get("delay.lag", 0.0), least)}
    return problem.change(point, structure=structure, values=values)


def _correct_jitter(problem: PredictionErrorProblem, point: Estimate) -> PredictionErrorProblem:
    """The measurements corrected for jitter of the loop, if frames are measured at even times.

    A device measures at even times, and the robot program logs the frame a little early or late.
    The jitter is the deviation of the sample times from even ones; a reading is corrected by the
    jitter times the slope that the model has there.
    """
    jitter = [_compute_deviation_from_even(record.measurements.time) for record in problem.records]
    if max(float(np.abs(one).max()) for one in jitter) > 0.5 * problem.lag_sd * UNIFORM:
        return problem
    slopes = _compute_reading_slopes(problem, point)
    records = []
    for record, own, first in zip(problem.records, jitter, problem.run_edges, strict=False):
        run = record.measurements
        measured = run.measured + slopes[first : first + own.size] * own[:, None]
        jumps = np.abs(np.diff(run.voltage, prepend=0.0)) > JUMP
        measured[1:][jumps[:-1], 1] = np.nan  # an average over a sudden change of slope
        records.append(record.change(measured=measured))
    return replace(problem, records=tuple(records))


def _compute_reading_slopes(problem: PredictionErrorProblem, point: Estimate) -> Array:
    """(n, 2) derivative of the simulated readings by time [unit/s, unit/s²]."""
    base = problem.initial_nuisance.add(LAG, point.nuisance.lag_offset)
    steps = (-SLOPE_STEP, SLOPE_STEP)
    readings = [problem.simulate(point.model, base.add(LAG, by)) for by in steps]
    early, late = (np.column_stack((one.expected, one.seen)) for one in readings)
    return np.asarray((early - late) / (2.0 * SLOPE_STEP))


def _compute_deviation_from_even(time: Array) -> Array:
    """(n,) [s] times minus evenly spaced ones."""
    steps = np.diff(time)
    index = np.concatenate(([0.0], np.cumsum(np.round(steps / np.median(steps)))))
    line = np.polynomial.Polynomial.fit(index, time, 1)
    return np.asarray(time - line(index))
