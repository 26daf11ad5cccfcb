"""RobotPy programs on fakes, and on RobotPy in WPILib's simulation: both show the same."""

import json
import math
from pathlib import Path

import pytest
from robot_mistakes import MOUNTS, needs_robot

from grader.robotcode.bench.facts import RoutineFacts, from_json, to_json
from grader.robotcode.python import run_python

PROGRAMS = Path(__file__).resolve().parents[2] / "shared" / "data" / "robot-code"
OWN = Path(__file__).resolve().parent / "robotcode"
FILES = [*sorted(PROGRAMS.glob("*/exercise4/*/*.py")), OWN / "pwm_drive.py"]
FILES = [one for one in FILES if one.parent.name != "py_name_counter"]  # its names count the loops
LOOPS = 2  # both clocks are counted in other steps


def compare(one, other, way="facts"):  # noqa: C901 - one case for each type
    """Where two facts differ by more than a loop or two."""
    if isinstance(one, dict) and isinstance(other, dict):
        for key in (one.keys() | other.keys()) - {"values"}:  # one loop more moves them
            yield from compare(one.get(key), other.get(key), f"{way}.{key}")
    elif isinstance(one, list | tuple) and isinstance(other, list | tuple):
        if len(one) != len(other):
            yield way, one, other
        for number, pair in enumerate(zip(one, other, strict=False)):
            yield from compare(*pair, f"{way}[{number}]")
    elif isinstance(one, int) and isinstance(other, int):
        if abs(one - other) > LOOPS:
            yield way, one, other
    elif isinstance(one, float) and isinstance(other, float):
        if not math.isclose(one, other, rel_tol=5e-2, abs_tol=0.3):
            yield way, one, other
    elif one != other:
        yield way, one, other


@needs_robot
@pytest.mark.skipif(not PROGRAMS.is_dir(), reason="the programs of the workplace are not here")
@pytest.mark.parametrize("path", FILES, ids=lambda one: f"{one.parent.name}/{one.name}")
def test_fakes_and_robotpy_show_the_same(path):
    mounts = MOUNTS if "ExampleSubsystem" in path.read_text("utf-8") else {}
    fakes, robotpy = (
        to_json(run_python(path, "routine", mounts, robotpy=one)[0]) for one in (False, True)
    )

    assert list(compare(fakes, robotpy)) == []
    assert from_json(RoutineFacts, json.loads(json.dumps(fakes))) == from_json(RoutineFacts, fakes)
