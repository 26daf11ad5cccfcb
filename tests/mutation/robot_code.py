"""Every mutant of the Java and RobotPy answers to exercises 4, 5, 10 and the practice."""

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
    """Every mutant of every base."""
    for name, file, text in bases():
        for operator, line, changed in CHANGES[Path(file).suffix](text):
            yield Mutant(name, file, operator, line, changed)
