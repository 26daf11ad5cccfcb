"""Every mutant of the Java and RobotPy answers to exercises 4, 5, 10 and the practice."""

import re
from collections.abc import Iterator
from pathlib import Path

from mutation import java_operators, python_operators
from mutation.answers import BASES, answer
from mutation.mutant import Mutant

EXERCISES = ("exercise4", "exercise5", "exercise10")
CHANGES = {".java": java_operators.changes_of, ".py": python_operators.changes_of}


def bases() -> Iterator[tuple[str, str, str]]:
    """Exercise, file and text of every right answer that is mutated."""
    for name in EXERCISES:
        for file, text in answer(name).items():
            if Path(file).suffix in CHANGES:
                yield name, file, text
    for path in sorted(BASES.rglob("*")):
        if path.suffix in CHANGES:
            yield path.parent.name, path.name, path.read_text(encoding="utf-8")


def mutants() -> Iterator[Mutant]:
    """Every mutant of every base; of exercise 5 only the learner's own part, and the imports."""
    for name, file, text in bases():
        own = _learners_lines(text)
        for operator, line, changed in CHANGES[Path(file).suffix](text):
            if name != "exercise5" or line in own:
                yield Mutant(name, file, operator, line, changed)


def _learners_lines(text: str) -> set[int]:
    """The lines between the marks of an authored answer, and the imports."""
    found, inside = set(), False
    for number, line in enumerate(text.splitlines(), 1):
        if "--- answer:" in line or "--- end" in line:
            inside = "--- answer:" in line
        elif inside or re.match(r"(import|from) ", line):
            found.add(number)
    return found
