"""Turn the selected effects and the residual tests into findings."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from sim.core.units import Unit
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.optimize import compute_standard_errors
from sim.physics.effect import ONSET
from sim.physics.effects import EFFECTS
from sim.reconcile.backward_elimination import find_separating_test
from sim.reconcile.cross_validation import Gap, compute_missed_motion, count_noise_floors
from sim.reconcile.damage import DamagedInterval
from sim.reconcile.model_selection import is_ordinary_size
from sim.reconcile.probability import (
    Evidence,
    JudgedEffect,
    compute_log_ratio,
    compute_log_size,
    compute_probability,
    compute_rival_share,
)
from sim.reconcile.residual_tests.summary import ResidualSummary
from sim.reconcile.selection_round import SelectionRound
from sim.reconcile.story import Chapter, Finding, ParameterEstimate
from sim.reconcile.thresholds import (
    LATEST,
    LEAST_PROBABILITY,
    LOST,
    MAJOR,
    MAJOR_UNEXPLAINED,
    NARROWER,
    SOONEST,
    SURE_FAULT,
    VISIBLE_FLOORS,
)

TURNLESS = (
    "The free play is known only to a factor of two: no fitted run changes direction, and "
    "only a run that does is sure to cross all of the play. Record steps forward and back in "
    "one run."
)

BELIED = (
    "The last model has {} right before the moment that it explains least. It is not named: what "
    "happened then may be something else."
)


DOUBTED = (
    "With {} the model fits this log better. The probability that the mechanism really has this "
    "effect is only {}, so the model leaves it out."
)


def make_findings(
    problem: PredictionErrorProblem, done: Sequence[SelectionRound],
    damages: Sequence[DamagedInterval], chapters: Sequence[Chapter], *,
    without: Mapping[str, float], held_out: bool, left: ResidualSummary, per: Unit,
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
        left: what the last model leaves.
        per: the owner's unit.
    """
    faults = [_make_fault_finding(one, chapters[0].gap) for one in damages]
    judged = judge_effects(problem, done, left, damaged=bool(damages))
    noises = count_noise_floors(done[-1].gap.velocity, problem)
    far = noises > VISIBLE_FLOORS or left.has_structure
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
            one for one in effects if one.size == "major" or _narrows(rounds[one.effect], done[-1])
        ]
    closed = _shares_closed(done)
    effects.sort(key=lambda one: -one.probability * closed[one.effect])
    return tuple(sorted((*faults, *effects), key=_sort_key)), judged


def judge_effects(
    problem: PredictionErrorProblem,
    done: Sequence[SelectionRound],
    left: ResidualSummary,
    *,
    damaged: bool,
) -> tuple[JudgedEffect, ...]:
    """The effects of the last model that may be findings, each with its probability.

    Args:
        problem: the measurements.
        done: the base model and the selection rounds.
        left: residuals of the last model.
        damaged: whether damaged intervals were excluded.
    """
    last = done[-1].candidate.estimate
    missed = compute_missed_motion(done[-1].gap.velocity, problem)
    if not missed <= LOST:  # no number at all is lost, too
        return ()
    possible = [
        (before, now)
        for before, now in pairwise(done)
        if not is_ordinary_size(now.candidate.effect, last.values)
        and not is_contradicted(now.candidate.effect, problem, last, left)
        and not oscillates_within_sample(now.candidate.effect, problem, last.values)
    ]
    found = []
    for place, (before, now) in enumerate(possible):
        name = now.candidate.effect
        with_, bare = compare_gaps(now, done[-1])
        added = before.candidate.score - now.candidate.score
        evidence = Evidence(
            likelihood=math.log(max(_removal_cost(before, now), 1.0)),
            gap=0.5
            * (
                compute_log_ratio(with_.velocity, bare.velocity)
                + compute_log_ratio(with_.position, bare.position)
            ),
            size=compute_log_size(name, last.values),
            rival=compute_rival_share(
                name, added, list_rival_scores(before, last.structure.effects, name)
            ),
            later=float(place > 0),
            structure=float(left.has_structure),
            once=float(EFFECTS[name].has_onset),
            damaged=float(damaged and EFFECTS[name].has_onset),
        )
        found.append(JudgedEffect(name, now.rivals, evidence, compute_probability(evidence)))
    return tuple(found)


def oscillates_within_sample(
    effect: str, problem: PredictionErrorProblem, values: Mapping[str, float]
) -> bool:
    """Whether a soft joint oscillates once or more from one sample to the next.

    No log can show that. The angular frequency is 1/√(softness·share·(1 - share)·kA) [rad/s].

    Args:
        effect: its name.
        problem: the measurements.
        values: of a model, in SI.
    """
    if "joint_compliance" not in EFFECTS[effect].hooks:
        return False
    share, soft = values[f"{effect}.share"], values[f"{effect}.softness"]
    reduced = share * (1.0 - share) * values["kA"]
    return 2.0 * math.pi * math.sqrt(max(soft * reduced, 0.0)) < problem.period


def list_rival_scores(before: SelectionRound, kept: Sequence[str], name: str) -> dict[str, float]:
    """Candidate -> its score in the round of an effect, without other effects of the last model.

    Those explain something else: they are in the model beside it.

    Args:
        before: the round.
        kept: the effects of the last model.
        name: the effect.
    """
    others = {*kept} - {name}
    return {one.effect: one.score for one in before.tried if one.effect not in others}


def _removal_cost(before: SelectionRound, now: SelectionRound) -> float:
    """[of -2 log L] what the last model loses without an effect; what it brought, if not asked."""
    if math.isnan(now.removal_cost):
        return before.candidate.score - now.candidate.score
    return now.removal_cost


def _shares_closed(done: Sequence[SelectionRound]) -> dict[str, float]:
    """Effect -> [1] of the velocity gap that it closes: the largest is the most important.

    What it closes as the first effect and as the last one differs, so the geometric mean of both
    counts, as in the Shapley value of two effects. For an effect that was not tried alone, what it
    closes as the last one counts.

    Args:
        done: the base and the rounds.
    """
    alone = {one.effect: one.gap for one in done[0].tried}
    found = {}
    for one in done[1:]:
        name = one.candidate.effect
        with_, bare = compare_gaps(one, done[-1])
        last = compute_log_ratio(with_.velocity, bare.velocity)
        first = compute_log_ratio(alone[name], 1.0) if name in alone else last
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
            done[n - 1],
            done[n],
            done[-1],
            errors,
            *gaps[done[n].candidate.effect],
            per=per,
            least=least,
        )
        for n in range(1, len(done))
    ]
    closed = done[-1].gap.velocity <= least * done[0].gap_before.velocity
    if closed and not far and all(one.size != "major" for one in found):
        most = min(range(len(found)), key=lambda n: _share_left(done[n + 1]), default=None)
        if most is not None:
            found[most] = replace(found[most], size="major")
    return found


def _demote_unseen(one: Finding) -> Finding:
    """The finding, minor where the shown gap does not visibly shrink with it."""
    seen = one.gap_after <= NARROWER * one.gap_before
    return one if seen else replace(one, size="minor")


def _narrows(added: SelectionRound, end: SelectionRound) -> bool:
    """Whether the last model's gap, of velocity and position, is narrower with an effect."""
    with_, bare = compare_gaps(added, end)
    product = with_.velocity * with_.position
    return product <= NARROWER**2 * bare.velocity * bare.position


def compare_gaps(added: SelectionRound, end: SelectionRound) -> tuple[Gap, Gap]:
    """The gap of the last model, and of the same without one effect, refitted.

    Where the last model has one effect only, that is what its round brought.
    """
    if added.gap_without is None:
        return added.gap, added.gap_before
    return end.gap, added.gap_without


def _share_left(one: SelectionRound) -> float:
    """[1] of the gap before it that an effect left when it was added."""
    return one.gap.velocity / one.gap_before.velocity if one.gap_before.velocity > 0.0 else math.inf


def _sort_key(one: Finding) -> int:
    """Its place: sure faults, major effects, faults that are none perhaps, minor effects."""
    return 2 * (one.size != "major") + (one.kind == "effect")


def is_contradicted(
    effect: str, problem: PredictionErrorProblem, last: Estimate, left: ResidualSummary
) -> bool:
    """Whether the largest unexplained residual follows this effect's onset.

    A sensor that slips or a robot that is bumped loses speed as one does that takes up a load, but
    has it back at another pace. The knock itself is known to a sample, and never explained quite.
    """
    moment = left.worst_window
    if not (EFFECTS[effect].has_onset and left.has_unlikely_window):
        return False
    record = problem.records[moment.record]
    onset = last.values[f"{effect}.{ONSET}"] - record.clock + float(record.measurements.time[0])
    return onset + SOONEST * problem.period < moment.start < onset + LATEST


def select_reported_rounds(
    done: Sequence[SelectionRound], findings: Sequence[Finding], judged: Sequence[JudgedEffect]
) -> Sequence[SelectionRound]:
    """The rounds to show: up to the last whose effect is named or, if everyday, narrows the gap.

    An effect that is less likely than not is not shown as if it explained the log.
    """
    named = {one.effect for one in findings}
    unlikely = _list_unlikely(judged)
    last = max(
        n
        for n, one in enumerate(done)
        if n == 0
        or one.candidate.effect in named
        or (one.candidate.effect not in unlikely and _narrows(one, done[-1]))
    )
    return done[: last + 1]


def _list_unlikely(judged: Sequence[JudgedEffect]) -> dict[str, float]:
    """Effect -> probability, of the effects that are less likely than not."""
    return {one.effect: one.probability for one in judged if one.probability < LEAST_PROBABILITY}


def list_remarks(
    problem: PredictionErrorProblem,
    done: Sequence[SelectionRound],
    findings: Sequence[Finding],
    judged: Sequence[JudgedEffect],
    left: ResidualSummary,
) -> tuple[str, ...]:
    """Remarks: effects that were not reported, and what the data do not determine."""
    last = done[-1].candidate.estimate
    structure = last.structure
    named = {one.effect for one in findings}
    unsure = [name for name in structure.effects if is_contradicted(name, problem, last, left)]
    rest = [name for name in structure.effects if name not in {*named, *unsure}]
    last_shown = select_reported_rounds(done, findings, judged)[-1]
    kept = last_shown.candidate.estimate.structure.effects
    said = []
    if inside := [name for name in rest if name in kept]:
        what = " and ".join(inside)
        why = "no more than on other robots, or too little to narrow the gap"
        said.append(f"In the last model there is also a little {what}: {why}.")
    unlikely = _list_unlikely(judged)
    doubted = [name for name in rest if name not in kept and name in unlikely]
    said += [DOUBTED.format(name, f"{unlikely[name]:.0%}") for name in doubted]
    if outside := [name for name in rest if name not in {*kept, *doubted}]:
        what = " and ".join(outside)
        said.append(
            f"A little {what} would fit the log better, but the gap does not shrink with it, so "
            "the model leaves it out."
        )
    said += [BELIED.format(name) for name in unsure]
    if structure.has_backlash and not _reverses_within_run(problem):
        said.append(TURNLESS)
    return tuple(said)


def _reverses_within_run(problem: PredictionErrorProblem) -> bool:
    """Whether it moved both ways within a run."""
    ways = [
        np.sign(problem.measured[first:last, 1][problem.moving[first:last]])
        for first, last in pairwise(problem.run_edges.tolist())
    ]
    return any((one > 0.0).any() and (one < 0.0).any() for one in ways)


def _make_fault_finding(one: DamagedInterval, gap: float) -> Finding:
    size = "major" if one.confidence >= SURE_FAULT else "minor"
    return Finding(
        effect=one.fault, kind="fault", size=size, ambiguous_with=(), parameters={},
        gap_before=gap, gap_after=gap, score=math.inf, sentence=one.sentence, inspect=one.advice,
        separating_test="",
    )  # fmt: skip


def _make_effect_finding(  # noqa: PLR0917 - two rounds, and what to call them
    before: SelectionRound, now: SelectionRound, end: SelectionRound, errors: Mapping[str, float],
    gap_before: float, gap_after: float, *, per: Unit, least: float,
) -> Finding:  # fmt: skip
    name = now.candidate.effect
    effect = EFFECTS[name]
    last = end.candidate.estimate
    with_, bare = compare_gaps(now, end)
    major = with_.velocity <= least * bare.velocity
    score = _removal_cost(before, now)
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
        score=score,
        sentence=f"{effect.summary[0].upper()}{effect.summary[1:]}. {effect.fingerprint}",
        inspect=effect.inspect, separating_test=" ".join(dict.fromkeys(tests)),
    )  # fmt: skip
