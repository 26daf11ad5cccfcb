"""Model selection: which candidate is added, by likelihood and by cross-validation."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

from sim.physics.effects import EFFECTS
from sim.reconcile.candidates import rank_candidates
from sim.reconcile.cross_validation import Gap, compute_validation_gap
from sim.reconcile.selection_data import SelectionData
from sim.reconcile.selection_round import SelectionRound, WeighedCandidate
from sim.reconcile.story import TriedCandidate
from sim.reconcile.thresholds import (
    COMPARABLE,
    EQUAL_SCORE,
    LEAST_SCORE,
    LEAST_SCORE_ONCE,
    LEAST_SCORE_UNSEEN,
    MAJOR_UNEXPLAINED,
    NARROWER,
)

HARDLY, WIDENS = "hardly narrows the gap", "widens the gap"
CUT_SHORT = "the search ended before all were compared"
TINY = 1e-300  # avoids a division by a gap of zero


def weigh_candidates(data: SelectionData, now: SelectionRound) -> list[WeighedCandidate]:
    """The best candidates of a round with their cross-validated gaps, likeliest first.

    If the search is stopped before all were tried, those that were tried are returned, and none of
    them is admitted: the best one may be missing among them.
    """
    point = now.candidate.estimate
    found = []
    residual = data.voltage_residual(point)
    ranked = rank_candidates(
        data.problem, point, residual, seeds=now.seeds, stop=data.is_budget_spent
    )
    for candidate in ranked:
        score = now.candidate.bic - candidate.bic
        gap, ratio, why = now.gap, math.nan, "explains too little"
        if score >= find_required_improvement(candidate.effect):
            gap = compute_validation_gap(data.problem, candidate.estimate, data.folds)
            ratio = gap.velocity / max(now.gap.velocity, TINY)
            why = explain_rejection(gap, now.gap, score)
        tried = TriedCandidate(candidate.effect, score, ratio, admitted=not why, why=why)
        found.append(WeighedCandidate(candidate, gap, tried))
    if data.is_budget_spent():
        found = [
            replace(one, report=replace(one.report, admitted=False, why=CUT_SHORT)) for one in found
        ]
    return found


def find_required_improvement(effect: str) -> float:
    """Least decrease of the BIC for which a candidate is added."""
    return LEAST_SCORE_ONCE if EFFECTS[effect].has_onset else LEAST_SCORE


def explain_rejection(gap: Gap, before: Gap, score: float) -> str:
    """Why a candidate is not admitted; empty if it is."""
    if is_wider(gap, before):
        return WIDENS
    narrower = gap.velocity <= NARROWER * before.velocity
    return "" if narrower or score >= LEAST_SCORE_UNSEEN else HARDLY


def is_wider(gap: Gap, before: Gap) -> bool:
    """Whether a gap is clearly wider than another, or not known."""
    if not math.isfinite(gap.velocity + gap.position):
        return True
    velocity = gap.velocity / max(before.velocity, TINY)
    position = gap.position / max(before.position, TINY)
    return bool(min(velocity, math.sqrt(velocity * position)) * NARROWER > 1.0)


def choose_next(admitted: Sequence[WeighedCandidate]) -> WeighedCandidate:
    """The candidate with the smallest BIC, or one half as likely that closes far more of the gap.

    A model that is still far from the log has large process noise, and its likelihood may prefer
    an effect with which no run is predicted better. An effect that begins at a moment has to beat
    the others by ``LEAST_SCORE_ONCE``, because it may be an accident in a single run.
    """

    def has_onset(one: WeighedCandidate) -> bool:
        return EFFECTS[one.candidate.effect].has_onset

    best = max(
        admitted,
        key=lambda one: one.report.improvement - LEAST_SCORE_ONCE * has_onset(one),
    )
    likely = [
        one
        for one in admitted
        if one.report.improvement >= COMPARABLE * best.report.improvement
        and (has_onset(best) or not has_onset(one))
    ]
    closest = min(likely, key=lambda one: one.report.gap_ratio)
    closer = closest.report.gap_ratio < MAJOR_UNEXPLAINED * best.report.gap_ratio
    return closest if closer else best


def list_rivals(
    best: WeighedCandidate, weighed: Sequence[WeighedCandidate]
) -> list[WeighedCandidate]:
    """Effects that explain about as much as the chosen one.

    An effect that has the chosen one as its simpler form always explains as much, so it is a rival
    only if it explains more.
    """
    chosen = best.candidate.effect
    return [
        one
        for one in weighed
        if one is not best
        and one.report.admitted
        and best.report.improvement - one.report.improvement <= EQUAL_SCORE
        and not (
            one.report.improvement <= best.report.improvement
            and contains_effect(one.candidate.effect, chosen)
        )
    ]


def contains_effect(effect: str, other: str) -> bool:
    """Whether an effect has another one as its simpler form, directly or in several steps."""
    simpler = EFFECTS[effect].simpler
    while simpler and simpler != other:
        simpler = EFFECTS[simpler].simpler
    return bool(simpler)


def list_blocked_candidates(weighed: Sequence[WeighedCandidate]) -> list[WeighedCandidate]:
    """Candidates that are much likelier, but simulate other runs worse.

    Something is missing then, but not this effect, or not it alone. Effects with an onset are left
    out, because other runs cannot confirm them, and so are everyday effects.
    """
    return [
        one
        for one in weighed
        if one.report.why == WIDENS
        and one.report.improvement >= LEAST_SCORE_ONCE
        and not EFFECTS[one.candidate.effect].has_onset
        and not is_ordinary_size(one.candidate.effect, one.candidate.estimate.values)
    ]


def is_ordinary_size(effect: str, values: Mapping[str, float]) -> bool:
    """Whether an effect is no larger than on any healthy robot."""
    return EFFECTS[effect].compute_everyday_size(values) <= 1.0
