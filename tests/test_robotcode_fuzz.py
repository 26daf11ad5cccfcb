"""Damaged robot code gives facts or a refusal: it never crashes the reader, nor keeps it busy.

``python tests/benchmarks/fuzz_robotcode.py 10000`` does the same with ten thousand.
"""

from collections import Counter
from pathlib import Path

import pytest
from robotcode_mutants import CHANGES, SUFFIXES, Mutant, mutant, sources
from robotcode_readings import READERS, Reading, among_neighbors, faults, flaws

from grader.robotcode.facts import Certainty, ConfigQuantity, ParseProblem, RoutineFacts
from sim.core.errors import Refusal

MUTANTS = 300
FEWER = 5  # mutants of each change at least, so that none is forgotten
SECONDS = 2.0  # of one mutant and reader


@pytest.fixture(scope="module")
def mutants() -> list[Mutant]:
    files = sources()
    return [mutant(number, files) for number in range(MUTANTS)]


def test_mutants_become_facts_or_a_refusal_in_time_and_never_a_crash(
    mutants: list[Mutant], tmp_path: Path
) -> None:
    outcomes: Counter[tuple[str, str]] = Counter()

    with among_neighbors(tmp_path) as readings:
        for number, one in enumerate(mutants):
            said = f"mutant {number} of {one.source.name}: {one.how}"
            try:
                found = readings(one)
            except Exception as error:
                error.add_note(said)
                raise
            assert not any(faults(reading, one, most=SECONDS) for reading in found), said
            outcomes.update((reading.reader, reading.outcome) for reading in found)

    for reader in READERS:  # a mutant that is refused tries nothing: there have to be others
        assert outcomes[reader, "facts"] > MUTANTS / 10
        assert outcomes[reader, "problems"] > MUTANTS / 10
        assert outcomes[reader, "refused"] > 0


@pytest.mark.parametrize("reader", READERS)
def test_every_reader_stands_every_file_as_it_is(reader: str) -> None:
    refused = []
    for path in sources():
        try:
            READERS[reader](path)
        except Refusal as refusal:
            refused.append((path, refusal.where))

    assert len(refused) < len(sources()) / 10
    assert [path for path, where in refused if path.name not in where] == []


def test_the_same_number_gives_the_same_mutant_and_another_one_another() -> None:
    files = sources()

    assert mutant(7, files) == mutant(7, files)
    assert mutant(7, files).content != mutant(7 + len(files), files).content


@pytest.mark.parametrize("change", CHANGES)
def test_every_change_is_made_to_both_languages(change: str, mutants: list[Mutant]) -> None:
    changed = [one for one in mutants if change in one.how.split(", ")]

    assert len(changed) >= FEWER
    assert {one.source.suffix for one in changed} == SUFFIXES


def test_a_slow_reading_is_noticed() -> None:
    one = Mutant(Path("Arm.java"), b"class Arm {}", "none")

    assert faults(Reading("routine", "facts", 2.1, RoutineFacts("java")), one, most=2.0) == ["slow"]


FLAWED = {
    "a line that the file does not have": RoutineFacts("java", routine_line=9),
    "a problem without a line": RoutineFacts(
        "java", problems=(ParseProblem("a ')' is missing", 0),)
    ),
    "a problem of several lines": RoutineFacts("java", problems=(ParseProblem("a\nb", 1),)),
    "a number known and unknown": RoutineFacts("java", step=ConfigQuantity(Certainty.STATED)),
    "a place where no argument is": RoutineFacts("java", mechanism_argument=-2),
}


@pytest.mark.parametrize("flaw", FLAWED)
def test_facts_that_cannot_be_are_noticed(flaw: str) -> None:
    assert flaws(FLAWED[flaw], lines=3) == [flaw]
