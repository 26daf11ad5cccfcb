"""Facts about robots that texts and starters rely on, worked out from the mechanisms themselves."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.physics.model import Part
from sim.teaching.reality_gap import LIMIT, record_limited_robot

ROUTINE = """
import pathlib

import commands2
from commands2.sysid import SysIdRoutine
from wpilib.sysid import State, SysIdRoutineLog

lift = commands2.Subsystem()
mechanism = SysIdRoutine.Mechanism(lambda volts: None, {log}, lift)
test = SysIdRoutine(SysIdRoutine.Config(), mechanism).dynamic(SysIdRoutine.Direction.kForward)
test.initialize()
for _ in range(3):
    test.execute()
words = str(State.kDynamicForward), SysIdRoutineLog.stateEnumToString(State.kDynamicForward)
pathlib.Path("words.txt").write_text(" ".join(words), encoding="utf-8")  # WPILib prints, too
"""


def run_routine(log, folder):
    """A test of WPILib's own routine with this log callback, three loops long."""
    pytest.importorskip("commands2")
    return subprocess.run(
        [sys.executable, "-c", ROUTINE.format(log=log)],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )


def test_none_for_the_log_callback_fails_in_the_first_loop(tmp_path):
    failed = run_routine("None", tmp_path)

    assert failed.returncode != 0
    assert "TypeError: 'NoneType' object is not callable" in failed.stderr
    assert run_routine("lambda log: None", tmp_path).returncode == 0


def test_only_state_enum_to_string_makes_the_word_that_sysid_looks_for(tmp_path):
    run_routine("lambda log: None", tmp_path)

    words = (tmp_path / "words.txt").read_text(encoding="utf-8")
    assert words == "State.kDynamicForward dynamic-forward"


def test_lesson_9_reaches_the_limit_with_the_hard_step_alone():
    """Below the limit nothing changes by a digit; above it everything does."""
    free = replace(MECHANISMS["drivetrain"], stator=np.inf, supply=np.inf, brownout=0.0)
    limited = replace(free, hidden=(Part("current-limit", {"limit": LIMIT}),))

    def velocity(robot, step):
        routine = Routine(1.0, step, timeout=2.0, kinds=("dynamic",))
        return simulate(robot, routine, rng=np.random.default_rng(1)).runs[0].velocity

    assert np.array_equal(velocity(limited, 2.5), velocity(free, 2.5))
    assert not np.allclose(velocity(limited, 6.0), velocity(free, 6.0), rtol=0.05)
    gentle, hard = record_limited_robot().values()
    steps = [log.list_runs_of_test("dynamic-forward")[0].voltage.max() for log in (gentle, hard)]
    assert steps == pytest.approx([2.5, 6.0])
