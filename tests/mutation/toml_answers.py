"""Every mutant of the answers.toml of every exercise that has one."""

from collections.abc import Iterator

from mutation.answers import ROOT, answer
from mutation.mutant import Mutant
from mutation.toml_operators import changes_of

FILE = "answers.toml"
EXERCISES = tuple(sorted(folder.parent.name for folder in (ROOT / "exercises").glob(f"*/{FILE}")))


def mutants() -> Iterator[Mutant]:
    """Return every mutant of every solved answers.toml, for one student."""
    for name in EXERCISES:
        for operator, line, changed in changes_of(answer(name)[FILE]):
            yield Mutant(name, FILE, operator, line, changed)
