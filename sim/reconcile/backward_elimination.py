"""Backward elimination: remove or simplify effects that others have made needless."""

import math
from collections.abc import Sequence
from dataclasses import replace

from sim.estimation.likelihood import PredictionErrorProblem
from sim.physics.effects import EFFECTS
from sim.reconcile.candidates import Candidate, score_estimate, simplify_effect
from sim.reconcile.cross_validation import Gap, compute_validation_gap
from sim.reconcile.local_minimum import minimize
from sim.reconcile.model_selection import find_required_improvement, is_wider
from sim.reconcile.selection_data import SelectionData
from sim.reconcile.selection_round import SelectionRound


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


def remove_needless_effects(
    data: SelectionData, done: list[SelectionRound]
) -> list[SelectionRound]:
    """The rounds of the needed effects, each with the last model refitted without its effect.

    An effect is needless if it improves the BIC of the last model by less than was asked of it when
    it was added, because effects that were added later explain the same. The least needed one goes
    first. An only effect stays: it was admitted over the base model.
    """
    problem = data.problem
    while len(done) > 2:  # noqa: PLR2004 - the base and an only effect
        last = done[-1].candidate
        reduced = [refit_without_effect(problem, last, one.candidate.effect) for one in done[1:]]
        surplus = [
            less.bic - last.bic - find_required_improvement(one.candidate.effect)
            for one, less in zip(done[1:], reduced, strict=True)
        ]
        least = min(range(len(surplus)), key=surplus.__getitem__)
        if surplus[least] >= 0.0:
            gaps = [compute_validation_gap(problem, one.estimate, data.folds) for one in reduced]
            rounds = zip(done[1:], reduced, gaps, strict=True)
            return [
                done[0],
                *(replace(one, without=less, gap_without=gap) for one, less, gap in rounds),
            ]
        kept = [*done[: least + 1], *done[least + 2 :]]
        found = replace(reduced[least], effect=kept[-1].candidate.effect)
        gap = compute_validation_gap(problem, found.estimate, data.folds)
        done = [*kept[:-1], replace(kept[-1], candidate=found, gap=gap)]
    return done


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
