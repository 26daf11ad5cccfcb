"""The choice of a student's graded files: one rule for all kinds of submissions.

A file may be an answer to an exercise if it lies in a folder with the exercise's name
(``exercise4``, ``Exercise 4``, ``ex4``), however deep. In no such folder, it belongs to the
exercise that its own name means (``Exercise4.java``), to the only one that has a file of its name,
or, where there are no such folders at all, to the only exercise that is asked for. Its name counts
without what a browser or a computer adds (``answers (1).toml``, ``answers - Copy.toml``), and a
Java file that declares the class of the exercise's own file counts as that file.

Of all files that may be the answer to one exercise, starters as the course gave them do not count,
and files in the exercise's folder come before files elsewhere. If one is left, it is graded. If two
that differ are left, none is graded, and both are listed. Whatever else somebody could call an
answer is listed, too: a person decides.
"""

import os
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from functools import cache
from pathlib import Path, PurePosixPath

from grader.answers.answer_key import FILE_NAME as KEY
from grader.answers.submission import LARGEST
from grader.classroom.submitted_files import MAX_TOTAL, SubmittedFile, format_file_name
from grader.course.package_files import (
    IGNORED,
    digest_starter,
    find_imported_modules,
    read_listed_files,
)
from grader.exercise.exercise import Exercise
from grader.student_data.class_package import PLACE as ISSUED
from sim.support.printable import list_first

MAX_FILES = 40  # for one exercise
LARGEST_LOG = 32_000_000  # [bytes] of one robot log; four tests of SysId take less than 10 MB
LONGEST_NAME = 200  # [bytes] of a file's name; some systems take no more than 255
OURS = {"README.md", "hints.toml", "checks.py"}  # of the exercise, whatever a student did to them
COURSE_FOLDERS = {"lessons", "grader", "sim", "tests"}  # of a whole course
COURSE_FILES = {
    "license", "pyproject.toml", "constraints.txt", "changelog.md", "contributing.md",
    "instructors.md", "starters.toml", "progress.toml", ISSUED.name,
    *(name.casefold() for name in IGNORED),
}  # fmt: skip
EXERCISE = re.compile(r"(?:exercise|ex)[ _-]*0*(\d+)")  # how people write it, in lower case
# What a browser, Windows, macOS or Canvas adds to the name of a second copy.
COPY = re.compile(
    r"(?:\s*\(\d+\)|\s\d+|-\d+|(?:\s-)?[ _](?:copy|kopie)(?:\s*\(?\d+\)?)?)$", re.IGNORECASE
)
DATA = "data"  # a folder of an exercise with what the course made; of it only identities are read
PROGRESS = ".course/progress.toml"

Files = Mapping[str, bytes]


class _Place(Enum):
    """Why a file may belong to an exercise; the first counts more than the others."""

    FOLDER = 0  # it lies in the exercise's folder
    NAME = 1  # its own name means the exercise
    ONLY = 2  # no other exercise is asked for


@dataclass(frozen=True)
class _Candidate:
    """A file that may be a part of the answer to an exercise.

    Args:
        path: where it lies.
        name: the exercise's own name of it, or its own.
        content: cut off where it is too large for an answer.
        place: why it may belong to the exercise.
        problem: why it cannot be graded; empty if it can.
    """

    path: PurePosixPath
    name: str
    content: bytes
    place: _Place
    problem: str = ""

    @property
    def ending(self) -> str:
        """What its name ends in."""
        return PurePosixPath(self.name).suffix.lower()


@dataclass(frozen=True)
class Submission:
    """What one student handed in.

    Args:
        student: who: as on the roster, or by the name of the folder or zip file.
        place: where it lies; the first place where there are several.
        files: exercise -> file name -> its content, cut off where it is too large for an answer.
        problems: exercise -> why its files cannot be graded.
        problem: why nothing of it can be graded; empty if it can.
        identities: what the course itself wrote into it about whose numbers these are: the content
            of ``class.toml`` and of ``progress.toml``.
        data_folders: names of the folders with drawn data in it.
        worked_as: whose numbers they worked on; empty for their own.
        unused: files that may be answers and were not graded, one line each.
        late: whether the platform says that a part of it came after the due date.
        likely: students on the roster who may be meant, where none has its name.
    """

    student: str
    place: Path
    files: Mapping[str, Files] = field(default_factory=dict, repr=False)
    problems: Mapping[str, str] = field(default_factory=dict)
    problem: str = ""
    identities: Mapping[str, bytes] = field(default_factory=dict, repr=False)
    data_folders: frozenset[str] = frozenset()
    worked_as: str = ""
    unused: tuple[str, ...] = ()
    late: bool = False
    likely: tuple[str, ...] = ()

    @property
    def numbers_owner(self) -> str:
        """The student whose numbers the submission is graded on."""
        return self.worked_as or self.student


class AnswerSelector:
    """Takes the files of one student as they come, then selects those that are graded.

    Args:
        exercises: all of the course.
        asked: those that are graded.
    """

    def __init__(self, exercises: Sequence[Exercise], asked: Sequence[Exercise]) -> None:
        self._by_folder = {one.name.casefold(): one for one in exercises}
        self._by_file = _find_only_holders(exercises)
        self._asked = {one.name: one for one in asked}
        self._only = asked[0] if len(asked) == 1 else None
        self._candidates: dict[str, list[_Candidate]] = {one.name: [] for one in asked}
        self._has_folders = False
        self._unknown: list[tuple[PurePosixPath, Exercise | None]] = []
        self._identities: dict[str, bytes] = {}
        self._data: set[str] = set()
        self._left = MAX_TOTAL

    def add(self, found: SubmittedFile) -> None:
        """Store a file if it may be an answer, or names the owner of the numbers.

        Raises:
            ValueError: there is too much to read.
        """
        path = found.path
        inside = path.parts[:-1]
        if path.name == ISSUED.name and (inside[-1:] == (".course",) or DATA in inside):
            self._identities[ISSUED.as_posix()] = self._read_content(found, LARGEST)
        elif path.parts[-2:] == tuple(PurePosixPath(PROGRESS).parts):
            self._identities[PROGRESS] = self._read_content(found, LARGEST)
        elif DATA in inside:
            after = inside[inside.index(DATA) + 1 :]
            self._data.update(after[:1])
        elif path.name not in OURS and not any(one.startswith(".") for one in path.parts):
            self._add_candidate(found)

    def _add_candidate(self, found: SubmittedFile) -> None:
        path = found.path
        exercise, place = self._find_by_folder(path), _Place.FOLDER
        self._has_folders = self._has_folders or exercise is not None
        if exercise is None and COURSE_FOLDERS & {*path.parts[:-1]}:
            return
        if exercise is None:
            exercise, place = self._find_by_name(path), _Place.NAME
        if exercise is None and not self._has_folders:
            exercise, place = self._only, _Place.ONLY
        if exercise is None:
            self._unknown.append((path, None))
        elif exercise.name in self._asked and path.name not in _name_given_files(exercise):
            name = _restore_name(path.name, exercise)
            fits = PurePosixPath(name).suffix.lower() in _list_endings(exercise)
            if fits and len(os.fsencode(name)) <= LONGEST_NAME:
                self._candidates[exercise.name].append(
                    self._make_candidate(found, name, exercise, place)
                )
            else:
                self._unknown.append((path, exercise))

    def _make_candidate(
        self, found: SubmittedFile, name: str, exercise: Exercise, place: _Place
    ) -> _Candidate:
        if len(self._candidates[exercise.name]) >= MAX_FILES:
            many = f"more than {MAX_FILES} files may belong to it"
            return _Candidate(found.path, name, b"", place, many)
        log = found.path.suffix.lower() in exercise.log_endings
        most = LARGEST_LOG if log else LARGEST
        content = self._read_content(found, most)
        if log and len(content) > most:
            said = f"{format_file_name(found.path.name)} is larger than {most / 1e6:g} MB"
            return _Candidate(found.path, name, b"", place, said)
        return _Candidate(found.path, _find_declared(name, content, exercise), content, place)

    def _read_content(self, found: SubmittedFile, most: int) -> bytes:
        content = found.content(min(most, self._left))
        self._left -= len(content)
        if self._left < 0:
            raise ValueError(f"it holds more than {MAX_TOTAL / 1e6:g} MB of answers")
        return content

    def _find_by_folder(self, path: PurePosixPath) -> Exercise | None:
        found = (self._find_by_word(part) for part in reversed(path.parts[:-1]))
        return next((one for one in found if one), None)

    def _find_by_name(self, path: PurePosixPath) -> Exercise | None:
        """The exercise that a file's own name means."""
        named = self._find_by_word(path.stem)
        if named and path.suffix.lower() in _list_endings(named):
            return named
        return self._by_file.get(_strip_copy(path.name))

    def _find_by_word(self, word: str) -> Exercise | None:
        """The exercise of a name as people write it: ``exercise4``, ``Exercise 4``, ``ex4``."""
        for plain in (word.strip().casefold(), COPY.sub("", word.strip().casefold())):
            number = EXERCISE.fullmatch(plain)
            if found := self._by_folder.get(f"exercise{number[1]}" if number else plain):
                return found
        return None

    def select(self, student: str, place: Path, *, late: bool) -> Submission:
        """The student's graded files, and one line for each file that is not graded."""
        files: dict[str, Files] = {}
        problems: dict[str, str] = {}
        unused: list[str] = []
        for name, exercise in self._asked.items():
            mine = [
                one
                for one in self._candidates[name]
                if not (self._has_folders and one.place is _Place.ONLY)
            ]
            self._unknown += [(one.path, None) for one in self._candidates[name] if one not in mine]
            chosen, problem, lines = _select_answer(mine, exercise)
            if chosen:
                chosen.sort(key=lambda one: one.name)
                files[name] = {one.name: one.content for one in chosen}
            if problem:
                problems[name] = problem
            unused += lines
        doubtful, unknown = self._judge_unknown({*files, *problems})
        return Submission(
            student,
            place,
            files,
            {**doubtful, **problems},
            identities=self._identities,
            data_folders=frozenset(self._data),
            unused=(*unused, *unknown),
            late=late,
        )

    def _judge_unknown(self, answered: set[str]) -> tuple[dict[str, str], tuple[str, ...]]:
        """Files that belong to no exercise, each perhaps the only answer to one.

        Args:
            answered: the exercises of which there is an answer.

        Returns:
            Exercise -> why it cannot be graded, where only one is possible; and a line for each of
            the other files.
        """
        certain: dict[str, list[str]] = {}
        unused = []
        for path, exercise in self._unknown:
            if _is_harmless(path):
                continue
            own = (one for one in self._asked.values() if _is_own_name(path.name, one))
            fit = [exercise] if exercise else [*own]
            open_ = [one.name for one in fit or self._asked.values() if one.name not in answered]
            shown = format_file_name(path.name)
            if len(open_) == 1:
                certain.setdefault(open_[0], []).append(shown)
            elif open_ and fit:
                unused.append(
                    f"{shown} could belong to {list_first(open_)}; it was not graded. "
                    "Put it into a folder with the name of its exercise"
                )
            elif open_:
                unused.append(f"{shown} is not a file of any exercise; it was not graded")
        found = {
            name: _explain_wrong_files(self._asked[name], those) for name, those in certain.items()
        }
        return found, tuple(unused)


def _select_answer(
    mine: Sequence[_Candidate], exercise: Exercise
) -> tuple[list[_Candidate], str, list[str]]:
    """The files of one exercise that are graded.

    Args:
        mine: all files that may belong to it.
        exercise: the exercise.

    Returns:
        The files; why they cannot be graded, or nothing; and a line for each other file that may
        be an answer.
    """
    touched = [one for one in mine if one.problem or not _is_starter(one, exercise)]
    if not touched:
        return [], "", []
    pool = [one for one in touched if one.place is _Place.FOLDER] or touched
    graded = _find_read_files(pool, exercise)
    problem = next((one.problem for one in pool if one.problem), "") or _find_rivals(pool, exercise)
    if not graded:
        shown = [format_file_name(one.path.name) for one in pool]
        return [], problem or _explain_wrong_files(exercise, shown), []
    kept = {one.content for one in graded}
    from_ = list_first([_show_path(one) for one in graded])
    lines = [
        f"{_show_path(one)} was not graded: {exercise.name} is graded from {from_}"
        for one in touched
        if one.content not in kept
    ]
    return [*graded, *_find_kept_starters(mine, graded, exercise)], problem, lines


def _find_read_files(pool: Sequence[_Candidate], exercise: Exercise) -> list[_Candidate]:
    """The files that the exercise's checks will read; of identical ones the first.

    A file of another name is a part of a program of which the exercise's own file was filled in,
    or, where no such file was, perhaps the answer itself.
    """
    filled = {one.ending for one in pool if one.name in exercise.starters}
    answers = exercise.answer_endings
    read = {*filled, *exercise.log_endings} | (set() if filled & answers else answers)
    best_last = sorted(pool, key=lambda one: one.name in exercise.starters)
    found = {
        (_find_group(one, exercise), one.content): one for one in best_last if one.ending in read
    }
    return [*found.values()]


def _find_rivals(pool: Sequence[_Candidate], exercise: Exercise) -> str:
    """Why an exercise cannot be graded: several files of which only one can count; else empty."""
    rivals: dict[str, dict[bytes, str]] = {}
    for one in pool:
        those = rivals.setdefault(_find_group(one, exercise), {})
        those.setdefault(one.content, _show_path(one))
    for those in rivals.values():
        if len(those) > 1:
            shown = list_first([*those.values()])
            return (
                f"there are {len(those)} different files that may be the answer: {shown}. Keep the "
                "one that counts"
            )
    return ""


def _find_group(one: _Candidate, exercise: Exercise) -> str:
    """What stands for all files of which only one can count.

    Files of one name are rivals. So are all files of answers, whatever their names are; other
    files of code may belong to one program.
    """
    return one.ending if one.ending in exercise.answer_endings & {".toml"} else one.name


def _find_kept_starters(
    mine: Sequence[_Candidate], graded: Sequence[_Candidate], exercise: Exercise
) -> list[_Candidate]:
    """Starters that belong to an answer, so that it is said that they were not filled in.

    An untouched file to fill in is left out where another file may be the answer instead of it.
    """
    names = {*exercise.companion_files}
    if not any(one.ending in exercise.answer_endings and one.name not in names for one in graded):
        names |= {*exercise.files}
    names -= {one.name for one in graded}
    return [*{one.name: one for one in mine if one.name in names}.values()]


def _show_path(one: _Candidate) -> str:
    return format_file_name(str(one.path))


def _explain_wrong_files(exercise: Exercise, names: Sequence[str]) -> str:
    """Why an exercise was not graded where only files of other names were handed in."""
    shown, name = list_first(names), exercise.name
    if all(_is_own_name(one, exercise) for one in names):
        return f"{shown} may belong to {name}. Put it into a folder {name}"
    needed = " or ".join(exercise.files)
    return f"{shown} cannot be graded: {name} needs {needed}"


def _is_harmless(path: PurePosixPath) -> bool:
    """Whether an unused file needs no remark: of the course, of the computer, or a log."""
    name = path.name.casefold()
    return (
        name in COURSE_FILES
        or name.startswith(("readme", "~$"))
        or path.suffix.lower() == ".wpilog"
    )


def _is_own_name(name: str, exercise: Exercise) -> bool:
    """Whether an exercise has a file of this name."""
    return _restore_name(name, exercise) in exercise.starters


def _strip_copy(name: str) -> str:
    """A file's name in lower case, without the additions of a browser or a computer."""
    path = PurePosixPath(name.casefold().removesuffix(".txt"))
    return f"{COPY.sub('', path.stem)}{path.suffix}"


def _restore_name(name: str, exercise: Exercise) -> str:
    """An exercise's own name of a file: ``ANSWERS.TOML`` and ``answers (1).toml.txt`` have it."""
    own = {one.casefold(): one for one in exercise.starters}
    return own.get(name.casefold()) or own.get(_strip_copy(name)) or name


def _find_declared(name: str, content: bytes, exercise: Exercise) -> str:
    """The exercise's own name of a Java file that declares its class; else the file's name."""
    if name in exercise.starters or not name.lower().endswith(".java"):
        return name
    for own in exercise.starters:
        declares = rf"^\s*(?:public\s+)?(?:final\s+)?class\s+{re.escape(Path(own).stem)}\b"
        if own.endswith(".java") and re.search(declares.encode(), content, re.MULTILINE):
            return own
    return name


@cache
def _name_given_files(exercise: Exercise) -> frozenset[str]:
    """The names of the files in an exercise's folder that a student does not fill in."""
    modules = find_imported_modules(exercise.folder / "checks.py", exercise.folder / KEY)
    listed = read_listed_files(exercise).keys() - {*exercise.starters}
    return frozenset({*(path.name for path in modules), *listed, *OURS})


def _is_starter(one: _Candidate, exercise: Exercise) -> bool:
    """Whether a file is as the course gave it: nobody filled it in."""
    return digest_starter(one.content) in read_listed_files(exercise).values()


def _list_endings(exercise: Exercise) -> set[str]:
    """The possible endings of the names of an exercise's answer files."""
    return {*(Path(file).suffix for file in exercise.starters), *exercise.log_endings}


def _find_only_holders(exercises: Iterable[Exercise]) -> dict[str, Exercise]:
    """File name in lower case -> the only exercise that has a file of this name.

    A file that several have belongs to the only one that it is the answer to: others have it beside
    their answer.
    """
    every = [(name, one) for one in exercises for name in one.starters]
    answered = [(name, one) for one in exercises for name in one.files]
    return _find_single_holders(every) | _find_single_holders(answered)


def _find_single_holders(pairs: Iterable[tuple[str, Exercise]]) -> dict[str, Exercise]:
    holders: dict[str, list[Exercise]] = {}
    for name, one in pairs:
        holders.setdefault(name.casefold(), []).append(one)
    return {name: those[0] for name, those in holders.items() if len(those) == 1}
