"""The student of a submission, from the names that learning platforms give to files.

    Canvas             doejane_LATE_101_5555_exercises.zip
    Moodle             Jane Doe_4711_assignsubmission_file_exercises.zip, or a folder without file
    Google Classroom   Jane Doe - exercises.zip
    GitHub Classroom   week-3-janedoe, a folder for each repository

Canvas writes the family name first and leaves out everything but letters and digits; what a teacher
renames may have either name first. A name is therefore compared by its words in any order.
"""

import difflib
import re
import unicodedata
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import PurePath

from grader.classroom.submitted_files import ARCHIVES
from sim.core.errors import Refusal
from sim.support.student_names import make_folder_name, normalize_name

CANVAS = re.compile(r"(?P<name>[^_]+)(?P<late>_LATE)?_(?P<id>\d+)_\d+_(?P<file>.+)")
MOODLE = re.compile(r"(?P<name>.+?)_(?P<id>\d+)_assignsubmission_[a-z]+_?(?P<file>.*)")
GOOGLE = re.compile(r"(?P<name>.+?) - (?P<file>.+\.\w+)")
PLATFORMS = (MOODLE, CANVAS, GOOGLE)
CANVAS_ID = "id"  # the column of Canvas's export that holds the number in its files' names
GITHUB = "github_username"  # a column of GitHub Classroom's roster
NAMES = (
    "student", "name", "full name", "sis login id", "login", "email", "sis user id", "identifier",
    GITHUB,
)  # fmt: skip
FIRST, LAST = ("first name", "given name", "firstname"), ("last name", "surname", "lastname")
ALIKE = 0.75  # how alike two names are for one to be proposed for the other
MOST_LIKELY = 3  # so many are proposed


@dataclass(frozen=True)
class SubmissionName:
    """Student and exercise, as the name of a file or folder tells them.

    Args:
        student: the name in it, as the platform writes it.
        canvas_id: the student's number in Canvas; empty elsewhere.
        file: the name of the file as the student called it; empty for a folder or a plain name.
        late: whether the platform says that it came after the due date.
        guessed: whether it is a file that no platform named, so that it says whose it is only if
            the roster knows the name.
    """

    student: str
    canvas_id: str = ""
    file: str = ""
    late: bool = False
    guessed: bool = False


def parse_name(name: str, *, folder: bool) -> SubmissionName:
    """Read the name of one thing that was handed in.

    Args:
        name: of the file or folder.
        folder: whether it is a folder.
    """
    for platform in PLATFORMS:
        found = platform.fullmatch(name)
        if found is None or (folder and platform is not MOODLE):
            continue
        canvas_id = found["id"] if platform is CANVAS else ""
        late = platform is CANVAS and found["late"] is not None
        return SubmissionName(found["name"].strip(), canvas_id, found["file"], late)
    if folder:
        return SubmissionName(name)
    ending = max((one for one in ARCHIVES if name.lower().endswith(one)), key=len, default="")
    stem = name[: -len(ending)] if ending else PurePath(name).stem
    return SubmissionName(stem, file="" if ending else name, guessed=not ending)


class Identities:
    """The students of a roster, and the names each of them may be called by.

    Args:
        rows: student -> their row of the roster, by its header.
    """

    def __init__(self, rows: Mapping[str, Mapping[str, str]]) -> None:
        self._students = {normalize_name(student): student for student in rows}
        self._students |= {make_folder_name(student): student for student in rows}
        self._canvas_ids: dict[str, str] = {}
        self._aliases: dict[str, set[str]] = {}
        self._github: dict[str, str] = {}
        for student, row in rows.items():
            cells = {head.strip().casefold(): text.strip() for head, text in row.items()}
            self._canvas_ids[cells.get(CANVAS_ID, "")] = student
            if cells.get(GITHUB):
                self._github[cells[GITHUB].casefold()] = student
            for name in _list_names(student, cells):
                for form in list_spellings(name):
                    self._aliases.setdefault(form, set()).add(student)
        self._canvas_ids.pop("", None)

    def find(self, name: SubmissionName) -> str | None:
        """The student on the roster that a name means; None if it means none, or several."""
        try:
            exact = self._students.get(normalize_name(name.student))
        except Refusal:
            return None
        known = exact or self._canvas_ids.get(name.canvas_id)
        if known is not None:
            return known
        meant = set().union(
            *(self._aliases.get(one, set()) for one in list_spellings(name.student))
        )
        if not meant and not name.file:
            plain = name.student.casefold()
            logins = [login for login in self._github if plain.endswith(f"-{login}")]
            meant = {self._github[max(logins, key=len)]} if logins else set()
        return next(iter(meant)) if len(meant) == 1 else None

    def propose(self, name: SubmissionName) -> tuple[str, ...]:
        """Students on the roster whose names are like this one, the likeliest first."""
        likeness: dict[str, float] = {}
        asked = list_spellings(name.student)
        for form, students in self._aliases.items():
            ratios = [difflib.SequenceMatcher(None, form, own).ratio() for own in asked]
            for student in students:
                likeness[student] = max([likeness.get(student, 0.0), *ratios])
        likely = sorted(likeness, key=lambda one: (-likeness[one], one))
        return tuple(one for one in likely if likeness[one] >= ALIKE)[:MOST_LIKELY]


def _list_names(student: str, cells: Mapping[str, str]) -> Iterator[str]:
    """All names of one student, from their row of the roster."""
    yield student
    yield from (cells[column] for column in NAMES if cells.get(column))
    first = next((cells[one] for one in FIRST if cells.get(one)), "")
    last = next((cells[one] for one in LAST if cells.get(one)), "")
    if first and last:
        yield f"{first} {last}"


def list_spellings(name: str) -> frozenset[str]:
    """A name's letters and digits, its words in every rotation, with accents and without.

    ``Doe, Zoë`` and ``Zoë Doe`` share ``zoëdoe``; Canvas's file name is ``doezo`` or ``doezoe``.
    """
    words = re.findall(r"[^\W_]+", unicodedata.normalize("NFC", name).casefold())
    found = set()
    for start in range(max(len(words), 1)):
        turned = "".join([*words[start:], *words[:start]])
        parts = unicodedata.normalize("NFKD", turned)
        unaccented = "".join(sign for sign in parts if not unicodedata.combining(sign))
        ascii_only = turned.encode("ascii", "ignore").decode()
        found |= {turned, unaccented, ascii_only}
    return frozenset(found - {""})
