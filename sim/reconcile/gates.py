"""The gap on runs that a fit has not seen: what a new effect has to narrow."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from sim.engine import NO_TRUST
from sim.log import Array
from sim.reconcile.descent import better
from sim.reconcile.friction import LEAST_KS, MOST_VARIED
from sim.reconcile.outset import Outset
from sim.reconcile.problem import Point, Problem

REFIT = 4  # steps


@dataclass(frozen=True)
class Gap:
    """Simulation without correction against measurement.

    Args:
        velocity: [unit/s] root mean square.
        position: [unit] the same.
    """

    velocity: float
    position: float


@dataclass(frozen=True, eq=False)
class Fold:
    """Runs to fit, and runs to predict.

    Args:
        fitted: places among a problem's runs.
        predicted: the same.
    """

    fitted: tuple[int, ...]
    predicted: tuple[int, ...]


def folds(sessions: Sequence[int]) -> tuple[Fold, ...]:
    """What is fitted to predict what.

    With two logs the first predicts the second; with one, each run is predicted by the others.

    Args:
        sessions: (runs,) the log of each.
    """
    every = range(len(sessions))
    if len(set(sessions)) > 1:
        first = min(sessions)
        return (
            Fold(
                tuple(n for n in every if sessions[n] == first),
                tuple(n for n in every if sessions[n] != first),
            ),
        )
    return tuple(Fold(tuple(m for m in every if m != n), (n,)) for n in every)


def outside(problem: Problem, point: Point, parts: Sequence[Fold]) -> Gap:
    """The gap of a hypothesis on runs that its values were not fitted to."""
    errors = [np.empty((0, 2))]
    for part in parts:
        if not (_tells(problem, part.fitted) and _tells(problem, part.predicted)):
            continue
        fitted = _some(problem, part.fitted)
        begin = fitted.at(point.hypothesis, point.values, point.outset.of(part.fitted), point.q)
        found = better(fitted, begin, steps=REFIT)
        errors.append(
            errors_of(
                _some(problem, part.predicted),
                found,
                point.outset.of(part.predicted),
                eased=True,
            )
        )
    return rms(np.concatenate(errors))


def _tells(problem: Problem, chosen: Sequence[int]) -> bool:
    """Whether anything of these runs is compared."""
    edges = problem.edges.tolist()
    return any(problem.telling[edges[n] : edges[n + 1]].any() for n in chosen)


def errors_of(problem: Problem, point: Point, outset: Outset, *, eased: bool = False) -> Array:
    """(n, 2) position and velocity, measured less simulated without correction, where it moves.

    Args:
        problem: the runs.
        point: values that are simulated.
        outset: how each run begins.
        eased: each run may have a friction of its own, as ``friction.py`` has it: what one run's
            accident does to the gap says nothing about an effect.
    """
    track = problem.track(point.hypothesis.model(point.values), outset, NO_TRUST)
    errors = problem.measured - track[:, [0, 3]]
    moves = problem.moving | ((track[:, 1] != 0.0) & problem.telling)
    if not eased:
        return np.asarray(errors[moves])
    errors = _eased(problem, point, outset, track, moves)
    flown = ~np.isfinite(track[:, [0, 3]]) & ~np.isnan(problem.measured)
    errors = np.where(flown, np.inf, errors)  # what runs away is not left out of the mean
    return np.asarray(errors[moves | flown.any(axis=1)])


def _eased(
    problem: Problem, point: Point, outset: Outset, track: Array, moves: NDArray[np.bool_]
) -> Array:
    """The errors, less what the likeliest friction of each run's own makes of them."""
    errors = problem.measured - track[:, [0, 3]]
    most = MOST_VARIED * max(point.values["kS"], LEAST_KS)
    values = {**point.values, "kS": point.values["kS"] + most}
    more = problem.track(point.hypothesis.model(values), outset, NO_TRUST)
    change = (track - more)[:, [0, 3]]  # of the errors, by so much friction
    sizes = np.sqrt(np.nanmean(np.square(errors[moves]), axis=0)) + 1e-300
    eased = errors.copy()
    for first, last in pairwise(problem.edges.tolist()):
        here = slice(first, last)
        told = moves[here, None] & ~np.isnan(errors[here])
        column = np.where(told, change[here] / sizes, 0.0).ravel()
        rest = np.where(told, errors[here] / sizes, 0.0).ravel()
        along = float(column @ column)
        share = -float(column @ rest) / along if along > 0.0 else 0.0
        eased[here] += min(max(share, -1.0), 1.0) * change[here]
    return eased


def rms(errors: Array) -> Gap:
    """The gap of errors (n, 2)."""
    if not errors.size:
        return Gap(0.0, 0.0)
    position, velocity = np.sqrt(np.nanmean(np.square(errors), axis=0))
    return Gap(float(velocity), float(position))


def _some(problem: Problem, chosen: Sequence[int]) -> Problem:
    return Problem(tuple(problem.lanes[n] for n in chosen), problem.noise)
