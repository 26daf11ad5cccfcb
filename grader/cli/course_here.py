"""The course folder that a command is typed in, the exercises that it is about, and options."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from grader.feedback.terminal import print_error
from sim.core.errors import BadRequest

if TYPE_CHECKING:
    from grader.exercise.exercise import Exercise

PATH = click.Path(path_type=Path)
STUDENT = click.option(
    "--student", metavar="NAME", help="Who you are; your numbers and progress depend on it."
)
PLAIN = click.option(
    "--plain", is_flag=True, help="For screen readers: words instead of symbols, no columns."
)
ONLY = click.option(
    "--exercise", "only", multiple=True, help="Only this exercise; may be repeated."
)


def find_course_here(inside: Path | None = None) -> Path:
    """The course folder; prints a remark if it holds other code than the one that is running.

    Args:
        inside: a folder in the course; None takes the one that one stands in.

    Raises:
        BadRequest: there is no course here.
    """
    from grader.course.progress import describe_other_code, find_course  # noqa: PLC0415 - --help must not wait for it

    course = find_course(inside.resolve() if inside else Path.cwd())
    if said := describe_other_code(course):
        print_error(said)
    return course


def choose_exercises(only: Sequence[str], course: Path) -> "tuple[Exercise, ...]":
    """The exercises that were named, in the order of the course; all if none was.

    Raises:
        BadRequest: there is no such exercise, or none at all.
    """
    from grader.exercise.exercise import find_exercise, list_exercises  # noqa: PLC0415 - --help must not wait for it

    names = {find_exercise(one, course).name for one in only}
    asked = tuple(one for one in list_exercises(course) if not only or one.name in names)
    if not asked:
        raise BadRequest(
            "there are no exercises here",
            where=str(course),
            advice="Run this in the folder the course was fetched into.",
        )
    return asked
