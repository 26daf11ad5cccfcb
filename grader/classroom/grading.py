"""One student's files, graded: plain data in, plain data out, so that any process can do it."""

import os
import tempfile
from collections.abc import Collection, Mapping, Sequence
from contextlib import nullcontext
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from grader.classroom.answer_files import Files
from grader.classroom.bundle import unpack_course
from grader.exercise import Exercise, Grade, list_exercises
from grader.student_data.variant import use_class_secret
from sim.support.printable import list_first

if TYPE_CHECKING:
    from grader.classroom.bundle import CourseBundle

MISSING = "missing"  # the status of an exercise that was not handed in
NOTHING = "nothing was handed in"
SHOWN = 3  # names of files in a message

Record = dict[str, Any]  # as JSON holds it


@dataclass(frozen=True)
class GradingJob:
    """One student to grade.

    Args:
        student: who.
        digest: of everything the results depend on.
        files: exercise -> file name -> content.
        problems: exercise -> why it cannot be graded.
        numbers_owner: whose numbers it is graded on: the student's, unless they studied as nobody.
        names: the exercises to grade.
        course: the course folder, or all of it that grading needs, for another machine.
        secret: of the class; None where everybody's numbers are those of self-study.
        run: whether robot code is run, too.
    """

    student: str
    digest: str
    files: Mapping[str, Files]
    problems: Mapping[str, str]
    numbers_owner: str
    names: tuple[str, ...]
    course: "Path | CourseBundle"
    secret: bytes | None
    run: bool

    def __repr__(self) -> str:
        """Without the secret: a message may hold this."""
        return f"Job({self.student!r})"


@dataclass(frozen=True)
class GradedStudent:
    """One student's results, as they are kept.

    Args:
        student: who.
        digest: of everything they depend on.
        records: one for each exercise, as ``grade --json`` writes it, with ``file`` and ``reason``.
    """

    student: str
    digest: str
    records: tuple[Record, ...]


def grade_student(job: GradingJob) -> GradedStudent:
    """Grade everything one student handed in; whatever happens is a result."""
    there = {one.name: one for one in list_exercises(unpack_course(job.course))}
    with (
        tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder,
        use_class_secret(job.secret) if job.secret is not None else nullcontext(),
    ):
        records = tuple(_grade(there[name], job, Path(folder) / name) for name in job.names)
    return GradedStudent(job.student, job.digest, records)


def _grade(exercise: Exercise, job: GradingJob, folder: Path) -> Record:
    files, student = job.files.get(exercise.name, {}), job.student
    if exercise.name in job.problems:
        return make_missing_record(
            exercise, student, status="ungradable", reason=job.problems[exercise.name]
        )
    if not files:
        return make_missing_record(exercise, student, status=MISSING, reason=NOTHING)
    endings = {Path(name).suffix for name in exercise.files}
    if not any(Path(name).suffix.lower() in endings for name in files):
        needed, there = " or ".join(exercise.files), list_first(sorted(files), most=SHOWN)
        reason = f"{needed} is missing; there is only {there}"
        return make_missing_record(exercise, student, status="ungradable", reason=reason)
    try:
        folder.mkdir()
        for name, content in files.items():
            (folder / name).write_bytes(content)
        grade = exercise.grade(folder, student=job.numbers_owner, run=job.run)
        return make_grade_record(replace(grade, student=student), folder=folder)
    except MemoryError:
        reason = "grading it needed more memory than this computer has"
        return make_missing_record(exercise, student, status="ungradable", reason=reason)
    except Exception as error:  # noqa: BLE001 - one student's file must not stop the class
        broken = f"our mistake ({type(error).__name__}: {error}); please report it, with the file"
        return make_missing_record(exercise, student, status="ungradable", reason=broken)


def make_ungraded_record(job: GradingJob, name: str, reason: str) -> Record:
    """The record of an exercise whose grading did not end.

    Args:
        job: the student's.
        name: of the exercise.
        reason: why, one line.
    """
    there = {one.name: one for one in list_exercises(unpack_course(job.course))}
    return make_missing_record(there[name], job.student, status="ungradable", reason=reason)


def make_missing_record(exercise: Exercise, student: str, *, status: str, reason: str) -> Record:
    """The record of an exercise of which nothing was graded."""
    skipped = exercise.skip(reason, student=student)
    return make_grade_record(replace(skipped, status=status))


def make_grade_record(grade: Grade, *, folder: Path | None = None) -> Record:
    """A grade as plain data, without the paths of this machine, so that it is the same anywhere.

    Args:
        grade: what became of the answer.
        folder: where it lay while it was graded; None takes that of its file.
    """
    names = ("exercise", "student", "score", "max_score", "status")
    place = folder or (grade.file.parent if grade.file else None)

    def shorten(text: str) -> str:
        return text if place is None else (
            text.replace(f"{place}{os.sep}", "").replace(f"{place}: ", "")
        )  # fmt: skip

    checks = [replace(one, seen=shorten(one.seen), hint=shorten(one.hint)) for one in grade.checks]
    return {
        **{name: getattr(grade, name) for name in names},
        "file": grade.file.name if grade.file else "",
        "reason": shorten(grade.reason),
        "warnings": [*grade.warnings],
        "checks": [{**asdict(one), "status": str(one.status)} for one in checks],
    }


def make_ungraded_student(
    student: str, asked: Sequence[Exercise], *, handed_in: Collection[str], reason: str
) -> GradedStudent:
    """The results of a student of whom nothing could be graded.

    Args:
        student: who.
        asked: the exercises.
        handed_in: of which exercises there was something.
        reason: why it could not be graded, one line.
    """
    records = tuple(
        make_missing_record(one, student, status="ungradable", reason=reason)
        if one.name in handed_in
        else make_missing_record(one, student, status=MISSING, reason=NOTHING)
        for one in asked
    )
    return GradedStudent(student, "", records)  # no digest: it is not taken for final
