"""The verdict: explained, ambiguous, unexplained or nothing missing."""

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
from sim.reconcile.thresholds import COMPARABLE, LOST, VISIBLE_FLOORS, VISIBLE_SPEED

CUT_SHORT = (
    "A search has a limit. To search further, give --effort a number above 1: with --effort 5, "
    "the limit is five times as high."
)
REFUTED = (
    "With {} the model fits the log better, but it misses runs that were not fitted by more. So "
    "this is not the cause, or the logs are of different mechanisms."
)


def reach_verdict(
    findings: Sequence[Finding], rounds: Sequence[SelectionRound], problem: PredictionErrorProblem,
    *, residuals: ResidualSummary, complete: bool = True, refuted: Sequence[str] = (), unit: Unit,
) -> tuple[str, bool, str]:  # fmt: skip
    """The verdict, whether something remains, and a sentence about it.

    Args:
        findings: the reported effects and faults.
        rounds: the base model and the selection rounds.
        problem: the measurements.
        residuals: residual tests of the last model.
        complete: whether the search ended before its budget.
        refuted: major effects that widen the gap on runs that were not fitted.
        unit: the log's unit.
    """
    gap, before = (one.velocity for one in (rounds[-1].gap, rounds[0].gap))
    floors = count_noise_floors(gap, problem)
    share = compute_missed_motion(gap, problem)
    if not share <= LOST:
        remains = (
            f"The last model misses {share:.0%} of the motion on runs it was not fitted to, so "
            "nothing is named. Check that voltage, position and velocity are of the same mechanism "
            "and the same moment."
        )
        return UNEXPLAINED, True, remains
    remains = (
        (CUT_SHORT if not complete else "")
        or (REFUTED.format(" and ".join(refuted)) if refuted else "")
        or _describe_residual(problem, residuals, unit)
        or _describe_remainder(findings, rounds, floors=floors)
    )
    majors = [one for one in findings if one.size == "major"]
    effects = any(one.kind == "effect" for one in majors)
    mostly = effects and floors > VISIBLE_FLOORS and gap > COMPARABLE * before
    if majors:
        unexplained = gap > VISIBLE_SPEED * problem.top_speed and floors > VISIBLE_FLOORS
    else:  # effects of the last model that are no findings explain nothing
        unexplained = count_noise_floors(before, problem) > VISIBLE_FLOORS
    if mostly or (remains and unexplained):
        return UNEXPLAINED, True, remains
    if not majors:
        return NOTHING_MISSING, bool(remains), remains
    if any(one.ambiguous_with for one in majors):
        return AMBIGUOUS, bool(remains), remains
    return EXPLAINED, bool(remains), remains


def _describe_remainder(
    findings: Sequence[Finding], rounds: Sequence[SelectionRound], *, floors: float
) -> str:
    """A sentence about a wide gap, or a sign that the model is wrong; empty if there is none."""
    if floors > VISIBLE_FLOORS:
        return (
            "The last model still misses the log by more than its noise, and the search accepts "
            "no effect that makes that smaller."
        )
    if likely := list_blocked_candidates(rounds[-1].candidates):
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
    problem: PredictionErrorProblem, residuals: ResidualSummary, unit: Unit
) -> str:
    """A sentence about structure in the last model's residuals; empty if they are noise."""
    if residuals.has_unlikely_window:
        window = residuals.worst_window
        record = problem.records[window.record]
        return (
            f"In {record.test}, {window.start:.2f} to {window.end:.2f} s, the log shows a "
            f"motion that no effect in the catalogue explains ({window.size:.0f} times the "
            "usual size)."
        )
    if residuals.is_repeated:
        return _describe_repeated(residuals.repeated, unit)
    if residuals.is_periodic:
        return (
            f"Something pushes back and forth every {1.0 / residuals.peak.rate:.2f} s, whatever "
            "the mechanism does, and no effect in the catalogue explains it. Look for "
            "something with a rhythm of its own: a robot that rocks on its blocks, a "
            "compressor, another mechanism."
        )
    return ""


def _find_nested_pair(findings: Sequence[Finding]) -> str:
    """The names of two found effects of which one is a simpler form of the other; or nothing.

    On some 2900 logs, none of which has two such effects, they were found together 51 times: on 50
    with a force that is not in the catalogue, and on one where two other effects were not found.
    """
    named = {one.effect for one in findings if one.kind == "effect"}
    for one, other in permutations(sorted(named), 2):
        if contains_effect(one, other):
            return f"{one} together with {other}"
    return ""


def _describe_repeated(repeated: RepeatedResidual, unit: Unit) -> str:
    """A sentence about residuals that runs share."""
    low, high = (
        f"{edge / unit.si:.3g}".replace("-", "−") for edge in (repeated.low, repeated.high)
    )
    where, of = ("places", "") if repeated.what == POSITION else ("speeds", "/s")
    way = "forward" if repeated.way > 0 else "in reverse"
    return (
        f"At the same {where} the same error comes back in every run ({repeated.size:.0f} times "
        "as large as by chance), and no effect in the catalogue explains it; most of it "
        f"{way}, between {low} and {high} {unit.symbol}{of}."
    )
