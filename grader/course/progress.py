"""The course on this machine: its folder, the learner, and their progress."""

import math
import os
import tomllib
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, replace
from importlib import import_module
from itertools import chain, count
from pathlib import Path

from grader.student_data.class_package import PLACE as ISSUED
from grader.student_data.fingerprint import PACKAGES, fingerprint_folders, fingerprint_packages
from sim.core.errors import BadRequest, Refusal
from sim.support.atomic_file import write_atomically
from sim.support.student_names import check_student_name, make_folder_name

NOBODY = "me"  # who is learning, until they say otherwise
PLACE = Path(".course") / "progress.toml"


def find_course(start: Path) -> Path:
    """The course folder that ``start`` lies in, else the one this package lies in.

    Raises:
        BadRequest: there is none, or only a student's own numbers are there; the message says what
            to do.
    """
    here = Path(__file__).resolve().parents[2]
    for folder in (start, *start.parents, here):
        if (folder / "exercises").is_dir() and (folder / "lessons").is_dir():
            return folder
        if (folder / ISSUED).is_file():
            raise BadRequest(
                "your numbers are here, and the course is not",
                where=str(folder),
                advice="Unpack your class's course.zip where you unpacked your own zip file.",
            )
    raise BadRequest(
        f"{start} is not in a course folder",
        advice="Run this inside the course folder, the one that holds exercises and lessons. To "
        "make one: grade start my-course",
    )


def describe_other_code(course: Path) -> str:
    """A remark if a course folder holds other code than the one that is running; else empty.

    The folder one stands in decides about exercises and lessons; grader and sim are those of the
    installation that runs. Empty where the two are the same, or the folder holds no code.
    """
    own = [course / one.name for one in PACKAGES]
    if not all((one / "__init__.py").is_file() for one in own) or own[0].samefile(PACKAGES[0]):
        return ""
    if fingerprint_packages(own) == fingerprint_folders():
        return ""
    return (
        f"the grader and sim that run are those in {PACKAGES[0].parent}, and {course} holds other "
        "ones. To run those of the folder: python -m grader"
    )


@dataclass(frozen=True)
class Standing:
    """How far one learner is with one exercise: the best score so far, and hints shown."""

    score: float = 0.0
    max_score: float = 0.0
    hints: int = 0

    def __post_init__(self) -> None:
        known = 0 <= self.score <= self.max_score < math.inf and self.hints >= 0
        if not (known and isinstance(self.hints, int)):
            raise ValueError

    @property
    def is_done(self) -> bool:
        """Whether it has earned full marks."""
        return 0 < self.max_score <= self.score


@dataclass(frozen=True)
class Progress:
    """Everybody's progress on this machine.

    Args:
        student: who is learning, unless a command says otherwise; empty where it was written down
            and is lost.
        standings: student -> exercise -> standing.
    """

    student: str = NOBODY
    standings: Mapping[str, Mapping[str, Standing]] = field(default_factory=dict)

    def find_standing(self, student: str, exercise: str) -> Standing:
        """How far a learner is with an exercise."""
        return self.standings.get(student, {}).get(exercise, Standing())

    def replace_standing(self, student: str, exercise: str, standing: Standing) -> "Progress":
        """A copy with one standing changed."""
        mine = {**self.standings.get(student, {}), exercise: standing}
        return replace(self, standings={**self.standings, student: mine})

    def add_score(
        self, student: str, exercise: str, *, score: float, max_score: float
    ) -> "Progress":
        """A copy with a score added; a better earlier one is kept."""
        old = self.find_standing(student, exercise)
        best = score if old.max_score != max_score else max(score, old.score)
        new = replace(old, score=best, max_score=max_score)
        return self.replace_standing(student, exercise, new)

    def add_hints(self, student: str, exercise: str, hints: int) -> "Progress":
        """A copy with so many hints shown; a larger earlier number is kept."""
        old = self.find_standing(student, exercise)
        return self.replace_standing(student, exercise, replace(old, hints=max(hints, old.hints)))


def load_progress(course: Path) -> tuple[Progress, str]:
    """Read the progress kept in a course folder.

    Returns:
        The progress, and what is to be said about it: a damaged file is set aside, the first as
        ``progress.toml.bak``, the next as ``progress.toml.2.bak``.
    """
    path, text = course / PLACE, ""
    try:
        text = path.read_text(encoding="utf-8")
        return _parse_progress(tomllib.loads(text)), ""
    except FileNotFoundError:
        return Progress(), ""
    except (OSError, ValueError, TypeError, LookupError, AttributeError, RecursionError, Refusal):
        aside = _find_free_name(path)
        said = f"your progress in {path} could not be read; it starts again from zero"
        fresh = Progress(_rescue_student(text) or _find_default_student(course))
        with suppress(OSError):
            path.replace(aside)
            write_atomically(path, _format_progress(fresh))
            said += f", and the damaged file is now {aside.name}"
        return fresh, f"{said}."


def _rescue_student(text: str) -> str:
    """The student's name in a damaged file, so that no other student's numbers are used."""
    for line in text.splitlines():
        with suppress(ValueError, TypeError, LookupError, RecursionError, Refusal):
            return check_student_name(_parse_student(tomllib.loads(line)))
    return ""


def _find_default_student(course: Path) -> str:
    """The name for a course without a student; empty if the name was lost."""
    owners = {path.name for path in course.glob("exercises/*/data/*")}
    return "" if owners - {make_folder_name(NOBODY)} else NOBODY


def _parse_student(raw: Mapping[str, object]) -> str:
    """The student's name in a file's content; raises an error if there is none."""
    student = raw["student"]
    if not isinstance(student, str):
        raise TypeError
    return student


def _find_free_name(path: Path) -> Path:
    """Where a damaged file is set aside: nothing lies there yet."""
    first = path.with_name(f"{path.name}.bak")
    later = (path.with_name(f"{path.name}.{number}.bak") for number in count(2))
    return next(one for one in chain((first,), later) if not one.exists())


def _parse_progress(raw: dict[str, object]) -> Progress:
    """Progress from its file's content; raises an error for anything else."""
    if not raw:  # a disk that was full, or a machine that lost its power
        raise ValueError
    standings: dict[str, dict[str, Standing]] = {}
    tables = raw.get("progress", {})
    if not isinstance(tables, dict):
        raise TypeError
    for student, exercises in tables.items():
        standings[student] = {name: Standing(**one) for name, one in exercises.items()}
    student = _parse_student({"student": NOBODY, **raw})
    return Progress(check_student_name(student) if student else "", standings)


def update_progress(course: Path, change: Callable[[Progress], Progress]) -> str:
    """Change the progress stored in a course folder, safely against other processes.

    Args:
        course: the course folder.
        change: from the progress as it stands on the disk to what it is to be.

    Returns:
        What is to be said: that it could not be saved, or that it was damaged before; else nothing.
    """
    path = course / PLACE
    try:
        path.parent.mkdir(exist_ok=True)
        with _lock_file(path.with_name("progress.lock")):
            before, said = load_progress(course)
            after = change(before)
            if after != before or said:
                write_atomically(path, _format_progress(after))
    except OSError as error:
        return f"your progress could not be saved to {path}: {error.strerror or error}."
    return said


def _format_progress(progress: Progress) -> str:
    import tomlkit  # noqa: PLC0415 - reading needs no writer

    tables = {
        student: {
            name: {"score": one.score, "max_score": one.max_score, "hints": one.hints}
            for name, one in exercises.items()
        }
        for student, exercises in progress.standings.items()
    }
    return tomlkit.dumps({"student": progress.student, "progress": tables})


@contextmanager
def _lock_file(path: Path) -> Iterator[None]:
    """Be the only process in here; the others wait.

    Where a file system knows no locks, nobody waits.
    """
    with path.open("a+b") as stream:
        if os.name == "nt":
            msvcrt = import_module("msvcrt")
            with suppress(OSError):  # after ten seconds it gives up
                msvcrt.locking(stream.fileno(), msvcrt.LK_LOCK, 1)
        else:
            fcntl = import_module("fcntl")
            with suppress(OSError):
                fcntl.flock(stream.fileno(), fcntl.LOCK_EX)
        yield  # closing the file ends the lock
