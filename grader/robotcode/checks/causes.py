"""Causes of missing behavior: it does not compile, it stopped, a file is missing."""

import re
from collections.abc import Iterable, Mapping

from grader.check import NotReachedError, WrongAnswer
from grader.robotcode.bench.facts import TESTS, Outcome, ProgramFacts
from sim.support.printable import join_names

WHEN = {  # where a program stopped, in words
    "start": "when the robot's program starts",
    "drive": "in the drive callback",
    "log": "in the log callback",
    "periodic": "in periodic() or a trigger",
    "command": "when a test is started",
}


def explain_doubt(what: str, text: str) -> str:
    """A message that asks the learner about code with an unknown effect."""
    return f"the grader cannot know {what}{f': {text}' if text else ''}"


def quote(line: int) -> str:
    """A line's number in brackets, for the end of a sentence; empty for line 0."""
    return f" (line {line})" if line else ""


def list_tests(tests: Iterable[str]) -> str:
    """Tests in words: ``dynamic forward and dynamic reverse``; all four are ``every test``."""
    asked = set(tests)
    found = [one.replace("-", " ") for one in TESTS if one in asked]
    return "every test" if len(found) == len(TESTS) else join_names(found)


def ask_for_files(unknown: Mapping[str, int], earned: float = 0.0) -> None:
    """Ask for the missing files that may contain the missing code.

    Args:
        unknown: a name, and the line that uses it.
        earned: points all the same.

    Raises:
        WrongAnswer: there is such a name.
    """
    for name, line in unknown.items():
        raise WrongAnswer(
            f"the grader cannot know what {name.rpartition('.')[2]} does{quote(line)}: it is in no "
            "file here",
            hint="Put its file into the same folder, or its class into this file, and grade again.",
            earned=earned,
        )


def check_compiles(facts: ProgramFacts, *, earned: float = 0.0) -> None:
    """Raise ``WrongAnswer`` if a compiler, or Python itself, would stop at an error.

    Args:
        facts: the run.
        earned: points all the same.
    """
    if facts.errors:
        one, count = facts.errors[0], len(facts.errors)
        java = facts.language == "java"
        stops = "the code does not compile" if java else "Python stops with an error"
        more = f" There are {count} such lines." if count > 1 else ""
        other = f" of {one.file}" if one.file else ""
        raise WrongAnswer(
            f"line {one.line}{other}: {one.message}",
            hint=f"With this line {stops}, and the robot does not start. Correct it.{more}",
            earned=earned,
        )


def check_stop(facts: ProgramFacts, *places: str, earned: float = 0.0) -> None:
    """Raise ``WrongAnswer`` if the program ended unexpectedly.

    Args:
        facts: the run.
        places: of ``WHEN``, at which it may have stopped; none are all.
        earned: points all the same.
    """
    stop = facts.stop
    if stop is None or (places and stop.where not in places):
        return
    check_compiles(facts, earned=earned)
    if stop.outcome is Outcome.CANNOT:
        raise NotReachedError(stop.said)
    verb = "stops"
    hint = "On the robot it would stop in the same way. Mend that line, and grade again."
    if stop.outcome is Outcome.ENDLESS:
        verb = "hangs"
        hint = "A robot's loop has 0.02 s. Code that waits or repeats must return at once."
    elif re.search(r"(quasistatic|dynamic)\W.*(takes|missing|argument)", stop.said):
        hint = (
            "SysIdRoutine is the class, and it has no motors: ask the object that you made, "
            "as in self.routine.quasistatic(direction)."
        )
    seen = f"the program {verb} {WHEN[stop.where]}{quote(stop.line)}: {stop.said}"
    raise WrongAnswer(seen, hint=hint, earned=earned)
