"""Gradescope's results.json, one for each student.

Its format: https://gradescope-autograders.readthedocs.io/en/latest/specs/#output-format
A result without points is a failure of the autograder there, and shows the student nothing. So what
could not be graded has 0 points, and the first line says that this is no mark.
"""

import json
from pathlib import Path
from typing import Any

from grader.classroom.atomic_files import write_private_file
from grader.classroom.grading import GradedStudent
from grader.classroom.results import ClassResults
from grader.feedback.report import compose_feedback
from sim.support.printable import make_printable
from sim.support.student_names import make_folder_name


def write(results: ClassResults, folder: Path) -> tuple[Path, ...]:
    """Write a folder ``gradescope`` with a ``results.json`` for each student.

    Raises:
        BadRequest: they cannot be written.
    """
    return tuple(
        write_private_file(
            folder / "gradescope" / make_folder_name(one.student) / "results.json",
            json.dumps(_make_result(one, results), ensure_ascii=False, indent=1) + "\n",
        )
        for one in results.students
    )


def _make_result(one: GradedStudent, results: ClassResults) -> dict[str, Any]:
    warnings = [
        f"{grade.exercise} was not graded, so its 0 points are not a mark: {grade.reason}"
        for grade in one.grades
        if grade.status == "ungradable"
    ]
    warnings += [f"not graded: {text}" for text in results.remarks.get(one.student, ())]
    warnings += [f"{grade.exercise}: {text}" for grade in one.grades for text in grade.warnings]
    return {
        "output_format": "text",
        "visibility": "visible",
        "stdout_visibility": "hidden",
        **({"output": make_printable("\n".join(warnings))} if warnings else {}),
        "tests": [
            {
                "name": f"{grade.exercise}: {check.description}",
                "number": f"{place}.{number}",
                "score": check.points,
                "max_score": check.max_points,
                "status": "passed" if check.status == "passed" else "failed",
                "output": compose_feedback(check),
                "output_format": "text",
                "tags": [tag for tag in (check.misconception,) if tag],
                "visibility": "visible",
            }
            for place, grade in enumerate(one.grades, start=1)
            for number, check in enumerate(grade.checks, start=1)
        ],
    }
