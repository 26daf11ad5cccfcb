"""Backward elimination: remove or simplify effects that others have made needless."""

import math
from dataclasses import replace

from sim.estimation.likelihood import PredictionErrorProblem
from sim.physics.effects import EFFECTS
from sim.reconcile.candidates import Candidate, score_estimate, simplify_effect
from sim.reconcile.cross_validation import compute_validation_gap
from sim.reconcile.local_minimum import minimize
from sim.reconcile.model_selection import find_required_improvement, is_wider
from sim.reconcile.selection_data import SelectionData
from sim.reconcile.selection_round import SelectionRound


def simplify_effects(data: SelectionData, rounds: list[SelectionRound]) -> list[SelectionRound]:
    """The rounds, with effects replaced by simpler forms that explain as much.

    An effect that was added early also had to explain what later effects explain now, and may have
    needed more parameters for that.
    """
    problem = data.problem
    for place in range(1, len(rounds)):
        last, effect = rounds[-1], rounds[place].candidate.effect
        if data.is_budget_spent():
            break
        point = last.candidate.estimate
        simpler = EFFECTS[effect].simpler
        if simpler in {"", *point.structure.effects}:
            continue
        residual = data.voltage_residual(point)
        start = simplify_effect(problem, point, [simpler], residual, effect=effect)
        if start is None or not math.isfinite(start.cost):
            continue
        found = score_estimate(problem, minimize(problem, start), start.structure.effects[-1])
        gap = compute_validation_gap(problem, found.estimate, data.folds)
        if found.bic <= last.candidate.bic and not is_wider(gap, last.gap):
            swapped = replace(rounds[place].candidate, effect=found.effect)
            rounds = [*rounds]
            rounds[place] = replace(rounds[place], candidate=swapped, rivals=())
            end = replace(found, effect=rounds[-1].candidate.effect)
            rounds[-1] = replace(rounds[-1], candidate=end, gap=gap, rivals=())
    return rounds


def remove_needless_effects(
    data: SelectionData, rounds: list[SelectionRound]
) -> list[SelectionRound]:
    """The rounds of the needed effects, each with the last model refitted without its effect.

    An effect is needless if it improves the BIC of the last model by less than was required
    to add it, because effects that were added later explain the same. The least needed one is
    removed first. A single effect stays: it was admitted over the base model.
    """
    problem = data.problem
    while len(rounds) > 2:  # noqa: PLR2004 - the base and a single effect
        last = rounds[-1].candidate
        reduced = [refit_without_effect(problem, last, one.candidate.effect) for one in rounds[1:]]
        surplus = [
            less.bic - last.bic - find_required_improvement(one.candidate.effect)
            for one, less in zip(rounds[1:], reduced, strict=True)
        ]
        least = min(range(len(surplus)), key=surplus.__getitem__)
        if surplus[least] >= 0.0:
            gaps = [compute_validation_gap(problem, one.estimate, data.folds) for one in reduced]
            refitted = zip(rounds[1:], reduced, gaps, strict=True)
            return [
                rounds[0],
                *(replace(one, without=less, gap_without=gap) for one, less, gap in refitted),
            ]
        kept = [*rounds[: least + 1], *rounds[least + 2 :]]
        found = replace(reduced[least], effect=kept[-1].candidate.effect)
        gap = compute_validation_gap(problem, found.estimate, data.folds)
        rounds = [*kept[:-1], replace(kept[-1], candidate=found, gap=gap)]
    return rounds


def refit_without_effect(
    problem: PredictionErrorProblem, candidate: Candidate, effect: str
) -> Candidate:
    """A model refitted without one of its effects."""
    point = candidate.estimate
    structure = point.structure - effect
    values = {name: point.values[name] for name in structure.names}
    start = problem.change(point, structure=structure, values=values)
    return score_estimate(problem, minimize(problem, start))
