"""What a class handed in: folders and zip files, read but never unpacked.

Each student's folder or zip file may hold single answers, folders of exercises or the whole course;
zip files inside it are looked into once. A file belongs to the exercise whose name its folder has,
however deep. Where there is no such folder at all, it belongs to the only exercise that is asked
for, or to the only one that has a file of its name.
"""

import hashlib
import io
import os
import stat
import struct
import zipfile
import zlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path, PurePosixPath

from grader.class_package import PLACE as ISSUED
from grader.classroom.submission_names import Identities, SubmissionName, parse_name
from grader.exercise import Exercise
from grader.submission import LARGEST
from grader.variant import check_student_name
from sim.core.errors import BadRequest, Refusal

MOST_SEEN = 20_000  # [entries] of one student's: a whole robot project with its build has fewer
MOST_FILES = 40  # for one exercise
LARGEST_LOG = 32_000_000  # [bytes] of one robot log; four tests of SysId take less than 10 MB
LARGEST_WHOLE = 40_000_000  # [bytes] of everything that is read of one student's
MOST_PACKED = (
    50  # [bytes for one in a zip file] logs come to 10, and text that says nothing to 1000
)
LONGEST_NAME = 200  # [bytes] of a file's name; some systems take no more than 255
SHOWN = 40  # [characters] of a name that is none
OURS = {"README.md", "hints.toml", "checks.py"}  # of the exercise, whatever a student did to them
NOT_THEIRS = {"__pycache__", "__MACOSX", ".git", ".gradle", "build"}
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
    """

    student: str
    place: Path
    files: Mapping[str, Files] = field(default_factory=dict)
    problems: Mapping[str, str] = field(default_factory=dict)
    problem: str = ""
    identities: Mapping[str, bytes] = field(default_factory=dict)
    data_folders: frozenset[str] = frozenset()
    worked_as: str = ""

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
    """A file of an answer: how deep it lay, its content, and why it cannot be graded."""

    depth: int
    content: bytes
    problem: str = ""


class _SortedFiles:
    """Files sorted into exercises as they come.

    Args:
        exercises: all of the course.
        asked: those that are graded.
    """

    def __init__(self, exercises: Sequence[Exercise], asked: Sequence[Exercise]) -> None:
        self._by_folder = {one.name.casefold(): one for one in exercises}
        self._by_file = _find_only_holders(exercises)
        self._asked = {one.name for one in asked}
        self._only = asked[0] if len(asked) == 1 else None
        self._kinds = {one.name: _list_endings(one) for one in asked}
        self._files: dict[str, dict[str, _TakenFile]] = {}  # exercise -> name -> file
        self._outside: dict[str, dict[str, _TakenFile]] = {}  # the same, in no exercise's folder
        self._has_folders = False
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
        exercise = self._of_folder(found.path)
        self._has_folders = self._has_folders or exercise is not None
        outside = exercise is None
        exercise = exercise or self._only or self._by_file.get(found.path.name)
        if exercise is None or exercise.name not in self._asked or (outside and self._has_folders):
            return
        name, ending = found.path.name, found.path.suffix.lower()
        if ending not in self._kinds[exercise.name] or len(os.fsencode(name)) > LONGEST_NAME:
            return
        files = self._outside if outside else self._files
        mine = files.setdefault(exercise.name, {})
        depth = len(found.path.parts)
        if name in mine and mine[name].depth < depth:
            return
        if name not in mine and len(mine) >= MOST_FILES:
            name, file = "", _TakenFile(0, b"", f"more than {MOST_FILES} files may belong to it")
        else:
            file = self._taken(found, exercise, depth)
        if name in mine and mine[name].depth == depth and mine[name].content != file.content:
            said = f"there are two different files {_format_name(name)}; keep the one that counts"
            file = replace(file, problem=said)
        mine[name] = file

    def _taken(self, found: _FoundFile, exercise: Exercise, depth: int) -> "_TakenFile":
        log = found.path.suffix.lower() in exercise.log_endings
        most = LARGEST_LOG if log else LARGEST
        content = self._content(found, most)
        if log and len(content) > most:
            said = f"{_format_name(found.path.name)} is larger than {most / 1e6:g} MB"
            return _TakenFile(depth, b"", said)
        return _TakenFile(depth, content)

    def _content(self, found: _FoundFile, most: int) -> bytes:
        content = found.content(min(most, self._left))
        self._left -= len(content)
        if self._left < 0:
            raise ValueError(f"it holds more than {LARGEST_WHOLE / 1e6:g} MB of answers")
        return content

    def _of_folder(self, path: PurePosixPath) -> Exercise | None:
        for part in reversed(path.parts[:-1]):
            if part.casefold() in self._by_folder:
                return self._by_folder[part.casefold()]
        return None

    def result(self) -> Submission:
        """Everything that was taken."""
        taken = self._files if self._has_folders else self._outside
        return Submission(
            "",
            Path(),
            {
                exercise: {name: mine[name].content for name in sorted(mine)}
                for exercise, mine in sorted(taken.items())
            },
            {
                exercise: file.problem
                for exercise, mine in taken.items()
                for file in mine.values()
                if file.problem
            },
            identities=self._identities,
            data_folders=frozenset(self._data),
        )


def _list_endings(exercise: Exercise) -> set[str]:
    """What the names of an exercise's files end in."""
    named = {Path(file).suffix for file in (*exercise.files, *exercise.companion_files)}
    return {*named, *exercise.log_endings}


def _find_only_holders(exercises: Sequence[Exercise]) -> dict[str, Exercise]:
    """File name -> the only exercise that has a file of this name."""
    holders: dict[str, list[Exercise]] = {}
    for one in exercises:
        for name in (*one.files, *one.companion_files):
            holders.setdefault(name, []).append(one)
    return {name: held[0] for name, held in holders.items() if len(held) == 1}
