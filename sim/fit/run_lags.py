"""A lag of each run's own: the phase of a sensor's frames against the loop that logs them.

A device sends a frame every 20 ms, and a robot program logs the latest one every 20 ms. How old it
is then depends on when each of them was started: up to a period, the same throughout a run, and
another in the next, because a routine begins in any loop. One lag for all runs leaves each of them
early or late by some milliseconds, which kS and kA take up.

The lag of run i is that of all runs plus d_i ~ N(0, λ²). λ is the standard deviation of an age
that is anything between nothing and a period. Whether the runs differ is decided by their
likelihood with the d_i integrated out (Laplace's approximation):

    -2 log L - Σ (d_i/λ)² - Σ log(1 + λ² a_i)        a_i the square of how innovations change with d_i

Source: N. Laird and J. Ware, "Random-effects models for longitudinal data", Biometrics 38, 1982.
"""

import math
from dataclasses import replace

import numpy as np

from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.optimize import levenberg_marquardt
from sim.fit.everyday_effects import promised_improvement
from sim.fit.search import ROUGHLY, STEPS, drop_outliers, fit_open_loop, fit_tracking

WORTH = 8.0  # [of -2 log L] what they must explain together to be believed
UNIFORM = math.sqrt(12.0)  # standard deviations in the width of an even distribution
SHARED = "delay"


def fit_run_lags(
    problem: PredictionErrorProblem, point: Estimate, *, every: PredictionErrorProblem, period: float
) -> tuple[PredictionErrorProblem, Estimate]:
    """Fit a lag for each run, where the data ask for it.

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
    begin = _with_shared_lag(extended, point, least=0.0)
    if not promised_improvement(extended, begin) > WORTH:
        return problem, point
    alike = fit_tracking(every, point.structure, point.values)
    extended = replace(every, lag_sd=period / UNIFORM)
    begin = _with_shared_lag(extended, alike, least=0.5 * period)
    tracked = levenberg_marquardt(extended, begin, steps=2 * STEPS, enough=ROUGHLY)
    if not tracked.cost + laplace_correction(extended, tracked) < alike.cost - WORTH:
        return problem, point
    extended = drop_outliers(extended, tracked)
    tracked = levenberg_marquardt(extended, _again(extended, tracked), steps=STEPS, enough=ROUGHLY)
    return extended, fit_open_loop(extended, tracked)


def laplace_correction(problem: PredictionErrorProblem, point: Estimate) -> float:
    """[of -2 log L] Laplace correction for integrating over the runs' own lags."""
    slopes = np.sum(np.square(problem.lag_jacobian(point)), axis=0)
    return float(np.sum(np.log1p(problem.lag_sd**2 * slopes)))


def _with_shared_lag(
    problem: PredictionErrorProblem, point: Estimate, *, least: float
) -> Estimate:
    """The estimate in a model that has a lag, of ``least`` [s] or more, so that runs may differ."""
    structure = point.structure
    if SHARED not in structure.effects:
        structure += SHARED
    values = {**point.values, "delay.lag": max(point.values.get("delay.lag", 0.0), least)}
    return problem.evaluate(structure, values, point.nuisance, point.process_noise)


def _again(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """The same values, with other measurements."""
    return problem.evaluate(point.structure, point.values, point.nuisance, point.process_noise)
