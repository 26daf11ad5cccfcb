"""A learner's submission: which file it is, and its text, or a refusal with the reason."""

import re
import tomllib
from collections import UserDict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import accumulate
from pathlib import Path
from typing import Any, NoReturn

from sim.core.errors import UnreadableFile
from sim.support.printable import list_first

LARGEST = 1_000_000  # [bytes] robot code and answers are far smaller; a log or a picture is not
LARGEST_ANSWERS = 64_000  # [bytes] of a file of answers; the longest solved one has 3,000
DEEPEST = 50  # [lists in lists] of it; the parser needs a call of Python for each
LONGEST_LINE = 2_000  # [characters] of it: reading a key takes the square of its length
_BARE_WORDS = re.compile(r"[\w.]+\s*=\s*\[?\s*[A-Za-z][\w\s,-]*\]?\s*(#.*)?")  # no quotes
NOT_ANSWERS = {
    "answer_key.toml", "class.toml", "faults.toml", "hints.toml", "progress.toml", "pyproject.toml",
    "slips.toml", "starters.toml",
}  # fmt: skip


class NamedAnswers(UserDict[str, object]):
    """Name -> answer as it stands in the file; a name may be in upper or lower case."""

    def __init__(self, answers: Mapping[str, object]) -> None:
        super().__init__({name.lower(): answer for name, answer in answers.items()})

    def __getitem__(self, name: str) -> object:
        return self.data[name.lower()]

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and name.lower() in self.data


@dataclass(frozen=True)
class StudentAnswers:
    """A student's answers, as the checks of an exercise read them.

    Args:
        given: the answers.
        variant: what is the student's own, as the exercise's ``draw`` gives it.
        student: who.
    """

    given: Mapping[str, object]
    variant: Any
    student: str


def find_files(
    given: Path | None, *, folder: Path, names: Sequence[str], companion_files: Sequence[str]
) -> tuple[Path, ...]:
    """The files to grade.

    Args:
        given: the file or folder the learner named; None takes the exercise's own files.
        folder: the exercise's folder.
        names: what the exercise's own files are called, the preferred one first.
        companion_files: what the files are called that belong to them; whoever names one means
            the file beside it that it belongs to.

    Raises:
        UnreadableFile: there is nothing there, or nothing of the right kind.
    """
    if given is None:
        return _find_named(folder, names) or _refuse_files(
            f"{' and '.join(names)} not found", folder, _explain_restore(folder, names[0])
        )
    if given.is_dir():
        return _find_in_folder(given, names)
    if not given.exists():
        own = folder / names[0]
        advice = f"Check the name; the exercise's own file is {own}."
        return _refuse_files("there is no such file", given, advice)
    if given.name in companion_files:
        what = f"{names[0]} is not in the same folder, and the two are graded together"
        advice = f"Put your {names[0]} into the same folder."
        return _find_named(given.parent, names)[:1] or _refuse_files(what, given, advice)
    if not _may_be_answer(given, names):
        what = "this file cannot be handed in for this exercise"
        return _refuse_files(what, given, f"Hand in {' or '.join(names)}.")
    return (given,)


def _find_named(folder: Path, names: Sequence[str]) -> tuple[Path, ...]:
    """The files of these names that are in a folder."""
    return tuple(folder / name for name in names if (folder / name).is_file())


def _find_in_folder(folder: Path, names: Sequence[str]) -> tuple[Path, ...]:
    """The files of an answer in a folder: those of the exercise's names, else the only one."""
    like = sorted(file for file in folder.iterdir() if _may_be_answer(file, names))
    like = [file for file in like if _is_filled(file)]
    if own := _find_named(folder, names):
        return own
    if not like:
        return _refuse_files(f"{' or '.join(names)} is missing", folder, "Name the file itself.")
    if len(like) > 1:  # one answer each: the best of many would be a prize for guessing
        named = list_first([file.name for file in like])
        what = f"{len(like)} files here could be the answer ({named})"
        advice = f"Type the name of the one that counts, or rename it to {names[0]}."
        return _refuse_files(what, folder, advice)
    return tuple(like)


def _refuse_files(what: str, place: Path, advice: str) -> NoReturn:
    raise UnreadableFile(what, where=str(place), advice=advice)


def _may_be_answer(file: Path, names: Sequence[str]) -> bool:
    """Whether a file ends as one of these does, and is not a file that the course has itself."""
    endings = {Path(name).suffix for name in names}
    return file.suffix.lower() in endings and file.name not in NOT_ANSWERS


def _is_filled(file: Path) -> bool:
    """Whether a file has content: a package's empty ``__init__.py`` is no answer."""
    return file.is_file() and file.stat().st_size > 0


def read_text(path: Path) -> str:
    """The text of a file that was handed in.

    Raises:
        UnreadableFile: it is missing, not to be opened, empty, too large, or not text.
    """
    try:
        if path.stat().st_size > LARGEST:
            raise UnreadableFile(
                f"{path.stat().st_size / 1e6:.0f} MB is too large for an answer",
                where=str(path),
                advice="Name the file you wrote: is this a log, or the whole project?",
            )
        raw = path.read_bytes()
    except OSError as error:
        reason = (error.strerror or type(error).__name__).lower()
        raise UnreadableFile(
            f"cannot be opened: {reason}",
            where=str(path),
            advice="Check its name, and whether you have the right to read it.",
        ) from None
    if not raw.strip():
        restore = _explain_restore(path.resolve().parent, path.name)
        advice = f"Write your answer into it. {restore}".rstrip()
        raise UnreadableFile("the file is empty", where=str(path), advice=advice)
    text = _decode_text(raw)
    if text is None:
        raise UnreadableFile(
            "this is not text", where=str(path), advice="Save it as text, in UTF-8."
        )
    return text


def read_answers(path: Path) -> dict[str, object]:
    """The answers in a TOML file, by name.

    Raises:
        UnreadableFile: it cannot be read, or is not TOML; the message names the line.
    """
    text = read_text(path)
    _check_size(text, path)
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        found = re.search(r"line (\d+)", str(error))
        number = int(found[1]) if found else text.count("\n") + 1
        rows = text.splitlines()
        above = rows[: min(number, len(rows)) - 1]
        row = rows[len(above)].strip()
        what = f"{row!r} cannot be read"
        advice = 'Every line is a name, = and a number: kV = 0.5 or, with a unit, kV = "0.5 V·s/m".'
        if before := _find_same_name(above, row):
            what = f"{row.partition('=')[0].strip()} is already answered in line {before}"
            advice = "Keep the line that counts, and delete the other one."
        elif re.search(r"\d,\d", row):
            advice = 'Write a decimal point, 0.5, or put quotes around the decimal comma: "0,5".'
        elif _BARE_WORDS.fullmatch(row):
            advice = 'Put quotes around each word: "word", or in a list ["word", "word"].'
        elif re.fullmatch(r"[\w.]+\s*=\s*(#.*)?", row):
            what = f"the value is missing after {row.partition('=')[0].strip()} ="
            advice = 'Write a number there, or "" as long as you have none.'
        raise UnreadableFile(what, where=f"{path}, line {number}", advice=advice) from None


def _find_same_name(rows: Sequence[str], row: str) -> int:
    """The number of the line, of those before a line, that answers the same name; 0 if none does.

    A name may come again in another table: below another line such as ``[arm]``.
    """
    name, equals, _ = row.partition("=")
    for number in range(len(rows), 0, -1):
        other, also, _ = rows[number - 1].partition("=")
        if equals and also and other.strip() == name.strip():
            return number
        if other.lstrip().startswith("["):
            break
    return 0


def _check_size(text: str, path: Path) -> None:
    """Refuse a file that is too large for an answer, or would take long to read.

    Raises:
        UnreadableFile: the file or one of its lines is too long, or its lists go too deep.
    """
    if len(text) > LARGEST_ANSWERS:
        raise UnreadableFile(
            f"{len(text):,} characters are too many for answers",
            where=str(path),
            advice="Write your answers only: is this another file?",
        )
    if max(accumulate((sign in "[{") - (sign in "]}") for sign in text), default=0) > DEEPEST:
        raise UnreadableFile(
            "lists in lists in lists: they go too deep",
            where=str(path),
            advice="An answer is a number, a text, or one list of them.",
        )
    for number, line in enumerate(text.splitlines(), start=1):
        if len(line) > LONGEST_LINE:
            raise UnreadableFile(
                f"this line has {len(line):,} characters",
                where=f"{path}, line {number}",
                advice=f"No answer is longer than {LONGEST_LINE:,} characters. Shorten it.",
            )


def _decode_text(raw: bytes) -> str | None:
    """UTF-8, with or without a mark, or the UTF-16 that some Windows editors write; else None."""
    encoding = "utf-16" if raw.startswith((b"\xff\xfe", b"\xfe\xff")) else "utf-8-sig"
    try:
        text = raw.decode(encoding)
    except UnicodeDecodeError:
        return None
    return None if "\0" in text else text


def _explain_restore(folder: Path, name: str) -> str:
    """How to get an exercise's own file back; nothing for a file from elsewhere."""
    if folder.parent.name != "exercises":
        return ""
    path = f"{folder.parent.name}/{folder.name}/{name}"
    return f"To get the file back as it was: {explain_restore(folder.parents[1], path)}"


def explain_restore(course: Path, *names: str) -> str:
    """The command that restores changed files of the course.

    Args:
        course: the course folder.
        names: paths in it.
    """
    here = course.resolve()
    if any((above / ".git").exists() for above in (here, *here.parents)):
        return f"git checkout -- {' '.join(names)}"
    return (
        "make a new copy of the course with grade start NEW-FOLDER --no-lab, and take "
        f"{' '.join(names)} from there."
    )
