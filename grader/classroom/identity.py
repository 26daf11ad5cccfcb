"""The owner of the numbers in a submission, read from the seals that the course wrote into it."""

import hmac
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType

from grader.classroom.answer_files import PROGRESS, Submission
from grader.classroom.secret import seal_identity
from grader.course.progress import NOBODY
from grader.exercise.exercise import Exercise
from grader.student_data.class_package import PLACE, parse_class_package
from sim.core.errors import BadRequest, Refusal
from sim.support.printable import list_first
from sim.support.student_names import check_student_name, make_folder_name, normalize_name


def check_identities(
    handed_in: Sequence[Submission],
    asked: Sequence[Exercise],
    *,
    secret: bytes | None,
    self_study: bool = False,
    partners: Mapping[str, Sequence[str]] = MappingProxyType({}),
) -> tuple[Submission, ...]:
    """The submissions, marked where a student handed in another's package or worked without a name.

    Args:
        handed_in: by everybody.
        asked: the exercises that are graded.
        secret: of the class; None where everybody's numbers are those of self-study.
        self_study: whether somebody said that these numbers are those of self-study.
        partners: student -> those who may hand in the same work.

    Returns:
        The submissions, with a problem where the numbers are not the student's own.

    Raises:
        BadRequest: a class issued packages with its secret, and no secret was named; or nothing
            says whose numbers the answers are about.
    """
    if secret is None and not self_study:
        _refuse_unknown_numbers(handed_in, asked)
    return tuple(
        one if one.problem else _check_identity(one, secret, partners.get(one.student, ()))
        for one in handed_in
    )


def _refuse_unknown_numbers(handed_in: Sequence[Submission], asked: Sequence[Exercise]) -> None:
    """Refuse to grade answers with the numbers of self-study where nothing says that they are.

    Raises:
        BadRequest: there are such answers.
    """
    personal = {one.name for one in asked if one.is_personal}
    unknown = [
        one.student
        for one in handed_in
        if not (one.problem or one.identities or one.data_folders) and personal & one.files.keys()
    ]
    if unknown:
        raise BadRequest(
            "nothing says which numbers these students worked on: "
            f"{list_first(unknown, separator='; ')}",
            advice="If they had packages of grade release, add --secret class.secret. If they "
            "worked in the course without packages, add --self-study.",
        )


def _check_identity(one: Submission, secret: bytes | None, partners: Sequence[str]) -> Submission:
    content = one.identities.get(PLACE.as_posix())
    if content is None:
        return one if secret is not None else _grade_as_started(one, partners)
    try:
        found = parse_class_package(content)
    except ValueError:
        return replace(one, problem=f"its {PLACE.name} cannot be read: was it changed?")
    if secret is None:
        raise BadRequest(
            f"the numbers of {one.student} were made for the class {found.name}, "
            "which has a secret",
            where=str(one.place),
            advice="Give the secret file that grade release made: --secret class.secret",
        )
    mark = seal_identity(secret, student=found.student, name=found.name)
    if not hmac.compare_digest(mark.encode(), found.seal.encode()):
        said = (
            f"its package was issued to {found.student} ({found.name}) with another secret, or "
            f"its {PLACE.name} was changed"
        )
        return replace(one, problem=said)
    return _assign_numbers(one, found.student, partners, what="its package was issued to")


def _assign_numbers(
    one: Submission, owner: str, partners: Sequence[str], *, what: str
) -> Submission:
    """The submission, graded on the numbers of whom it says to be of, if the student may do so.

    Args:
        one: the submission.
        owner: whose numbers they are.
        partners: those who may hand in the same work.
        what: what says so.
    """
    name = normalize_name(owner)
    if name == normalize_name(one.student):
        return one
    if mates := [mate for mate in partners if normalize_name(mate) == name]:
        return replace(one, worked_as=mates[0])
    return replace(
        one,
        problem=f"{what} {owner}, and {one.student} handed it in. Ask both. Then give it the name "
        "of the student who did the work",
    )


def _grade_as_started(one: Submission, partners: Sequence[str]) -> Submission:
    """The submission, graded with the numbers of the name its student began the course with."""
    if make_folder_name(one.student) in one.data_folders:
        return one
    nobody = NOBODY if make_folder_name(NOBODY) in one.data_folders else one.student
    started_as = _read_started_student(one) or nobody
    # NOBODY's numbers are nobody's: whoever never gave a name has them
    mates = (*partners, NOBODY)
    return _assign_numbers(one, started_as, mates, what="its course was started as")


def _read_started_student(one: Submission) -> str:
    """The student that the course names; empty if it names none."""
    try:
        raw = tomllib.loads(one.identities[PROGRESS].decode("utf-8"))
        return check_student_name(str(raw["student"]))
    except (LookupError, ValueError, TypeError, RecursionError, Refusal):
        return ""
