"""Causes of missing behavior: it does not compile, it stopped, a file is missing."""

import re
from collections.abc import Iterable, Mapping
from pathlib import Path

from grader.checks.check import NotReachedError, WrongAnswer
from grader.checks.texts import read_texts
from grader.robotcode.bench.facts import TESTS, Outcome, ProgramFacts
from sim.support.printable import join_names

FAULTS = read_texts(Path(__file__).with_name("faults.toml"))
PHRASES = FAULTS.pop("phrases")

WHEN = {  # where a program stopped, in words
    "start": "when the robot's program starts",
    "drive": "in the drive callback",
    "log": "in the log callback",
    "periodic": "in periodic() or a trigger",
    "command": "when a test is started",
}


def explain_doubt(what: str, text: str) -> str:
    """The message that the grader cannot know something, with the code that causes it."""
    return f"the grader cannot know {what}{f': {text}' if text else ''}"


def quote(line: int) -> str:
    """A line's number in brackets, for the end of a sentence; empty for line 0."""
    return f" (line {line})" if line else ""


def fault(kind: str, line: int = 0, *, earned: float = 0.0, **values: object) -> WrongAnswer:
    """What is wrong, in the words of ``faults.toml``.

    Args:
        kind: its row there.
        line: of the code that does it; 0 if there is none to name.
        earned: points that are given in spite of it.
        values: for the gaps in its words.
    """
    row, values = FAULTS[kind], values | {"at": quote(line), "line": line}
    whole = {part: re.sub(r"\{(\w+)\}", _put_phrase, text) for part, text in row.items()}
    seen, hint = (whole[part].format_map(values) for part in ("seen", "hint"))
    return WrongAnswer(seen, hint=hint, misconception=row.get("misconception", ""), earned=earned)


def _put_phrase(gap: re.Match[str]) -> str:
    """The phrase of a gap's name; another gap stays open."""
    return str(PHRASES.get(gap[1], gap[0]))


def list_tests(tests: Iterable[str]) -> str:
    """Tests in words: ``dynamic forward and dynamic reverse``; all four are ``every test``."""
    asked = set(tests)
    found = [one.replace("-", " ") for one in TESTS if one in asked]
    return "every test" if len(found) == len(TESTS) else join_names(found)


def ask_for_files(unknown: Mapping[str, int], earned: float = 0.0) -> None:
    """Ask for the missing files that may contain the missing code.

    Args:
        unknown: a name, and the line that uses it.
        earned: points that are given in spite of it.

    Raises:
        WrongAnswer: there is such a name.
    """
    for name, line in unknown.items():
        raise fault("missing_file", line, name=name.rpartition(".")[2], earned=earned)


def check_swapped(facts: ProgramFacts, *, earned: float = 0.0) -> None:
    """Raise ``WrongAnswer`` if the drive callback treats the voltage as a log.

    Args:
        facts: the run.
        earned: points that are given in spite of it.
    """
    said = [(one.message, one.line, one.file) for one in facts.errors]
    said += [(facts.stop.said, facts.stop.line, "")] if facts.stop is not None else []
    for message, line, file in said:
        if re.search(r"(Voltage|float'|Measure) (has no|object has no attribute) '?motor", message):
            other = f" in {file}" if file else ""
            raise fault("callbacks_swapped", 0 if file else line, other=other, earned=earned)


def check_compiles(facts: ProgramFacts, *, earned: float = 0.0) -> None:
    """Raise ``WrongAnswer`` if a compiler, or Python itself, would stop at an error.

    Args:
        facts: the run.
        earned: points that are given in spite of it.
    """
    check_swapped(facts, earned=earned)
    if facts.errors:
        one, count = facts.errors[0], len(facts.errors)
        java = facts.language == "java"
        stops = "the code does not compile" if java else "Python stops with an error"
        more = f" There are {count} such lines." if count > 1 else ""
        other = f" of {one.file}" if one.file else ""
        raise fault(
            "does_not_compile", one.line, message=one.message, stops=stops, other=other, more=more,
            earned=earned,
        )  # fmt: skip


def check_stop(facts: ProgramFacts, *places: str, earned: float = 0.0) -> None:
    """Raise ``WrongAnswer`` if the program ended unexpectedly.

    Args:
        facts: the run.
        places: of ``WHEN``, at which it may have stopped; none are all.
        earned: points that are given in spite of it.
    """
    stop = facts.stop
    if stop is None or (places and stop.where not in places):
        return
    check_compiles(facts, earned=earned)
    if stop.outcome is Outcome.CANNOT:
        raise NotReachedError(stop.said)
    kind = "stops"
    if stop.outcome is Outcome.ENDLESS:
        kind = "hangs"
    elif re.search(r"(quasistatic|dynamic)\W.*(takes|missing|argument)", stop.said):
        kind = "asks_the_class"
    raise fault(kind, stop.line, when=WHEN[stop.where], said=stop.said, earned=earned)
