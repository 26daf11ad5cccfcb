"""The submissions of a class: the student of each folder and zip file, and their answers.

Each student's folder or zip file may hold single answers, folders of exercises or the whole course.
``submitted_files.py`` reads it, and ``answer_files.py`` selects what is graded.
"""

import hashlib
import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path, PurePath

from grader.classroom.answer_files import AnswerSelector, Submission
from grader.classroom.submission_names import Identities, SubmissionName, parse_name
from grader.classroom.submitted_files import UNREADABLE, format_file_name, list_submitted_files
from grader.exercise.exercise import Exercise
from sim.core.errors import BadRequest, Refusal
from sim.support.student_names import check_student_name

SHOWN = 40  # [characters] of a name that is none


@dataclass(frozen=True)
class _Part:
    """One file or folder of a student's, and the name the student gave it."""

    path: Path
    name: SubmissionName


def find_submissions(
    folder: Path,
    exercises: Sequence[Exercise],
    *,
    asked: Sequence[Exercise] | None = None,
    roster: Identities | None = None,
) -> tuple[Submission, ...]:
    """Everything in a class's folder, in order of the students' names.

    Args:
        folder: with a folder or zip file for each student, or files as a learning platform names
            them.
        exercises: all of the course.
        asked: those that are graded; None grades all.
        roster: who is in the class; None takes the names as they are.

    Raises:
        BadRequest: there is no such folder, nothing in it, or one student twice.
    """
    if not folder.is_dir():
        raise BadRequest(
            "there is no such folder",
            where=str(folder),
            advice="Name the folder that holds a folder or zip file for each student.",
        )
    found: dict[str, list[_Part]] = {}
    for part in _list_parts(folder, roster):
        known = roster.find(part.name) if roster else None
        key = (known or part.name.canvas_id or part.name.student).casefold()
        twins = found.setdefault(key, [])
        if twins and not (part.name.file and twins[0].name.file):
            raise BadRequest(
                f"{format_file_name(twins[0].path.name)} and {format_file_name(part.path.name)} "
                "seem to be the same student",
                where=str(folder),
                advice="Keep one of the two, or put all files of that student into one folder.",
            )
        twins.append(part)
    if not found:
        raise BadRequest(
            "nobody handed anything in",
            where=str(folder),
            advice="Put a folder or zip file there for each student, with the student's name.",
        )
    each = [
        _identify_student(parts, AnswerSelector(exercises, asked or exercises), roster)
        for parts in found.values()
    ]
    return tuple(sorted(each, key=lambda one: one.student.casefold()))


def find_stray_files(folder: Path, roster: Identities | None) -> tuple[str, ...]:
    """Names of files in a class's folder that belong to no known student."""
    taken = {part.path for part in _list_parts(folder, roster)}
    return tuple(
        format_file_name(path.name)
        for path in sorted(folder.iterdir())
        if path not in taken and not path.name.startswith((".", "__"))
    )


def _list_parts(folder: Path, roster: Identities | None) -> Iterator[_Part]:
    for path in sorted(folder.iterdir(), key=lambda one: os.fsencode(one.name)):
        if path.name.startswith((".", "__")) or path.is_symlink():
            continue
        name = parse_name(path.name, folder=path.is_dir())
        if not name.guessed or (roster and roster.find(name)):
            yield _Part(path, name)


def _identify_student(
    parts: Sequence[_Part], selector: AnswerSelector, roster: Identities | None
) -> Submission:
    """What one student handed in, by the name on the roster; a stranger's is not read."""
    first = parts[0]
    if roster is None:
        return _read_submission(parts, selector, student=first.name.student)
    if student := roster.find(first.name):
        return _read_submission(parts, selector, student=student)
    likely = roster.propose(first.name)
    perhaps = f". Perhaps it is {' or '.join(likely)}" if likely else ""
    problem = (
        f"{format_file_name(first.path.name)} does not match any name on the roster{perhaps}. "
        "Give it the student's name, or add the student to the roster."
    )
    return Submission(_make_legible(first.name.student), first.path, problem=problem, likely=likely)


def read_submission(
    place: Path,
    exercises: Sequence[Exercise],
    *,
    asked: Sequence[Exercise] | None = None,
    student: str | None = None,
) -> Submission:
    """The submission of one student; unreadable files are noted in it.

    Args:
        place: a folder or a zip file.
        exercises: all of the course.
        asked: those that are graded; None grades all.
        student: who; None takes the name of the place.
    """
    name = SubmissionName(place.stem if place.is_file() else place.name)
    selector = AnswerSelector(exercises, asked or exercises)
    return _read_submission([_Part(place, name)], selector, student=student or name.student)


def _read_submission(
    parts: Sequence[_Part], selector: AnswerSelector, *, student: str
) -> Submission:
    place = parts[0].path
    try:
        student = check_student_name(student)
    except Refusal as refusal:
        return Submission(_make_legible(student), place, problem=str(refusal))
    at, late = "", any(part.name.late for part in parts)
    try:
        for part in parts:
            at = format_file_name(part.path.name)
            for one in list_submitted_files(part.path, name=part.name.file):
                selector.add(one)
    except UNREADABLE as error:
        reason = getattr(error, "strerror", None) or str(error) or type(error).__name__
        file = PurePath(str(getattr(error, "filename", None) or at)).name
        inside = "" if file == part.path.name else f", {file}"
        said = f"{at}{format_file_name(inside)} cannot be read: {reason}"
        return Submission(student, place, problem=format_file_name(said, most=300), late=late)
    return selector.select(student, place, late=late)


def _make_legible(name: str) -> str:
    """A short printable name to show in place of one that cannot be printed."""
    try:
        return check_student_name(name)
    except Refusal:
        mark = hashlib.sha256(name.encode("utf-8", "surrogatepass")).hexdigest()[:8]
        return f"{format_file_name(name, most=SHOWN)}… ({mark})"
