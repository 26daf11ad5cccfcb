"""The overview of a class, and a page for each student: HTML that asks the network for nothing."""

import math
from pathlib import Path
from statistics import median
from typing import Any

from grader.checks.misconception import MISCONCEPTIONS
from grader.classroom.atomic_files import write_private_file
from grader.classroom.grading import MISSING, GradedStudent
from grader.classroom.item_analysis import (
    FEWEST,
    analyze_items,
    count_misconceptions,
    summarize_exercises,
)
from grader.classroom.results import (
    ClassResults,
    collect_scores,
    find_status,
    find_total,
    has_handed_in,
)
from grader.feedback.report import format_points, render_checks
from sim.support.student_names import make_folder_name

FOLDER = Path(__file__).parent
PEOPLE = "students"
TENTHS = 10  # of all points, in each of which students are counted
SIGNS = {MISSING: "–", "ungradable": "!"}


def write_pages(results: ClassResults, folder: Path) -> tuple[Path, ...]:
    """Write ``index.html``, and ``students/NAME.html`` for each of them.

    Returns:
        The paths of all pages, the overview's first.

    Raises:
        BadRequest: they cannot be written.
    """
    from sim.report.page_file import load_templates  # noqa: PLC0415 - only who writes pages needs them

    templates = load_templates(FOLDER)
    templates.filters |= {"percent": _format_percent, "signed": _format_signed}
    pages = []
    for one in results.students:
        text = templates.get_template("student.html.jinja").render(_fill_student_page(one, results))
        pages.append(write_private_file(folder / _name_page(one), text))
    text = templates.get_template("class.html.jinja").render(_fill_class_page(results))
    return (write_private_file(folder / "index.html", text), *pages)


def _name_page(one: GradedStudent) -> str:
    return f"{PEOPLE}/{make_folder_name(one.student)}.html"


def summarize_class(results: ClassResults) -> str:
    """The class in two sentences."""
    there = [one for one in results.students if has_handed_in(one)]
    shares = _list_shares(results)
    handed = f"{len(there)} of {len(results.students)} students handed something in"
    if not shares:
        return f"{handed}."
    mean = f"on average they have {100 * sum(shares) / len(shares):.0f} % of all points"
    full = sum(share == 1 for share in shares)
    return f"{handed}; {mean}, and {full or 'nobody'} {'have' if full > 1 else 'has'} full marks."


def _list_shares(results: ClassResults) -> list[float]:
    """The share of all points of each student of whom anything was graded."""
    return [_compute_share(one, results) for one in results.students if collect_scores(one)]


def _compute_share(one: GradedStudent, results: ClassResults) -> float:
    most = sum(results.max_scores.values())
    return sum(collect_scores(one).values()) / most if most else 0.0


def _fill_class_page(results: ClassResults) -> dict[str, Any]:
    shares = _list_shares(results)
    found = sorted(
        analyze_items(results.students), key=lambda one: (one.share, one.exercise, one.check)
    )
    return {
        "results": results,
        "verdict": summarize_class(results),
        "open": _list_open_cases(results),
        "columns": summarize_exercises(results.students),
        "spread": [
            sum(min(int(TENTHS * one), TENTHS - 1) == k for one in shares) for k in range(TENTHS)
        ],
        "median": median(shares) if shares else None,
        "misconceptions": [
            {"code": code, "count": count, "says": _explain_misconception(code)}
            for code, count in count_misconceptions(results.students)
        ],
        "fewest": FEWEST,
        "items": found,
        "exercises": [name.removeprefix("exercise") for name in results.exercises],
        "students": [_make_row(one, results) for one in results.students],
    }


def _explain_misconception(code: str) -> str:
    """How to correct a misconception, and the lesson about it; empty for an unknown code."""
    known = MISCONCEPTIONS.get(code)
    return f"{known.says} See {known.reference}." if known else ""


def _list_open_cases(results: ClassResults) -> list[dict[str, str]]:
    """The ungraded submissions that a person has to check; each once, with the reason."""
    found = []
    for one in results.students:
        unread: dict[str, list[str]] = {}  # reason -> exercises
        for grade in one.grades:
            if grade.status == "ungradable":
                unread.setdefault(grade.reason, []).append(grade.exercise)
        for reason, names in unread.items():
            everything = len(names) > 1 and len(names) == len(one.grades)
            exercises = "" if everything else ", ".join(names)
            found.append({"student": one.student, "exercise": exercises, "why": reason})
    found += [
        {"student": name, "exercise": "", "why": line}
        for name, lines in results.remarks.items()
        for line in lines
    ]
    return sorted(found, key=lambda case: case["student"].casefold())


def _make_row(one: GradedStudent, results: ClassResults) -> dict[str, Any]:
    points, how = collect_scores(one), find_status(one)
    cells = [
        {
            "text": SIGNS.get(how.get(name, MISSING), f"{points.get(name, 0):g}"),
            "share": points[name] / results.max_scores[name] if name in points else None,
        }
        for name in results.exercises
    ]
    return {
        "student": one.student,
        "page": _name_page(one),
        "cells": cells,
        "total": _format_total(one, results),
        "late": results.late.get(one.student, ""),
    }


def _format_total(one: GradedStudent, results: ClassResults) -> str:
    total = find_total(one, results)
    if total is None:
        return "incomplete" if has_handed_in(one) else "–"
    return f"{total:g} of {sum(results.max_scores.values()):g}"


def _fill_student_page(one: GradedStudent, results: ClassResults) -> dict[str, Any]:
    total = _format_total(one, results)
    return {
        "one": one,
        "name": results.name,
        "verdict": f"{total} points." if " of " in total else "Not everything was graded yet.",
        "format_points": format_points,
        "render_checks": render_checks,
    }


def _format_percent(value: float) -> str:
    return "" if math.isnan(value) else f"{100 * value:.0f}"


def _format_signed(value: float | None) -> str:
    return "" if value is None else f"{value:+.2f}".replace("-", "−")
