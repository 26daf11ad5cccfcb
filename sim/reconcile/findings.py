"""Turn the selected effects and the residual tests into findings."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

from sim.core.units import Unit
from sim.estimation.likelihood import PredictionErrorProblem
from sim.estimation.run_variation import compute_standard_errors
from sim.physics.effect import LATER, UNTIL
from sim.physics.effects import EFFECTS, list_look_alikes
from sim.reconcile.backlash_phase import reverses_within_run
from sim.reconcile.cross_validation import count_noise_floors
from sim.reconcile.damage import DamagedInterval
from sim.reconcile.judgement import is_narrower_with, judge_effects
from sim.reconcile.probability import JudgedEffect, compute_log_ratio
from sim.reconcile.remarks import select_reported_rounds
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
    problem: PredictionErrorProblem, rounds: Sequence[SelectionRound],
    damages: Sequence[DamagedInterval], chapters: Sequence[Chapter], *,
    without: Mapping[str, float], residuals: ResidualSummary, unit: Unit,
) -> tuple[tuple[Finding, ...], tuple[JudgedEffect, ...], tuple[str, ...]]:  # fmt: skip
    """Findings in order of importance, all effects that were judged, and those that were refuted.

    An effect is a finding if its probability is at least ``LEAST_PROBABILITY``. These are not
    findings: an everyday effect, which only stays in the model; beside a major effect, a minor one
    that does not narrow the cross-validated gap; and an effect that widens the cross-validated gap
    or that of the shown log, alone or together with the others. A major one is refuted then.

    Args:
        problem: the measurements.
        rounds: the base model and the selection rounds.
        damages: faults of the record that are reported.
        chapters: each round's model on the shown log.
        without: effect -> [log's unit/s] gap of the last model without it on the shown log.
        residuals: residual tests of the last model.
        unit: the log's unit.
    """
    faults = [_make_fault_finding(one, chapters[0].gap) for one in damages]
    judged = judge_effects(problem, rounds, residuals, damaged=bool(damages))
    floors = count_noise_floors(rounds[-1].gap.velocity, problem)
    incomplete = floors > VISIBLE_FLOORS or residuals.has_structure
    gaps = {name: (gap, chapters[-1].gap) for name, gap in without.items()}
    sized = _classify_size(problem, rounds, gaps, judged, incomplete=incomplete, unit=unit)
    effects = [one for one in sized if one.probability >= LEAST_PROBABILITY]
    by_effect = {one.candidate.effect: one for one in rounds[1:]}
    confirmed = [
        one
        for one in effects
        if one.gap_after <= one.gap_before
        and rounds[-1].gap.velocity <= by_effect[one.effect].gap_without.velocity
    ]
    refuted = tuple(one.effect for one in effects if one.size == "major" and one not in confirmed)
    effects = [  # minor where the gap on the shown log is not narrower with it
        one if one.gap_after <= NARROWER * one.gap_before else replace(one, size="minor")
        for one in confirmed
    ]
    if any(one.size == "major" for one in effects):
        effects = [
            one
            for one in effects
            if one.size == "major" or is_narrower_with(by_effect[one.effect], rounds[-1])
        ]
    closed = _compute_closed_shares(rounds)
    effects.sort(key=lambda one: -one.probability * closed[one.effect])
    last = chapters[len(select_reported_rounds(rounds, effects)) - 1]
    if not last.gap <= chapters[0].gap:
        refuted, effects = tuple(one.effect for one in effects), []
    return tuple(sorted((*faults, *effects), key=_sort_key)), judged, refuted


def _compute_closed_shares(rounds: Sequence[SelectionRound]) -> dict[str, float]:
    """Effect -> [1] share of the velocity gap that it closes: the largest is the most important.

    An effect closes another share as the first effect than as the last one, so the gap ratios of
    both are averaged geometrically, as in the Shapley value of two effects. An effect that was not
    compared in the first round, because others were more promising, is taken to close nothing then.
    """
    alone = {one.effect: one.gap_ratio for one in rounds[0].tried}
    found = {}
    for one in rounds[1:]:
        name = one.candidate.effect
        last = compute_log_ratio(rounds[-1].gap.velocity, one.gap_without.velocity)
        first = compute_log_ratio(alone.get(name, 1.0), 1.0)
        found[name] = 1.0 - math.exp(0.5 * (first + last))
    return found


def _classify_size(
    problem: PredictionErrorProblem,
    rounds: Sequence[SelectionRound],
    gaps: Mapping[str, tuple[float, float]],
    judged: Sequence[JudgedEffect],
    *,
    incomplete: bool,
    unit: Unit,
) -> list[Finding]:
    """The finding of each round's effect, major or minor.

    Without one of several effects that resemble each other, the others take its place, so all of
    them are minor at first. If together they closed the gap, the one that closed most is major.
    """
    least = MAJOR_UNEXPLAINED if incomplete else MAJOR
    last = rounds[-1].candidate.estimate
    errors = compute_standard_errors(problem, last)
    if not reverses_within_run(problem):  # a run that starts within a backlash crosses a part of it
        errors |= {name: last.values[name] for name in last.structure.backlash_names}
    probabilities = {one.effect: one.probability for one in judged}
    found = [
        _make_effect_finding(
            one,
            rounds[-1],
            errors,
            *gaps[one.candidate.effect],
            unit=unit,
            least=least,
            probability=probabilities.get(one.candidate.effect, 0.0),
        )
        for one in rounds[1:]
    ]
    closed = rounds[-1].gap.velocity <= least * rounds[0].gap.velocity
    if closed and not incomplete and all(one.size != "major" for one in found):
        ratios = [
            compute_log_ratio(one.gap.velocity, before.gap.velocity)
            for before, one in pairwise(rounds)
        ]
        if ratios:
            most = ratios.index(min(ratios))
            found[most] = replace(found[most], size="major")
    return found


def _sort_key(one: Finding) -> int:
    """Sort key: sure faults, major effects, unsure faults (they may be physics), minor effects."""
    return 2 * (one.size != "major") + (one.kind == "effect")


def _make_fault_finding(one: DamagedInterval, gap: float) -> Finding:
    size = "major" if one.confidence >= SURE_FAULT else "minor"
    return Finding(
        effect=one.fault, kind="fault", size=size, ambiguous_with=(), parameters={},
        gap_before=gap, gap_after=gap, sentence=one.sentence, inspect=one.advice,
        separating_test="", probability=one.confidence,
    )  # fmt: skip


def make_suspicions(
    suspected: Sequence[DamagedInterval], findings: Sequence[Finding], gap: float
) -> tuple[Finding, ...]:
    """Minor findings of faults that could be an unexplained effect and have no finding yet.

    Args:
        suspected: faults that look like missing physics.
        findings: the effects and faults that are reported already.
        gap: [log's unit/s] of the base model on the shown log.
    """
    named = {one.effect for one in findings}
    return tuple(
        replace(_make_fault_finding(one, gap), size="minor")
        for one in suspected
        if one.fault not in named
    )


def _make_effect_finding(
    now: SelectionRound, end: SelectionRound, errors: Mapping[str, float],
    gap_before: float, gap_after: float, *, unit: Unit, least: float, probability: float,
) -> Finding:  # fmt: skip
    name = now.candidate.effect
    effect = EFFECTS[name]
    last = end.candidate.estimate
    major = end.gap.velocity <= least * now.gap_without.velocity
    parameters = {}
    for one in effect.parameters:
        if one.name == UNTIL and last.values[f"{name}.{UNTIL}"] == LATER:
            continue  # it does not end within the log
        key = f"{name}.{one.name}"
        scale = unit.si**one.power
        error = errors.get(key)
        parameters[one.name] = ParameterEstimate(
            last.values[key] * scale, None if error is None else error * scale,
            one.unit.format(u=unit.symbol),
        )  # fmt: skip
    alike = list_look_alikes(name)
    tests = [alike[rival] for rival in now.rivals if alike.get(rival)]
    return Finding(
        effect=name, kind="effect", size="major" if major else "minor", ambiguous_with=now.rivals,
        parameters=parameters, gap_before=gap_before, gap_after=gap_after,
        sentence=f"{effect.summary[0].upper()}{effect.summary[1:]}. {effect.fingerprint}",
        inspect=effect.inspect, separating_test=" ".join(dict.fromkeys(tests)),
        probability=probability,
    )  # fmt: skip
