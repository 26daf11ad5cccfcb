"""Whose numbers a student worked on: read from what the course wrote into what was handed in."""

import hmac
import tomllib
from collections.abc import Sequence
from dataclasses import replace

from grader.class_package import PLACE, ClassPackage, parse_class_package
from grader.classroom.secret import seal_identity
from grader.classroom.sorted_files import PROGRESS
from grader.classroom.submissions import Submission
from grader.course import NOBODY
from grader.variant import check_student_name, make_folder_name, normalize_name
from sim.core.errors import BadRequest, Refusal


def check_identities(
    handed_in: Sequence[Submission], *, secret: bytes | None
) -> tuple[Submission, ...]:
    """The submissions, marked where a student handed in another's package or worked without a name.

    Args:
        handed_in: by everybody.
        secret: of the class; None where everybody's numbers are those of self-study.

    Returns:
        The submissions, with a problem where the numbers are not the student's own.

    Raises:
        BadRequest: a class issued packages with its secret, and no secret was named.
    """
    return tuple(one if one.problem else _check_identity(one, secret) for one in handed_in)


def _check_identity(one: Submission, secret: bytes | None) -> Submission:
    content = one.identities.get(PLACE.as_posix())
    if content is None:
        return one if secret is not None else _grade_as_started(one)
    try:
        found = parse_class_package(content)
    except ValueError:
        return replace(one, problem=f"its {PLACE.name} cannot be read: was it changed?")
    one = _by_name(one, found.student)
    if secret is None:
        raise BadRequest(
            f"the numbers of {one.student} were made for the class {found.name}, "
            "which has a secret",
            where=str(one.place),
            advice="Give the secret file that grade release made: --secret class.secret",
        )
    return replace(one, problem=_explain_foreign_package(one, found, secret))


def _explain_foreign_package(one: Submission, found: ClassPackage, secret: bytes) -> str:
    """Why a class's package is not this student's; empty if it is."""
    mark = seal_identity(secret, student=found.student, name=found.name)
    if not hmac.compare_digest(mark.encode(), found.seal.encode()):
        return (
            f"its package was issued to {found.student} ({found.name}) with another secret, or "
            f"its {PLACE.name} was changed"
        )
    if not found.is_for(one.student):
        return (
            f"its package was issued to {found.student}, and {one.student} handed it in. Ask both. "
            "Then give it the name of the student who did the work"
        )
    return ""


def _grade_as_started(one: Submission) -> Submission:
    """The same, on the numbers of whoever the course was started as."""
    started_as = _read_started_student(one)
    one = _by_name(one, started_as)
    if make_folder_name(one.student) in one.data_folders:
        return one
    if not started_as and make_folder_name(NOBODY) in one.data_folders:
        started_as = NOBODY
    if not started_as or normalize_name(started_as) == normalize_name(one.student):
        return one
    if started_as == NOBODY:  # these numbers are nobody's: whoever never gave a name has them
        return replace(one, worked_as=NOBODY)
    return replace(
        one,
        problem=(
            f"its course was started as {started_as}, and {one.student} handed it in. Ask both. "
            "Then give it the name of the student who did the work"
        ),
    )


def _by_name(one: Submission, student: str) -> Submission:
    """The same, by the name that JupyterHub's folder of their work stands for; else as it is."""
    if student and one.student.casefold() == make_folder_name(student):
        return replace(one, student=student)
    return one


def _read_started_student(one: Submission) -> str:
    """The student that the course names; empty if it names none."""
    try:
        raw = tomllib.loads(one.identities[PROGRESS].decode("utf-8"))
        return check_student_name(str(raw["student"]))
    except (LookupError, ValueError, TypeError, RecursionError, Refusal):
        return ""
