"""One student's files, graded: plain data in, plain data out, so that any process can do it."""

import os
import tempfile
from collections.abc import Iterable
from contextlib import nullcontext
from dataclasses import dataclass, field, replace
from pathlib import Path

from grader.classroom.answer_files import Submission
from grader.classroom.bundle import CourseBundle, unpack_course
from grader.exercise.exercise import Exercise, Grade
from grader.student_data.variant import use_class_secret
from sim.support.printable import list_first

MISSING = "missing"  # the status of an exercise that was not handed in
NOTHING = "nothing was handed in"


@dataclass(frozen=True)
class GradingJob:
    """One student to grade.

    Args:
        submission: what the student handed in.
        digest: of everything the results depend on.
        names: the exercises to grade.
        course: the course folder, or all of it that grading needs, for another machine.
        secret: of the class; None where everybody's numbers are those of self-study.
        run: whether robot code is run, too.
    """

    submission: Submission
    digest: str
    names: tuple[str, ...]
    course: Path | CourseBundle
    secret: bytes | None = field(repr=False)  # a message may hold this
    run: bool

    def find_exercise(self, name: str) -> Exercise:
        """An exercise of its course."""
        return Exercise(name, unpack_course(self.course) / "exercises" / name)


@dataclass(frozen=True)
class GradedStudent:
    """One student's results, as they are kept.

    Args:
        student: who.
        digest: of everything they depend on; empty if they are not kept.
        grades: one for each exercise.
    """

    student: str
    digest: str
    grades: tuple[Grade, ...]


def grade_student(job: GradingJob) -> GradedStudent:
    """Grade all submissions of one student; every error becomes a result."""
    with (
        tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder,
        use_class_secret(job.secret) if job.secret is not None else nullcontext(),
    ):
        grades = tuple(
            _grade_exercise(job.find_exercise(name), job, Path(folder) / name) for name in job.names
        )
    return GradedStudent(job.submission.student, job.digest, grades)


def _grade_exercise(exercise: Exercise, job: GradingJob, folder: Path) -> Grade:
    given, student = job.submission, job.submission.student
    files = given.files.get(exercise.name, {})
    if exercise.name in given.problems:
        return exercise.skip(given.problems[exercise.name], student=student)
    if not files:
        return exercise.skip(NOTHING, student=student, status=MISSING)
    if exercise.answer_endings.isdisjoint(Path(name).suffix.lower() for name in files):
        needed, there = " or ".join(exercise.files), list_first(sorted(files))
        return exercise.skip(f"{needed} is missing; there is only {there}", student=student)
    try:
        folder.mkdir()
        for name, content in files.items():
            (folder / name).write_bytes(content)
        grade = exercise.grade(folder, student=given.numbers_owner, run=job.run)
        return _remove_paths(replace(grade, student=student), folder)
    except MemoryError:
        reason = "grading it needed more memory than this computer has"
    except Exception as error:  # noqa: BLE001 - one student's file must not stop the class
        reason = f"our mistake ({type(error).__name__}: {error}); please report it, with the file"
    return exercise.skip(reason, student=student)


def _remove_paths(grade: Grade, folder: Path) -> Grade:
    """The grade without the paths of this machine, so that it is the same anywhere.

    Args:
        grade: what became of the answer.
        folder: where it lay while it was graded.
    """

    def shorten(text: str) -> str:
        return text.replace(f"{folder}{os.sep}", "").replace(f"{folder}: ", "")

    checks = (replace(one, seen=shorten(one.seen), hint=shorten(one.hint)) for one in grade.checks)
    file = Path(grade.file.name) if grade.file else None
    return replace(grade, checks=tuple(checks), file=file, reason=shorten(grade.reason))


def skip_student(
    student: str, asked: Iterable[Exercise], *, status: str, reason: str
) -> GradedStudent:
    """The results of a student of whom nothing was graded, for a reason of one line."""
    grades = tuple(one.skip(reason, student=student, status=status) for one in asked)
    return GradedStudent(student, "", grades)
