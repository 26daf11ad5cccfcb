"""Tab completes what a person types: commands, options, mechanisms, effects, faults, exercises."""

import os
import subprocess
import sys

import pytest
from places import ROOT

from grader.exercise.exercise import list_exercises
from sim.bench.mechanisms import MECHANISMS
from sim.inspect.faults import FAULTS
from sim.physics.effects import EFFECTS

EXERCISES = {one.name for one in list_exercises(ROOT)}
PROGRAMS = {"grade": "grader.cli", "sysid": "sim.cli"}


def complete(line, cwd=ROOT):
    """What bash would offer at the end of a line."""
    words = line.split(" ")
    told = {
        "COMP_WORDS": line,
        "COMP_CWORD": str(len(words) - 1),
        f"_{words[0].upper()}_COMPLETE": "bash_complete",
    }
    done = subprocess.run(
        [sys.executable, "-c", f"from {PROGRAMS[words[0]]} import main; main()"],
        cwd=cwd, env={**os.environ, **told}, capture_output=True, encoding="utf-8", check=False,
    )  # fmt: skip
    assert done.stderr == ""
    return {row.partition(",")[2] for row in done.stdout.splitlines()}


@pytest.mark.parametrize(
    ("line", "offered"),
    [
        ("sysid f", {"fit", "faults"}),
        ("sysid simulate ", set(MECHANISMS)),
        ("sysid simulate arm --hide ", set(EFFECTS)),
        ("sysid simulate arm --fault ", set(FAULTS)),
        ("sysid contaminate a.csv --fault enc", {"encoder-slip"}),
        ("sysid fit --met", {"--method"}),
        ("sysid fit --type ", {"simple", "elevator", "arm"}),
        ("grade exercise1", {one for one in EXERCISES if one.startswith("exercise1")}),
        ("grade watch pr", {"practice"}),
        ("grade rel", {"release"}),
    ],
)
def test_tab_completion_offers_the_expected_words(line, offered):
    assert complete(line) == offered


def test_every_exercise_is_offered():
    assert complete("grade ") >= EXERCISES
