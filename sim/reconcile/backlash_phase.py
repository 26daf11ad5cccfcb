"""Estimates where in its backlash each run started.

If the gear teeth touch, the motor pushes at once; if not, it first crosses the backlash. Where a
run starts depends on the motion before it, which is not recorded.
"""

import math
from dataclasses import replace

import numpy as np

from sim.core.log import Array
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.run_nuisance import RunNuisance

FIRST_PHASES = (-1.0, -0.5, 0.0, 0.5, 1.0)  # [half the free play]
PHASE_STEP = 0.2  # [half the free play] to both sides of a phase that is refined


def estimate_backlash_phase(
    problem: PredictionErrorProblem, point: Estimate, *, ends_only: bool = False
) -> Estimate:
    """The estimate with the likeliest backlash phase of each run.

    Args:
        problem: the measurements.
        point: the estimate, which is returned unchanged if its model has no backlash.
        ends_only: whether to try only the two ends of the backlash first, which is faster.
    """
    if not point.structure.has_backlash or not math.isfinite(point.cost):
        return point
    old = point.nuisance
    before = old.backlash_phase
    if not old.has_backlash_phase:
        phases = FIRST_PHASES[:: len(FIRST_PHASES) - 1] if ends_only else FIRST_PHASES
        others = [np.full(before.size, phase) for phase in phases]
    else:
        others = [
            np.where(np.isnan(before), math.copysign(1.0, by), np.clip(before + by, -1.0, 1.0))
            for by in (-PHASE_STEP, PHASE_STEP)
        ]
    costs = [_compute_costs_by_run(problem, point, point.innovations, old)]
    for each in others:
        other = replace(old, backlash_phase=each)
        innovations = problem.predict_errors(point.model, other, point.kalman_filter)
        costs.append(_compute_costs_by_run(problem, point, innovations, other))
    tried, chosen = np.stack([before, *others]), np.argmin(np.stack(costs), axis=0)
    if not chosen.any():
        return point
    nuisance = replace(old, backlash_phase=tried[chosen, np.arange(before.size)])
    found = problem.change(point, nuisance=nuisance)
    return min(point, found, key=lambda one: one.cost)


def halve_backlash(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """The estimate with half the backlash, and a new start of each run between the teeth."""
    halves = {name: 0.5 * point.values[name] for name in point.structure.backlash_names}
    values, nuisance = {**point.values, **halves}, point.nuisance.without_backlash_phase
    start = problem.change(point, values=values, nuisance=nuisance)
    return estimate_backlash_phase(problem, start)


def _compute_costs_by_run(
    problem: PredictionErrorProblem, point: Estimate, innovations: Array, nuisance: RunNuisance
) -> Array:
    """(runs,) -2 log L of each run's innovations, with the prior of its backlash phase."""
    squares = np.square(problem.whiten(point, innovations)).reshape(-1, 2).sum(axis=1)
    costs: Array = np.add.reduceat(squares, problem.run_edges[:-1]) + nuisance.backlash_phase_costs
    return costs


def reverses_within_run(problem: PredictionErrorProblem) -> bool:
    """Whether a run moves in both directions, and so crosses all of a backlash."""
    signs = [
        np.sign(problem.measured[rows, 1][problem.moving[rows]]) for rows in problem.run_slices
    ]
    return any((one > 0.0).any() and (one < 0.0).any() for one in signs)
