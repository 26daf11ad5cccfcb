"""Where in its free play each run began: nothing tells, but how it went on.

Teeth that rest on one another push at once, others first cross the slack and then meet; which it
is, is left from whatever was before the run.
"""

import math

import numpy as np

from sim.log import Array
from sim.reconcile.problem import Point, Problem

PLACES = (-1.0, -0.5, 0.0, 0.5, 1.0)  # [1] of half the play
FINER = 0.2  # [1] to both sides of the place that was the best one
PRICE = 2.0 * math.log(len(PLACES))  # [of -2 log L] of telling where


def meshed(problem: Problem, point: Point) -> Point:
    """The same values, each run begun where it follows best; the same point without free play."""
    if not point.hypothesis.plays or not math.isfinite(point.cost):
        return point
    before = point.outset.meshed
    if np.isnan(before).all():
        others = [np.full(before.size, place) for place in PLACES]
    else:
        others = [np.clip(before + by, -1.0, 1.0) for by in (-FINER, FINER)]
    model = point.hypothesis.model(point.values)
    costs = [_costs(problem, point, point.ahead, before)]
    for each in others:
        ahead = problem.ahead(model, point.outset.meshing(each), point.trust)
        costs.append(_costs(problem, point, ahead, each))
    tried, chosen = np.stack([before, *others]), np.argmin(np.stack(costs), axis=0)
    if not chosen.any():
        return point
    outset = point.outset.meshing(tried[chosen, np.arange(before.size)])
    found = problem.at(point.hypothesis, point.values, outset, point.q)
    return found if found.cost + price(found) < point.cost + price(point) else point


def _costs(problem: Problem, point: Point, ahead: Array, meshed: Array) -> Array:
    """(runs,) what the innovations of each cost, by the spread at a point, and what was told."""
    squares = np.square(problem.white(point, ahead)).reshape(-1, 2).sum(axis=1)
    costs: Array = np.add.reduceat(squares, problem.edges[:-1]) + PRICE * ~np.isnan(meshed)
    return costs


def price(point: Point) -> float:
    """[of -2 log L] of what was told of where its runs began."""
    return PRICE * float(np.count_nonzero(~np.isnan(point.outset.meshed)))
