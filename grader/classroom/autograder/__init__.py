"""Autograders for other people's systems: Gradescope's zip file, a workflow for GitHub Classroom.

autograder.zip, as Gradescope asks for it:

    setup.sh                     builds the image
    run_autograder               grades one submission
    settings.sh                  what is graded, and by what students are told apart
    requirements.txt             packages from PyPI; requirements-robot.txt, to run robot code
    course/                      what students get: no solutions
    roster.csv, class.secret     only where asked for
"""

import re
import shlex
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from grader.classroom.bundle import zip_files

SCRIPTS = ("setup.sh", "run_autograder")
NOT_FOR_GRADING = {"ipywidgets", "jupyterlab", "sysid-course"}  # lessons need them, or it is us
SECONDS_ALLOWED = 540  # [s] of the ten minutes that Gradescope allows unless told otherwise
OWNER_ONLY = {"class.secret", "roster.csv"}
EXECUTABLE, PRIVATE = 0o755, 0o600


@dataclass(frozen=True)
class AutograderContents:
    """What Gradescope's autograder is made of.

    Args:
        course: path in the course folder -> content: what students get.
        exercises: names of those that are graded.
        student_from: what tells students apart: ``email``, ``name`` or ``sid``.
        roster: content of the class's roster; None where there is none.
        secret: of the class; None where everybody's numbers are those of self-study.
    """

    course: Mapping[str, bytes] = field(repr=False)
    exercises: tuple[str, ...]
    student_from: str
    roster: bytes | None = field(default=None, repr=False)
    secret: bytes | None = field(default=None, repr=False)  # a message may hold this


def pack_gradescope(given: AutograderContents) -> bytes:
    """The zip file to be uploaded as Gradescope's autograder; the same input, the same bytes."""
    here = Path(__file__).resolve().parent
    settings = {
        "EXERCISES": " ".join(given.exercises),
        "STUDENT_FROM": given.student_from,
        "SECONDS_ALLOWED": str(SECONDS_ALLOWED),
    }
    plain, robot = _read_requirements(given.course["pyproject.toml"])
    files = {name: (here / name).read_bytes().replace(b"\r\n", b"\n") for name in SCRIPTS}
    files |= {
        "settings.sh": _join_lines(
            f"{name}={shlex.quote(value)}" for name, value in settings.items()
        ),
        "requirements.txt": _join_lines(plain),
        "requirements-robot.txt": _join_lines(robot),
        **{f"course/{name}": content for name, content in given.course.items()},
    }
    if given.roster is not None:
        files["roster.csv"] = given.roster
    if given.secret is not None:
        files["class.secret"] = given.secret + b"\n"
    rights = dict.fromkeys(SCRIPTS, EXECUTABLE) | dict.fromkeys(OWNER_ONLY, PRIVATE)
    return zip_files(files, rights=rights)


def _join_lines(lines: Iterable[str]) -> bytes:
    return "".join(f"{line}\n" for line in lines).encode()


def _read_requirements(pyproject: bytes) -> tuple[list[str], list[str]]:
    """What to install from PyPI: always, and to run robot code."""
    project = tomllib.loads(pyproject.decode())["project"]
    extras = project["optional-dependencies"]
    plain = [
        one
        for one in (*project["dependencies"], *extras["course"], *extras["fast"])
        if (name := re.match(r"[\w.-]+", one)) and name[0] not in NOT_FOR_GRADING
    ]
    return plain, list(extras["robot"])


def make_workflow(exercises: Sequence[str]) -> str:
    """A workflow for GitHub Classroom: one step for each exercise, and the points of all.

    Args:
        exercises: names of those that are graded.
    """
    from jinja2 import Environment  # noqa: PLC0415 - Gradescope needs no template

    brackets = Environment(  # noqa: S701 - no page, and GitHub has braces of its own
        *("[%", "%]", "[[", "]]"), trim_blocks=True, keep_trailing_newline=True
    )
    text = Path(__file__).with_name("workflow.yml.jinja").read_text(encoding="utf-8")
    return brackets.from_string(text).render(exercises=exercises)
