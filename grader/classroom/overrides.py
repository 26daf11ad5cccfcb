"""Marks that an instructor sets by hand: a file of their own, so that they outlive every new run.

    student,check,points,why
    Jane Doe,exercise4/timeout,2,showed me on the robot
    Jane Doe,exercise9,8,handed in on paper

A check is an exercise and the id of one of its checks, or the exercise alone: then the points are
those of the whole exercise.
"""

import csv
import io
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from grader.classroom.grading import GradedStudent, Record
from grader.variant import normalize_name
from sim.core.errors import BadRequest, Refusal

COLUMNS = ("student", "check", "points", "why")


@dataclass(frozen=True)
class Override:
    """A mark set by hand.

    Args:
        student: whose.
        exercise: of which exercise.
        check: the id of the check; empty for the whole exercise.
        points: how many.
        why: as the student may read it.
        where: the line it stands in.
    """

    student: str
    exercise: str
    check: str
    points: float
    why: str
    where: str


def read_overrides(path: Path) -> tuple[Override, ...]:
    """Read a file of marks.

    Raises:
        BadRequest: it cannot be read, lacks a column, or a line says no points or no reason.
    """
    try:
        text = path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        why = error.strerror if isinstance(error, OSError) else "it is not UTF-8"
        raise BadRequest(
            f"the marks cannot be read ({why})",
            where=str(path),
            advice="Give the path of a CSV file in UTF-8.",
        ) from None
    delimiter = max(",;\t", key=text.partition("\n")[0].count)
    table = csv.DictReader(io.StringIO(text, newline=""), delimiter=delimiter)
    header = {(name or "").strip().casefold(): name for name in table.fieldnames or ()}
    missing = [name for name in COLUMNS if name not in header]
    if missing:
        raise BadRequest(
            f"the first line names no column {missing[0]}",
            where=str(path),
            advice=f"Write this as the first line: {','.join(COLUMNS)}",
        )
    found = []
    for row in table:
        cells = {name: (row.get(header[name]) or "").strip() for name in COLUMNS}
        if any(cells.values()):
            found.append(_parse_row(cells, where=f"{path}, line {table.line_num}"))
    return tuple(found)


def _parse_row(cells: dict[str, str], *, where: str) -> Override:
    exercise, _, check = cells["check"].partition("/")
    try:
        points = float(cells["points"].replace(",", "."))
    except ValueError:
        points = math.nan
    if not math.isfinite(points) or points < 0:
        raise BadRequest(
            f"{cells['points']!r} is no number of points",
            where=where,
            advice="Write a number, such as 2 or 1.5.",
        )
    if not cells["why"]:
        raise BadRequest(
            "it does not say why",
            where=where,
            advice="Write the reason into the column why: the student reads it.",
        )
    names = (cells["student"], exercise.strip(), check.strip())
    return Override(*names, points, cells["why"], where)


def apply_overrides(
    students: Sequence[GradedStudent], overrides: Sequence[Override]
) -> tuple[GradedStudent, ...]:
    """The results with the marks that were set by hand.

    Args:
        students: the results of everybody.
        overrides: the marks.

    Raises:
        BadRequest: a mark is of nobody, of nothing that is graded, or of more points than there
            are.
    """
    found = {normalize_name(one.student): one for one in students}
    for one in overrides:
        try:
            key = normalize_name(one.student)
        except Refusal:
            key = ""
        if key not in found:
            raise BadRequest(
                f"there is no student {one.student!r} in this class",
                where=one.where,
                advice="Write the name as in the column student of gradebook.csv.",
            )
        records = [dict(record) for record in found[key].records]
        record = next((each for each in records if each["exercise"] == one.exercise), None)
        if record is None:
            raise BadRequest(
                f"{one.exercise!r} was not graded",
                where=one.where,
                advice=f"Choose one of: {', '.join(str(each['exercise']) for each in records)}.",
            )
        _set_points(record, one)
        found[key] = replace(found[key], records=tuple(records))
    return tuple(found.values())


def _set_points(record: Record, override: Override) -> None:
    """Set the points of a whole exercise, or of one check of it."""
    said = f"Your instructor gave {override.points:g} points: {override.why}"
    checks = [dict(one) for one in record["checks"]]
    if override.check:
        check = next((one for one in checks if one["id"] == override.check), None)
        if check is None:
            raise BadRequest(
                f"{override.exercise} has no check {override.check!r}",
                where=override.where,
                advice=f"Choose one of: {', '.join(str(one['id']) for one in checks)}.",
            )
        most = float(check["max_points"])
        status = "passed" if override.points >= most else "failed"
        check |= {"points": override.points, "status": status, "hint": said, "misconception": ""}
        score = sum(float(one["points"]) for one in checks)
    else:
        most, score = float(record["max_score"]), override.points
        record["warnings"] = [*record["warnings"], said]
    if override.points > most:
        raise BadRequest(
            f"{override.points:g} points are more than the {most:g} there are",
            where=override.where,
            advice=f"Write {most:g} or fewer.",
        )
    status = "passed" if score >= float(record["max_score"]) else "failed"
    record |= {"checks": checks, "score": score, "status": status, "reason": ""}
