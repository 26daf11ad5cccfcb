"""Turn the selected effects and the residual tests into findings."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

from sim.core.units import Unit
from sim.estimation.likelihood import PredictionErrorProblem
from sim.estimation.optimize import compute_standard_errors
from sim.physics.effects import EFFECTS
from sim.reconcile.backward_elimination import find_separating_test
from sim.reconcile.cross_validation import Gap, count_noise_floors
from sim.reconcile.damage import DamagedInterval
from sim.reconcile.judgement import is_narrower_with, judge_effects
from sim.reconcile.probability import JudgedEffect, compute_log_ratio
from sim.reconcile.residual_tests.summary import ResidualSummary
from sim.reconcile.selection_round import SelectionRound
from sim.reconcile.story import Chapter, Finding, ParameterEstimate
from sim.reconcile.thresholds import (
    LEAST_PROBABILITY,
    MAJOR,
    MAJOR_UNEXPLAINED,
    NARROWER,
    SURE_FAULT,
    VISIBLE_FLOORS,
)


def make_findings(
    problem: PredictionErrorProblem, done: Sequence[SelectionRound],
    damages: Sequence[DamagedInterval], chapters: Sequence[Chapter], *,
    without: Mapping[str, float], held_out: bool, residuals: ResidualSummary, per: Unit,
) -> tuple[tuple[Finding, ...], tuple[JudgedEffect, ...]]:  # fmt: skip
    """Findings, faults first, then effects, major ones first; and all effects that were judged.

    An effect is a finding if it is likelier right than wrong. What any robot has a little of stays
    in the model and is no finding, however much of a small gap it takes. Nor is a minor effect
    beside a major one with which the gap of other runs does not shrink, nor one with which the
    shown log is missed by more, unless that log is held out: then it decides nothing. A fault that
    is cut out for safety's sake, but may be physics, comes after the major effects.

    Args:
        problem: the measurements.
        done: the base and the rounds.
        damages: of the record.
        chapters: of the shown log, one for each round.
        without: effect -> [owner's unit/s] gap of the last model without it on the shown log.
        held_out: whether the shown log decides nothing.
        residuals: what the last model leaves.
        per: the owner's unit.
    """
    faults = [_make_fault_finding(one, chapters[0].gap) for one in damages]
    judged = judge_effects(problem, done, residuals, damaged=bool(damages))
    noises = count_noise_floors(done[-1].gap.velocity, problem)
    far = noises > VISIBLE_FLOORS or residuals.has_structure
    gaps = {name: (gap, chapters[-1].gap) for name, gap in without.items()}
    told = {one.effect: one for one in judged if one.probability >= LEAST_PROBABILITY}
    effects = [
        replace(one, probability=told[one.effect].probability)
        for one in _classify_size(problem, done, gaps, far=far, per=per)
        if one.effect in told
    ]
    if not held_out:
        effects = [_demote_unseen(one) for one in effects]
        effects = [one for one in effects if not NARROWER * one.gap_after > one.gap_before]
    if any(one.size == "major" for one in effects):
        rounds = {one.candidate.effect: one for one in done[1:]}
        effects = [
            one
            for one in effects
            if one.size == "major" or is_narrower_with(rounds[one.effect], done[-1])
        ]
    closed = _shares_closed(done)
    effects.sort(key=lambda one: -one.probability * closed[one.effect])
    return tuple(sorted((*faults, *effects), key=_sort_key)), judged


def _shares_closed(done: Sequence[SelectionRound]) -> dict[str, float]:
    """Effect -> [1] of the velocity gap that it closes: the largest is the most important.

    What it closes as the first effect and as the last one differs, so the geometric mean of both
    counts, as in the Shapley value of two effects. An effect that was not compared in the first
    round, because others were more promising, is taken to close nothing alone.

    Args:
        done: the base and the rounds.
    """
    alone = {one.effect: one.gap_ratio for one in done[0].tried}
    found = {}
    for one in done[1:]:
        name = one.candidate.effect
        last = compute_log_ratio(done[-1].gap.velocity, one.gap_without.velocity)
        first = compute_log_ratio(alone.get(name, 1.0), 1.0)
        found[name] = 1.0 - math.exp(0.5 * (first + last))
    return found


def _classify_size(
    problem: PredictionErrorProblem,
    done: Sequence[SelectionRound],
    gaps: Mapping[str, tuple[float, float]],
    *,
    far: bool,
    per: Unit,
) -> list[Finding]:
    """What each round added, major or minor.

    Of effects that stand in for one another none is missed alone: if together they closed the gap,
    the one that closed most of it is major.
    """
    least = MAJOR_UNEXPLAINED if far else MAJOR
    errors = compute_standard_errors(problem, done[-1].candidate.estimate)
    found = [
        _make_effect_finding(
            done[n],
            done[-1],
            errors,
            *gaps[done[n].candidate.effect],
            per=per,
            least=least,
        )
        for n in range(1, len(done))
    ]
    closed = done[-1].gap.velocity <= least * done[0].gap.velocity
    if closed and not far and all(one.size != "major" for one in found):
        left = [_share_left(before.gap, one.gap) for before, one in pairwise(done)]
        if left:
            most = left.index(min(left))
            found[most] = replace(found[most], size="major")
    return found


def _demote_unseen(one: Finding) -> Finding:
    """The finding, minor where the shown gap does not visibly shrink with it."""
    seen = one.gap_after <= NARROWER * one.gap_before
    return one if seen else replace(one, size="minor")


def _share_left(before: Gap, after: Gap) -> float:
    """[1] share of the velocity gap that is left after a round."""
    return after.velocity / before.velocity if before.velocity > 0.0 else math.inf


def _sort_key(one: Finding) -> int:
    """Its place: sure faults, major effects, faults that are none perhaps, minor effects."""
    return 2 * (one.size != "major") + (one.kind == "effect")


def _make_fault_finding(one: DamagedInterval, gap: float) -> Finding:
    size = "major" if one.confidence >= SURE_FAULT else "minor"
    return Finding(
        effect=one.fault, kind="fault", size=size, ambiguous_with=(), parameters={},
        gap_before=gap, gap_after=gap, sentence=one.sentence, inspect=one.advice,
        separating_test="",
    )  # fmt: skip


def _make_effect_finding(
    now: SelectionRound, end: SelectionRound, errors: Mapping[str, float],
    gap_before: float, gap_after: float, *, per: Unit, least: float,
) -> Finding:  # fmt: skip
    name = now.candidate.effect
    effect = EFFECTS[name]
    last = end.candidate.estimate
    major = end.gap.velocity <= least * now.gap_without.velocity
    parameters = {}
    for one in effect.parameters:
        whole = f"{name}.{one.name}"
        scale = per.si**one.power
        error = errors.get(whole)
        parameters[one.name] = ParameterEstimate(
            last.values[whole] * scale, None if error is None else error * scale,
            one.unit.format(u=per.symbol),
        )  # fmt: skip
    tests = [test for rival in now.rivals if (test := find_separating_test(name, rival))]
    return Finding(
        effect=name, kind="effect", size="major" if major else "minor", ambiguous_with=now.rivals,
        parameters=parameters, gap_before=gap_before, gap_after=gap_after,
        sentence=f"{effect.summary[0].upper()}{effect.summary[1:]}. {effect.fingerprint}",
        inspect=effect.inspect, separating_test=" ".join(dict.fromkeys(tests)),
    )  # fmt: skip
