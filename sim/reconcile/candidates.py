"""Candidate effects: each effect of the catalogue on top of a model, ranked by BIC.

Start values of each come from the log (``Effect.start_values``) and are simulated once. The most
promising are optimized for a few steps, the best of these to a local minimum. Joints (backlash,
compliance) show only after changes of the voltage, so their starts are first tried on the step
tests. If the model has large process noise, which hides any model error, a model with less of it is
the starting point.
"""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.optimize import levenberg_marquardt, make_joint_jacobian
from sim.estimation.random_friction import compute_laplace_correction
from sim.estimation.run_nuisance import POSITION
from sim.physics.effect import Effect, are_compatible
from sim.physics.effects import EFFECTS
from sim.physics.voltage_residual import VoltageResidual
from sim.reconcile.local_minimum import (
    RatedStart,
    find_calmer_estimate,
    minimize,
    minimize_fully,
    minimize_repeatedly,
    rate_starts,
)
from sim.reconcile.onset_scan import refine_onset, scan_onsets
from sim.reconcile.thresholds import LEAST_SCORE
from sim.reconcile.two_body_starts import TwoBodyStarts

TRIED, KEPT = 8, 4  # candidates that are optimized for a few steps, and to a local minimum
FEW_STEPS = 2  # Levenberg-Marquardt steps before candidates are compared
FURTHER = 6  # the same from a start of a joint
FRICTION_SHARES = (0.0, 0.2, 0.4, 0.7, 1.0)  # [1] of friction at the motor: start values of a joint
THRESHOLD_SHARES = (0.93, 0.96, 0.98, 1.02, 1.04, 1.07)  # [1] of a threshold that are tried, too
TRIED_CALM = 3  # candidates that are also tried with less process noise
INCOMPATIBLE: dict[str, tuple[str, ...]] = {
    "elevator": ("constant-load", "gravity-cosine", "wheel-slip"),
    "arm": ("gravity-cosine", "wheel-slip"),
}
"""Base type -> effects that it has already, or cannot have: an elevator has no pivot."""

Seeds = Mapping[str, Mapping[str, float]]
"""Effect -> values of ``effect.parameter`` that earlier rounds found for it."""


@dataclass(frozen=True, eq=False)
class Candidate:
    """An effect, the estimate with it, and its BIC.

    Args:
        effect: its name; empty for the base model.
        estimate: the optimized parameters of the model with it.
        bic: [of -2 log L] Bayesian information criterion of the estimate, integrated over the
            friction and lag of each run; the smaller, the better.
    """

    effect: str
    estimate: Estimate
    bic: float


def score_estimate(problem: PredictionErrorProblem, point: Estimate, effect: str = "") -> Candidate:
    """An estimate with its BIC: -2 log L + k·ln N (Schwarz, 1978)."""
    penalty = point.structure.free_count * math.log(max(problem.sample_count, 2))
    integral = sum(
        compute_laplace_correction(sd, problem.compute_run_jacobian(point, name))
        for name, sd in problem.list_random_effects(point.values).items()
        if name != POSITION  # the starts are the same in all models
    )
    return Candidate(effect, point, point.cost + integral + penalty)


def rank_candidates(
    problem: PredictionErrorProblem, point: Estimate, residual: VoltageResidual, *,
    only: Iterable[str] | None = None, seeds: Seeds | None = None,
    stop: Callable[[], bool] = lambda: False,
) -> list[Candidate]:  # fmt: skip
    """The effects that improve an estimate most, best first.

    Args:
        problem: the measurements.
        point: the estimate without them.
        residual: voltage residual of the whole log under the base gains of the estimate.
        only: names to choose from; None is the whole catalogue.
        seeds: additional start values from earlier rounds. After another effect was added, a search
            from the effect's usual start values may no longer find them.
        stop: whether no further search may begin.
    """
    seeds = seeds or {}
    had = (*point.structure.effects, *INCOMPATIBLE.get(point.structure.type, ()))
    names = [name for name in (EFFECTS if only is None else only) if name not in had]
    present = [EFFECTS[name] for name in point.structure.effects]
    names = [name for name in names if are_compatible([*present, EFFECTS[name]])]
    effects = [EFFECTS[name] for name in names]
    calmer = find_calmer_estimate(problem, point, steps=FEW_STEPS)
    usual = effects if calmer is None else [one for one in effects if not one.is_joint]
    rated = _choose_best_starts(problem, point, usual, residual, seeds)[:TRIED]
    descended = [
        descend_candidate(problem, refine_onset(problem, one))
        for starts in rated
        for _, one in starts
        if not stop()
    ]
    best = _choose_best_of_each_effect(descended)[:KEPT]
    if calmer is not None:
        rated = _choose_best_starts(problem, calmer, effects, residual, seeds, heavy=True)
        joints = [one for one in rated[TRIED_CALM:] if _ends_with_joint(one[0][1])]
        rated = [*rated[:TRIED_CALM], *joints]
        calm = [
            descend_candidate(problem, one) for starts in rated for _, one in starts if not stop()
        ]
        best = _choose_best_of_each_effect([*descended, *calm])[:KEPT]
        best += _choose_best_of_each_effect(calm)[:1]  # less noise starts farther from the minimum
    minima = [_minimize_nested(problem, point, one) for one in dict.fromkeys(best) if not stop()]
    simpler = [simplify_effect(problem, one, names, residual) for one in minima if not stop()]
    minima = _choose_best_of_each_effect(
        [*minima, *(minimize(problem, one) for one in simpler if one)]
    )
    found = [score_estimate(problem, one, one.structure.effects[-1]) for one in minima]
    return sorted(found, key=lambda one: one.bic)


def _minimize_nested(problem: PredictionErrorProblem, point: Estimate, start: Estimate) -> Estimate:
    """The local minimum near the start of a candidate, searched twice if the first search fails.

    A candidate contains the model without it, so it cannot be less likely at its minimum. If it is,
    its start had another process noise than that model, and the search starts again from that of
    the model. A joint is searched from several shares of the friction instead.

    Args:
        problem: the measurements.
        point: the estimate without the candidate.
        start: an estimate with it.
    """
    found = refine_threshold(problem, minimize(problem, start))
    if _ends_with_joint(start):
        likelier = not point.structure.has_joint and point.cost - found.cost > LEAST_SCORE
        return _refine_motor_friction(problem, found) if likelier else found
    if found.cost <= point.cost:
        return found
    noisy = problem.change(start, process_noise=point.process_noise)
    return min(found, minimize_fully(problem, noisy), key=lambda one: one.cost)


def refine_threshold(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """The likeliest of an estimate and of those with a slightly smaller or larger threshold.

    The samples beyond a threshold change in jumps, so its derivative does not lead to the best one.
    """
    effect, structure = EFFECTS[point.structure.effects[-1]], point.structure
    names = [f"{effect.name}.{one.name}" for one in effect.parameters if one.stepwise]
    moved = [
        {name: structure.clamp_value(name, point.values[name] * share) for name in names}
        for share in (THRESHOLD_SHARES if names else ())
    ]
    tried = [problem.change(point, values={**point.values, **one}) for one in moved]
    best = min([point, *tried], key=lambda one: one.cost)
    return point if best is point else minimize(problem, best)


def _refine_motor_friction(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """The likeliest model of a joint, searched from several shares of friction at the motor.

    Whether a load moves on a slow ramp depends on where the friction is, so the search has a local
    minimum for each share.
    """
    name = f"{point.structure.effects[-1]}.motor_friction"
    moved = (
        problem.change(point, values={**point.values, name: share}) for share in FRICTION_SHARES
    )
    descended = [levenberg_marquardt(problem, one, steps=FURTHER) for one in moved]
    best = min(descended, key=lambda one: one.cost)
    return min(point, minimize_repeatedly(problem, best), key=lambda one: one.cost)


def descend_candidate(problem: PredictionErrorProblem, start: Estimate) -> Estimate:
    """A candidate after a few optimizer steps, for comparison with others.

    The backlash phase of a run is estimated before the gains have adjusted to it, so it may lead to
    a poor minimum. The start is therefore tried without backlash phases, too.

    Args:
        problem: the measurements.
        start: an estimate with the candidate.
    """
    if not _ends_with_joint(start):
        return levenberg_marquardt(problem, start, steps=FEW_STEPS)
    found = levenberg_marquardt(problem, start, steps=FURTHER)
    if not start.nuisance.has_backlash_phase:
        return found
    again = problem.change(start, nuisance=start.nuisance.without_backlash_phase)
    return min(found, levenberg_marquardt(problem, again, steps=FURTHER), key=lambda one: one.cost)


def _ends_with_joint(point: Estimate) -> bool:
    """Whether the last effect of an estimate is a joint, which makes two bodies of one."""
    return EFFECTS[point.structure.effects[-1]].is_joint


def simplify_effect(
    problem: PredictionErrorProblem, point: Estimate, names: Sequence[str],
    residual: VoltageResidual, *, effect: str = "",
) -> Estimate | None:  # fmt: skip
    """A start: an estimate with an effect replaced by its simpler form; None if it has none.

    The optimum of the richer effect is a good start for the simpler one, whose own start values may
    lead to a worse local minimum.

    Args:
        problem: the measurements.
        point: an estimate with the effect.
        names: effects that may replace it.
        residual: voltage residual of the log.
        effect: the effect to replace; empty for the one that was added last.
    """
    old = EFFECTS[effect or point.structure.effects[-1]]
    name = old.simpler
    if name not in names:
        return None
    own = {one: point.values[f"{old.name}.{one}"] for one in old.names}
    values = old.simplify(own, residual)
    structure = point.structure - old.name + name
    added = {
        f"{name}.{one}": structure.clamp_value(f"{name}.{one}", value)
        for one, value in values.items()
    }
    kept = {one: point.values[one] for one in (point.structure - old.name).names}
    return problem.change(point, structure=structure, values={**kept, **added})


def _choose_best_of_each_effect(points: Iterable[Estimate]) -> list[Estimate]:
    """The best point of each effect, the likeliest first."""
    best: dict[str, Estimate] = {}
    for one in sorted(points, key=lambda one: one.cost):
        best.setdefault(one.structure.effects[-1], one)
    return list(best.values())


def _choose_best_starts(
    problem: PredictionErrorProblem, point: Estimate, effects: Iterable[Effect],
    residual: VoltageResidual, seeds: Seeds, *, heavy: bool = False,
) -> list[list[RatedStart]]:  # fmt: skip
    """The best start of each effect; the effect with the largest predicted improvement first.

    A joint has one start for each local minimum that it has on the step tests, because the
    prediction does not say which is the best. ``heavy`` also tries joints with more inertia.
    """
    jacobian = make_joint_jacobian(problem, point)
    found = []
    step_tests = None
    for effect in effects:
        structure = point.structure + effect.name
        starts = [
            {
                f"{effect.name}.{one.name}": min(max(start[one.name], one.least), one.most)
                for one in effect.parameters
            }
            for start in effect.start_values(residual)
        ]
        tried_on_steps = False
        if effect.is_joint:
            step_tests = step_tests or TwoBodyStarts(problem, point)
            if tried_on_steps := step_tests.available:
                starts = step_tests.list_starts(structure, starts, heavy=heavy)
        starts += [
            {**starts[0], "kA": share * point.values["kA"]} for share in effect.inertia_shares
        ]
        if effect.has_onset:
            starts += scan_onsets(problem, point, effect, jacobian=jacobian)
        if effect.name in seeds:
            starts.append(dict(seeds[effect.name]))
        rated = rate_starts(
            problem, point, structure, starts, jacobian=jacobian, as_given=tried_on_steps
        )
        rated.sort(key=lambda one: -one[0])
        if rated:
            found.append(rated if tried_on_steps else rated[:1])
    return sorted(found, key=lambda starts: -starts[0][0])
