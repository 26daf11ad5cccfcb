"""Cross-validation: the gap on runs to which the model was not fitted."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.optimize import levenberg_marquardt
from sim.estimation.random_friction import get_friction_sd
from sim.estimation.run_nuisance import RunNuisance
from sim.physics.engine import Track
from sim.reconcile.search_effort import STEPS

EASED = (-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0)
"""[standard deviations] of a run's own friction that are tried."""


@dataclass(frozen=True)
class Gap:
    """Open-loop simulation error, RMS.

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


def make_folds(sessions: Sequence[int]) -> tuple[Fold, ...]:
    """Partition the runs into folds.

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


def compute_validation_gap(
    problem: PredictionErrorProblem, point: Estimate, parts: Sequence[Fold]
) -> Gap:
    """The gap on runs to which the values were not fitted."""
    errors = [np.empty((0, 2))]
    for part in parts:
        if not (_has_comparison(problem, part.fitted) and _has_comparison(problem, part.predicted)):
            continue
        fitted = _select_records(problem, part.fitted)
        begin = fitted.evaluate(
            point.structure,
            point.values,
            point.nuisance.select_runs(part.fitted),
            point.process_noise,
        )
        found = levenberg_marquardt(fitted, begin, steps=STEPS // 2)
        nuisance = point.nuisance.select_runs(part.predicted).with_common_friction
        errors.append(
            compute_open_loop_errors(
                _select_records(problem, part.predicted), found, nuisance, eased=True
            )
        )
    return compute_rms_gap(np.concatenate(errors))


def _has_comparison(problem: PredictionErrorProblem, chosen: Sequence[int]) -> bool:
    """Whether anything of these runs is compared."""
    edges = problem.run_edges.tolist()
    return any(problem.informative[edges[n] : edges[n + 1]].any() for n in chosen)


def compute_open_loop_errors(
    problem: PredictionErrorProblem, point: Estimate, nuisance: RunNuisance, *, eased: bool = False
) -> Array:
    """(n, 2) measured minus simulated, position and velocity, without correction, while it moves.

    Args:
        problem: the runs.
        point: values that are simulated.
        nuisance: how each run begins.
        eased: each run may have a friction of its own, as in ``random_friction.py``, so that an
            accident in one run does not count for or against an effect.
    """
    track = problem.simulate(point.structure.model(point.values), nuisance)
    errors = problem.measured - track.sensor_readings
    moves = problem.moving | ((track.velocity != 0.0) & problem.informative)
    if not eased:
        return np.asarray(errors[moves])
    errors = _with_run_friction(problem, point, nuisance, track, moves)
    away = np.isinf(errors).any(axis=1)  # which is not left out of the mean
    return np.asarray(errors[moves | away])


def _with_run_friction(
    problem: PredictionErrorProblem,
    point: Estimate,
    nuisance: RunNuisance,
    track: Track,
    moves: NDArray[np.bool_],
) -> Array:
    """The errors with the likeliest friction of each run's own.

    Each is simulated: over a long way, a wave along it falls out of step with a little friction,
    and what that changes is in no proportion to it. Between those that are tried, each run's
    likeliest is where a parabola is lowest.
    """
    deviation = get_friction_sd(point.values)
    model, runs = point.structure.model(point.values), len(problem.records)

    def missed(rubs: Array) -> Array:
        other = problem.simulate(model, nuisance.add_friction(rubs)) if rubs.any() else track
        return _open_loop_errors(problem, other)

    every = np.stack(
        [missed(np.full(runs, share * deviation)) for share in EASED]
    )  # (shares, n, 2)
    costs = _costs_by_share(problem, every, moves)
    best = np.clip(np.argmin(costs, axis=0), 1, len(EASED) - 2)
    less, here, more = (costs[best + way, np.arange(runs)] for way in (-1, 0, 1))
    aside = find_parabola_minima(less, here, more)
    between = missed((np.array(EASED)[best] + aside) * deviation)
    every = np.concatenate([every, between[None]])
    best = np.argmin(_costs_by_share(problem, every, moves), axis=0)
    return np.asarray(every[np.repeat(best, np.diff(problem.run_edges)), np.arange(len(moves))])


def find_parabola_minima(less: Array, here: Array, more: Array) -> Array:
    """Minima of parabolas through values at -1, 0 and 1; 0 where there is none."""
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        aside = 0.5 * (less - more) / (less - 2.0 * here + more)
    return np.asarray(np.clip(np.nan_to_num(aside, posinf=0.0, neginf=0.0), -1.0, 1.0))


def _costs_by_share(
    problem: PredictionErrorProblem, every: Array, moves: NDArray[np.bool_]
) -> Array:
    """(shares, runs) what each run misses, position and velocity in what is ordinary for both."""
    with np.errstate(over="ignore", invalid="ignore"):  # of what ran away
        squares = np.where(moves[:, None] & ~np.isnan(every), np.square(every), 0.0)
        sizes = np.mean(squares[EASED.index(0.0)], axis=0) + 1e-300
        costs = np.add.reduceat(np.sum(squares / sizes, axis=2), problem.run_edges[:-1], axis=1)
    return np.asarray(np.nan_to_num(costs, nan=np.inf))


def _open_loop_errors(problem: PredictionErrorProblem, track: Track) -> Array:
    """(n, 2) measured minus simulated; infinite where a simulation diverged."""
    seen = track.sensor_readings
    away = ~np.isfinite(seen) & ~np.isnan(problem.measured)
    return np.where(away, np.inf, problem.measured - seen)


def compute_rms_gap(errors: Array) -> Gap:
    """RMS of errors (n, 2); nan where nothing was measured."""
    if not errors.size:
        return Gap(0.0, 0.0)
    counts = np.count_nonzero(~np.isnan(errors), axis=0)
    with np.errstate(over="ignore", invalid="ignore"):  # what ran away, and what is not there
        position, velocity = np.sqrt(np.nansum(np.square(errors), axis=0) / counts)
    return Gap(float(velocity), float(position))


def count_noise_floors(gap: float, problem: PredictionErrorProblem) -> float:
    """[1] A gap of the velocity over the noise that any model leaves.

    Args:
        gap: [unit/s].
        problem: the measurements.
    """
    return gap / problem.velocity_floor


def compute_missed_motion(gap: float, problem: PredictionErrorProblem) -> float:
    """[1] A velocity gap [unit/s] over the root mean square of the velocities in motion."""
    speeds = problem.measured[problem.moving, 1]
    size = float(np.sqrt(np.nanmean(np.square(speeds)))) if speeds.size else 0.0
    return gap / max(size, 1e-300)


def _select_records(
    problem: PredictionErrorProblem, chosen: Sequence[int]
) -> PredictionErrorProblem:
    return PredictionErrorProblem(tuple(problem.records[n] for n in chosen), problem.noise)
