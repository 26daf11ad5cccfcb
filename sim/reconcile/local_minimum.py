"""The local minimum near an estimate, and the predicted improvement of a candidate's starts.

Levenberg–Marquardt steps alternate with a search for the process noise and for the backlash phase
of each run.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence

import numpy as np

from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.model_structure import ModelStructure
from sim.estimation.optimize import (
    ENOUGH,
    FACTOR,
    JointJacobian,
    levenberg_marquardt,
    tune_process_noise,
)
from sim.reconcile.backlash_phase import estimate_backlash_phase, halve_backlash
from sim.reconcile.search_effort import ROUNDS, STEPS
from sim.reconcile.thresholds import EQUAL_SCORE

SCANNED = (-12, -9, -6, -4, -2)  # powers of FACTOR: the first process noise is usually too large
LEAST_SHARE, MOST_SHARE = 0.03, 0.8  # [1] of a start's size: limits of a smaller one that is tried
MOST_OPPOSITE_SHARE = 30.0  # [1] the upper limit for a size with the opposite sign
WORTHWHILE = 10.0  # [of -2 log L] improvement for which a search is repeated or a size is tried
START_HALVINGS = 3  # of the best start, which may be too large for a subtle effect
FIRST_STEPS = 3  # Levenberg-Marquardt steps before the process noise is estimated
MOST_REPEATS = 6  # of a minimization
CALM = 1.0  # [(velocity noise)²/s] little process noise
AGITATED = 8.0  # [CALM] more process noise may hide a model error
BACKLASH_HALVINGS = 6  # at most
RatedStart = tuple[float, Estimate]  # predicted decrease of -2 log L by a start, and the start


def minimize(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """Alternate between parameters and process noise until neither improves, or ``ROUNDS`` times.

    The parameters come first: far from their optimum a large process noise is the likeliest, and
    hides the residuals.
    """
    point = levenberg_marquardt(problem, point, steps=FIRST_STEPS)
    for _ in range(ROUNDS):
        before = point.cost
        tuned = tune_process_noise(problem, estimate_backlash_phase(problem, point))
        point = levenberg_marquardt(problem, tuned, steps=STEPS)
        if before - point.cost < 2.0 * ENOUGH:
            break
    return point


def minimize_fully(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """The local minimum near an estimate, also searched from less process noise if it has much.

    Large process noise hides any residual, so a search tends to stop there with wrong gains.
    """
    best = minimize_repeatedly(problem, point)
    if (calmer := find_calmer_estimate(problem, best, steps=STEPS)) is not None:
        best = min(best, minimize_repeatedly(problem, calmer), key=lambda one: one.cost)
    return _tighten_backlash(problem, best) if point.structure.has_backlash else best


def find_calmer_estimate(
    problem: PredictionErrorProblem, point: Estimate, *, steps: int
) -> Estimate | None:
    """The estimate refitted with little process noise; None if it has little, or diverges then."""
    calm = CALM * problem.noise.velocity**2
    if point.process_noise <= AGITATED * calm:
        return None
    calmer = problem.change(point, process_noise=calm)
    calmer = levenberg_marquardt(problem, calmer, steps=steps)
    return calmer if math.isfinite(calmer.cost) else None


def _tighten_backlash(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """The smallest of about equally likely backlashes; if no run crosses it, any size fits."""
    best = point
    for _ in range(BACKLASH_HALVINGS):
        less = minimize(problem, halve_backlash(problem, point))
        if not less.cost < best.cost + EQUAL_SCORE:
            break
        point = less
        best = min(best, point, key=lambda one: one.cost)
    return point


def minimize_repeatedly(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """The estimate, minimized again while that improves it by more than ``WORTHWHILE``."""
    for _ in range(MOST_REPEATS):
        before = point.cost
        point = minimize(problem, point)
        if not before - point.cost > WORTHWHILE:
            break
    return point


def rate_starts(
    problem: PredictionErrorProblem, point: Estimate, structure: ModelStructure,
    starts: Sequence[Mapping[str, float]], *, jacobian: JointJacobian, as_given: bool = False,
) -> list[RatedStart]:  # fmt: skip
    """Estimates at a candidate's starts, each with its predicted decrease of -2 log L.

    The prediction lets the gains adjust, to second order. A start that is too large, or has the
    wrong sign because of an effect that is missing, is tried again at the size that would improve
    most if the effect were proportional to it. The best of all is halved while that improves the
    prediction: effects that are not proportional (backlash, a limit) may be smaller than any start.

    Args:
        problem: the measurements.
        point: the estimate without the candidate.
        structure: the model with it as its last effect.
        starts: values of the parameters that each start adds or changes.
        jacobian: joint Jacobian at ``point``.
        as_given: whether to try no other sizes, because the starts result from a search.
    """

    def rate(one: Mapping[str, float]) -> RatedStart:
        other = problem.change(point, structure=structure, values={**point.values, **one})
        if not point.structure.has_backlash:  # else the phases are estimated already
            other = estimate_backlash_phase(problem, other, ends_only=not as_given)
        if not math.isfinite(other.cost):
            return -math.inf, other
        remaining = jacobian.compute_residual_square(problem.whiten(point, other.innovations))
        phases = other.nuisance.backlash_phase_costs - point.nuisance.backlash_phase_costs
        return square - remaining - float(np.sum(phases)), other

    now = problem.whiten(point, point.innovations)
    square = jacobian.compute_residual_square(now)
    found = []
    for one in starts:
        improvement, other = rate(one)
        if not math.isfinite(improvement):
            continue
        change = problem.whiten(point, other.innovations) - now
        product, change_square = map(float, jacobian.compute_residual_products(change, now))
        share = -product / change_square if change_square > 0.0 else 0.0
        found.append((improvement, other))
        if as_given or not _may_have_size(structure, share):
            continue
        if share**2 * change_square > improvement + WORTHWHILE:
            found.append(rate(_scale_start(structure, one, share)))
    if found and not as_given:
        found += _halve_start(structure, tuple(starts[0]), max(found, key=lambda one: one[0]), rate)
    return [one for one in found if math.isfinite(one[0])]


def _halve_start(
    structure: ModelStructure, names: Sequence[str], best: RatedStart,
    rate: Callable[[Mapping[str, float]], RatedStart],
) -> Iterator[RatedStart]:  # fmt: skip
    """The best start halved, and halved again, while that improves the prediction."""
    for _ in range(START_HALVINGS):
        half = rate(_scale_start(structure, {name: best[1].values[name] for name in names}, 0.5))
        if not half[0] > best[0]:
            return
        yield half
        best = half


def _may_have_size(structure: ModelStructure, share: float) -> bool:
    """Whether to try this share of a start's size: a smaller one, or one of the opposite sign."""
    if share > 0.0:
        return LEAST_SHARE < share < MOST_SHARE
    sizes = _list_size_parameters(structure)
    signed = bool(sizes) and all(structure.parameters[name].least < 0.0 for name in sizes)
    return signed and LEAST_SHARE < -share < MOST_OPPOSITE_SHARE


def _list_size_parameters(structure: ModelStructure) -> list[str]:
    """The searched parameters of the last effect that are 0 without it."""
    own = f"{structure.effects[-1]}."
    return [
        name
        for name, known in structure.parameters.items()
        if name.startswith(own) and known.neutral == 0.0 and known.searched
    ]


def _scale_start(
    structure: ModelStructure, one: Mapping[str, float], share: float
) -> dict[str, float]:
    """A start at a share of its size."""
    sizes = _list_size_parameters(structure)
    return {
        name: structure.clamp_value(name, value * share) if name in sizes else value
        for name, value in one.items()
    }


def scan_process_noise(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """The likeliest of an estimate and of five with less process noise."""
    tried = [
        problem.change(point, process_noise=point.process_noise * FACTOR**power)
        for power in SCANNED
    ]
    return min([point, *tried], key=lambda one: one.cost)
