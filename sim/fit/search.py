"""The search for the gains of a log: first looking a little ahead, then with the likeliest noise.

A search with a large process noise predicts only a little ahead and is not easily led astray; with
a small one it simulates whole runs and knows more.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from sim.core.log import Array, Log
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.measurements import ROBUST, RunMeasurements, merge_stale_samples
from sim.estimation.model_structure import ModelStructure
from sim.estimation.optimize import JointJacobian, levenberg_marquardt, tune_process_noise
from sim.estimation.run_records import make_separate_records

SLACK = 0.02  # [m or rad] of a gear or a chain, which kS, kV and kA do not describe
TRACKING = 1.0  # [1/s] q over the variance of a velocity: it moves by its noise in a second
OPEN_LOOP = 1e-7  # [1/s] the same where a simulation is all but left to itself
BETWEEN = (1e-4, 1e-2)  # [1/s] the same where some models are likeliest
COARSE = 100.0  # [1] steps of q
FARTHEST = 8  # steps of q in one round
STEPS = 8  # of the gains in one round
ENOUGH = 0.05  # [of -2 log L] a step that gains less ends a search
ROUGHLY = 5.0  # [of -2 log L] the same of a first search
OUTLIER = 6.0  # [standard deviations] farther than this no noise goes
START = 0.15  # [s] of a motion in which nothing is left out: about two time constants
AROUND = 2  # samples on both sides of an outlier


def make_fit_problem(log: Log, measured: Sequence[RunMeasurements]) -> PredictionErrorProblem:
    """The estimation problem of a log's runs, each by itself, for gains and lags.

    Args:
        log: the runs.
        measured: of those with enough samples, the measurements.
    """
    records = make_separate_records(log, [merge_stale_samples(one) for one in measured])
    return PredictionErrorProblem.from_records(
        records, varying_friction=False, backlash_allowance=SLACK
    )


def fit_tracking(
    problem: PredictionErrorProblem,
    structure: ModelStructure,
    values: Mapping[str, float],
    *,
    steps: int = STEPS,
) -> Estimate:
    """Fit from a first guess, with process noise as large as the sensor noise each second.

    Args:
        problem: the measurements.
        structure: the parameters.
        values: the guess.
        steps: of the search, at most.

    Returns:
        The estimate; where nothing can be simulated from the guess, the guess, at an infinite cost.
    """
    q = TRACKING * problem.noise.velocity**2
    point = problem.evaluate(structure, values, problem.initial_nuisance, q)
    return levenberg_marquardt(problem, point, steps=steps, enough=ROUGHLY)


def fit_open_loop(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """Fit with the likeliest process noise, from a tracking fit.

    Either a model holds, and is likeliest with next to no process noise, or something is missing
    from it. On the way from one to the other it may be less likely than at both ends, so the far
    end is tried first. Failing that, the noise shrinks as long as that is likelier.
    """
    size = problem.noise.velocity**2
    deep = refine(problem, _with_noise(problem, point, OPEN_LOOP * size))
    if deep.cost < point.cost:
        others = [_with_noise(problem, deep, q * size) for q in BETWEEN]
        best = tune_process_noise(problem, min(deep, *others, key=lambda one: one.cost))
        return best if best is deep else refine(problem, best)
    for _ in range(FARTHEST):
        other = _with_noise(problem, point, point.process_noise / COARSE)
        other = levenberg_marquardt(problem, other, steps=1)
        if not other.cost < point.cost - 0.5:
            break
        point = other
    return refine(problem, tune_process_noise(problem, point))


def refine(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """Fit again with unchanged process noise."""
    return levenberg_marquardt(problem, point, steps=STEPS, enough=ENOUGH)


def predict_improvement(
    problem: PredictionErrorProblem,
    point: Estimate,
    more: Sequence[tuple[str, float]],
    *,
    kept: JointJacobian,
) -> Array:
    """(more,) predicted decrease of -2 log L if one further parameter is added, to second order.

    Args:
        problem: the measurements.
        point: the best estimate without them.
        more: ``effect.parameter`` and its value.
        kept: the joint Jacobian at the estimate.
    """
    now = kept.compute_residual_square(problem.whiten(point, point.innovations))
    gains = []
    for name, value in more:
        structure = point.structure + name.partition(".")[0]
        values = {**point.values, name: value}
        other = problem.evaluate(structure, values, point.nuisance, point.process_noise)
        gains.append(now - kept.compute_residual_square(problem.whiten(point, other.innovations)))
    return np.array(gains)


def drop_outliers(problem: PredictionErrorProblem, point: Estimate) -> PredictionErrorProblem:
    """The problem without its outliers and the samples around them.

    A stop that was hit, a tooth that slipped, a voltage that was not applied: one such moment may
    weigh more than all the rest. These measurements still keep the simulation on course.
    """
    size = np.array(
        [
            ROBUST * float(np.median(np.abs(errors[~ignored]))) if not ignored.all() else np.inf
            for errors, ignored in zip(point.innovations.T, problem.ignored_readings.T, strict=True)
        ]
    )
    outlying = np.abs(point.innovations) > OUTLIER * np.maximum(size, problem.noise.resolution)
    far = outlying.any(axis=1)
    kept = []
    for record, first in zip(problem.records, problem.run_edges, strict=False):
        run = record.measurements
        own = far[first : first + run.time.size].copy()
        # a start is what shows inertia: there an outlier is more likely the model's
        own[run.time < run.time[int(np.argmax(run.moving))] + START] = False
        wide = np.convolve(own, np.ones(2 * AROUND + 1), mode="same")[: run.time.size] > 0.0
        kept.append(replace(record, measurements=replace(run, informative=run.informative & ~wide)))
    same = all(
        np.array_equal(one.measurements.informative, other.measurements.informative)
        for one, other in zip(kept, problem.records, strict=True)
    )
    return problem if same else replace(problem, records=tuple(kept))


def _with_noise(problem: PredictionErrorProblem, point: Estimate, q: float) -> Estimate:
    return problem.evaluate(point.structure, point.values, point.nuisance, q)
