"""Names in a file of answers that the exercise does not ask for, with the names likely meant.

The answer to a misspelled name is not read, and its check finds nothing. A warning says why. It
costs no points, and neither does a name too many.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from difflib import SequenceMatcher

from grader.checks.check import shorten
from sim.support.printable import list_first

ALIKE = 0.6  # [share] how alike two names are for one to be proposed for the other
MOST_WARNINGS = 5  # a file with more of them belongs to another exercise
MOST_NAMES = 8  # in a message


def find_unknown_names(
    answers: Mapping[str, object],
    known: Sequence[str],
    *,
    tables: Sequence[str] = (),
    text: str,
    file: str,
    exercise: str,
) -> tuple[str, ...]:
    """A warning for each name that the exercise does not ask for, or that stands there twice.

    Args:
        answers: name -> answer, in the order of the file.
        known: the names that the exercise asks for, in upper or lower case.
        tables: those of them that have answers of their own below them: ``delay.lag``.
        text: the file's text, to find the lines.
        file: the file's name.
        exercise: the exercise's name.
    """
    found = []
    asked = {one.lower(): one in tables for one in known}
    for name, repeated in _list_unread(answers, asked, text):
        line = _find_line(text, name)
        why = (
            f"{shorten(name)} is the same name as {repeated}, and only the last one counts. "
            "Delete the other one"
            if repeated
            else _explain_unknown(name, answers, known, text=text, exercise=exercise)
        )
        found.append(f"{file}, line {line}: {why}" if line else f"{file}: {why}")
        if len(found) > MOST_WARNINGS:
            return (*found[:MOST_WARNINGS], f"{file}: more names do not count. Correct these first")
    return tuple(found)


def find_similar_name(name: str, known: Sequence[str]) -> str:
    """The known name that is most like another one; empty if none is."""
    plain = shorten(name).lower()
    shares = {one: SequenceMatcher(None, plain, one.lower()).ratio() for one in known}
    best = max(shares, key=lambda one: shares[one], default="")
    return best if shares.get(best, 0.0) >= ALIKE else ""


def _list_unread(
    answers: Mapping[str, object], asked: Mapping[str, bool], text: str
) -> Iterator[tuple[str, str]]:
    """Each unknown name, and each repeated name with the line that it repeats.

    Args:
        answers: name -> answer.
        asked: name in lower case -> whether it may be a table.
        text: the file's.
    """
    seen: dict[str, str] = {}
    for name, value in answers.items():
        key = name.lower()
        stray = isinstance(value, dict) and not asked.get(key, False)
        if key in asked and not stray:
            if key in seen:
                yield name, seen[key]
            seen[key] = name
        elif stray and isinstance(value, dict) and not _is_header(text, name):  # arm.kG = 0.5
            yield from ((f"{name}.{inner}", "") for inner in value)
        else:
            yield name, ""


def _explain_unknown(
    name: str, answers: Mapping[str, object], known: Sequence[str], *, text: str, exercise: str
) -> str:
    if isinstance(answers.get(name), dict) and _is_header(text, name):
        shown = f"[{shorten(name)}]"
        return f"{shown} starts a table, and nothing below it counts. Delete the line with {shown}"
    why = f"{exercise} does not ask for {shorten(name)}, so this line does not count"
    near = find_similar_name(name, known)
    if not near:
        return f"{why}. {exercise} asks for {list_first(known, most=MOST_NAMES)}"
    there = {one.lower(): value for one, value in answers.items()}
    if there.get(near.lower(), "") in ("", []):
        return f"{why}. Did you mean {near}?"
    return f"{why}. Did you mean {near}? That name already has an answer: keep the right one"


def _is_header(text: str, name: str) -> bool:
    """Whether a name stands in a line of its own, such as ``[arm]``, which starts a table."""
    return re.search(rf"^\s*\[+\s*[\"']?{re.escape(name)}\b", text, re.MULTILINE) is not None


def _find_line(text: str, name: str) -> int:
    """The number of the line that answers a name or starts its table; 0 if none is found."""
    parts = r"\s*\.\s*".join(rf"[\"']?{re.escape(part)}[\"']?" for part in name.split("."))
    pattern = re.compile(rf"\s*\[*\s*{parts}\s*[=.\]]")
    rows = enumerate(text.splitlines(), start=1)
    return next((number for number, row in rows if pattern.match(row)), 0)
