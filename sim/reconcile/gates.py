"""The gap on runs that a fit has not seen: what a new effect has to narrow."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from sim.engine import NO_TRUST
from sim.log import Array
from sim.reconcile.descent import better
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
    errors = []
    for part in parts:
        fitted = _some(problem, part.fitted)
        begin = fitted.at(point.hypothesis, point.values, point.starts[list(part.fitted)], point.q)
        found = better(fitted, begin, steps=REFIT)
        errors.append(
            errors_of(_some(problem, part.predicted), found, point.starts[list(part.predicted)])
        )
    return rms(np.concatenate(errors))


def errors_of(problem: Problem, point: Point, starts: Array) -> Array:
    """(n, 2) position and velocity, measured less simulated without correction, where it moves."""
    model = point.hypothesis.model(point.values)
    track = problem.track(model, starts, NO_TRUST)
    moves = problem.moving | ((track[:, 1] != 0.0) & problem.telling)
    return np.asarray((problem.measured - track[:, [0, 3]])[moves])


def rms(errors: Array) -> Gap:
    """The gap of errors (n, 2)."""
    if not errors.size:
        return Gap(0.0, 0.0)
    position, velocity = np.sqrt(np.nanmean(np.square(errors), axis=0))
    return Gap(float(velocity), float(position))


def _some(problem: Problem, chosen: Sequence[int]) -> Problem:
    return Problem(tuple(problem.lanes[n] for n in chosen), problem.noise)
