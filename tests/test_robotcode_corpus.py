"""Robot code in, facts of its run out: a corpus of what teams write and learners hand in."""

import re
import tomllib

import pytest
from robot_corpus import whole_corpus

from grader.robotcode.bench.facts import RoutineFacts, Setting
from grader.robotcode.running import run_routine
from sim.core.errors import UnreadableFile

pytestmark = pytest.mark.slow

CORPUS = whole_corpus()
TABLE = tomllib.loads((CORPUS / "expected.toml").read_text("utf-8"))
SOURCES = {one for one in CORPUS.rglob("*") if one.suffix in {".java", ".py"}}
VOLTS = re.compile("set_?voltage", re.IGNORECASE)  # a PWM controller makes a duty cycle of it


def run(name: str) -> tuple[RoutineFacts, ...]:
    return run_routine(CORPUS / name, mounts={"java": {}, "python": {}}, task="no task")


def number(settings: list[Setting]) -> object:
    """One number of the Config as the table has it: unknown where two runs have two."""
    first = settings[0]
    if first.value is None or len({one.value for one in settings}) > 1:
        return "wrong" if first.problem else "unknown"
    return "default" if first.default else pytest.approx(first.value)


def table(runs: tuple[RoutineFacts, ...]) -> dict[str, object]:
    """What the table says of a program, without what is as it should be."""
    tests = [test for facts in runs for test in facts.tests.values()]
    driven = [(name, one) for test in tests for name, d in test.motors.items() for one in d.sent]
    kinds = {f"{m} {'voltage' if VOLTS.fullmatch(s.method) else s.kind}" for m, s in driven}
    logged = {f"{m} {s}" for test in tests for m, several in test.signals.items() for s in several}
    config = [
        number([getattr(facts, one) for facts in runs]) for one in ("ramp", "step", "timeout")
    ]
    found = {"config": config, "drive": sorted(kinds), "logged": sorted(logged)}
    return {key: value for key, value in found.items() if value and value != ["unknown"] * 3}


def test_every_file_has_a_row_and_every_row_a_file() -> None:
    rows = [name for part in TABLE.values() for name in part]
    assert sorted(rows) == sorted(path.relative_to(CORPUS).as_posix() for path in SOURCES)


@pytest.mark.parametrize("name", TABLE["ran"])
def test_run_of_each_program_has_the_expected_facts(name: str) -> None:
    row, runs = dict(TABLE["ran"][name]), run(name)
    stop = runs[0].stop.said if runs[0].stop else ""
    own = [one.message for one in runs[0].errors if not one.file]
    errors = "\n".join(one for one in own if "is not imported" not in one)

    for said, part in ((stop, row.pop("stop", "")), (errors, row.pop("error", ""))):
        assert part in said
        assert bool(part) == bool(said)
    assert table(runs) == row


@pytest.mark.parametrize("name", TABLE["nothing"])
def test_no_routine_is_found_where_there_is_none(name: str) -> None:
    assert run(name)[0].line == 0


@pytest.mark.parametrize("name", TABLE["refused"])
def test_program_that_cannot_be_run_is_refused_with_the_reason(name: str) -> None:
    with pytest.raises(UnreadableFile) as refusal:
        run(name)
    assert TABLE["refused"][name] in str(refusal.value)
