"""Friction that is a little different in every run: a random effect, and no finding.

A gear warms up, a chain lies otherwise, a carpet has a seam: kS of a run is kS + δ, δ ~ N(0, τ²).
With a_r, b_r the square and the product of run r's friction column with the white innovations,

    Σ log(1 + τ² a_r) - τ² b_r²/(1 + τ² a_r)  -  what the values gain by adjusting

is how -2 log L changes, and the likeliest τ is taken. So an effect has to explain more than
what friction of that kind would.
"""

from itertools import pairwise

import numpy as np

from sim.log import Array
from sim.reconcile.problem import Point, Problem

SHARES = (0.0, 0.005, 0.01, 0.02, 0.04, 0.08)
"""[of kS] τ that are tried: more than a tenth of the friction is no accident."""
MOST_VARIED = SHARES[-1]
USUAL = 0.04  # [of kS] by which it varies on most robots
LEAST_KS = 0.05  # [V] of which they are shares where kS is less


def varied(problem: Problem, point: Point) -> float:
    """[of -2 log L] by which friction that varies from run to run makes a point likelier; ≤ 0."""
    columns = problem.columns(point)
    rest = problem.white(point, point.ahead)
    searched = list(point.hypothesis.searched)
    friction = columns[:, searched.index("kS")] = _by_friction(problem, point)
    edges = (2 * problem.edges).tolist()
    runs = [slice(*pair) for pair in pairwise(edges)]
    square = np.array([friction[run] @ friction[run] for run in runs])
    product = np.array([friction[run] @ rest[run] for run in runs])
    size = np.linalg.norm(columns, axis=0)
    size[size == 0.0] = 1.0
    table = columns / size
    full = table.T @ table + 1e-9 * np.eye(size.size)
    across = np.array([table[run].T @ friction[run] for run in runs])
    slope = table.T @ rest
    kept = max(point.values["kS"], LEAST_KS)
    changes = [_changed(share * kept, square, product, across, full, slope) for share in SHARES]
    return min(changes) - changes[0]


def _by_friction(problem: Problem, point: Point) -> Array:
    """(2 n,) change of the white innovations with friction, of the size by which it varies.

    A run that is about to move begins a sample sooner or later with hardly less friction: what a
    smaller step shows is whether it is about to.
    """
    kept = point.values["kS"]
    step = USUAL * max(kept, LEAST_KS)
    ends = (kept + step, max(kept - step, 0.0))
    more, less = (
        problem.ahead(
            point.hypothesis.model({**point.values, "kS": one}), point.outset, point.trust
        )
        for one in ends
    )
    return problem.white(point, (more - less) / (ends[0] - ends[1]))


def _changed(  # noqa: PLR0917 - an equation in six symbols
    tau: float, square: Array, product: Array, across: Array, full: Array, slope: Array
) -> float:
    """-2 log L for one τ, up to a constant, after the values have adjusted."""
    weight = tau**2 / (1.0 + tau**2 * square)
    told = full - (across.T * weight) @ across
    left = slope - across.T @ (weight * product)
    adjusted = float(left @ np.linalg.solve(told, left))
    return float(np.sum(np.log1p(tau**2 * square)) - np.sum(weight * product**2) - adjusted)
