"""GitHub Classroom's result of a step, one for each student: JSON in base64.

Its reporter reads it from ``result=…`` in ``$GITHUB_OUTPUT``. One test for each exercise: its table
counts tests and not points, so the parts of an exercise are told in the message.
"""

import base64
import json
from pathlib import Path
from typing import Any

from grader.classroom.atomic_files import write_private_file
from grader.classroom.grading import GradedStudent
from grader.classroom.results import ClassResults
from grader.exercise.exercise import Grade
from grader.feedback.report import compose_feedback
from sim.support.printable import make_printable
from sim.support.student_names import make_folder_name

LONGEST = 500  # [characters] of an output, says the reporter
STATUS = {"passed": "pass", "failed": "fail", "missing": "fail", "ungradable": "error"}


def write(results: ClassResults, folder: Path) -> tuple[Path, ...]:
    """Write a folder ``github`` with a file for each student.

    Raises:
        BadRequest: they cannot be written.
    """
    return tuple(
        write_private_file(
            folder / "github" / f"{make_folder_name(one.student)}.txt",
            _format_student(one, results),
        )
        for one in results.students
    )


def _format_student(one: GradedStudent, results: ClassResults) -> str:
    text = json.dumps(_make_result(one, results)).encode("ascii")
    return f"result={base64.b64encode(text).decode('ascii')}\n"


def _make_result(one: GradedStudent, results: ClassResults) -> dict[str, Any]:
    unused = results.remarks.get(one.student, ())
    tests = [_make_test(number, grade) for number, grade in enumerate(one.grades)]
    told = {test["status"] for test in tests}
    return {
        "version": 1,
        "status": next((status for status in ("error", "fail") if status in told), "pass"),
        "message": "; ".join(unused)[:LONGEST] or None,
        "max_score": sum(grade.max_score for grade in one.grades),
        "tests": tests,
    }


def _make_test(number: int, grade: Grade) -> dict[str, Any]:
    wrong = [check for check in grade.checks if check.status != "passed"]
    told = [make_printable(text) for text in grade.warnings]
    told += [f"{check.description}: {compose_feedback(check)}" for check in wrong]
    output = "\n".join(told)
    return {
        "name": grade.exercise,
        "status": STATUS[grade.status],
        "message": grade.reason,
        "test_code": "",
        "task_id": number,
        "filename": str(grade.file or ""),
        "line_no": 0,
        "duration": 0.0,
        "score": grade.score,
        "output": output if len(output) <= LONGEST else output[: LONGEST - 1] + "…",
    }
