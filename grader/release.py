"""Packages for students: the course without solutions, and each student's own numbers.

course.zip               for everybody: no solutions, no tests, no secret
students/NAME.zip        to be unpacked over it: data drawn and sealed with the class's secret
"""

import io
import tempfile
import zipfile
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

import tomlkit

from grader.classroom.bundle import Bundle
from grader.classroom.secret import identity_seal, seal
from grader.exercise import exercises
from grader.issued import PLACE, Issued
from grader.variant import folder_name, of_class
from sim.errors import BadRequest

TOPS = ("LICENSE", "README.md", "exercises", "grader", "lessons", "pyproject.toml", "sim")
MADE = {"__pycache__", ".ipynb_checkpoints"}  # by Python and Jupyter


@dataclass(frozen=True)
class Package:
    """What one student gets.

    Args:
        student: whose numbers these are.
        secret: of the class.
        name: of the class.
        course: the course's exercises.
    """

    student: str
    secret: bytes
    name: str
    course: Bundle

    def __repr__(self) -> str:
        """Without the secret: a message may hold this."""
        return f"Package({self.student!r})"


def common(course: Path) -> bytes:
    """The zip file for everybody.

    Raises:
        BadRequest: this is not the whole course.
    """
    missing = [name for name in TOPS if not (course / name).exists()]
    if missing:
        raise BadRequest(
            f"{missing[0]} is missing: this is not the whole course",
            where=str(course),
            advice="Run this in the folder the course was fetched into.",
        )
    return _zipped(
        {
            f"course/{path.relative_to(course).as_posix()}": path.read_bytes()
            for top in TOPS
            for path in _files(course / top)
            if not _left_out(path.relative_to(course))
        }
    )


def _files(top: Path) -> Iterable[Path]:
    return [top] if top.is_file() else sorted(path for path in top.rglob("*") if path.is_file())


def _left_out(path: Path) -> bool:
    """Whether a file was made here: somebody's own data, or by Python."""
    return bool(MADE & {*path.parts}) or (path.parts[0] == "exercises" and "data" in path.parts)


def own(package: Package) -> tuple[str, bytes]:
    """One student's numbers: their name, and the zip file to unpack over the course."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as there:
        course = Path(there)
        with zipfile.ZipFile(io.BytesIO(package.course.content)) as archive:
            archive.extractall(course)
        with of_class(package.secret):
            for one in exercises(course):
                one.prepare(package.student, say=lambda _: None)
        made = {
            path.relative_to(course).as_posix(): path.read_bytes()
            for path in sorted(
                (course / "exercises").glob(f"*/data/{folder_name(package.student)}/*")
            )
        }
    sealed = {
        name: seal(package.secret, student=package.student, content=content)
        for name, content in made.items()
    }
    mark = identity_seal(package.secret, student=package.student, name=package.name)
    identity = {"class": package.name, "student": package.student, "seal": mark}
    beside = {Path(name).with_name(PLACE.name).as_posix() for name in made}
    files = {
        **made,
        PLACE.as_posix(): tomlkit.dumps({**identity, "sealed": sealed}).encode(),
        **dict.fromkeys(sorted(beside), tomlkit.dumps(identity).encode()),
    }
    return package.student, _zipped({f"course/{name}": text for name, text in files.items()})


def _zipped(files: Mapping[str, bytes]) -> bytes:
    """A zip file; the same files give the same bytes."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(zipfile.ZipInfo(name), content, zipfile.ZIP_DEFLATED)
    return stream.getvalue()


def broken_seals(course: Path, found: Issued, *, secret: bytes) -> list[str]:
    """Files of a course folder that are not as the class gave them to this student."""

    def whole(path: Path, expected: str) -> bool:
        if not path.is_file():
            return False
        return seal(secret, student=found.student, content=path.read_bytes()) == expected

    return [name for name, expected in found.sealed.items() if not whole(course / name, expected)]
