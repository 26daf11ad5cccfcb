"""Robot code in, facts out: a corpus of what teams write and learners hand in, sound and broken.

The tables are the files `expected.toml` in the folders of `robotcode/`. They were written by
reading the code, not by running the reader.
"""

import tomllib

import pytest
from robot_corpus import whole_corpus

from grader.robotcode import read
from grader.robotcode.facts import Certainty, ConfigQuantity, DriveCall, LoggedSignal, RoutineFacts
from sim.core.errors import UnreadableFile

CORPUS = whole_corpus()
SUFFIXES = {".java", ".py"}
LEAST = {".java": 60, ".py": 50}  # files of each language: what a reader of both has to stand


def expected() -> dict[str, dict[str, object]]:
    """Every table row, by the file's path in the corpus."""
    found = {}
    for page in sorted(CORPUS.rglob("expected.toml")):
        folder = page.parent.relative_to(CORPUS)
        rows = tomllib.loads(page.read_text(encoding="utf-8"))
        found |= {(folder / name).as_posix(): row for name, row in rows.items()}
    return found


EXPECTED = expected()
SOURCES = sorted(path for path in CORPUS.rglob("*") if path.suffix in SUFFIXES)
PASSED = {True: "self", False: "no", None: "other"}
CONSTANT = {True: "parameter", False: "constant", None: "untold"}


def number(quantity: ConfigQuantity) -> str:
    if quantity.known is Certainty.STATED:
        return f"{quantity.value:g} {quantity.dimension}"
    return quantity.known.value


def command(call: DriveCall) -> str:
    scaled = {True: " scaled", False: "", None: " scaled?"}[call.scaled]
    carries = CONSTANT[call.uses_parameter]
    return f"{call.motor} {call.method} {call.output.value} {carries}{scaled}"


def entry(signal: LoggedSignal) -> str:
    words = (signal.family, signal.signal, signal.unit, signal.source.value)
    return f"{signal.motor}: {' '.join(word for word in words if word)}"


def table(facts: RoutineFacts) -> dict[str, object]:
    """The facts as `expected.toml` writes them, without what is as it should be."""
    problems = [f"line {one.line}: {one.message}" for one in facts.problems]
    if facts == RoutineFacts(facts.language, problems=facts.problems):
        return {"nothing": problems}
    found = {
        "class": facts.class_name,
        "subsystem": facts.is_subsystem,
        "config": [number(one) for one in (facts.ramp, facts.step, facts.timeout)],
        "motors": list(facts.motors),
        "drive": [command(call) for call in facts.drive],
        "logged": [entry(signal) for signal in facts.logged],
        "passed": PASSED[facts.subsystem_passed],
        "arguments": [facts.config_argument, facts.mechanism_argument],
        "callbacks": [
            "drive" if facts.drive_found else "",
            "null" if facts.log_is_null else "log" if facts.log_found else "",
        ],
        "problems": problems,
        "unread": [f"line {one.line}: {one.message}" for one in facts.unread],
    }
    usual = {
        "subsystem": True,
        "passed": "self",
        "arguments": [0, 1],
        "callbacks": ["drive", "log"],
        "problems": [],
        "unread": [],
    }
    return {key: value for key, value in found.items() if value != usual.get(key)}


def test_every_file_has_a_row_and_every_row_a_file() -> None:
    assert sorted(EXPECTED) == sorted(path.relative_to(CORPUS).as_posix() for path in SOURCES)


@pytest.mark.parametrize("suffix", LEAST)
def test_the_corpus_holds_many_files_of_either_language(suffix: str) -> None:
    assert sum(path.suffix == suffix for path in SOURCES) >= LEAST[suffix]


@pytest.mark.parametrize("name", EXPECTED)
def test_a_file_gives_the_facts_a_reader_finds_in_it(name: str) -> None:
    row = EXPECTED[name]

    if "refused" in row:
        with pytest.raises(UnreadableFile) as refusal:
            read(CORPUS / name)
        assert str(row["refused"]) in refusal.value.what
    elif "problem" in row:  # of what is this damaged, the first problem is all that is asked
        first = read(CORPUS / name).problems[0]
        assert f"line {first.line}: {first.message}".startswith(str(row["problem"]))
    else:
        assert table(read(CORPUS / name)) == row
