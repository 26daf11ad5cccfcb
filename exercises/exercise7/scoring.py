"""Compare the claims about one log with the truth."""

from collections.abc import Sequence
from dataclasses import dataclass

from .drawn import Case, Damaged
from .feedback import (
    ACTIONS,
    explain_false_alarm,
    explain_mixed_up,
    explain_overlooked,
    explain_wrong_samples,
    list_actions,
)
from .line import CLEAN, Claim, Span

LABEL, PLACE, ACTION = 0.5, 0.25, 0.25  # [share of a fault's points]
NEAR = 0.5  # [shared over covered time] that is the right place
SLACK = 0.1  # [s] or: both ends this near, as who reads them off a picture can be
FALSE_ALARM = 0.5  # points off for each fault where there is none


@dataclass(frozen=True)
class Score:
    """The points of a line, and its feedback; empty if all is right."""

    points: float
    hint: str


def score_claims(claims: Sequence[Claim], case: Case, *, points: float) -> Score:
    """Judge the claims about one log.

    Args:
        claims: what was said, at least one.
        case: the log, and the truth about it.
        points: what a log is worth.
    """
    if claims[0].fault == CLEAN:
        if case.damage:
            return Score(0.0, explain_overlooked(case.damage[0].fault))
        return Score(points, "")
    pairs, alarms = _pair_claims(claims, case)
    if not case.damage:
        return Score(0.0, _explain_alarm(claims[0]))
    share, says = 0.0, []
    for damaged, claim in pairs:
        earned, hint = _judge_claim(claim, damaged, case)
        share += earned / len(case.damage)
        says += [hint] if hint else []
    says += [_explain_alarm(claim) for claim in alarms]
    hint = " ".join(dict.fromkeys(says))
    return Score(max(points * share - FALSE_ALARM * len(alarms), 0.0), hint)


def _pair_claims(
    claims: Sequence[Claim], case: Case
) -> tuple[list[tuple[Damaged, Claim | None]], list[Claim]]:
    """Each damage with the claim that means it, and the claims that mean none."""
    left = list(claims)
    pairs: list[tuple[Damaged, Claim | None]] = []
    for damaged in case.damage:
        named = [one for one in left if one.fault == damaged.fault]
        pairs.append((damaged, named[0] if named else None))
        left = [one for one in left if one not in named[:1]]
    for index, (damaged, found) in enumerate(pairs):
        there = [one for one in left if not found and _measure_overlap(one, damaged, case) > 0.0]
        if there:  # seen, but taken for something else
            pairs[index] = (damaged, there[0])
            left.remove(there[0])
    return pairs, left


def _judge_claim(claim: Claim | None, damaged: Damaged, case: Case) -> tuple[float, str]:
    """Share of a fault's points, and what to say."""
    if claim is None:
        return 0.0, explain_overlooked(damaged.fault)
    placed = _measure_overlap(claim, damaged, case) >= NEAR
    share = PLACE * placed
    if claim.fault != damaged.fault:
        return share, explain_mixed_up(claim.fault, damaged.fault)
    share += LABEL
    says = []
    if not placed:
        says.append(_explain_place(claim, whole=damaged.whole, lasts=_find_end(case)))
    if claim.action in list_actions(damaged.fault):
        share += ACTION
    elif claim.action:
        partly = "trim" in list_actions(damaged.fault)
        asks = "Is the rest of the test good" if partly else "Will the next recording have it, too"
        says.append(f"{ACTIONS[claim.action]}: not here. {asks}?")
    else:
        says.append("What should you do? Add one of: rerun, trim, filter, fix-config.")
    return share, " ".join(says)


def _find_end(case: Case) -> float:
    """When the log ends [s]."""
    return max(float(run.time[-1]) for run in case.log.runs)


def _explain_place(claim: Claim, *, whole: bool, lasts: float) -> str:
    if claim.times is not None and claim.times[0] > lasts:
        return (
            f"The fault is right, but the log ends after {lasts:.0f} s. Are your times in "
            "milliseconds? Write seconds."
        )
    if not claim.places and claim.times is None:
        return "Where is it? Add the test, and the times when it starts and ends."
    if whole:
        return "This fault damages whole tests. Which ones? Look at each of the four."
    if not claim.places:
        return (
            "The fault is right, but not the place. Add the name of the test: without it, times"
            " count from the start of the log."
        )
    long = ", and is it as long as you wrote" if claim.times else ""
    return (
        "The fault is right, but not the place: write the times of the first and the last wrong"
        f" sample. Is it in this test{long}? {explain_wrong_samples(claim.fault)}"
    ).strip()


def _explain_alarm(claim: Claim) -> str:
    return (
        f"{explain_false_alarm(claim.fault)} Can you find that in a plot? Something odd may be "
        "normal for a good mechanism. Does it look the same in the other direction?"
    )


def _measure_overlap(claim: Claim, damaged: Damaged, case: Case) -> float:
    """Shared over covered time, of the better way to read the claim; 1 where both ends are near."""
    truth = [(part.run or 0, part.start, part.end) for part in damaged.where]
    if damaged.whole:
        runs = case.log.runs
        truth = [(i, float(runs[i].time[0]), float(runs[i].time[-1])) for i, _, _ in truth]
    ways = claim.spans(case.log, whole=damaged.whole)
    return max((_compute_overlap(way, truth) for way in ways), default=0.0)


def _compute_overlap(one: Sequence[Span], other: Sequence[Span]) -> float:
    mine, others = ({run: ends for run, *ends in spans} for spans in (one, other))
    if mine.keys() == others.keys() and all(
        abs(a - b) <= SLACK for run in mine for a, b in zip(mine[run], others[run], strict=True)
    ):
        return 1.0
    shared = sum(
        max(min(mine[run][1], others[run][1]) - max(mine[run][0], others[run][0]), 0.0)
        for run in mine.keys() & others.keys()
    )
    covered = sum(max(end - begin, 0.0) for begin, end in (*mine.values(), *others.values()))
    return shared / (covered - shared) if covered > shared else 0.0
