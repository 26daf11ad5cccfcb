"""A home for each student: a copy of the course that is theirs and stays from day to day."""

import csv
import hmac
import io
import secrets
import zipfile
from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path

from grader.course import update_progress
from grader.variant import folder_name, same
from sim.errors import BadRequest
from sim.report.written import write_whole
from sim.roster import read_roster

CODES = "codes.csv"
LETTERS = "ABCDEFGHJKLMNPQRSTUVWXYZ23456789"  # without those that look like others
LENGTH = 6  # a thousand million codes, and a wrong one costs a second


def codes(folder: Path, students: Iterable[str]) -> dict[str, str]:
    """Student -> the code they come in with; made once, kept in ``codes.csv``.

    Raises:
        BadRequest: the file cannot be read or written.
    """
    path = folder / CODES
    known: dict[str, str] = {}
    if path.exists():
        roster = read_roster(path, advice="Remove it: new codes are made.")
        known = {same(row[0]): row[1] for _, row in roster.rows if len(row) > 1}
    found = {name: known.get(same(name)) or _code() for name in students}
    if {same(name): code for name, code in found.items()} != known:
        stream = io.StringIO(newline="")
        csv.writer(stream).writerows([("student", "code"), *found.items()])
        folder.mkdir(parents=True, exist_ok=True)
        write_whole(stream.getvalue(), path)
    return found


def _code() -> str:
    return "".join(secrets.choice(LETTERS) for _ in range(LENGTH))


def right(given: str, code: str) -> bool:
    """Whether this is the code, in capitals or not; how long it takes tells nothing."""
    plain = given.strip().upper().encode("utf-8", "replace")
    return hmac.compare_digest(plain, code.encode())


def home(folder: Path, student: str, *, packages: Iterable[bytes]) -> Path:
    """A student's course folder; unpacked where it is not there yet, else left as it is.

    Args:
        folder: of all homes.
        student: whose.
        packages: zip files with a folder ``course``, the later over the earlier.

    Raises:
        BadRequest: it cannot be written.
    """
    place = folder / folder_name(student)
    course = place / "course"
    if course.is_dir():
        return course
    part = place / "part"
    try:
        for package in packages:
            with zipfile.ZipFile(io.BytesIO(package)) as archive:
                archive.extractall(part)
        (part / "course").rename(course)
        part.rmdir()
    except OSError as error:
        raise BadRequest(
            f"a home cannot be made: {error.strerror}",
            where=str(place),
            advice="Make room there, or name another folder.",
        ) from None
    if said := update_progress(course, lambda now: replace(now, student=student)):
        raise BadRequest(said, where=str(course), advice="Allow writing there.")
    return course


def find(students: Mapping[str, str], name: str) -> str | None:
    """The student who is meant, as on the roster; None if nobody is."""
    wanted = name.strip().casefold()
    return next((one for one in students if one.casefold() == wanted), None)
