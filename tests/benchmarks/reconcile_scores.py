"""Score the answers of the benchmark of reconcile: what was named, against what was hidden."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from sim.physics.effects import find_motion_class

UNKNOWN = "unknown"
SIZES = {"real": "realistic", "subtle": "subtle"}

RIGHT, SILENT, WRONG, CRASH = "right", "silent", "wrong", "crash"
ALARM, ONE, BESIDE = "false alarm", "one of two", "flagged, wrong name too"
MARKS = (RIGHT, SILENT, WRONG, ONE, BESIDE, ALARM, CRASH)


@dataclass(frozen=True)
class Scored:
    """One case, judged.

    Args:
        case: its folder's name.
        group: ``clean realistic`` and so on.
        mark: one of ``MARKS``.
        want: what was hidden, classes of what is the same; empty for a complete model.
        detail: what was hidden, by its own name.
        found: what was named, the first first.
        major: those of them that were called major.
        verdict: the answer's own word; empty if there was none.
        before: [noise floors] the gap on the held-out file; None if not given.
        after: the same, afterwards.
        seconds: [s] by the clock.
        busy: [s] of one core, or None.
        memory: [MB], or None.
    """

    case: str
    group: str
    mark: str
    want: tuple[str, ...]
    detail: tuple[str, ...]
    found: tuple[str, ...]
    major: tuple[str, ...]
    verdict: str
    before: float | None
    after: float | None
    seconds: float
    busy: float | None
    memory: float | None

    @property
    def extra(self) -> bool:
        """Whether something was called major that was not hidden."""
        return any(name not in self.want for name in self.major)


def score(
    answers: Iterable[Mapping[str, Any]], key: Mapping[str, Mapping[str, Any]]
) -> list[Scored]:
    """Judge the answers of all cases but the controls.

    Args:
        answers: as ``reconcile_blind`` writes them.
        key: name of a case -> what is hidden in it.
    """
    return [
        _scored(answer, key[answer["case"]])
        for answer in answers
        if not key[answer["case"]].get("shuffled")
    ]


def controls(
    answers: Iterable[Mapping[str, Any]], key: Mapping[str, Mapping[str, Any]]
) -> Counter[str]:
    """Verdicts of the cases with a voltage that is not theirs; ``refused`` has none."""
    return Counter(
        (answer["said"] or {}).get("verdict", "refused")
        for answer in answers
        if key[answer["case"]].get("shuffled")
    )


def shares(scored: Sequence[Scored]) -> dict[str, dict[str, float]]:
    """Group -> its size ``n``, the share of every mark, and ``extra`` major names."""
    found = {}
    for group in sorted({one.group for one in scored}):
        mine = [one for one in scored if one.group == group]
        marks = Counter(one.mark for one in mine)
        found[group] = {"n": float(len(mine))}
        found[group] |= {mark: marks[mark] / len(mine) for mark in MARKS if marks[mark]}
        found[group].setdefault(RIGHT, 0.0)
        if group.endswith(" two"):
            found[group]["extra"] = sum(one.extra for one in mine) / len(mine)
    return found


def confusion(scored: Iterable[Scored]) -> dict[str, Counter[str]]:
    """What was hidden -> what was named first: of one effect, of none, and of a stranger.

    Where there was no effect to name, only a major name counts.
    """
    table: dict[str, Counter[str]] = {}
    for one in scored:
        if len(one.want) > 1:
            continue
        true = one.want[0] if one.want else "nothing"
        names = one.major if one.want in {(), (UNKNOWN,)} else one.found
        named = names[0] if names else _instead(one)
        table.setdefault(true, Counter())[named] += 1
    return dict(sorted(table.items()))


def mark(want: Sequence[str], found: Sequence[str], major: Sequence[str], *, flagged: bool) -> str:
    """Judge one answer.

    Args:
        want: what was hidden.
        found: all that was named, the first first.
        major: those that were called major.
        flagged: the answer says that something is left that it has no name for.
    """
    if not want:
        return ALARM if major else RIGHT
    if list(want) == [UNKNOWN]:
        if flagged:
            return BESIDE if major else RIGHT
        return WRONG if major else SILENT
    if not found:
        return SILENT
    if len(want) > 1:
        hits = len(set(want) & set(found))
        return {0: WRONG, len(set(want)): RIGHT}.get(hits, ONE)
    return RIGHT if found[0] == want[0] else WRONG


def _scored(answer: Mapping[str, Any], truth: Mapping[str, Any]) -> Scored:
    want = tuple(find_motion_class(name) for name in truth["effects"])
    said: Mapping[str, Any] = answer["said"] or {}
    findings = said.get("findings", [])
    found = tuple(find_motion_class(one["effect"]) for one in findings)
    major = tuple(n for n, one in zip(found, findings, strict=True) if one["size"] == "major")
    flagged = said.get("verdict") == "unexplained" or bool(said.get("remainder"))
    judged = mark(want, found, major, flagged=flagged) if answer["said"] else CRASH
    floor = said.get("noise_floor")
    before, after = (
        said[gap] / floor if floor and said.get(gap) is not None else None
        for gap in ("gap_before", "gap_after")
    )
    return Scored(
        answer["case"], _group(truth), judged, want, tuple(truth["detail"]), found,
        major, said.get("verdict", ""), before, after,
        answer["seconds"], answer["busy"], answer["memory"],
    )  # fmt: skip


def _group(truth: Mapping[str, Any]) -> str:
    """As the acceptance of the command has them."""
    effects = truth["effects"]
    if not effects:
        kind = "complete"
    elif UNKNOWN in effects:
        kind = UNKNOWN
    else:
        kind = "two" if len(effects) > 1 else SIZES[truth["severity"]]
    return f"{'dirty' if truth['dirty'] else 'clean'} {kind}"


def _instead(one: Scored) -> str:
    """What an answer without a name says."""
    if one.mark == CRASH:
        return CRASH
    return "(unexplained)" if one.verdict == "unexplained" else "(nothing)"
