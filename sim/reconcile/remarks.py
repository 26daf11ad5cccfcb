"""Remarks: effects of the last model that are no findings, and what the data do not determine."""

from collections.abc import Sequence

from sim.estimation.likelihood import PredictionErrorProblem
from sim.reconcile.backlash_phase import reverses_within_run
from sim.reconcile.judgement import is_contradicted, is_narrower_with
from sim.reconcile.model_selection import is_ordinary_size
from sim.reconcile.probability import JudgedEffect
from sim.reconcile.residual_tests.summary import ResidualSummary
from sim.reconcile.selection_round import SelectionRound
from sim.reconcile.story import Finding
from sim.reconcile.thresholds import LEAST_PROBABILITY

NO_REVERSAL = (
    "The free play is known only to a factor of two: no fitted run changes direction, and "
    "only a run that does is sure to cross all of the play. Record steps forward and back in "
    "one run."
)

CONTRADICTED = (
    "With {} the model fits this log better, but the part of the log that it explains least comes "
    "right after this effect begins. The real cause may be another one, so the model leaves it out."
)

UNLIKELY = (
    "With {} the model fits this log better. The probability that the mechanism really has this "
    "effect is {}, so the model leaves it out."
)


def list_remarks(
    problem: PredictionErrorProblem,
    rounds: Sequence[SelectionRound],
    findings: Sequence[Finding],
    judged: Sequence[JudgedEffect],
    residuals: ResidualSummary,
) -> tuple[str, ...]:
    """Remarks: effects that were not reported, and what the data do not determine."""
    last = rounds[-1].candidate.estimate
    structure = last.structure
    named = {one.effect for one in findings}
    contradicted = [
        name for name in structure.effects if is_contradicted(name, problem, last, residuals)
    ]
    rest = [name for name in structure.effects if name not in {*named, *contradicted}]
    last_shown = select_reported_rounds(rounds, findings)[-1]
    kept = (reported := last_shown.candidate.estimate.structure).effects
    remarks = []
    if inside := [name for name in rest if name in kept]:
        what = " and ".join(inside)
        why = "it is no larger than on most robots, or the gap is hardly wider without it"
        remarks.append(f"The last model also has {what}, which is no finding: {why}.")
    unlikely = {
        one.effect: one.probability for one in judged if one.probability < LEAST_PROBABILITY
    }
    doubted = [name for name in rest if name not in kept and name in unlikely]
    remarks += [UNLIKELY.format(name, _describe_small_share(unlikely[name])) for name in doubted]
    if outside := [name for name in rest if name not in {*kept, *doubted}]:
        what = " and ".join(outside)
        remarks.append(
            f"A little {what} would fit the log better, but the gap does not shrink with it, so "
            "the model leaves it out."
        )
    remarks += [CONTRADICTED.format(name) for name in contradicted]
    if reported.has_backlash and not reverses_within_run(problem):
        remarks.append(NO_REVERSAL)
    return tuple(remarks)


def select_reported_rounds(
    rounds: Sequence[SelectionRound], findings: Sequence[Finding]
) -> Sequence[SelectionRound]:
    """The rounds to show: up to the last whose effect is named or, if everyday, narrows the gap.

    An effect of another size that is not named is not shown as if it explained the log.
    """
    named = {one.effect for one in findings}
    values = rounds[-1].candidate.estimate.values
    last = max(
        n
        for n, one in enumerate(rounds)
        if n == 0
        or one.candidate.effect in named
        or (is_ordinary_size(one.candidate.effect, values) and is_narrower_with(one, rounds[-1]))
    )
    return rounds[: last + 1]


def _describe_small_share(share: float) -> str:
    """A small probability as text: ``only 12%``, or ``less than 1%`` instead of zero."""
    shown = f"{share:.0%}"
    return "less than 1%" if shown == "0%" else f"only {shown}"
