"""The files of one student, sorted into exercises.

A file belongs to the exercise whose name its folder has (``exercise4``, ``Exercise 4``, ``ex4``),
however deep. In no such folder, it belongs to the exercise that its own name means
(``Exercise4.java``), to the only one that has a file of its name, or, where there are no such
folders at all, to the only exercise that is asked for. Files that remain may be the answer to an
exercise of which there is nothing else: they are listed, and a person decides.
"""

import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path, PurePosixPath

from grader.class_package import PLACE as ISSUED
from grader.classroom.submitted_files import LARGEST_WHOLE, SubmittedFile, format_file_name
from grader.exercise import Exercise
from grader.package_files import IGNORED, digest_starter, list_modules, read_listed_files
from grader.submission import LARGEST
from sim.support.printable import list_first

MOST_FILES = 40  # for one exercise
LARGEST_LOG = 32_000_000  # [bytes] of one robot log; four tests of SysId take less than 10 MB
LONGEST_NAME = 200  # [bytes] of a file's name; some systems take no more than 255
FEW = 3  # names in a line
OURS = {"README.md", "hints.toml", "checks.py"}  # of the exercise, whatever a student did to them
COURSE_FOLDERS = {"lessons", "grader", "sim", "tests"}  # of a whole course
COURSE_FILES = {
    "license", "pyproject.toml", "constraints.txt", "changelog.md", "contributing.md",
    "instructors.md", "starters.toml", "progress.toml", ISSUED.name,
    *(name.casefold() for name in IGNORED),
}  # fmt: skip
EXERCISE = re.compile(r"(?:exercise|ex)[ _-]*0*(\d+)")  # how people write it, in lower case
DATA = "data"  # a folder of an exercise with what the course made; of it only identities are read
PROGRESS = ".course/progress.toml"

Files = Mapping[str, bytes]


@dataclass(frozen=True)
class _TakenFile:
    """A file of an answer: where it lay, its content, and why it cannot be graded."""

    path: PurePosixPath
    content: bytes
    problem: str = ""

    @property
    def depth(self) -> int:
        """In how many folders it lay."""
        return len(self.path.parts)


_Taken = dict[str, dict[str, _TakenFile]]  # exercise -> name -> file


@dataclass(frozen=True)
class SortedFiles:
    """The files of one student, by exercise.

    Args:
        files: exercise -> file name -> its content, cut off where it is too large for an answer.
        problems: exercise -> why its files cannot be graded.
        identities: what the course itself wrote into it about whose numbers these are: the content
            of ``class.toml`` and of ``progress.toml``.
        data_folders: names of the folders with drawn data in it.
        unused: files that belong to no exercise, one line each, where an exercise has no answer.
    """

    files: Mapping[str, Files]
    problems: Mapping[str, str]
    identities: Mapping[str, bytes]
    data_folders: frozenset[str]
    unused: tuple[str, ...]


class FileSorter:
    """Sorts files into exercises as they come.

    Args:
        exercises: all of the course.
        asked: those that are graded.
    """

    def __init__(self, exercises: Sequence[Exercise], asked: Sequence[Exercise]) -> None:
        self._by_folder = {one.name.casefold(): one for one in exercises}
        self._by_file = _find_only_holders(exercises)
        self._asked = {one.name: one for one in asked}
        self._only = asked[0] if len(asked) == 1 else None
        self._in_folder: _Taken = {}
        self._by_name: _Taken = {}  # in no exercise's folder
        self._of_only: _Taken = {}  # the same, and of a name that says nothing
        self._has_folders = False
        self._remaining: list[tuple[PurePosixPath, Exercise | None]] = []
        self._identities: dict[str, bytes] = {}
        self._data: set[str] = set()
        self._left = LARGEST_WHOLE

    def add(self, found: SubmittedFile) -> None:
        """Take a file, if it is an answer or says whose numbers these are."""
        path = found.path
        inside = path.parts[:-1]
        if path.name == ISSUED.name and (inside[-1:] == (".course",) or DATA in inside):
            self._identities[ISSUED.as_posix()] = self._content(found, LARGEST)
        elif path.parts[-2:] == tuple(PurePosixPath(PROGRESS).parts):
            self._identities[PROGRESS] = self._content(found, LARGEST)
        elif DATA in inside:
            after = inside[inside.index(DATA) + 1 :]
            self._data.update(after[:1])
        elif path.name not in OURS and not any(one.startswith(".") for one in path.parts):
            self._add_answer(found)

    def _add_answer(self, found: SubmittedFile) -> None:
        path = found.path
        exercise = self._of_folder(path)
        self._has_folders = self._has_folders or exercise is not None
        if exercise is None and COURSE_FOLDERS & {*path.parts[:-1]}:
            return
        taken = self._in_folder
        if exercise is None:
            exercise, taken = self._of_name(path), self._by_name
        if exercise is None and not self._has_folders:
            exercise, taken = self._only, self._of_only
        if exercise is None:
            self._remaining.append((path, None))
        elif exercise.name in self._asked and path.name not in _name_given_files(exercise):
            name = _restore_name(path.name, exercise)
            fits = PurePosixPath(name).suffix.lower() in _list_endings(exercise)
            if fits and len(os.fsencode(name)) <= LONGEST_NAME:
                self._take(found, name, exercise, taken.setdefault(exercise.name, {}))
            else:
                self._remaining.append((path, exercise))

    def _take(
        self, found: SubmittedFile, name: str, exercise: Exercise, mine: dict[str, _TakenFile]
    ) -> None:
        path = found.path
        depth = len(path.parts)
        before = mine.get(name)
        if before and before.depth < depth:
            return
        if before is None and len(mine) >= MOST_FILES:
            many = f"more than {MOST_FILES} files may belong to it"
            name, file = "", _TakenFile(PurePosixPath(), b"", many)
        else:
            file = self._taken(found, exercise)
        if before and before.depth == depth and before.content != file.content:
            places = " and ".join(format_file_name(str(one)) for one in (path, before.path))
            said = (
                f"there are two different files {format_file_name(name)}: {places}. "
                "Keep the one that counts"
            )
            file = replace(file, problem=said)
        mine[name] = file

    def _taken(self, found: SubmittedFile, exercise: Exercise) -> "_TakenFile":
        log = found.path.suffix.lower() in exercise.log_endings
        most = LARGEST_LOG if log else LARGEST
        content = self._content(found, most)
        if log and len(content) > most:
            said = f"{format_file_name(found.path.name)} is larger than {most / 1e6:g} MB"
            return _TakenFile(found.path, b"", said)
        return _TakenFile(found.path, content)

    def _content(self, found: SubmittedFile, most: int) -> bytes:
        content = found.content(min(most, self._left))
        self._left -= len(content)
        if self._left < 0:
            raise ValueError(f"it holds more than {LARGEST_WHOLE / 1e6:g} MB of answers")
        return content

    def _of_folder(self, path: PurePosixPath) -> Exercise | None:
        found = (self._of_word(part) for part in reversed(path.parts[:-1]))
        return next((one for one in found if one), None)

    def _of_name(self, path: PurePosixPath) -> Exercise | None:
        """The exercise that a file's own name means."""
        name = path.name.casefold()
        named = self._of_word(path.stem)
        if named and path.suffix.lower() in _list_endings(named):
            return named
        return self._by_file.get(name) or self._by_file.get(name.removesuffix(".txt"))

    def _of_word(self, word: str) -> Exercise | None:
        """The exercise of a name as people write it: ``exercise4``, ``Exercise 4``, ``ex4``."""
        plain = word.strip().casefold()
        number = EXERCISE.fullmatch(plain)
        return self._by_folder.get(f"exercise{number[1]}" if number else plain)

    def result(self) -> SortedFiles:
        """Everything that was taken, and what remains."""
        taken: _Taken = {}
        for exercise in self._asked.values():
            loose = self._by_name.get(exercise.name, {})
            if not self._has_folders:
                loose = {**self._of_only.get(exercise.name, {}), **loose}
            for mine in (self._in_folder.get(exercise.name, {}), loose):
                if exercise.name not in taken and not _is_untouched(mine, exercise):
                    taken[exercise.name] = mine
        if self._has_folders:
            those = (file for mine in self._of_only.values() for file in mine.values())
            self._remaining += [(file.path, None) for file in those]
        problems = {
            exercise: file.problem
            for exercise, mine in taken.items()
            for file in mine.values()
            if file.problem
        }
        doubtful, unused = self._judge_remaining({*taken})
        return SortedFiles(
            {
                exercise: {name: mine[name].content for name in sorted(mine)}
                for exercise, mine in sorted(taken.items())
            },
            {**doubtful, **problems},
            identities=self._identities,
            data_folders=frozenset(self._data),
            unused=unused,
        )

    def _judge_remaining(self, answered: set[str]) -> tuple[dict[str, str], tuple[str, ...]]:
        """Files that belong to no exercise, each perhaps the only answer to one.

        Args:
            answered: the exercises of which there is an answer.

        Returns:
            Exercise -> why it cannot be graded, where only one is possible; and a line for each of
            the other files.
        """
        certain: dict[str, list[str]] = {}
        unused = []
        for path, exercise in self._remaining:
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
                    f"{shown} could belong to {list_first(open_, most=FEW)}; it was not graded. "
                    "Put it into a folder with the name of its exercise"
                )
            elif open_:
                unused.append(f"{shown} is not a file of any exercise; it was not graded")
        found = {
            name: _explain_wrong_files(self._asked[name], those) for name, those in certain.items()
        }
        return found, tuple(unused)


def _explain_wrong_files(exercise: Exercise, names: Sequence[str]) -> str:
    """Why an exercise was not graded where only files of other names were handed in."""
    shown, name = list_first(names, most=FEW), exercise.name
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
    return _restore_name(name, exercise).casefold() in _list_own_names(exercise)


def _list_own_names(exercise: Exercise) -> set[str]:
    """The names of an exercise's files, in lower case."""
    return {name.casefold() for name in (*exercise.files, *exercise.companion_files)}


def _restore_name(name: str, exercise: Exercise) -> str:
    """An exercise's own name of a file: ``ANSWERS.TOML`` and ``answers.toml.txt`` have it, too."""
    own = {one.casefold(): one for one in (*exercise.files, *exercise.companion_files)}
    plain = name.casefold()
    return own.get(plain) or own.get(plain.removesuffix(".txt")) or name


@cache
def _name_given_files(exercise: Exercise) -> frozenset[str]:
    """The names of the files of an exercise's folder that nobody fills in."""
    modules = {path.name for path in list_modules(exercise)}
    listed = read_listed_files(exercise).keys() - {*exercise.files, *exercise.companion_files}
    return frozenset({*modules, *listed, *OURS})


def _is_untouched(mine: Mapping[str, _TakenFile], exercise: Exercise) -> bool:
    """Whether all files of an answer are as the course gave them: nothing was handed in."""
    listed = read_listed_files(exercise)
    return all(
        not file.problem and listed.get(name) == digest_starter(file.content)
        for name, file in mine.items()
    )


def _list_endings(exercise: Exercise) -> set[str]:
    """What the names of an exercise's files end in."""
    named = {Path(file).suffix for file in (*exercise.files, *exercise.companion_files)}
    return {*named, *exercise.log_endings}


def _find_only_holders(exercises: Sequence[Exercise]) -> dict[str, Exercise]:
    """File name in lower case -> the only exercise that has a file of this name.

    A file that several have belongs to the only one that it is the answer to: others have it beside
    their answer.
    """
    found: dict[str, Exercise] = {}
    for name in {name for one in exercises for name in _list_own_names(one)}:
        holders = [one for one in exercises if name in _list_own_names(one)]
        graded = [one for one in holders if name in {file.casefold() for file in one.files}]
        if len(graded) == 1 or len(holders) == 1:
            found[name] = (graded or holders)[0]
    return found
