"""Results of a class on disk: a file for each student, written as soon as it is graded."""

import hashlib
import hmac
import json
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import asdict
from pathlib import Path
from typing import Any

from grader.checks.check import Result, Status
from grader.classroom.answer_files import Submission
from grader.classroom.atomic_files import write_private_file
from grader.classroom.grading import GradedStudent
from grader.exercise.exercise import Grade
from sim.support.os_errors import refuse_os_errors
from sim.support.student_names import make_folder_name

RESULTS = "results"
WRITTEN = "written.txt"  # there: the files of the last run that ended, one path in each line


def digest_job(
    one: Submission, *, names: tuple[str, ...], made_by: str, secret: bytes | None
) -> str:
    """A digest of everything that a student's results depend on.

    Args:
        one: what the student handed in.
        names: the exercises that are graded.
        made_by: the fingerprint of the course.
        secret: of the class.
    """
    found = hmac.new(secret or b"alone", digestmod=hashlib.sha256)
    about = [one.student, one.numbers_owner, sorted(one.problems.items()), names, made_by]
    found.update(json.dumps(about).encode())
    for exercise, those in sorted(one.files.items()):
        for name, content in sorted(those.items()):
            found.update(json.dumps([exercise, name, len(content)]).encode())
            found.update(content)
    return found.hexdigest()


class ResultStore:
    """A class's results in a folder.

    Args:
        folder: where they are kept.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def get(self, student: str, expected: str) -> GradedStudent | None:
        """A student's results, if they are there whole and nothing they depend on has changed."""
        try:
            kept = json.loads(self._get_path(student).read_text(encoding="utf-8"))
            grades = tuple(map(_parse_grade, kept["grades"]))
            found = GradedStudent(kept["student"], kept["digest"], grades)
        except (OSError, ValueError, KeyError, TypeError):
            return None
        return found if (found.student, found.digest) == (student, expected) else None

    def put(self, graded: GradedStudent) -> None:
        """Keep a student's results.

        Raises:
            BadRequest: they cannot be written.
        """
        raw = asdict(graded)  # of paths, there are only names of files
        text = json.dumps(raw, ensure_ascii=False, indent=1, allow_nan=False, default=str)
        write_private_file(self._get_path(graded.student), text + "\n")

    def remove_outdated(self, written: Iterable[Path], *, students: Iterable[str]) -> None:
        """Remove the files that the run before this one wrote and this one did not.

        Args:
            written: the files of this run in the folder, besides results.
            students: whose results are of this run.

        Raises:
            BadRequest: a file cannot be removed, or the list of files cannot be written.
        """
        files = {*written, *(path for path in map(self._get_path, students) if path.is_file())}
        now = {path.relative_to(self.folder).as_posix() for path in files}
        kept = self.folder / RESULTS / WRITTEN
        before: set[str] = set()
        with suppress(OSError, ValueError):  # the first run, or a list that somebody changed
            before = {*kept.read_text(encoding="utf-8").splitlines()}
        advice = "Close the programs that use it, then run the same command again."
        for name in sorted(before - now):
            path = self.folder / name
            if path.resolve().is_relative_to(self.folder.resolve()) and path.is_file():
                with refuse_os_errors("cannot be replaced", path, advice=advice):
                    path.unlink()
                with suppress(OSError):  # it is not empty
                    path.parent.rmdir()
        write_private_file(kept, "".join(f"{name}\n" for name in sorted(now)))

    def _get_path(self, student: str) -> Path:
        return self.folder / RESULTS / f"{make_folder_name(student)}.json"


def _parse_grade(raw: dict[str, Any]) -> Grade:
    """A grade from a stored file; raises an error for anything else."""
    checks = tuple(Result(**{**one, "status": Status(one["status"])}) for one in raw["checks"])
    file = Path(raw["file"]) if raw["file"] else None
    return Grade(**{**raw, "checks": checks, "file": file, "warnings": tuple(raw["warnings"])})
