"""Backward elimination: replace or simplify effects that were added earlier.

Of two effects that mask each other, the first that is found may be a third one that resembles both.
"""

import math
from collections.abc import Sequence
from dataclasses import replace

from sim.estimation.likelihood import PredictionErrorProblem
from sim.physics.effects import EFFECTS
from sim.reconcile.candidates import Candidate, rank_candidates, score_estimate, simplify_effect
from sim.reconcile.cross_validation import Gap, compute_validation_gap
from sim.reconcile.local_minimum import minimize
from sim.reconcile.model_selection import compare_scores, find_required_improvement, is_wider
from sim.reconcile.selection_data import SelectionData
from sim.reconcile.selection_round import SelectionRound
from sim.reconcile.thresholds import COMPARABLE, EQUAL_SCORE, LEAST_SCORE_ONCE


def replace_effects(data: SelectionData, done: list[SelectionRound]) -> list[SelectionRound]:
    """The rounds, with an earlier effect removed if needless, or replaced if another is likelier.

    At most one of them: the search then goes on. A needless effect goes even if the gap becomes
    wider without it: it has then taken the place of another one.
    """
    problem, last = data.problem, done[-1]
    for place in range(1, len(done) - 1):
        effect = done[place].candidate.effect
        others = _look_alikes(done, place)
        if not others:
            continue
        reduced = refit_without_effect(problem, last.candidate, effect)
        needed = reduced.bic - last.candidate.bic >= find_required_improvement(effect)
        if not needed:
            gap = compute_validation_gap(problem, reduced.estimate, data.folds)
            if not math.isfinite(gap.velocity + gap.position):
                continue
            best = replace(reduced, effect=last.candidate.effect)
            return [*done[:place], *done[place + 1 : -1], replace(last, candidate=best, gap=gap)]
        residual = data.voltage_residual(reduced.estimate)
        found = rank_candidates(
            problem, reduced.estimate, residual,
            only=others, seeds=last.seeds, stop=data.out_of_time,
        )  # fmt: skip
        if data.out_of_time():
            break
        if not found or compare_scores(last.candidate, found[0]) < _required_advantage(
            effect, found[0].effect
        ):
            continue
        gap = compute_validation_gap(problem, found[0].estimate, data.folds)
        if is_wider(gap, last.gap):
            continue
        return _replace_one(done, place, found[0], gap)
    return done


def _required_advantage(effect: str, other: str) -> float:
    """[of -2 log L] by which another effect must be likelier to take the place of one."""
    passing = EFFECTS[other].has_onset and not EFFECTS[effect].has_onset
    return LEAST_SCORE_ONCE if passing else EQUAL_SCORE


def simplify_effects(data: SelectionData, done: list[SelectionRound]) -> list[SelectionRound]:
    """The rounds, with effects replaced by simpler forms that explain as much.

    What an effect had to explain before all was found may have needed its further parameters.
    """
    problem = data.problem
    for place in range(1, len(done)):
        last, effect = done[-1], done[place].candidate.effect
        if data.out_of_time():
            break
        point = last.candidate.estimate
        had = point.structure.effects  # those that nobody names among them
        names = [EFFECTS[effect].simpler] if EFFECTS[effect].simpler not in {"", *had} else []
        residual = data.voltage_residual(point)
        begun = simplify_effect(problem, point, names, residual, effect=effect)
        if begun is None or not math.isfinite(begun.cost):
            continue
        found = score_estimate(problem, minimize(problem, begun), begun.structure.effects[-1])
        gap = compute_validation_gap(problem, found.estimate, data.folds)
        if found.bic <= last.candidate.bic and not is_wider(gap, last.gap):
            done = _replace_one(done, place, found, gap)
    return done


def _look_alikes(done: Sequence[SelectionRound], place: int) -> list[str]:
    """Effects that looked like one that was added, or are known to."""
    effect = done[place].candidate.effect
    had = {one.candidate.effect for one in done}
    tried = done[place - 1].tried
    best = max((one.improvement for one in tried), default=0.0)
    alike = [one.effect for one in tried if one.improvement > COMPARABLE * best]
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


def measure_removals(data: SelectionData, done: list[SelectionRound]) -> list[SelectionRound]:
    """The rounds, each with the estimate that lacks its effect.

    Rounds that added a single effect are returned as they are: its own round says what it brought.
    """
    last = done[-1].candidate
    if len(last.estimate.structure.effects) <= 1:  # what it brought is what it is worth
        return done
    told = [done[0]]
    for one in done[1:]:
        reduced = refit_without_effect(data.problem, last, one.candidate.effect)
        gap = compute_validation_gap(data.problem, reduced.estimate, data.folds)
        cost = reduced.bic - last.bic
        told.append(replace(one, removal_cost=cost, without=reduced, gap_without=gap))
    return told


def refit_without_effect(
    problem: PredictionErrorProblem, candidate: Candidate, effect: str
) -> Candidate:
    """A model refitted without one of its effects."""
    point = candidate.estimate
    structure = point.structure - effect
    values = {name: point.values[name] for name in structure.names}
    begin = problem.evaluate(structure, values, point.nuisance, point.process_noise)
    return score_estimate(problem, minimize(problem, begin))


def find_separating_test(effect: str, other: str) -> str:
    """The test that separates two effects; empty if none is known."""
    return EFFECTS[effect].apart.get(other, "") or EFFECTS[other].apart.get(effect, "")
