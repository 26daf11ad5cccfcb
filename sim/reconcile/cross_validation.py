"""Cross-validation: the gap on runs to which the model was not fitted."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.optimize import levenberg_marquardt
from sim.estimation.random_friction import get_friction_sd
from sim.estimation.run_nuisance import FRICTION, RunNuisance
from sim.physics.effects import EFFECTS
from sim.physics.engine import Track
from sim.reconcile.search_effort import STEPS

FRICTION_DEVIATIONS = (-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0)
"""[standard deviations] Additional friction of a run that is tried."""


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
        fitted: indices of the runs to fit.
        predicted: indices of the runs to predict.
    """

    fitted: tuple[int, ...]
    predicted: tuple[int, ...]


def make_folds(sessions: Sequence[int]) -> tuple[Fold, ...]:
    """Partition the runs into folds.

    With two logs the first predicts the second; with one, each run is predicted by the others.

    Args:
        sessions: (runs,) number of the log that each run is from.
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


def select_usable_folds(problem: PredictionErrorProblem, folds: Sequence[Fold]) -> tuple[Fold, ...]:
    """The folds that have compared samples both to fit and to predict."""
    used = [bool(problem.informative[rows].any()) for rows in problem.run_slices]
    return tuple(
        fold
        for fold in folds
        if any(used[n] for n in fold.fitted) and any(used[n] for n in fold.predicted)
    )


def compute_validation_gap(
    problem: PredictionErrorProblem, point: Estimate, folds: Sequence[Fold]
) -> Gap:
    """The gap on runs to which the searched parameters were not fitted.

    The process noise and the nuisance parameters of each run are those of the fit to all runs.

    Args:
        problem: the measurements.
        point: the best estimate of all runs.
        folds: which runs predict which; each has samples to fit and to predict.
    """
    errors = [np.empty((0, 2))]
    for fold in folds:
        fitted, nuisance = _select_runs(problem, point, fold.fitted)
        start = fitted.change(point, nuisance=nuisance)
        found = levenberg_marquardt(fitted, start, steps=STEPS // 2)
        predicted, nuisance = _select_runs(problem, point, fold.predicted)
        common = nuisance.with_common_friction
        errors.append(compute_open_loop_errors(predicted, found, common, own_friction=True))
    return compute_rms_gap(np.concatenate(errors))


def _select_runs(
    problem: PredictionErrorProblem, point: Estimate, chosen: Sequence[int]
) -> tuple[PredictionErrorProblem, RunNuisance]:
    """The problem of some runs, and their nuisance parameters under an estimate.

    The state of a motor that heats up depends on the runs before, so all runs are simulated then.
    """
    if any("update_memory" in EFFECTS[name].hooks for name in point.structure.effects):
        return problem.select_runs(range(len(problem.records)), compared=chosen), point.nuisance
    return problem.select_runs(chosen), point.nuisance.select_runs(chosen)


def compute_open_loop_errors(
    problem: PredictionErrorProblem, point: Estimate, nuisance: RunNuisance, *,
    own_friction: bool = False,
) -> Array:  # fmt: skip
    """(compared, 2) measured minus simulated position and velocity, without correction.

    Which samples are compared does not depend on the model.

    Args:
        problem: the runs.
        point: the estimate that is simulated.
        nuisance: initial values and friction of each run.
        own_friction: whether to fit an additional friction to each run, as in
            ``random_friction.py``, so that friction that varies does not decide about an effect.
    """
    track = problem.simulate(point.model, nuisance)
    compared = problem.moving | problem.informative
    if not own_friction:
        return _open_loop_errors(problem, track)[compared]
    errors = _with_run_friction(problem, point, nuisance, track, compared)
    return np.asarray(errors[compared])


def _with_run_friction(
    problem: PredictionErrorProblem,
    point: Estimate,
    nuisance: RunNuisance,
    track: Track,
    compared: NDArray[np.bool_],
) -> Array:
    """(n, 2) errors, each run with the additional friction that makes its errors smallest.

    Each friction is simulated, because friction shifts the phase of cogging nonlinearly. The best
    one between those that are tried is the minimum of a parabola.
    """
    deviation, runs = get_friction_sd(point.values), len(problem.records)

    def compute_errors(shares: Array) -> Array:
        other = track
        if shares.any():
            other = problem.simulate(point.model, nuisance.add(FRICTION, shares * deviation))
        return _open_loop_errors(problem, other)

    tried = np.array(FRICTION_DEVIATIONS)
    errors = np.stack([compute_errors(np.full(runs, one)) for one in tried])  # (shares, n, 2)
    costs = _compute_costs_by_share(problem, errors, compared)
    best = np.clip(np.argmin(costs, axis=0), 1, len(FRICTION_DEVIATIONS) - 2)
    less, here, more = (costs[best + way, np.arange(runs)] for way in (-1, 0, 1))
    offset = find_parabola_minima(less, here, more)
    between = compute_errors(tried[best] + offset)
    errors = np.concatenate([errors, between[None]])
    best = np.argmin(_compute_costs_by_share(problem, errors, compared), axis=0)
    return np.asarray(errors[np.repeat(best, np.diff(problem.run_edges)), np.arange(len(compared))])


def find_parabola_minima(less: Array, here: Array, more: Array) -> Array:
    """Minima of parabolas through values at -1, 0 and 1; 0 where there is none."""
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        minima = 0.5 * (less - more) / (less - 2.0 * here + more)
    return np.asarray(np.clip(np.nan_to_num(minima, posinf=0.0, neginf=0.0), -1.0, 1.0))


def _compute_costs_by_share(
    problem: PredictionErrorProblem, errors: Array, compared: NDArray[np.bool_]
) -> Array:
    """(shares, runs) squared errors over their mean without friction, position plus velocity."""
    with np.errstate(over="ignore", invalid="ignore"):  # simulations that diverged
        squares = np.where(compared[:, None] & ~np.isnan(errors), np.square(errors), 0.0)
        sizes = np.mean(squares[FRICTION_DEVIATIONS.index(0.0)], axis=0) + 1e-300
        costs = np.add.reduceat(np.sum(squares / sizes, axis=2), problem.run_edges[:-1], axis=1)
    return np.asarray(np.nan_to_num(costs, nan=np.inf))


def _open_loop_errors(problem: PredictionErrorProblem, track: Track) -> Array:
    """(n, 2) measured minus simulated; infinite where a simulation diverged."""
    simulated = track.sensor_readings
    diverged = ~np.isfinite(simulated) & ~np.isnan(problem.measured)
    return np.where(diverged, np.inf, problem.measured - simulated)


def compute_rms_gap(errors: Array) -> Gap:
    """RMS of errors (n, 2); nan where nothing was measured."""
    counts = np.count_nonzero(~np.isnan(errors), axis=0)
    # a simulation that diverged, and a signal without samples
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        position, velocity = np.sqrt(np.nansum(np.square(errors), axis=0) / counts)
    return Gap(float(velocity), float(position))


def count_noise_floors(gap: float, problem: PredictionErrorProblem) -> float:
    """[1] A velocity gap over the noise floor of the measured velocity.

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
