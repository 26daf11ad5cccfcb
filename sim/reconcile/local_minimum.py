"""The local minimum near an estimate, and what a start of a candidate promises.

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

SCANNED = (-12, -9, -6, -4, -2)  # powers of it: the process noise is first thought too large
SMALL_PART, LARGE_PART = 0.03, 0.8  # [1] of a start's size between which a part of it is tried, too
LARGEST_PART = 30.0  # [1] the same, the other way
SURELY_MORE = 10.0  # [of -2 log L]
START_HALVINGS = 3  # of the best start, which may be too large for a subtle effect
FIRST_STEPS = 3  # Levenberg-Marquardt steps before the process noise is estimated
AGAIN = 6  # times that a point is settled at most
CALM, AGITATED = 1.0, 8.0  # [noises of a velocity, squared, per second] such a q, and times it
HALVED = 6  # times at most that play is halved
Begun = tuple[float, Estimate]  # predicted improvement of a start, and the start


def minimize(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """Alternate between parameters and process noise until neither improves.

    Values go first: far from the best ones a large q is the likeliest, and hides what they miss.
    """
    point = levenberg_marquardt(problem, point, steps=FIRST_STEPS)
    for _ in range(ROUNDS):
        before = point.cost
        point = levenberg_marquardt(
            problem,
            tune_process_noise(problem, estimate_backlash_phase(problem, point)),
            steps=STEPS,
        )
        if before - point.cost < 2.0 * ENOUGH:
            break
    return point


def minimize_fully(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """The local minimum near an estimate, also searched from less process noise where that helps.

    Large process noise hides any residual, so a search whose gains are far off tends to stop there.
    """
    found = [_alternate(problem, point)]
    calm = CALM * problem.noise.velocity**2
    if found[0].process_noise > AGITATED * calm:
        calmer = problem.evaluate(point.structure, found[0].values, found[0].nuisance, calm)
        found.append(_alternate(problem, levenberg_marquardt(problem, calmer, steps=STEPS)))
    best = min(found, key=lambda one: one.cost)
    return _tighten_backlash(problem, best) if point.structure.has_backlash else best


def _tighten_backlash(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """The least play of those about as likely: what no run crosses may be of any size."""
    best = point
    for _ in range(HALVED):
        less = minimize(problem, halve_backlash(problem, point))
        if not less.cost < best.cost + EQUAL_SCORE:
            break
        point = less
        best = min(best, point, key=lambda one: one.cost)
    return point


def _alternate(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """The same, settled until that gains no more."""
    for _ in range(AGAIN):
        before = point.cost
        point = minimize(problem, point)
        if not before - point.cost > SURELY_MORE:
            break
    return point


def rate_starts(
    problem: PredictionErrorProblem, point: Estimate, structure: ModelStructure,
    more: Sequence[Mapping[str, float]], *, kept: JointJacobian, as_given: bool = False,
) -> list[Begun]:  # fmt: skip
    """Estimates at a candidate's starts, each with its predicted decrease of -2 log L.

    The prediction lets the gains adjust, to second order. A start that is too large, or has the
    wrong sign because of an effect that is missing, is tried again at the size that would improve
    most if the effect were proportional to it. The best of all is halved while that improves the
    prediction: effects that are not proportional (backlash, a limit) may be smaller than any start.

    Args:
        problem: the measurements.
        point: the best without the candidate.
        structure: with it.
        more: values that it adds, one start after another.
        kept: what the point adjusts to.
        as_given: none is tried smaller: they have been chosen from some that were.
    """

    def begun(one: Mapping[str, float]) -> tuple[float, Estimate]:
        other = problem.evaluate(
            structure, {**point.values, **one}, point.nuisance, point.process_noise
        )
        if not point.structure.has_backlash:  # else its runs are told by now
            other = estimate_backlash_phase(problem, other, aside=not as_given)
        if not math.isfinite(other.cost):
            return -math.inf, other
        left = kept.compute_residual_square(problem.whiten(point, other.innovations))
        phases = other.nuisance.backlash_phase_costs - point.nuisance.backlash_phase_costs
        return square - left - float(np.sum(phases)), other

    now = problem.whiten(point, point.innovations)
    square = kept.compute_residual_square(now)
    found = []
    for one in more:
        gained, other = begun(one)
        if not math.isfinite(gained):
            continue
        change = problem.whiten(point, other.innovations) - now
        along, size = kept.compute_residual_products(change, now)
        part = -along / size if size > 0.0 else 0.0
        found.append((gained, other))
        if as_given or not _is_other_size_worthwhile(structure, part):
            continue
        if part**2 * size > gained + SURELY_MORE:
            found.append(begun(_scale_start(structure, one, part)))
    if found and not as_given:
        found += _halve_start(structure, tuple(more[0]), max(found, key=lambda one: one[0]), begun)
    return [one for one in found if math.isfinite(one[0])]


def _halve_start(
    structure: ModelStructure, names: Sequence[str], best: Begun,
    begun: Callable[[Mapping[str, float]], Begun],
) -> Iterator[Begun]:  # fmt: skip
    """Half of the best start, and half of that, as long as it promises more."""
    for _ in range(START_HALVINGS):
        half = begun(_scale_start(structure, {name: best[1].values[name] for name in names}, 0.5))
        if not half[0] > best[0]:
            return
        yield half
        best = half


def _is_other_size_worthwhile(structure: ModelStructure, part: float) -> bool:
    """Whether a part of a start's size is worth a look: a smaller one, or one the other way."""
    if part > 0.0:
        return SMALL_PART < part < LARGE_PART
    sizes = _size_parameters(structure)
    signed = bool(sizes) and all(structure.parameters[name].least < 0.0 for name in sizes)
    return signed and SMALL_PART < -part < LARGEST_PART


def _size_parameters(structure: ModelStructure) -> list[str]:
    """The parameters of the last effect that are nothing where it is not there."""
    own = f"{structure.effects[-1]}."
    return [
        name
        for name, known in structure.parameters.items()
        if name.startswith(own) and known.neutral == 0.0 and known.searched
    ]


def _scale_start(
    structure: ModelStructure, one: Mapping[str, float], part: float
) -> dict[str, float]:
    """A start at a part of its size."""
    sizes = _size_parameters(structure)
    return {
        name: structure.clamp_value(name, value * part) if name in sizes else value
        for name, value in one.items()
    }


def scan_process_noise(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """The likeliest of an estimate and of five with less process noise."""
    tried = [
        problem.evaluate(
            point.structure, point.values, point.nuisance, point.process_noise * FACTOR**power
        )
        for power in SCANNED
    ]
    return min([point, *tried], key=lambda one: one.cost)
