"""Parse the output of the child process; only numbers in it are trusted."""

import json
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

LONGEST = 200  # [characters] of anything that is told on
NO_NUMBERS = {"nan": "nan", "inf": "infinity"}


@dataclass(frozen=True)
class CallResult:
    """The result of one call of a learner's function.

    Args:
        numbers: name -> value; finite, of type float.
        refused: name -> what stood there instead of a number, in words.
        reason: why there is nothing at all, one line; empty if there is.
    """

    numbers: Mapping[str, float] = field(default_factory=dict)
    refused: Mapping[str, str] = field(default_factory=dict)
    reason: str = ""


@dataclass(frozen=True)
class ParsedResults:
    """The parsed output of a child process.

    Args:
        force: what confined it, by its own word before it read the learner's file; None if it never
            came so far.
        answers: number of the call -> what it gave.
        crash: why the learner's file could not be loaded; empty if it could.
    """

    force: Mapping[str, object] | None
    answers: Mapping[int, CallResult]
    crash: str = ""


def parse_results(raw: bytes, *, nonce: str, file: str) -> ParsedResults:
    """Parse the result lines that a child process wrote.

    Args:
        raw: what came through the pipe.
        nonce: what each line has to begin with to count.
        file: name of the learner's file, for messages.
    """
    force: Mapping[str, object] | None = None
    answers: dict[int, CallResult] = {}
    crash = ""
    for said in _read_lines(raw, nonce):
        ready, number = said.get("ready"), said.get("call")
        if force is None:
            force = ready if isinstance(ready, dict) else {}
        elif type(number) is int:
            answers.setdefault(number, _read_answer(said, file))
        elif "crash" in said:
            crash = crash or _describe_crash(said["crash"], file)
    return ParsedResults(force, answers, crash)


def _read_lines(raw: bytes, nonce: str) -> Iterator[Mapping[str, object]]:
    for line in raw.split(b"\n"):
        try:
            said = json.loads(line)
        except (ValueError, RecursionError):  # cut off, or not ours
            continue
        if isinstance(said, dict) and said.get("nonce") == nonce:
            yield said


def _read_answer(said: Mapping[str, object], file: str) -> CallResult:
    if "crash" in said:
        return CallResult(reason=_describe_crash(said["crash"], file))
    result = said.get("result")
    pairs = result.get("names") if isinstance(result, dict) else None
    if not isinstance(pairs, list):
        return CallResult(
            reason=f"{file} returned {_describe_kind(result)}, not numbers by name in a dict"
        )
    numbers: dict[str, float] = {}
    refused: dict[str, str] = {}
    for pair in pairs:
        if not (isinstance(pair, list) and len(pair) == 2 and isinstance(pair[0], str)):  # noqa: PLR2004 - a name and what it stands for
            continue
        name, value = format_one_line(pair[0]), pair[1]
        if type(value) in {int, float} and _is_finite(value):
            numbers[name] = float(value)
        else:
            refused[name] = _describe_kind(value)
    return CallResult(numbers, refused)


def _is_finite(value: float) -> bool:
    try:
        return math.isfinite(float(value))
    except OverflowError:
        return False


def _describe_kind(value: object) -> str:
    """What something that is not a number is, in words."""
    if value is None:
        return "None"
    if isinstance(value, bool):
        return f"{value}, which is yes or no"
    if isinstance(value, str):
        return NO_NUMBERS.get(value, "a text")
    if isinstance(value, int | float):
        return "a number" if _is_finite(value) else "infinity"
    return _describe_type(value) if isinstance(value, dict) else "something that is not a number"


def _describe_type(told: Mapping[str, object]) -> str:
    """Words for the type that the child reports for a value."""
    name, of = format_one_line(told.get("is")), told.get("of")
    if name == "ndarray":
        return f"an array of shape {format_one_line(of)}"
    if name == "str":
        return f'the text "{format_one_line(of)}"'
    poses = isinstance(of, list) and ("int" in of or "float" in of)
    return f"a {name}, which only looks like a number" if poses else f"a {name}"


def _describe_crash(told: object, file: str) -> str:
    """``fit.py, line 12: ZeroDivisionError: division by zero``."""
    if not isinstance(told, dict):
        return f"{file} stopped"
    line = told.get("line")
    where = f"{file}, line {line}" if type(line) is int else file
    return f"{where}: {format_one_line(told.get('says'))}"


def format_one_line(text: object) -> str:
    """Text in one line of printable characters, and not too long."""
    kept = "".join(sign if sign.isprintable() else " " for sign in str(text)[: 2 * LONGEST])
    return kept if len(kept) <= LONGEST else f"{kept[:LONGEST]}…"
