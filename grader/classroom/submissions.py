"""What a class handed in: folders and zip files, read but never unpacked.

Each student's folder or zip file may hold single answers, folders of exercises or the whole course;
zip files inside it are looked into once. A file belongs to the exercise whose name its folder has
(``exercise4``, ``Exercise 4``, ``ex4``), however deep. In no such folder, it belongs to the
exercise that its own name means (``Exercise4.java``), to the only one that has a file of its name,
or, where there are no such folders at all, to the only exercise that is asked for. Files that
remain may be the answer to an exercise of which there is nothing else: they are listed, and a
person decides.
"""

import hashlib
import io
import os
import re
import stat
import struct
import zipfile
import zlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path, PurePosixPath

from grader.class_package import PLACE as ISSUED
from grader.classroom.submission_names import Identities, SubmissionName, parse_name
from grader.exercise import Exercise
from grader.package_files import IGNORED, digest_starter, find_imported_modules, read_listed_files
from grader.submission import LARGEST
from grader.variant import check_student_name
from sim.core.errors import BadRequest, Refusal
from sim.support.printable import list_first

MOST_SEEN = 20_000  # [entries] of one student's: a whole robot project with its build has fewer
MOST_FILES = 40  # for one exercise
LARGEST_LOG = 32_000_000  # [bytes] of one robot log; four tests of SysId take less than 10 MB
LARGEST_WHOLE = 40_000_000  # [bytes] of everything that is read of one student's
MOST_PACKED = (
    50  # [bytes for one in a zip file] logs come to 10, and text that says nothing to 1000
)
LONGEST_NAME = 200  # [bytes] of a file's name; some systems take no more than 255
SHOWN = 40  # [characters] of a name that is none
FEW = 3  # names in a line
OURS = {"README.md", "hints.toml", "checks.py"}  # of the exercise, whatever a student did to them
NOT_THEIRS = {"__pycache__", "__MACOSX", ".git", ".gradle", "build"}
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
UNREADABLE = (
    OSError, zipfile.BadZipFile, zlib.error, EOFError, struct.error, RuntimeError,
    NotImplementedError, ValueError,
)  # fmt: skip


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
        unused: files that belong to no exercise, one line each, where an exercise has no answer.
    """

    student: str
    place: Path
    files: Mapping[str, Files] = field(default_factory=dict)
    problems: Mapping[str, str] = field(default_factory=dict)
    problem: str = ""
    identities: Mapping[str, bytes] = field(default_factory=dict)
    data_folders: frozenset[str] = frozenset()
    worked_as: str = ""
    unused: tuple[str, ...] = ()

    @property
    def numbers_owner(self) -> str:
        """The student whose numbers it is graded on."""
        return self.worked_as or self.student


@dataclass(frozen=True)
class _Part:
    """One file or folder of a student's, and the name the student gave it."""

    path: Path
    name: SubmissionName


def find_submissions(
    folder: Path,
    exercises: Sequence[Exercise],
    *,
    asked: Sequence[Exercise] | None = None,
    roster: Identities | None = None,
) -> tuple[Submission, ...]:
    """Everything in a class's folder, in order of the students' names.

    Args:
        folder: with a folder or zip file for each student, or files as a learning platform names
            them.
        exercises: all of the course.
        asked: those that are graded; None grades all.
        roster: who is in the class; None takes the names as they are.

    Raises:
        BadRequest: there is no such folder, nothing in it, or one student twice.
    """
    if not folder.is_dir():
        raise BadRequest(
            "there is no such folder",
            where=str(folder),
            advice="Name the folder that holds a folder or zip file for each student.",
        )
    found: dict[str, list[_Part]] = {}
    for part in _list_parts(folder):
        known = roster.find(part.name) if roster else None
        key = (known or part.name.canvas_id or part.name.student).casefold()
        twins = found.setdefault(key, [])
        if twins and not (part.name.file and twins[0].name.file):
            raise BadRequest(
                f"{_format_name(twins[0].path.name)} and {_format_name(part.path.name)} "
                "seem to be the same student",
                where=str(folder),
                advice="Keep one of the two, or put all files of that student into one folder.",
            )
        twins.append(part)
    if not found:
        raise BadRequest(
            "nobody handed anything in",
            where=str(folder),
            advice="Put a folder or zip file there for each student, with the student's name.",
        )
    each = [_identify(parts, exercises, asked, roster) for parts in found.values()]
    return tuple(sorted(each, key=lambda one: one.student.casefold()))


def find_stray_files(folder: Path) -> tuple[str, ...]:
    """Names of files in a class's folder that belong to no known student."""
    taken = {part.path for part in _list_parts(folder)}
    return tuple(
        _format_name(path.name)
        for path in sorted(folder.iterdir())
        if path not in taken and not path.name.startswith((".", "__"))
    )


def _list_parts(folder: Path) -> Iterator[_Part]:
    for path in sorted(folder.iterdir(), key=lambda one: os.fsencode(one.name)):
        if path.name.startswith((".", "__")) or path.is_symlink():
            continue
        name = parse_name(path.name, folder=path.is_dir())
        if name is not None:
            yield _Part(path, name)


def _identify(
    parts: Sequence[_Part],
    exercises: Sequence[Exercise],
    asked: Sequence[Exercise] | None,
    roster: Identities | None,
) -> Submission:
    """What one student handed in, by the name on the roster; a stranger's is not read."""
    first = parts[0]
    if roster is None:
        return _read(parts, exercises, asked, student=first.name.student)
    student = roster.find(first.name)
    if student is not None:
        return _read(parts, exercises, asked, student=student)
    likely = roster.propose(first.name)
    perhaps = f". Perhaps it is {' or '.join(likely)}" if likely else ""
    problem = (
        f"{_format_name(first.path.name)} does not match any name on the roster{perhaps}. "
        "Give it the student's name, or add the student to the roster."
    )
    return Submission(_make_legible(first.name.student), first.path, problem=problem)


def read_submission(
    place: Path,
    exercises: Sequence[Exercise],
    *,
    asked: Sequence[Exercise] | None = None,
    student: str | None = None,
) -> Submission:
    """What one student handed in; files that cannot be read are noted in it.

    Args:
        place: a folder or a zip file.
        exercises: all of the course.
        asked: those that are graded; None grades all.
        student: who; None takes the name of the place.
    """
    name = SubmissionName(place.stem if place.is_file() else place.name)
    return _read([_Part(place, name)], exercises, asked, student=student or name.student)


def _read(
    parts: Sequence[_Part],
    exercises: Sequence[Exercise],
    asked: Sequence[Exercise] | None,
    *,
    student: str,
) -> Submission:
    place = parts[0].path
    try:
        student = check_student_name(student)
    except Refusal as refusal:
        return Submission(_make_legible(student), place, problem=str(refusal))
    at = ""
    try:
        sorted_ = _SortedFiles(exercises, asked or exercises)
        for part in parts:
            at = _format_name(part.path.name)
            for one in _list_files(part):
                sorted_.add(one)
    except UNREADABLE as error:
        reason = getattr(error, "strerror", None) or str(error) or type(error).__name__
        return Submission(
            student, place, problem=f"{at} cannot be read: {_format_name(reason, most=200)}"
        )
    return replace(sorted_.result(), student=student, place=place)


def _make_legible(name: str) -> str:
    """A name to be shown for one that is none: what can be seen of it, and not too long."""
    try:
        return check_student_name(name)
    except Refusal:
        mark = hashlib.sha256(name.encode("utf-8", "surrogatepass")).hexdigest()[:8]
        return f"{_format_name(name, most=SHOWN)}… ({mark})"


def _format_name(name: str, *, most: int = SHOWN * 2) -> str:
    """A file's name as it can be printed."""
    return "".join(sign if sign.isprintable() else "?" for sign in name)[:most]


@dataclass(frozen=True)
class _FoundFile:
    """A file that may be an answer: where it stood, and how to get at it."""

    path: PurePosixPath
    read: Path | tuple[zipfile.ZipFile, zipfile.ZipInfo]

    def content(self, most: int) -> bytes:
        """Its bytes, one more than ``most`` at most."""
        if isinstance(self.read, Path):
            with self.read.open("rb") as stream:
                return stream.read(most + 1)
        archive, info = self.read
        if info.file_size > max(MOST_PACKED * info.compress_size, most // MOST_PACKED):
            raise ValueError(
                f"{_format_name(info.filename)} unpacks to {info.file_size / 1e6:.1f} MB"
            )
        with archive.open(info) as stream:
            return stream.read(most + 1)


def _list_files(part: _Part) -> Iterator[_FoundFile]:
    """All files of one thing that was handed in."""
    if part.path.is_dir():
        for one in _read_folder(part.path):
            yield from _read_inner_zip(one) if _is_zip(one.path) else (one,)
        return
    name = part.name.file or part.path.name
    if not _is_zip(PurePosixPath(name)):
        yield _FoundFile(PurePosixPath(name), part.path)
        return
    top = PurePosixPath(PurePosixPath(name).stem)  # exercise4.zip may hold answers.toml alone
    with zipfile.ZipFile(part.path) as archive:
        for one in _read_zip(archive, top):
            yield from _read_inner_zip(one) if _is_zip(one.path) else (one,)


def _is_zip(path: PurePosixPath) -> bool:
    return path.suffix.lower() == ".zip"


def _read_inner_zip(found: _FoundFile) -> Iterator[_FoundFile]:
    """Files of a zip file inside what was handed in; zip files in that are nobody's answer."""
    content = found.content(LARGEST_WHOLE)
    if len(content) > LARGEST_WHOLE:
        raise ValueError(
            f"{_format_name(found.path.name)} is larger than {LARGEST_WHOLE / 1e6:g} MB"
        )
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        for one in _read_zip(archive, found.path.with_suffix("")):
            if not _is_zip(one.path):
                yield one


def _read_folder(place: Path) -> Iterator[_FoundFile]:
    """Files of a folder; a link is nobody's answer: it may lead anywhere."""
    seen = 0
    for top, folders, names in os.walk(place, followlinks=False):
        folders[:] = sorted((name for name in folders if name not in NOT_THEIRS), key=os.fsencode)
        for name in sorted(names, key=os.fsencode):
            seen += 1
            if seen > MOST_SEEN:
                raise ValueError(f"more than {MOST_SEEN} files")
            path = Path(top) / name
            if path.is_file() and not path.is_symlink():
                yield _FoundFile(PurePosixPath(path.relative_to(place).as_posix()), path)


def _read_zip(archive: zipfile.ZipFile, top: PurePosixPath) -> Iterator[_FoundFile]:
    if len(archive.infolist()) > MOST_SEEN:
        raise ValueError(f"more than {MOST_SEEN} files")
    for info in sorted(archive.infolist(), key=lambda one: one.filename):
        path = top / info.filename.replace("\\", "/").lstrip("/")
        link = stat.S_ISLNK(info.external_attr >> 16)
        if not (info.is_dir() or link or {*path.parts} & NOT_THEIRS):
            yield _FoundFile(path, (archive, info))


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


class _SortedFiles:
    """Files sorted into exercises as they come.

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

    def add(self, found: _FoundFile) -> None:
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

    def _add_answer(self, found: _FoundFile) -> None:
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
        self, found: _FoundFile, name: str, exercise: Exercise, mine: dict[str, _TakenFile]
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
            said = (
                f"there are two different files {_format_name(name)}: {_format_name(str(path))} "
                f"and {_format_name(str(before.path))}. Keep the one that counts"
            )
            file = replace(file, problem=said)
        mine[name] = file

    def _taken(self, found: _FoundFile, exercise: Exercise) -> "_TakenFile":
        log = found.path.suffix.lower() in exercise.log_endings
        most = LARGEST_LOG if log else LARGEST
        content = self._content(found, most)
        if log and len(content) > most:
            said = f"{_format_name(found.path.name)} is larger than {most / 1e6:g} MB"
            return _TakenFile(found.path, b"", said)
        return _TakenFile(found.path, content)

    def _content(self, found: _FoundFile, most: int) -> bytes:
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

    def result(self) -> Submission:
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
        return Submission(
            "",
            Path(),
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
        """The files of no exercise, where one may be the only answer to an exercise.

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
            shown = _format_name(path.name)
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
    modules = {path.name for path in find_imported_modules(exercise.folder / "checks.py")}
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
