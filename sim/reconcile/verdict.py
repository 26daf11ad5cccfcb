"""The verdict: explained, ambiguous, unexplained or nothing missing."""

import math
from collections.abc import Sequence
from itertools import permutations

from sim.core.units import Unit
from sim.estimation.likelihood import PredictionErrorProblem
from sim.reconcile.cross_validation import compute_missed_motion, count_noise_floors
from sim.reconcile.model_selection import contains_effect, list_blocked_candidates
from sim.reconcile.residual_tests.repeatability import POSITION, RepeatedResidual
from sim.reconcile.residual_tests.summary import ResidualSummary
from sim.reconcile.selection_round import SelectionRound
from sim.reconcile.story import AMBIGUOUS, EXPLAINED, NOTHING_MISSING, UNEXPLAINED, Finding
from sim.reconcile.thresholds import COMPARABLE, LOST, MAJOR, VISIBLE_FLOORS, VISIBLE_SPEED


def reach_verdict(
    findings: Sequence[Finding], done: Sequence[SelectionRound], problem: PredictionErrorProblem, *,
    residuals: ResidualSummary, cut: float = math.inf, per: Unit,
) -> tuple[str, bool, str]:  # fmt: skip
    """The verdict, whether something remains, and a sentence about it.

    Args:
        findings: what was named.
        done: the base and the rounds.
        problem: the measurements.
        residuals: what the last model leaves.
        cut: [s] time limit that ended the search; inf if it came to its own end.
        per: the owner's unit.
    """
    gap, before = (one.velocity for one in (done[-1].gap, done[0].gap))
    strays = count_noise_floors(gap, problem)
    share = compute_missed_motion(gap, problem)
    if not share <= LOST:
        remains = (
            f"The last model misses {share:.0%} of the motion on runs it was not fitted to, so "
            "nothing is named. Check that voltage, position and velocity are of the same mechanism "
            "and the same moment."
        )
        return UNEXPLAINED, True, remains
    remains = (
        _describe_cut(cut, strays)
        or _describe_residual(problem, residuals, per)
        or _describe_remainder(findings, done, strays=strays)
    )
    majors = [one for one in findings if one.size == "major"]
    effects = any(one.kind == "effect" for one in majors)
    mostly = effects and strays > VISIBLE_FLOORS and gap > COMPARABLE * before
    if majors:
        unexplained = gap > VISIBLE_SPEED * problem.top_speed and strays > VISIBLE_FLOORS
    else:  # effects of the last model that are not named explain nothing
        unexplained = count_noise_floors(before, problem) > VISIBLE_FLOORS
    if mostly or (remains and unexplained):
        return UNEXPLAINED, True, remains
    if not majors:
        return NOTHING_MISSING, bool(remains), remains
    if any(one.ambiguous_with for one in majors):
        return AMBIGUOUS, bool(remains), remains
    return EXPLAINED, bool(remains), remains


def _describe_cut(limit: float, strays: float) -> str:
    """A sentence about a search that a time limit ended; empty if none did, or nothing is left.

    Args:
        limit: [s] the time limit.
        strays: [noise floors] gap of the last model. Hardly any model comes below one noise floor,
            so of a gap that is nearly as small, no further effect can be major.
    """
    if math.isinf(limit) or MAJOR * strays <= 1.0:
        return ""
    return (
        f"The search stopped at its time limit of {limit:g} s of processor time, so more "
        f"effects may be missing. To search longer: --time-limit {10.0 * limit:g}."
    )


def _describe_remainder(
    findings: Sequence[Finding], done: Sequence[SelectionRound], *, strays: float
) -> str:
    """A sentence about how far the last model still is, or why it may be another; or nothing."""
    if strays > VISIBLE_FLOORS:
        return (
            f"The last model misses the log by {strays:.1f} times the noise of the velocity, "
            "and no effect in the catalogue makes that smaller."
        )
    if likely := list_blocked_candidates(done[-1].candidates):
        return (
            f"With {likely[0].candidate.effect} the model fits this log far better, but "
            "predicts other runs worse: something else is missing, or more than one thing."
        )
    if series := _find_nested_pair(findings):
        return (
            f"This log can be fitted with {series}, which do nearly the same: together they "
            "can follow any force that changes with the position, so the real force may be "
            "another one. Hold the mechanism still at ten places, and write down the voltage "
            "at each."
        )
    return ""


def _describe_residual(
    problem: PredictionErrorProblem, residuals: ResidualSummary, per: Unit
) -> str:
    """A sentence about what the last model leaves that is no noise; empty if it is."""
    if residuals.has_unlikely_window:
        moment = residuals.worst_window
        record = problem.records[moment.record]
        return (
            f"In {record.test}, {moment.start:.2f} to {moment.end:.2f} s, the log shows a "
            f"motion that no effect in the catalogue explains ({moment.size:.0f} times the "
            "usual size)."
        )
    if residuals.is_repeated:
        return _describe_repeated(residuals.repeated, per)
    if residuals.is_periodic:
        return (
            f"Something pushes back and forth every {1.0 / residuals.peak.rate:.2f} s, whatever "
            "the mechanism does, and no effect in the catalogue explains it. Look for "
            "something with a rhythm of its own: a robot that rocks on its blocks, a "
            "compressor, another mechanism."
        )
    return ""


def _find_nested_pair(findings: Sequence[Finding]) -> str:
    """Two effects of which one does about what the other does, with fewer parameters; or nothing.

    On some 2900 logs, none of which has two such effects, they were named together 51 times: on 50
    with a bump, a band or a grip that no effect is, and on one where two others were missed.
    """
    named = {one.effect for one in findings if one.kind == "effect"}
    for one, other in permutations(sorted(named), 2):
        if contains_effect(one, other):
            return f"{one} together with {other}"
    return ""


def _describe_repeated(alike: RepeatedResidual, per: Unit) -> str:
    """A sentence about what runs miss alike."""
    low, high = (f"{edge / per.si:.3g}".replace("-", "−") for edge in (alike.low, alike.high))
    where, of = ("places", "") if alike.what == POSITION else ("speeds", "/s")
    way = "forward" if alike.way > 0 else "in reverse"
    return (
        f"At the same {where} the same error comes back in every run ({alike.size:.0f} times "
        "as large as by chance), and no effect in the catalogue explains it; most of it "
        f"{way}, between {low} and {high} {per.symbol}{of}."
    )
