"""What a class handed in: a folder or a zip file for each student, read but never unpacked.

In each of them a file belongs to the exercise whose name its folder has, however deep; a file
that is called as in one exercise only needs no folder.
"""

import hashlib
import os
import zipfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

from grader.exercise import Exercise
from grader.submission import LARGEST
from grader.variant import student_name
from sim.errors import BadRequest, Refusal

MOST_SEEN = 20_000  # [entries] of one student's: a whole robot project with its build has fewer
MOST_FILES = 40  # for one exercise
SHOWN = 40  # [characters] of a name that is none
OURS = {"README.md", "hints.toml", "checks.py"}  # of the exercise, whatever a student did to them
NOT_THEIRS = {"data", "__pycache__", "__MACOSX", ".git", ".gradle", "build"}

Files = Mapping[str, bytes]


@dataclass(frozen=True)
class HandedIn:
    """What one student handed in.

    Args:
        student: who, by the name of the folder or zip file.
        place: where it lies.
        files: exercise -> file name -> its content, cut off where it is too large for an answer.
        problem: why it could not be read; empty if it could.
    """

    student: str
    place: Path
    files: Mapping[str, Files] = field(default_factory=dict)
    problem: str = ""


def find_all(folder: Path, exercises: Sequence[Exercise]) -> tuple[HandedIn, ...]:
    """Everything in a class's folder, in order of the students' names.

    Args:
        folder: with a folder or zip file for each student.
        exercises: what is graded.

    Raises:
        BadRequest: there is no such folder, nothing in it, or one student twice.
    """
    if not folder.is_dir():
        raise BadRequest(
            "there is no such folder",
            where=str(folder),
            advice="Name the folder that holds a folder or zip file for each student.",
        )
    found: dict[str, HandedIn] = {}
    for place in sorted(folder.iterdir(), key=lambda one: one.name):
        if not _is_one(place):
            continue
        one = find_one(place, exercises)
        twin = found.setdefault(one.student.casefold(), one)
        if twin is not one:
            raise BadRequest(
                f"{twin.place.name} and {place.name} are one student's",
                where=str(folder),
                advice="Keep one of the two, or name them apart by more than capitals.",
            )
    if not found:
        raise BadRequest(
            "nobody handed anything in",
            where=str(folder),
            advice="Put a folder or zip file there for each student, named as the student.",
        )
    return tuple(found[name] for name in sorted(found))


def _is_one(place: Path) -> bool:
    hidden = place.name.startswith((".", "__"))
    return not hidden and (place.is_dir() or place.suffix.lower() == ".zip")


def find_one(place: Path, exercises: Sequence[Exercise], *, student: str | None = None) -> HandedIn:
    """What one student handed in; what cannot be read is said, and stops nobody.

    Args:
        place: a folder or a zip file.
        exercises: what is graded.
        student: who; None takes the name of the place.
    """
    name = (place.stem if place.is_file() else place.name) if student is None else student
    try:
        student = student_name(name)
    except Refusal as refusal:
        return HandedIn(_stand_in(name), place, problem=str(refusal))
    try:
        reads = _of_zip(place) if place.is_file() else _of_folder(place)
        return HandedIn(student, place, _sorted_out(reads, exercises))
    except (OSError, zipfile.BadZipFile, RuntimeError, NotImplementedError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error) or type(error).__name__
        return HandedIn(student, place, problem=f"{place.name} cannot be read: {reason}")


def _stand_in(name: str) -> str:
    """A name to be shown for one that is none: what can be seen of it, and not too long."""
    seen = "".join(sign if sign.isprintable() else "?" for sign in name)
    mark = hashlib.sha256(name.encode("utf-8", "surrogatepass")).hexdigest()[:8]
    return f"{seen[:SHOWN]}… ({mark})"


@dataclass(frozen=True)
class _Found:
    """A file that may be an answer: where it stood, and how to get at it."""

    path: PurePosixPath
    read: Path | tuple[zipfile.ZipFile, zipfile.ZipInfo]

    def content(self) -> bytes:
        """Its bytes, one more than an answer may have at most."""
        if isinstance(self.read, Path):
            with self.read.open("rb") as stream:
                return stream.read(LARGEST + 1)
        archive, info = self.read
        with archive.open(info) as stream:
            return stream.read(LARGEST + 1)


def _of_folder(place: Path) -> Iterator[_Found]:
    """Files of a folder; a link is nobody's answer: it may lead anywhere."""
    seen = 0
    for top, folders, names in os.walk(place, followlinks=False):
        folders[:] = sorted(name for name in folders if name not in NOT_THEIRS)
        for name in sorted(names):
            seen += 1
            if seen > MOST_SEEN:
                raise ValueError(f"more than {MOST_SEEN} files")
            path = Path(top) / name
            if path.is_file() and not path.is_symlink():
                yield _Found(PurePosixPath(path.relative_to(place).as_posix()), path)


def _of_zip(place: Path) -> Iterator[_Found]:
    with zipfile.ZipFile(place) as archive:
        if len(archive.infolist()) > MOST_SEEN:
            raise ValueError(f"more than {MOST_SEEN} files")
        for info in sorted(archive.infolist(), key=lambda one: one.filename):
            path = PurePosixPath(info.filename.replace("\\", "/"))
            if not info.is_dir() and not {*path.parts} & NOT_THEIRS:
                yield _Found(path, (archive, info))


def _sorted_out(found: Iterable[_Found], exercises: Sequence[Exercise]) -> dict[str, Files]:
    """Exercise -> its files; of two with one name the less deep one."""
    own = _own_names(exercises)
    names = {one.name.casefold(): one for one in exercises}
    sorted_: dict[str, dict[str, tuple[int, bytes]]] = {}
    for one in found:
        exercise = _exercise_of(one.path, names) or own.get(one.path.name)
        if exercise is None or one.path.name in OURS or one.path.name.startswith("."):
            continue
        if one.path.suffix not in {Path(file).suffix for file in exercise.files}:
            continue
        mine = sorted_.setdefault(exercise.name, {})
        depth = len(one.path.parts)
        if one.path.name in mine and mine[one.path.name][0] <= depth:
            continue
        if len(mine) < MOST_FILES:
            mine[one.path.name] = (depth, one.content())
    return {
        name: {file: content for file, (_, content) in sorted(files.items())}
        for name, files in sorted(sorted_.items())
    }


def _exercise_of(path: PurePosixPath, names: Mapping[str, Exercise]) -> Exercise | None:
    for part in reversed(path.parts[:-1]):
        if part.casefold() in names:
            return names[part.casefold()]
    return None


def _own_names(exercises: Sequence[Exercise]) -> dict[str, Exercise]:
    """File name -> the only exercise that has a file of this name."""
    holders: dict[str, list[Exercise]] = {}
    for one in exercises:
        for name in one.files:
            holders.setdefault(name, []).append(one)
    return {name: held[0] for name, held in holders.items() if len(held) == 1}
