"""The search of method output-error: gains whose innovations are as small as noise allows.

Levenberg and Marquardt's steps on innovations made white by Σ, in turn with a line search for the
size q of what pushes at random. Derivatives are differences of simulations.
"""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from sim.fit.problem import FLOOR, POSITIVE, Point, Problem, white
from sim.log import Array

__all__ = [
    "Point",
    "Problem",
    "better",
    "covariance",
    "far",
    "near",
    "promise",
    "white",
]

ANEW = 1.0  # [1/s] q over the variance of a velocity: what pushes moves it by its noise in a second
COARSE, FINE = 100.0, 4.0  # [1] steps of q
FARTHEST = 8  # steps of q in one round
STEPS = 8  # of the gains in one round
CEILING = {"window": 0.9, "lag": 0.45}  # [s] later than this nothing on a robot answers
HARDLY = 1e-11  # [1] of a combination of values that the log says anything about
NOTHING = 1e-20  # [1] what it says of the rest


def near(problem: Problem, values: Mapping[str, float]) -> Point:
    """The best point from a first guess, if each second may go its own way by as much as noise.

    There the search looks only a little ahead at a time, and is not easily led astray.

    Returns:
        The point; where nothing can be simulated from the guess, the guess, at an infinite cost.
    """
    q = ANEW * problem.noise.velocity**2
    point = problem.at(values, np.zeros(len(problem.seen)), q)
    if not math.isfinite(point.cost):
        return point
    return better(problem, point, steps=STEPS, enough=5.0)


def far(problem: Problem, point: Point) -> Point:
    """The best point, from a near one: less and less is pardoned, as long as that is likelier."""
    for _ in range(FARTHEST):
        other = problem.at(point.values, point.starts, point.q / COARSE)
        other = better(problem, other, steps=1, enough=1.0)
        if not other.cost < point.cost - 0.5:
            break
        point = other
    return _finished(problem, point)


def promise(problem: Problem, point: Point, more: Sequence[Mapping[str, float]]) -> Array:
    """(more,) [of -2 log L] what other values may gain once the point's own have adjusted to them.

    Args:
        problem: what is searched.
        point: a best point.
        more: values to add, one set after another.
    """
    kept, _ = np.linalg.qr(problem.columns(point))

    def left(ahead: Array) -> float:
        rest = white(problem, point, ahead)
        return float(rest @ rest - np.sum((kept.T @ rest) ** 2))

    now = left(point.ahead)
    tried = (problem.at({**point.values, **one}, point.starts, point.q) for one in more)
    return np.array([now - left(other.ahead) for other in tried])


def again(problem: Problem, point: Point) -> Point:
    """The best point from one to which something was added; its q stays."""
    return better(problem, point, steps=STEPS, enough=0.05)


def _finished(problem: Problem, point: Point) -> Point:
    """The best point near one: q to a factor of ``FINE``, then the values."""
    for way in (FINE, 1.0 / FINE):
        other = problem.at(point.values, point.starts, point.q * way)
        while other.cost < point.cost - 0.1:
            point = other
            other = problem.at(point.values, point.starts, point.q * way)
    return better(problem, point, steps=STEPS, enough=0.05)


def covariance(problem: Problem, point: Point, *, starts: bool = False) -> Array:
    """(values, values) of the values, whatever the starts; with them, where asked for."""
    columns = problem.columns(point, fine=True)
    square = columns.T @ columns + np.diag(_beside(problem, point))
    size = np.sqrt(np.maximum(np.diag(square), 1e-100))
    told, ways = np.linalg.eigh(square / np.outer(size, size))
    # what nothing tells apart has an error without end, not none
    inverse = (ways / np.where(told > HARDLY, told, NOTHING)) @ ways.T / np.outer(size, size)
    count = None if starts else len(point.values)
    return np.asarray(inverse[:count, :count])


def better(problem: Problem, point: Point, *, steps: int, enough: float) -> Point:
    """The point after some steps of the values, fewer when one gains hardly anything.

    Args:
        problem: what is searched.
        point: where it begins; its q stays.
        steps: at most.
        enough: [of -2 log L] what a step must gain for another.
    """
    names = list(point.values)
    damping = 1e-4
    for _ in range(steps):
        table, rest = problem.columns(point), white(problem, point, point.ahead)
        beside = _beside(problem, point)
        size = np.linalg.norm(table, axis=0)
        size[size == 0.0] = 1.0
        table = table / size
        square = table.T @ table + np.diag(beside / size**2)
        slope = table.T @ rest
        slope[len(names) :] += (beside / size)[len(names) :] * point.starts
        better = point
        for _ in range(6):
            move = -np.linalg.solve(square + damping * np.eye(slope.size), slope) / size
            values = _stepped(point.values, move)
            starts = point.starts + move[len(names) :]
            moved = problem.at(values, starts, point.q)
            if moved.cost < point.cost:
                better, damping = moved, max(damping / 10.0, 1e-9)
                break
            damping *= 10.0
        gained, point = point.cost - better.cost, better
        if not gained > enough:
            break
    return point


def _beside(problem: Problem, point: Point) -> Array:
    """(values + runs,) what is known of each beside the measurements: 1/variance."""
    return np.repeat([0.0, problem.aside**-2.0], [len(point.values), point.starts.size])


def _stepped(values: Mapping[str, float], move: Array) -> dict[str, float]:
    """The values after a step, kept where they are physics."""
    after = {}
    for (name, value), by in zip(values.items(), move.tolist(), strict=False):
        if name in POSITIVE:  # at most a factor of three at once
            after[name] = value * min(max(1.0 + by / value, 1.0 / 3.0), 3.0)
        else:
            low, high = FLOOR.get(name, -math.inf), CEILING.get(name, math.inf)
            after[name] = min(max(value + by, low), high)
    return after
