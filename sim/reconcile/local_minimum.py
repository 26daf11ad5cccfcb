"""Levenberg–Marquardt search over parameters, nuisance parameters and process noise.

Levenberg and Marquardt's steps on white innovations, in turn with a search for the size q of what
pushes at random.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from sim.data.log import Array
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.model_structure import ModelStructure
from sim.estimation.random_friction import friction_sd
from sim.reconcile.backlash_phase import (
    backlash_phase_prior,
    estimate_backlash_phase,
    halve_backlash,
)
from sim.reconcile.thresholds import CLOSE

FIRST_DAMPING, TRIES = 1e-3, 5
SOFTER = 4.0  # [1] steps of q
LEAST_Q = 1e-12  # [noises of a velocity, squared, per second] below which q is none
SCANNED = (-12, -9, -6, -4, -2)  # powers of it: what pushes is first thought too large
SMALL_PART, LARGE_PART = 0.03, 0.8  # [1] of a start's size between which a part of it is tried, too
LARGEST_PART = 30.0  # [1] the same, the other way
SURELY_MORE = 10.0  # [of -2 log L]
HALVINGS = 3  # of the best start: what an effect offers may be too large for what is subtle
ROUNDS, FIRST_STEPS, STEPS = 3, 3, 8
AGAIN = 6  # times that a point is settled at most
CALM, AGITATED = 1.0, 8.0  # [noises of a velocity, squared, per second] such a q, and times it
Begun = tuple[float, Estimate]  # what a start promises, and where it begins
HALVED = 6  # times at most that play is halved
ENOUGH = 0.5  # [of -2 log L] a step that gains less ends the search
NOTHING = 0.1  # [of -2 log L] a step that promises less is not taken


@dataclass(frozen=True, eq=False)
class JointJacobian:
    """Jacobian of the whitened innovations with respect to parameters and nuisance parameters.

    Args:
        ways: (2 n, k) orthonormal with rows for the priors, which are left out here.
        held: (k,) what those rows hold of the point along each.
    """

    ways: Array
    held: Array

    def told(self, white: Array) -> Array:
        """(k,) what of innovations (2 n,) the point adjusts to."""
        return np.asarray(self.ways.T @ white + self.held)

    def square(self, white: Array) -> float:
        """Sum of the squares that are left once it has, but for a constant."""
        told = self.told(white)
        return float(white @ white - told @ told)

    def along(self, change: Array, white: Array) -> tuple[float, float]:
        """What is left of a change's product with innovations, and with itself."""
        told = self.ways.T @ change
        product = float(change @ white - told @ self.told(white))
        return product, float(change @ change - told @ told)


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
    """The local minimum near an estimate, and with less process noise where that matters.

    A large q bears with anything: it is where a search for gains that are far off comes to rest.
    """
    found = [_settled(problem, point)]
    calm = CALM * problem.noise.velocity**2
    if found[0].process_noise > AGITATED * calm:
        calmer = problem.at(point.structure, found[0].values, found[0].nuisance, calm)
        found.append(_settled(problem, levenberg_marquardt(problem, calmer, steps=STEPS)))
    best = min(found, key=total_cost)
    return _tight(problem, best) if point.structure.plays else best


def _tight(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """The least play of those about as likely: what no run crosses may be of any size."""
    best = point
    for _ in range(HALVED):
        less = minimize(problem, halve_backlash(problem, point))
        if not total_cost(less) < total_cost(best) + CLOSE:
            break
        point = less
        best = min(best, point, key=total_cost)
    return point


def total_cost(point: Estimate) -> float:
    """[of -2 log L] of an estimate, with the priors of its nuisance parameters."""
    return point.cost + backlash_phase_prior(point)


def _settled(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """The same, settled until that gains no more."""
    for _ in range(AGAIN):
        before = point.cost
        point = minimize(problem, point)
        if not before - point.cost > SURELY_MORE:
            break
    return point


def tune_process_noise(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """The same values with the likeliest process noise: factors of four, then a parabola."""
    least = LEAST_Q * problem.noise.velocity**2

    def at(part: float) -> Estimate:
        return problem.at(point.structure, point.values, point.nuisance, point.process_noise * part)

    beside = {way: at(way) for way in (SOFTER, 1.0 / SOFTER)}
    for way in (SOFTER, 1.0 / SOFTER):
        while (
            beside[way].cost < point.cost - 0.1
            and least < beside[way].process_noise < problem.most_q
        ):
            beside[1.0 / way], point = point, beside[way]
            beside[way] = at(way)
    more, less = beside[SOFTER].cost, beside[1.0 / SOFTER].cost
    bend = more + less - 2.0 * point.cost
    if not (math.isfinite(bend) and bend > 0.0 and beside[SOFTER].process_noise < problem.most_q):
        return point
    other = at(SOFTER ** (0.5 * (less - more) / bend))
    return min(point, other, key=lambda one: one.cost)


def levenberg_marquardt(
    problem: PredictionErrorProblem, point: Estimate, *, steps: int, enough: float = ENOUGH
) -> Estimate:
    """Levenberg–Marquardt steps until the gain per step is small."""
    if not math.isfinite(point.cost):
        return point
    damping = FIRST_DAMPING
    for _ in range(steps):
        table, rest = append_prior_rows(problem, point)
        with np.errstate(over="ignore"):  # a value that nothing bears to be moved
            size = np.linalg.norm(table, axis=0)
        size[size == 0.0] = 1.0
        table /= size
        square, slope = table.T @ table, table.T @ rest
        found = point
        for _ in range(TRIES):
            way = -np.linalg.solve(square + damping * np.eye(slope.size), slope)
            if -float(way @ (2.0 * slope + square @ way)) < NOTHING:
                break
            moved = _moved(problem, point, way / size)
            if moved.cost < point.cost:
                found, damping = moved, max(damping / 10.0, 1e-9)
                break
            damping *= 10.0
        gained, point = point.cost - found.cost, found
        if not gained > enough:
            break
    return point


def predicted_improvement(
    problem: PredictionErrorProblem, point: Estimate, structure: ModelStructure,
    more: Sequence[Mapping[str, float]], *, kept: JointJacobian, as_given: bool = False,
) -> list[Begun]:  # fmt: skip
    """What each start of a candidate may gain once the gains have adjusted, to second order.

    A start that goes too far, or the wrong way, as it may beside another effect that no start knows
    of, is tried again at the size that would gain most, if what it does were proportional to it;
    the best of all is halved while that promises more, for what does not act in proportion (free
    play, a limit) and is smaller than every start.

    Args:
        problem: the measurements.
        point: the best without the candidate.
        structure: with it.
        more: values that it adds, one start after another.
        kept: what the point adjusts to.
        as_given: none is tried smaller: they have been chosen from some that were.
    """

    def begun(one: Mapping[str, float]) -> tuple[float, Estimate]:
        other = problem.at(structure, {**point.values, **one}, point.nuisance, point.process_noise)
        if not point.structure.plays:  # else its runs are told by now
            other = estimate_backlash_phase(problem, other, aside=not as_given)
        if not math.isfinite(other.cost):
            return -math.inf, other
        return square - kept.square(problem.white(point, other.innovations)) - backlash_phase_prior(
            other
        ), other

    now = problem.white(point, point.innovations)
    square = kept.square(now)
    found = []
    for one in more:
        gained, other = begun(one)
        if not math.isfinite(gained):
            continue
        change = problem.white(point, other.innovations) - now
        along, size = kept.along(change, now)
        part = -along / size if size > 0.0 else 0.0
        found.append((gained, other))
        if as_given or not _another_size(structure, part):
            continue
        if part**2 * size > gained + SURELY_MORE:
            found.append(begun(_sized(structure, one, part)))
    if found and not as_given:
        found += _halved(structure, tuple(more[0]), max(found, key=lambda one: one[0]), begun)
    return [one for one in found if math.isfinite(one[0])]


def _halved(
    structure: ModelStructure, names: Sequence[str], best: Begun,
    begun: Callable[[Mapping[str, float]], Begun],
) -> Iterator[Begun]:  # fmt: skip
    """Half of the best start, and half of that, as long as it promises more."""
    for _ in range(HALVINGS):
        half = begun(_sized(structure, {name: best[1].values[name] for name in names}, 0.5))
        if not half[0] > best[0]:
            return
        yield half
        best = half


def _another_size(structure: ModelStructure, part: float) -> bool:
    """Whether a part of a start's size is worth a look: a smaller one, or one the other way."""
    if part > 0.0:
        return SMALL_PART < part < LARGE_PART
    sizes = _sizes(structure)
    signed = bool(sizes) and all(structure.parameters[name].least < 0.0 for name in sizes)
    return signed and SMALL_PART < -part < LARGEST_PART


def _sizes(structure: ModelStructure) -> list[str]:
    """The parameters of the last effect that are nothing where it is not there."""
    own = f"{structure.effects[-1]}."
    return [
        name
        for name, known in structure.parameters.items()
        if name.startswith(own) and known.neutral == 0.0 and known.searched
    ]


def _sized(structure: ModelStructure, one: Mapping[str, float], part: float) -> dict[str, float]:
    """A start at a part of its size."""
    sizes = _sizes(structure)
    return {
        name: structure.within(name, value * part) if name in sizes else value
        for name, value in one.items()
    }


def joint_jacobian(problem: PredictionErrorProblem, point: Estimate) -> JointJacobian:
    """The joint Jacobian at an estimate."""
    table, rest = append_prior_rows(problem, point)
    size = 2 * len(problem.measured)
    ways, _ = np.linalg.qr(table)
    return JointJacobian(np.ascontiguousarray(ways[:size]), np.asarray(ways[size:].T @ rest[size:]))


def append_prior_rows(problem: PredictionErrorProblem, point: Estimate) -> tuple[Array, Array]:
    """Jacobian and residual with a row for the prior of each nuisance parameter.

    Args:
        problem: the measurements.
        point: the values.
    """
    table, rest = problem.columns(point), problem.white(point, point.innovations)
    runs, tau = len(problem.records), friction_sd(point.values)
    prior = np.zeros((2 * runs, table.shape[1]))
    prior[:, -2 * runs :] = np.diag(np.repeat([1.0 / problem.loose, 1.0 / tau], runs))
    own = [point.nuisance.position_offset / problem.loose, point.nuisance.friction_offset / tau]
    return np.vstack([table, prior]), np.concatenate([rest, *own])


def _moved(problem: PredictionErrorProblem, point: Estimate, by: Array) -> Estimate:
    structure = point.structure
    values = dict(point.values)
    searched = structure.searched
    for name, step in zip(searched, by.tolist(), strict=False):
        values[name] = structure.stepped(name, values[name], step)
    starts, rubs = by[len(searched) :].reshape(2, -1)
    nuisance = point.nuisance.moved(starts).rubbing(rubs)
    common = float(
        np.mean(nuisance.friction_offset)
    )  # what all runs have is kS: only the price tells, hardly
    values["kS"] = max(values["kS"] + common, 0.0)
    nuisance = nuisance.rubbing(np.full_like(nuisance.friction_offset, -common))
    return problem.at(structure, values, nuisance, point.process_noise)


def scan_process_noise(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """The same values with the likeliest process noise of its whole range."""
    tried = [
        problem.at(
            point.structure, point.values, point.nuisance, point.process_noise * SOFTER**power
        )
        for power in SCANNED
    ]
    return min([point, *tried], key=lambda one: one.cost)
