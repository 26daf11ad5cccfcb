"""Levenberg–Marquardt search for the most likely gains and process noise.

Levenberg and Marquardt's steps on innovations made white by Σ, in turn with a line search for the
size q of what pushes at random. Derivatives are differences of simulations.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from sim.data.log import Array
from sim.fit.likelihood import FLOOR, POSITIVE, Estimate, PredictionErrorProblem, whiten

__all__ = [
    "Estimate",
    "PredictionErrorProblem",
    "estimate_covariance",
    "fit_open_loop",
    "fit_tracking",
    "levenberg_marquardt",
    "predicted_improvement",
    "whiten",
]

ANEW = 1.0  # [1/s] q over the variance of a velocity: what pushes moves it by its noise in a second
DEEP = 1e-7  # [1/s] the same where a simulation is all but left to itself
BETWEEN = (1e-4, 1e-2)  # [1/s] the same where some models are likeliest
COARSE, FINE = 100.0, 4.0  # [1] steps of q
FARTHEST = 8  # steps of q in one round
DAMPING, LEAST_DAMPING = 1e-6, 1e-9  # [1] of a step, first and at least
TRIALS = 8  # of a step, each with ten times the damping
STEPS = 8  # of the gains in one round
CEILING = {"window": 0.9, "lag": 0.45}  # [s] later than this nothing on a robot answers
LITTLE = 0.3  # [share of the squares] that a step takes away near the end of its way
HARDLY = 1e-11  # [1] of a combination of values that the log says anything about
NOTHING = 1e-20  # [1] what it says of the rest


def fit_tracking(problem: PredictionErrorProblem, values: Mapping[str, float]) -> Estimate:
    """Fit from a first guess, with process noise as large as the sensor noise each second.

    There the search looks only a little ahead at a time, and is not easily led astray. Where a run
    began is soon forgotten, so that is left as it is seen.

    Returns:
        The point; where nothing can be simulated from the guess, the guess, at an infinite cost.
    """
    q = ANEW * problem.noise.velocity**2
    point = problem.at(values, np.zeros(len(problem.runs)), q)
    if not math.isfinite(point.cost):
        return point
    return levenberg_marquardt(problem, point, steps=STEPS, enough=5.0, starts=False)


def fit_open_loop(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """Fit with the likeliest process noise, from a tracking fit.

    Either a model holds, and is likeliest where next to nothing is pardoned, or something is
    missing from it. On the way from one to the other it may be less likely than at both ends, so
    the far end is tried first. Failing that less and less is pardoned, as long as that is likelier.
    """
    size = problem.noise.velocity**2
    deep = problem.at(point.values, point.position_offsets, DEEP * size)
    deep = levenberg_marquardt(problem, deep, steps=STEPS, enough=0.05, goal=point.cost)
    if deep.cost < point.cost:
        others = [problem.at(deep.values, deep.position_offsets, q * size) for q in BETWEEN]
        best = _with_best_process_noise(problem, min(deep, *others, key=lambda one: one.cost))
        return (
            best if best is deep else levenberg_marquardt(problem, best, steps=STEPS, enough=0.05)
        )
    for _ in range(FARTHEST):
        other = problem.at(point.values, point.position_offsets, point.process_noise / COARSE)
        other = levenberg_marquardt(problem, other, steps=1, enough=1.0)
        if not other.cost < point.cost - 0.5:
            break
        point = other
    return levenberg_marquardt(
        problem, _with_best_process_noise(problem, point), steps=STEPS, enough=0.05
    )


def predicted_improvement(
    problem: PredictionErrorProblem, point: Estimate, more: Sequence[Mapping[str, float]]
) -> Array:
    """(more,) [of -2 log L] gain of further parameters, to second order, all others adjusted.

    Args:
        problem: what is searched.
        point: a best point, with slopes.
        more: values to add, one set after another.
    """
    table = point.jacobian
    size = np.linalg.norm(table, axis=0)
    size[size == 0.0] = 1.0
    adjusts = np.linalg.pinv(table.T @ table / np.outer(size, size), HARDLY, hermitian=True)

    def left(ahead: Array) -> float:
        rest = whiten(point, ahead)
        slope = table.T @ rest / size
        return float(rest @ rest - slope @ adjusts @ slope)

    now = left(point.innovations)
    tried = (
        problem.at({**point.values, **one}, point.position_offsets, point.process_noise)
        for one in more
    )
    return np.array([now - left(other.innovations) for other in tried])


def refine(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """Fit again after a parameter was added, with unchanged process noise."""
    return levenberg_marquardt(problem, point, steps=STEPS, enough=0.05)


def _with_best_process_noise(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """The same values with the likeliest process noise, to a factor of ``FINE``."""
    for way in (FINE, 1.0 / FINE):
        other = problem.at(point.values, point.position_offsets, point.process_noise * way)
        while other.cost < point.cost - 0.5:
            point = other
            other = problem.at(point.values, point.position_offsets, point.process_noise * way)
    return point


def estimate_covariance(
    problem: PredictionErrorProblem, point: Estimate, *, starts: bool = False
) -> Array:
    """(values, values) covariance of the parameters, with the start positions marginalized.

    Args:
        problem: what was searched.
        point: the best point, with fine slopes.
        starts: whether to add rows and columns for them.
    """
    columns = point.jacobian
    square = columns.T @ columns + np.diag(_prior_information(problem, point))
    size = np.sqrt(np.maximum(np.diag(square), 1e-100))
    told, ways = np.linalg.eigh(square / np.outer(size, size))
    # what nothing tells apart has an error without end, not none
    inverse = (ways / np.where(told > HARDLY, told, NOTHING)) @ ways.T / np.outer(size, size)
    count = None if starts else len(point.values)
    return np.asarray(inverse[:count, :count])


def levenberg_marquardt(
    problem: PredictionErrorProblem, point: Estimate, *, steps: int, enough: float,
    goal: float = math.inf, starts: bool = True,
) -> Estimate:  # fmt: skip
    """Levenberg–Marquardt steps until the gain per step is small.

    Args:
        problem: what is searched.
        point: where it begins; its q stays.
        steps: at most.
        enough: [of -2 log L] what a step must gain for another; one that gains what was foretold
            has arrived.
        goal: a cost that is to be beaten; it gives up when that is out of reach.
        starts: whether they are searched, too.
    """
    damping = DAMPING
    for _ in range(steps):
        point = problem.sloped(point, starts=starts)
        table, rest = point.jacobian, whiten(point, point.innovations)
        size = np.linalg.norm(table, axis=0)
        size[size == 0.0] = 1.0
        beside = _prior_information(problem, point)[: size.size] / size**2
        square = (table.T @ table) / np.outer(size, size) + np.diag(beside)
        slope = table.T @ rest / size
        if starts:
            slope[len(point.values) :] += (beside * size)[
                len(point.values) :
            ] * point.position_offsets
        before = point
        for _ in range(TRIALS):
            way = -np.linalg.solve(square + damping * np.eye(slope.size), slope)
            foretold = -float(way @ slope)
            if _converged_far_from_goal(point, foretold, rest, goal):
                return point
            point = _try_step(problem, before, way / size)
            if point is not before:
                damping = max(damping / 10.0, LEAST_DAMPING)
                break
            damping *= 10.0
        gained = before.cost - point.cost
        arrived = damping <= DAMPING and abs(gained - foretold) < enough
        if not gained > enough or arrived:
            break
    return point


def _try_step(problem: PredictionErrorProblem, point: Estimate, by: Array) -> Estimate:
    """The estimate after a step, if it is better; its Jacobian is reused."""
    count = len(point.values)
    by = by * _step_limit(point.values, by)
    starts = point.position_offsets + by[count:] if by.size > count else point.position_offsets
    moved = problem.at(_take_step(point.values, by), starts, point.process_noise)
    if not moved.cost < point.cost:
        return point
    return replace(moved, jacobian=point.jacobian, begun=point.begun)


def _step_limit(values: Mapping[str, float], by: Array) -> float:
    """The share of a step that changes positive parameters by at most a factor of three."""
    ratios = [
        change / value
        for (name, value), change in zip(values.items(), by.tolist(), strict=False)
        if name in POSITIVE
    ]
    return float(1.0 / max(1.0, max(ratios) / 2.0, -min(ratios) * 1.5))


def _converged_far_from_goal(point: Estimate, foretold: float, rest: Array, goal: float) -> bool:
    """Whether an estimate has converged and is still far from its goal.

    While much of the squares would go at once, what is foretold is only the beginning.
    """
    share = foretold / max(float(rest @ rest), 1e-300)
    return share < LITTLE and point.cost + 3.0 * rest.size * math.log1p(-share) > goal


def _prior_information(problem: PredictionErrorProblem, point: Estimate) -> Array:
    """(values + runs,) prior information on each parameter: 1/variance."""
    return np.repeat([0.0, problem.aside**-2.0], [len(point.values), point.position_offsets.size])


def _take_step(values: Mapping[str, float], by: Array) -> dict[str, float]:
    """The values after a step, kept physical."""
    after = {}
    for (name, value), change in zip(values.items(), by.tolist(), strict=False):
        low, high = FLOOR.get(name, -math.inf), CEILING.get(name, math.inf)
        after[name] = min(max(value + change, low), high)
    return after
