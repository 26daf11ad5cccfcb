"""Backward elimination: replace or simplify effects that were added earlier.

Of two effects that mask each other, the first that is found may be a third one that resembles both.
"""

import math
from collections.abc import Sequence
from dataclasses import replace

from sim.core.log import Log
from sim.estimation.likelihood import PredictionErrorProblem
from sim.physics.effects import EFFECTS
from sim.physics.voltage_residual import compute_voltage_residual
from sim.reconcile.candidates import Candidate, rank_candidates, score_estimate, simplify_effect
from sim.reconcile.cross_validation import Fold, Gap, validation_gap
from sim.reconcile.local_minimum import minimize
from sim.reconcile.model_selection import (
    WIDENS,
    rejection_reason,
    required_improvement,
    score_improvement,
)
from sim.reconcile.selection_round import SelectionRound
from sim.reconcile.thresholds import CLOSE, ONCE, SIMPLER, SURER

ALIKE = 0.3  # [of the best score in its round] from which an effect looked alike


def replace_effects(
    problem: PredictionErrorProblem, done: list[SelectionRound], log: Log, parts: Sequence[Fold]
) -> list[SelectionRound]:
    """Replace an earlier effect by another where that is likelier now."""
    last = done[-1]
    for place in range(1, len(done) - 1):
        effect = done[place].candidate.effect
        others = _look_alikes(done, place)
        if not others:
            continue
        reduced = refit_without(problem, last.candidate, effect)
        if reduced.score - last.candidate.score < required_improvement(
            effect
        ):  # it has become needless
            gap = validation_gap(problem, reduced.estimate, parts)
            if not math.isfinite(gap.velocity + gap.position):
                continue
            rest = [*done[:place], *done[place + 1 : -1]]
            return [
                *rest,
                replace(last, candidate=replace(reduced, effect=last.candidate.effect), gap=gap),
            ]
        model = reduced.estimate.structure.model(reduced.estimate.values)
        evidence = compute_voltage_residual(
            log, dict(model.gains), type=reduced.estimate.structure.type
        )
        found = rank_candidates(problem, reduced.estimate, evidence, only=others, seeds=last.seeds)
        if not found or score_improvement(last.candidate, found[0]) < _required_advantage(
            effect, found[0].effect
        ):
            continue
        gap = validation_gap(problem, found[0].estimate, parts)
        if rejection_reason(gap, last.gap, SURER) == WIDENS:
            continue
        return _replace_one(done, place, found[0], gap)
    return done


def _required_advantage(effect: str, other: str) -> float:
    """[of -2 log L] by which another effect must be likelier to take the place of one."""
    passing = EFFECTS[other].has_onset and not EFFECTS[effect].has_onset
    return ONCE if passing else CLOSE


def simplify_effects(
    problem: PredictionErrorProblem, done: list[SelectionRound], log: Log, parts: Sequence[Fold]
) -> list[SelectionRound]:
    """Replace effects by their simpler forms where these explain as much.

    What an effect had to explain before all was found may have needed its further parameters.
    """
    for place in range(1, len(done)):
        last = done[-1]
        effect = done[place].candidate.effect
        had = last.candidate.estimate.structure.effects  # those that nobody names among them
        names = [EFFECTS[effect].simpler] if EFFECTS[effect].simpler not in {"", *had} else []
        model = last.candidate.estimate.structure.model(last.candidate.estimate.values)
        evidence = compute_voltage_residual(
            log, dict(model.gains), type=last.candidate.estimate.structure.type
        )
        begun = simplify_effect(problem, last.candidate.estimate, names, evidence, effect=effect)
        if begun is None or not math.isfinite(begun.cost):
            continue
        found = score_estimate(problem, minimize(problem, begun), begun.structure.effects[-1])
        gap = validation_gap(problem, found.estimate, parts)
        as_good = found.score - last.candidate.score <= SIMPLER
        if as_good and rejection_reason(gap, last.gap, SURER) != WIDENS:
            done = _replace_one(done, place, found, gap)
    return done


def _look_alikes(done: Sequence[SelectionRound], place: int) -> list[str]:
    """Effects that looked like one that was added, or are known to."""
    effect = done[place].candidate.effect
    had = {one.candidate.effect for one in done}
    tried = done[place - 1].tried
    best = max((one.score for one in tried), default=0.0)
    alike = [one.effect for one in tried if one.score > ALIKE * best]
    return [name for name in dict.fromkeys([*alike, *EFFECTS[effect].apart]) if name not in had]


def _replace_one(
    done: Sequence[SelectionRound], place: int, found: Candidate, gap: Gap
) -> list[SelectionRound]:
    """The rounds with another effect in the place of one."""
    last = done[-1]
    old = done[place]
    if old is last:
        return [*done[:place], replace(last, candidate=found, gap=gap, rivals=())]
    swapped = replace(old.candidate, effect=found.effect)
    middle = [*done[:place], replace(old, candidate=swapped, rivals=()), *done[place + 1 : -1]]
    end = replace(found, effect=last.candidate.effect)
    return [*middle, replace(last, candidate=end, gap=gap, rivals=())]


def measure_removals(
    problem: PredictionErrorProblem, done: list[SelectionRound], parts: Sequence[Fold]
) -> list[SelectionRound]:
    """Each round with the estimate that lacks its effect."""
    last = done[-1].candidate
    if len(last.estimate.structure.effects) <= 1:  # what it brought is what it is worth
        return done
    told = [done[0]]
    for one in done[1:]:
        reduced = refit_without(problem, last, one.candidate.effect)
        gap = validation_gap(problem, reduced.estimate, parts)
        told.append(replace(one, removal_cost=reduced.score - last.score, gap_without=gap))
    return told


def refit_without(problem: PredictionErrorProblem, candidate: Candidate, effect: str) -> Candidate:
    """A model refitted without one of its effects."""
    point = candidate.estimate
    structure = point.structure - effect
    values = {name: point.values[name] for name in structure.names}
    begin = problem.evaluate(structure, values, point.nuisance, point.process_noise)
    return score_estimate(problem, minimize(problem, begin))


def separating_test(effect: str, other: str) -> str:
    """The test that separates two effects; empty if none is known."""
    return EFFECTS[effect].apart.get(other, "") or EFFECTS[other].apart.get(effect, "")
