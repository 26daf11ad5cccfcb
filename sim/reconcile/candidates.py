"""Candidate effects: each effect of the catalogue on top of a model, ranked by BIC.

Start values of each come from what the log shows (``Effect.start_values``) and are simulated once.
The most promising are searched for a few steps, the best of these to the end. Joints show only
after changes of the voltage, so their starts are first tried on the step tests. If the model has
large process noise, which hides any model error, they are tried from a model with less.
"""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.optimize import levenberg_marquardt, make_joint_jacobian
from sim.estimation.random_friction import compute_laplace_correction, get_friction_sd
from sim.physics.effect import Effect, are_compatible
from sim.physics.effects import EFFECTS
from sim.physics.voltage_residual import VoltageResidual
from sim.reconcile.local_minimum import (
    AGITATED,
    CALM,
    Begun,
    minimize,
    minimize_fully,
    rate_starts,
)
from sim.reconcile.onset_scan import refine_onset, scan_onsets
from sim.reconcile.thresholds import LEAST_SCORE
from sim.reconcile.two_body_starts import TwoBodyStarts

TRIED, KEPT = 8, 4  # candidates that go downhill a little, and to the end
A_LITTLE = 2  # steps
FURTHER = 6  # steps from each start of a joint, before starts are compared
FRICTION_SHARES = (
    0.0,
    0.3,
    0.6,
    1.0,
)  # [1] of the friction at the motor, from which a joint is searched
NEAR_FRICTION = 0.15  # [1] shares of friction that differ by less lead to one minimum
THRESHOLD_SHARES = (0.93, 0.96, 0.98, 1.02, 1.04, 1.07)  # [1] times a threshold, tried beside it
TRIED_CALM = 3  # more, where a large q hides what the base model lacks
INCOMPATIBLE: dict[str, tuple[str, ...]] = {
    "elevator": ("constant-load", "gravity-cosine", "wheel-slip"),
    "arm": ("gravity-cosine", "wheel-slip"),
}
"""Base type -> the effects that it has already, or cannot have: an elevator turns about nothing."""


Seeds = Mapping[str, Mapping[str, float]]
"""Effect -> its parameters, as ``effect.parameter``."""


@dataclass(frozen=True, eq=False)
class Candidate:
    """An effect, the estimate with it, and its BIC.

    Args:
        effect: its name; empty for the point itself.
        estimate: the best with it.
        bic: [of -2 log L] Bayesian information criterion of the estimate, integrated over the
            friction of each run; the smaller, the better.
    """

    effect: str
    estimate: Estimate
    bic: float


def score_estimate(problem: PredictionErrorProblem, point: Estimate, effect: str = "") -> Candidate:
    """An estimate with its BIC: -2 log L + k·ln N (Schwarz, 1978)."""
    values = point.structure.free_count * math.log(max(problem.sample_count, 2))
    sd = get_friction_sd(point.values)
    own = compute_laplace_correction(sd, problem.compute_friction_jacobian(point))
    return Candidate(effect, point, point.cost + own + values)


def rank_candidates(
    problem: PredictionErrorProblem, point: Estimate, residual: VoltageResidual, *,
    only: Iterable[str] | None = None, seeds: Seeds | None = None,
    stop: Callable[[], bool] = lambda: False,
) -> list[Candidate]:  # fmt: skip
    """The effects that improve an estimate most, best first.

    Args:
        problem: the measurements.
        point: the best without them.
        residual: voltage residual of the whole log under the base gains of the point.
        only: names to choose from; None is the whole catalogue.
        seeds: an effect's parameters as found before something else was added: where two effects
            are in a log, what one of them hides at first is hardly found anew beside the other.
        stop: whether there is no time for another candidate.
    """
    seeds = seeds or {}
    had = (*point.structure.effects, *INCOMPATIBLE.get(point.structure.type, ()))
    names = [name for name in (EFFECTS if only is None else only) if name not in had]
    here_already = [EFFECTS[name] for name in point.structure.effects]
    names = [name for name in names if are_compatible([*here_already, EFFECTS[name]])]
    effects = [EFFECTS[name] for name in names]
    calmer = _find_calmer_estimate(problem, point)
    here = effects if calmer is None else [one for one in effects if not one.is_joint]
    begun = _best_starts(problem, point, here, residual, seeds)[:TRIED]
    gone = [
        descend_candidate(problem, refine_onset(problem, one))
        for starts in begun
        for _, one in starts
        if not stop()
    ]
    best = _best_of_each_effect(gone)[:KEPT]
    if calmer is not None:
        begun = _best_starts(problem, calmer, effects, residual, seeds, heavy=True)
        joints = [one for one in begun[TRIED_CALM:] if _ends_in_two_bodies(one[0][1])]
        begun = [*begun[:TRIED_CALM], *joints]
        calm = [
            descend_candidate(problem, one) for starts in begun for _, one in starts if not stop()
        ]
        best = _best_of_each_effect([*gone, *calm])[:KEPT]
        best += _best_of_each_effect(calm)[:1]  # the likeliest of these has the longer way to go
    ended = [_minimize_nested(problem, point, one) for one in dict.fromkeys(best) if not stop()]
    simpler = [simplify_effect(problem, one, names, residual) for one in ended if not stop()]
    ended = _best_of_each_effect([*ended, *(minimize(problem, one) for one in simpler if one)])
    found = [score_estimate(problem, one, one.structure.effects[-1]) for one in ended]
    return sorted(found, key=lambda one: one.bic)


def _minimize_nested(problem: PredictionErrorProblem, point: Estimate, start: Estimate) -> Estimate:
    """The local minimum near the start of a candidate, searched twice if the first search fails.

    A candidate contains the model without it, so at its minimum it cannot be less likely. Where it
    is, its start had another process noise than that model, and the search begins anew from that
    of the model. A joint is searched from several shares of the friction instead.

    Args:
        problem: the measurements.
        point: the best without the candidate.
        start: with it.
    """
    found = refine_threshold(problem, minimize(problem, start))
    if _ends_in_two_bodies(start):
        return _refine_motor_friction(problem, found) if _is_much_likelier(found, point) else found
    if found.cost <= point.cost:
        return found
    noisy = problem.evaluate(start.structure, start.values, start.nuisance, point.process_noise)
    return min(found, minimize_fully(problem, noisy), key=lambda one: one.cost)


def refine_threshold(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """The likeliest of an estimate and of those with a slightly smaller or larger threshold.

    Which samples a threshold lets through changes in jumps, so no slope leads to the best one.
    """
    effect, structure = EFFECTS[point.structure.effects[-1]], point.structure
    names = [f"{effect.name}.{one.name}" for one in effect.parameters if one.stepwise]
    moved = [
        {name: structure.clamp_value(name, point.values[name] * share) for name in names}
        for share in (THRESHOLD_SHARES if names else ())
    ]
    tried = [
        problem.evaluate(structure, {**point.values, **one}, point.nuisance, point.process_noise)
        for one in moved
    ]
    best = min([point, *tried], key=lambda one: one.cost)
    return point if best is point else minimize(problem, best)


def _is_much_likelier(found: Estimate, point: Estimate) -> bool:
    """Whether a model with a joint is much likelier than one without any."""
    alone = not any(EFFECTS[name].is_joint for name in point.structure.effects)
    return alone and point.cost - found.cost > LEAST_SCORE


def _refine_motor_friction(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """The likeliest model of a joint, searched from several shares of friction at the motor.

    Whether a load moves on a slow ramp depends on where the friction is, so the search has a local
    minimum for each share.
    """
    name = f"{point.structure.effects[-1]}.motor_friction"
    best = point
    for share in FRICTION_SHARES:
        if abs(share - best.values[name]) < NEAR_FRICTION:
            continue
        moved = problem.evaluate(
            point.structure, {**best.values, name: share}, best.nuisance, best.process_noise
        )
        best = min(best, minimize(problem, moved), key=lambda one: one.cost)
    return best


def descend_candidate(problem: PredictionErrorProblem, start: Estimate) -> Estimate:
    """A candidate after a few optimizer steps, for comparison with others.

    The backlash phase of a run is estimated before the gains have adjusted to it, so it may lead to
    a poor minimum. The start is therefore tried without backlash phases, too.

    Args:
        problem: the measurements.
        start: a point with the candidate.
    """
    if not _ends_in_two_bodies(start):
        return levenberg_marquardt(problem, start, steps=A_LITTLE)
    gone = levenberg_marquardt(problem, start, steps=FURTHER)
    if not start.nuisance.has_backlash_phase:
        return gone
    untold = problem.evaluate(
        start.structure, start.values, start.nuisance.without_backlash_phase, start.process_noise
    )
    return min(gone, levenberg_marquardt(problem, untold, steps=FURTHER), key=lambda one: one.cost)


def _ends_in_two_bodies(point: Estimate) -> bool:
    """Whether the last effect of a point is a joint of two bodies."""
    return EFFECTS[point.structure.effects[-1]].is_joint


def _find_calmer_estimate(problem: PredictionErrorProblem, point: Estimate) -> Estimate | None:
    """A point that little pushes, near one that much does; None where little does anyway."""
    calm = CALM * problem.noise.velocity**2
    if point.process_noise <= AGITATED * calm:
        return None
    calmer = problem.evaluate(point.structure, point.values, point.nuisance, calm)
    calmer = levenberg_marquardt(problem, calmer, steps=A_LITTLE)
    return calmer if math.isfinite(calmer.cost) else None


def simplify_effect(
    problem: PredictionErrorProblem,
    point: Estimate,
    names: Sequence[str],
    residual: VoltageResidual,
    *,
    effect: str = "",
) -> Estimate | None:
    """An estimate with an effect replaced by its simpler form; None if it has none.

    The optimum of the richer effect is a good start for the simpler one: that must not be rejected
    only because its own search started badly.

    Args:
        problem: the measurements.
        point: with the effect.
        names: of effects to choose from.
        residual: voltage residual of the log.
        effect: to replace; empty for the one that was added last.
    """
    old = EFFECTS[effect or point.structure.effects[-1]]
    name = old.simpler
    if name not in names:
        return None
    mine = {one: point.values[f"{old.name}.{one}"] for one in old.names}
    values = old.simplify(mine, residual)
    structure = point.structure - old.name + name
    more = {
        f"{name}.{one}": structure.clamp_value(f"{name}.{one}", value)
        for one, value in values.items()
    }
    kept = {one: point.values[one] for one in (point.structure - old.name).names}
    return problem.evaluate(structure, {**kept, **more}, point.nuisance, point.process_noise)


def _best_of_each_effect(points: Iterable[Estimate]) -> list[Estimate]:
    """The best point of each effect, the likeliest first."""
    best: dict[str, Estimate] = {}
    for one in sorted(points, key=lambda one: one.cost):
        best.setdefault(one.structure.effects[-1], one)
    return list(best.values())


def _best_starts(
    problem: PredictionErrorProblem, point: Estimate, effects: Iterable[Effect],
    residual: VoltageResidual, seeds: Seeds, *, heavy: bool = False,
) -> list[list[Begun]]:  # fmt: skip
    """The best start of each effect, with what it promises; the most promising effect first.

    Of a joint, one start for each minimum that the step tests suggest: the prediction does not say
    which of these is the best. ``heavy`` tries joints of more inertia, too.
    """
    kept = make_joint_jacobian(problem, point)
    found = []
    step_tests = None
    for effect in effects:
        structure = point.structure + effect.name
        more = [
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
                more = step_tests.list_starts(structure, more, heavy=heavy)
        more += [{**more[0], "kA": share * point.values["kA"]} for share in effect.inertia_shares]
        if effect.has_onset:
            more += scan_onsets(problem, point, effect, kept=kept)
        if effect.name in seeds:
            more.append(dict(seeds[effect.name]))
        begun = rate_starts(problem, point, structure, more, kept=kept, as_given=tried_on_steps)
        begun.sort(key=lambda one: -one[0])
        if begun:
            found.append(begun if tried_on_steps else begun[:1])
    return sorted(found, key=lambda starts: -starts[0][0])
