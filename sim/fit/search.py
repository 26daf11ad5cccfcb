"""The search for the gains of a log: first with a large, then with the likeliest process noise.

With a large process noise the model predicts only a few samples ahead, and the search converges
easily. With a small one it simulates whole runs, which determines the gains better.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from sim.core.log import Array, Log
from sim.core.units import ROBUST
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.measurements import RunMeasurements, merge_stale_samples
from sim.estimation.model_structure import ModelStructure
from sim.estimation.optimize import JointJacobian, levenberg_marquardt, tune_process_noise
from sim.estimation.run_records import make_separate_records

SLACK = 0.02  # [m or rad] backlash of a gear or a chain, which is not in the model
TRACKING = 1.0  # [1/s] q over the velocity variance of a first search
OPEN_LOOP = 1e-7  # [1/s] the same of an almost open-loop simulation
BETWEEN = (1e-4, 1e-2)  # [1/s] other values, which are the likeliest for some models
COARSE = 100.0  # [1] factor by which q shrinks
MOST_ROUNDS = 8  # of a shrinking q
STEPS = 8  # of a search, at most
ENOUGH = 0.05  # [of -2 log L] a step that gains less ends a search
ROUGHLY = 5.0  # [of -2 log L] the same of a first search
OUTLIER = 6.0  # [standard deviations] a larger innovation is an outlier
START = 0.15  # [s] of a motion in which there are no outliers: about two time constants
AROUND = 2  # samples on both sides of an outlier, which are dropped with it


def make_fit_problem(log: Log, measured: Sequence[RunMeasurements]) -> PredictionErrorProblem:
    """The estimation problem of a log's runs as independent records, for gains and lags.

    Args:
        log: the runs.
        measured: the measurements of each run that has enough samples.
    """
    records = make_separate_records(log, [merge_stale_samples(one) for one in measured])
    problem = PredictionErrorProblem.from_records(records)
    return replace(problem, varying_friction=False, backlash_allowance=SLACK)


def fit_tracking(
    problem: PredictionErrorProblem,
    structure: ModelStructure,
    values: Mapping[str, float],
    *,
    steps: int = STEPS,
) -> Estimate:
    """Fit from a first guess, with process noise that equals the sensor noise in a second.

    Args:
        problem: the measurements.
        structure: the model structure.
        values: value of each of its parameters, the guess.
        steps: the largest number of steps.

    Returns:
        The estimate; the guess with an infinite cost if it cannot be simulated.
    """
    q = TRACKING * problem.noise.velocity**2
    point = problem.evaluate(structure, values, problem.initial_nuisance, q)
    return levenberg_marquardt(problem, point, steps=steps, enough=ROUGHLY)


def fit_open_loop(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """Fit with the likeliest process noise, from a tracking fit.

    A correct model is likeliest with almost no process noise, an incomplete one with more. The
    likelihood may have a minimum between the two, so almost no noise is tried first. If that is
    less likely, the noise is reduced in steps as long as the likelihood grows.
    """
    size = problem.noise.velocity**2
    open_loop = refine(problem, problem.change(point, process_noise=OPEN_LOOP * size))
    if open_loop.cost < point.cost:
        others = [problem.change(open_loop, process_noise=q * size) for q in BETWEEN]
        best = tune_process_noise(problem, min(open_loop, *others, key=lambda one: one.cost))
        return best if best is open_loop else refine(problem, best)
    for _ in range(MOST_ROUNDS):
        other = problem.change(point, process_noise=point.process_noise / COARSE)
        other = levenberg_marquardt(problem, other, steps=1)
        if not other.cost < point.cost - 0.5:
            break
        point = other
    return refine(problem, tune_process_noise(problem, point))


def refine(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """The estimate after a search to convergence, with unchanged process noise."""
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
        more: each ``effect.parameter`` with its value, in SI.
        kept: the joint Jacobian at the estimate.
    """
    square = kept.compute_residual_square(problem.whiten(point, point.innovations))
    gains = []
    for name, value in more:
        structure = point.structure + name.partition(".")[0]
        values = {**point.values, name: value}
        other = problem.change(point, structure=structure, values=values)
        gains.append(
            square - kept.compute_residual_square(problem.whiten(point, other.innovations))
        )
    return np.array(gains)


def drop_outliers(problem: PredictionErrorProblem, point: Estimate) -> PredictionErrorProblem:
    """The problem without its outliers and the samples around them.

    A stop that was hit, a chain that slipped, a voltage that was not applied: one such event may
    weigh more than all other samples. The Kalman filter still uses the dropped samples.
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
        # a start determines kA, and a large innovation there is more likely an error of the model
        own[run.time < run.time[int(np.argmax(run.moving))] + START] = False
        wide = np.convolve(own, np.ones(2 * AROUND + 1), mode="same")[: run.time.size] > 0.0
        kept.append(record.change(informative=run.informative & ~wide))
    same = all(
        np.array_equal(one.measurements.informative, other.measurements.informative)
        for one, other in zip(kept, problem.records, strict=True)
    )
    return problem if same else replace(problem, records=tuple(kept))
