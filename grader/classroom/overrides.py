"""Marks that an instructor sets by hand: a file of their own, so that they outlive every new run.

    student,check,points,why
    Jane Doe,exercise4/timeout,2,showed me on the robot
    Jane Doe,exercise9,8,handed in on paper

A check is an exercise and the id of one of its checks, or the exercise alone: then the points are
those of the whole exercise.
"""

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from grader.checks.check import Status
from grader.classroom.grading import GradedStudent
from grader.exercise.exercise import Exercise, Grade
from sim.core.errors import BadRequest, Refusal, refusals_at
from sim.support.student_names import normalize_name
from sim.support.student_table import read_student_table

COLUMNS = ("student", "check", "points", "why")


@dataclass(frozen=True)
class Override:
    """A mark set by hand.

    Args:
        student: whose, normalized.
        exercise: of which exercise.
        check: the id of the check; empty for the whole exercise.
        points: how many.
        why: as the student may read it.
    """

    student: str
    exercise: str
    check: str
    points: float
    why: str


def read_overrides(
    path: Path, *, students: Collection[str], exercises: Sequence[Exercise]
) -> tuple[Override, ...]:
    """Read a file of marks, before anything is graded.

    Args:
        path: path of a CSV file.
        students: everybody in the class.
        exercises: those that are graded.

    Raises:
        BadRequest: it cannot be read or lacks a column; or a mark is of nobody, of nothing that is
            graded, of no number of points or too many, or says no reason.
    """
    advice = "Give the path of a CSV file in UTF-8."
    table = read_student_table(path, what="the file of marks", advice=advice)
    advice = f"Write this as the first line: {','.join(COLUMNS)}"
    columns = {name: table.find_column(name, advice=advice) for name in COLUMNS}
    known = {normalize_name(one) for one in students}
    most = {one.name: {each.id: each.points for each in one.checks} for one in exercises}
    found = []
    for where, row in table.rows:
        with refusals_at(where):
            cells = {name: row.get(column, "").strip() for name, column in columns.items()}
            found.append(_parse_row(cells, known, most))
    return tuple(found)


def _parse_row(
    cells: Mapping[str, str],
    students: Collection[str],
    most: Mapping[str, Mapping[str, float]],
) -> Override:
    """A mark, from the cells of its line.

    Args:
        cells: by ``COLUMNS``.
        students: normalized names of everybody.
        most: exercise -> check -> the most points that it gives.

    Raises:
        BadRequest: as ``read_overrides``.
    """
    try:
        student = normalize_name(cells["student"])
    except Refusal:
        student = ""
    exercise, _, check = (part.strip() for part in cells["check"].partition("/"))
    checks = most.get(exercise, {})
    limit = checks.get(check, 0.0) if check else sum(checks.values())
    try:
        points = float(cells["points"].replace(",", "."))
    except ValueError:
        points = math.nan
    what = advice = ""
    if student not in students:
        what = f"there is no student {cells['student']!r} in this class"
        advice = "Write the name as in the column student of gradebook.csv."
    elif exercise not in most:
        what = f"{exercise!r} is not graded"
        advice = f"Choose one of: {', '.join(most)}."
    elif check and check not in checks:
        what = f"{exercise} has no check {check!r}"
        advice = f"Choose one of: {', '.join(checks)}."
    elif not 0 <= points <= limit:
        what = f"{cells['points']!r} is not a number of points from 0 to {limit:g}"
        advice = "Write a number, such as 2 or 1.5."
    elif not cells["why"]:
        what = "it does not say why"
        advice = "Write the reason into the column why: the student reads it."
    if what:
        raise BadRequest(what, advice=advice)
    return Override(student, exercise, check, points, cells["why"])


def apply_overrides(
    students: Sequence[GradedStudent], overrides: Sequence[Override]
) -> tuple[GradedStudent, ...]:
    """The results with the marks that were set by hand.

    Args:
        students: the results of everybody.
        overrides: the marks, of students and exercises among them.
    """
    found = {normalize_name(one.student): one for one in students}
    for one in overrides:
        grades = (
            _set_points(grade, one) if grade.exercise == one.exercise else grade
            for grade in found[one.student].grades
        )
        found[one.student] = replace(found[one.student], grades=tuple(grades))
    return tuple(found.values())


def _set_points(grade: Grade, override: Override) -> Grade:
    """The grade with the points of the whole exercise, or of one check of it, set."""
    said = f"Your instructor gave {override.points:g} points: {override.why}"
    checks, warnings, score = grade.checks, grade.warnings, override.points
    if override.check:
        checks = tuple(
            replace(
                one, points=score, hint=said, misconception="",
                status=Status.PASSED if score >= one.max_points else Status.FAILED,
            )
            if one.id == override.check
            else one
            for one in checks
        )  # fmt: skip
        score = sum(one.points for one in checks)
    else:
        warnings = (*warnings, said)
    status = "passed" if score >= grade.max_score else "failed"
    return replace(grade, checks=checks, warnings=warnings, score=score, status=status, reason="")
