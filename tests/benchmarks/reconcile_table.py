"""Print what the benchmark of reconcile found: goals, shares, confusions, and what went wrong."""

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from statistics import median

from reconcile_scores import (
    BESIDE,
    MARKS,
    RIGHT,
    UNKNOWN,
    WRONG,
    Scored,
    confusion,
    shares,
)

SURE = 1.0  # [standard errors] that a share is said with


@dataclass(frozen=True)
class Goal:
    """A figure and what it has to be.

    Args:
        name: in the words of the acceptance.
        figure: what came out; None if there was nothing to measure.
        least: what counts as resolved.
        aim: what we are here for.
        below: smaller is better.
        cases: how many it is from.
    """

    name: str
    figure: float | None
    least: float
    aim: float
    below: bool = False
    cases: int = 0

    @property
    def met(self) -> bool | None:
        """Whether it is what it has to be at least; None if it was not measured."""
        if self.figure is None:
            return None
        return self.figure <= self.least if self.below else self.figure >= self.least


SINGLES = (
    ("clean realistic", (0.92, 0.97), (0.03, 0.01)),
    ("clean subtle", (0.82, 0.92), (0.05, 0.02)),
    ("dirty realistic", (0.88, 0.95), (0.07, 0.02)),
    ("dirty subtle", (0.70, 0.85), (0.08, 0.03)),
)
"""Group, right (at least, aim), wrong (at most, aim)."""


def goals(scored: Sequence[Scored], verdicts: Counter[str]) -> list[Goal]:
    """The acceptance's rows.

    Args:
        scored: all cases but the controls.
        verdicts: of the controls.
    """
    rows = []
    for group, right, wrong in SINGLES:
        mine = [one for one in scored if one.group == group]
        rows.append(_share(f"{group}: right effect first", mine, {RIGHT}, right))
        rows.append(_share(f"{group}: wrong effect first", mine, {WRONG}, wrong, below=True))
    complete, unknown, two = (
        [one for one in scored if one.group.endswith(f" {kind}")]
        for kind in ("complete", UNKNOWN, "two")
    )
    rows.append(_share("complete: without a major finding", complete, {RIGHT}, (0.97, 1.0)))
    rows.append(_share("unknown: flagged", unknown, {RIGHT, BESIDE}, (0.95, 1.0)))
    rows.append(_share("unknown: a wrong name beside", unknown, {BESIDE}, (0.25, 0.05), below=True))
    rows.append(_share("two at once: both named", two, {RIGHT}, (0.88, 0.95)))
    extra = sum(one.extra for one in two) / len(two) if two else None
    rows.append(Goal("two at once: an extra name", extra, 0.15, 0.03, below=True, cases=len(two)))
    _, after = gaps(scored)
    rows.append(Goal("gap for right names [noise floors]", after, 1.08, 1.02, below=True))
    busy = [one.seconds if one.busy is None else one.busy for one in scored]
    rows.append(Goal("median case [s of one core]", _median(busy), 5.0, 1.5, below=True))
    memory = [one.memory for one in scored if one.memory is not None]
    rows.append(Goal("memory [MB]", max(memory, default=None), 500.0, 500.0, below=True))
    count = verdicts.total()
    strange = verdicts["unexplained"] / count if count else None
    rows.append(Goal("shuffled voltage: unexplained", strange, 0.95, 1.0, cases=count))
    return rows


def gaps(scored: Sequence[Scored]) -> tuple[float | None, float | None]:
    """[noise floors] median gap before and after, where what was hidden was named."""
    named = [o for o in scored if o.mark == RIGHT and o.want and o.want != (UNKNOWN,)]
    pairs = [(o.before, o.after) for o in named if o.before is not None and o.after is not None]
    return _median([before for before, _ in pairs]), _median([after for _, after in pairs])


def lines(scored: Sequence[Scored], verdicts: Counter[str]) -> Iterator[str]:
    """The whole table, a line at a time."""
    yield f"{'':42} {'here':>15} {'at least':>9} {'aim':>6}"
    for goal in goals(scored, verdicts):
        verdict = {True: "", False: "   missed", None: ""}[goal.met]
        yield f"{goal.name:42} {_said(goal):>15} {goal.least:>9g} {goal.aim:>6g}{verdict}"
    yield ""
    yield from _groups(shares(scored))
    yield ""
    yield from _matrix(confusion(scored))
    yield ""
    yield f"shuffled voltage: {_counted(verdicts)}"
    before, after = map(_number, gaps(scored))
    yield f"gap for right names, median: {before} noise floors before, {after} after"
    clock = [one.seconds for one in scored]
    busy = [one.busy for one in scored if one.busy is not None]
    if clock:
        yield f"seconds by the clock: median {_number(_median(clock))}, most {_number(max(clock))}"
    if busy:
        yield f"seconds of one core: median {_number(_median(busy))}, most {_number(max(busy))}"
    yield ""
    for one in sorted(scored, key=lambda one: (one.mark, one.want)):
        if one.mark != RIGHT:
            yield _miss(one)


def _share(
    name: str,
    mine: Sequence[Scored],
    marks: set[str],
    bounds: tuple[float, float],
    *,
    below: bool = False,
) -> Goal:
    part = sum(one.mark in marks for one in mine) / len(mine) if mine else None
    return Goal(name, part, *bounds, below=below, cases=len(mine))


def _said(goal: Goal) -> str:
    """A figure; a share with one standard error (Agresti and Coull's, which has one at 0 too)."""
    if goal.figure is None:
        return "not measured"
    if not goal.cases:
        return _number(goal.figure)
    n = goal.cases + 4.0 * SURE
    p = (goal.figure * goal.cases + 2.0 * SURE) / n
    return f"{goal.figure:.2f} ± {SURE * math.sqrt(p * (1.0 - p) / n):.2f}"


def _groups(found: Mapping[str, Mapping[str, float]]) -> Iterator[str]:
    used = [mark for mark in MARKS if any(mark in row for row in found.values())]
    yield f"{'':16} {'n':>4} " + " ".join(f"{mark:>{max(len(mark), 6)}}" for mark in used)
    for group, row in found.items():
        cells = " ".join(f"{row.get(mark, 0.0):>{max(len(mark), 6)}.2f}" for mark in used)
        yield f"{group:16} {row['n']:>4.0f} {cells}"


def _matrix(table: Mapping[str, Counter[str]]) -> Iterator[str]:
    """Rows are what was hidden, columns what was named first, under the letters of the rows."""
    named = {name for row in table.values() for name in row}
    columns = [*table, *sorted(named - set(table))]
    letter = {name: chr(ord("a") + n) if n < 26 else str(n) for n, name in enumerate(columns)}
    yield f"hidden, and what was named first {'':4}" + "".join(f"{v:>3}" for v in letter.values())
    for true in columns:
        row = table.get(true, Counter())
        cells = "".join(f"{row[name] or '·':>3}" for name in columns) if row else ""
        yield f"{letter[true]:>3} {true:32}{cells}"


def _miss(one: Scored) -> str:
    said = ", ".join(one.found) or one.verdict or "nothing"
    gap = "" if one.before is None else f" (gap {one.before:.2f} to {_number(one.after)})"
    hidden = " + ".join(one.detail) or "nothing"
    return f"{one.case} {one.group}, {hidden}: {one.mark}, said {said}{gap}"


def _counted(verdicts: Counter[str]) -> str:
    return ", ".join(f"{n} {word}" for word, n in verdicts.most_common()) or "none were made"


def _number(value: float | None) -> str:
    return "none" if value is None else f"{value:.3g}"


def _median(values: Sequence[float]) -> float | None:
    return median(values) if values else None
