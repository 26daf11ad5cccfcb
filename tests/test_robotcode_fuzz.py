"""Damaged robot code gives facts or a refusal: it never crashes the grader, nor keeps it busy.

The checks of exercise 4 judge every program that is not of another exercise.
"""

from collections import Counter
from pathlib import Path

import pytest
from places import ROOT
from robotcode_mutants import mutant, sources

from grader.checks.check import Status, run_checks
from grader.exercise.exercise import find_exercise
from grader.robotcode.running import run_buttons, run_gains, run_routine
from sim.core.errors import Refusal

pytestmark = pytest.mark.slow

MUTANTS = 300
FEWER = 5  # mutants of each outcome at least
CHECKS = find_exercise("exercise4", ROOT).checks
NO_MOUNTS = {"java": {}, "python": {}}
RUNS = {"exercise5": run_buttons, "exercise10": run_gains}  # of the solutions to an exercise
# Errors of Python's own: they tell of a mistake in the grader, not in a learner's program.
OURS = {"AssertionError", "AttributeError", "IndexError", "KeyError", "NameError", "OverflowError"}
OUR_WORDS = ("NoneType", "Unknown'", "positional argument", "object is not", "unsupported operand")


def survive(count: int, folder: Path) -> Counter[str]:
    """Run so many Java mutants; count how they end."""
    files = sources()
    outcomes: Counter[str] = Counter()
    for number in range(count):
        one = mutant(number, files)
        path = folder / str(number) / one.source.name
        path.parent.mkdir()
        path.write_bytes(one.content)
        said = f"mutant {number} of {one.source.name}: {one.how}"
        try:
            run = RUNS.get(one.source.parent.name)
            runs = run(path) if run else run_routine(path, mounts=NO_MOUNTS, task="no task")
            results = () if run else run_checks(CHECKS, runs)
        except Refusal:
            outcomes["refused"] += 1
        except BaseException as error:
            error.add_note(said)
            raise
        else:
            for stop in [run.stop for run in runs if run.stop is not None]:
                assert stop.kind not in OURS, (said, stop)
                assert not any(word in stop.said for word in OUR_WORDS), (said, stop)
            assert Status.ERROR not in {one.status for one in results}, (said, results)
            assert all(0.0 <= one.points <= one.max_points for one in results), said
            outcomes["stopped" if runs[0].stop else "errors" if runs[0].errors else "ran"] += 1
    return outcomes


def test_java_mutants_become_facts_or_a_refusal_and_never_a_crash(tmp_path: Path) -> None:
    outcomes = survive(MUTANTS, tmp_path)

    assert all(outcomes[one] >= FEWER for one in ("refused", "errors", "ran")), outcomes
