"""What the grader makes of damaged robot code: facts or a refusal, in time, and never nonsense."""

import re
import shutil
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from robotcode_mutants import FOLDERS, Mutant

from grader.robotcode import read
from grader.robotcode.bindings import read_bindings
from grader.robotcode.facts import Certainty, RoutineFacts
from grader.robotcode.gain_constants import read_gains
from sim.core.errors import Refusal

READERS: dict[str, Callable[[Path], object]] = {
    "routine": read,
    "bindings": read_bindings,
    "gains": read_gains,
}


@dataclass(frozen=True)
class Reading:
    """What became of a mutant.

    Args:
        reader: which part of the grader read it.
        outcome: ``facts``, ``problems`` (facts of a file that does not parse) or ``refused``.
        seconds: [s] of this thread alone: a busy machine does not count.
        facts: what was read; None if it was refused.
    """

    reader: str
    outcome: str
    seconds: float
    facts: object


@contextmanager
def among_neighbors(folder: Path) -> Iterator[Callable[[Mutant], list[Reading]]]:
    """Read mutants where the sound file stood, among those that it names."""
    copies = {top: folder / str(index) / top.name for index, top in enumerate(FOLDERS)}
    for top, copy in copies.items():
        shutil.copytree(top, copy, ignore=shutil.ignore_patterns("__pycache__", "data"))

    def readings(one: Mutant) -> list[Reading]:
        top = next(top for top in FOLDERS if top in one.source.parents)
        path = copies[top] / one.source.relative_to(top)
        sound = path.read_bytes()
        path.write_bytes(one.content)
        try:
            return [_reading(name, path) for name in READERS]
        finally:
            path.write_bytes(sound)

    yield readings


def _reading(name: str, path: Path) -> Reading:
    start = time.thread_time()
    facts: object = None
    try:
        facts = READERS[name](path)
    except Refusal:
        outcome = "refused"
    else:
        outcome = "problems" if getattr(facts, "problems", ()) else "facts"
    return Reading(name, outcome, time.thread_time() - start, facts)


def faults(reading: Reading, of: Mutant, *, most: float) -> list[str]:
    """What is wrong with a reading.

    Args:
        reading: what became of a mutant.
        of: the mutant.
        most: [s] that it may take.
    """
    lines = len(re.split(rb"\r\n|\r|\n", of.content))
    facts = reading.facts
    found = flaws(facts, lines=lines) if isinstance(facts, RoutineFacts) else []
    return [*found, "slow"] if reading.seconds > most else found


def flaws(facts: RoutineFacts, *, lines: int) -> list[str]:
    """What cannot be so in the facts of any file.

    Args:
        facts: of a file.
        lines: how many it has.
    """
    numbers = (facts.ramp, facts.step, facts.timeout)
    places = [facts.routine_line, *(one.line for one in (*facts.drive, *facts.logged, *numbers))]
    checks = {
        "a line that the file does not have": all(0 <= line <= lines for line in places),
        "a problem without a line": all(1 <= one.line <= lines for one in facts.problems),
        "a problem of several lines": not any("\n" in one.message for one in facts.problems),
        "a number known and unknown": all(
            (one.known is Certainty.UNKNOWN) == (one.value is None) for one in numbers
        ),
        "a place where no argument is": facts.config_argument >= -1 <= facts.mechanism_argument,
    }
    return [flaw for flaw, sound in checks.items() if not sound]
