"""Facts about robots that texts and starters rely on, worked out from the mechanisms themselves."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from places import ROOT

from exercises.exercise6.answer_key import WHY
from exercises.exercise12.drawn import TESTS
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.physics.model import Part
from sim.physics.motors import MOTORS
from sim.teaching.reality_gap import LIMIT, record_limited_robot

STATOR = 120.0  # [A] CTRE's default limit


def step_at_limit(mechanism):
    """[V] the step that drives the stator's limit through a motor that stands still."""
    return STATOR * mechanism.motor.resistance


def test_exercise_12_steps_the_drivetrain_below_its_current_limit_and_the_shooter_above():
    driving, shooting = (step_at_limit(MECHANISMS[name]) for name in ("drivetrain", "shooter"))

    assert driving == pytest.approx(3.9, abs=0.05)  # as the comment beside the steps says
    assert all(step < driving for (_, step) in TESTS["drivetrain"][:2])
    assert TESTS["drivetrain"][2] < driving
    assert max(TESTS["shooter"][1][1], TESTS["shooter"][2]) > shooting


def test_a_vortex_draws_what_wpilib_says_it_does():
    vortex = MOTORS["neoVortex"]

    assert vortex.free_current == 3.615  # wpilibsuite/allwpilib v2026.2.2, DCMotor.h and plant.py
    assert vortex.stall_torque == 3.6


def test_a_test_begins_with_a_full_battery():
    lesson = (ROOT / "lessons/05_preflight_and_run.py").read_text(encoding="utf-8")

    assert "12.5 V" in WHY["battery"]
    assert "**more than 12.5 V at rest**, and 20 mΩ or less on a battery tester" in lesson


@pytest.mark.parametrize("folder", ["exercises", "solutions"])
@pytest.mark.parametrize(
    ("file", "words"),
    [
        ("exercise4/ExampleSubsystem.java", "inverted in its settings"),
        ("exercise4/example_subsystem.py", "self.right.setInverted(True)"),
        ("exercise5/RobotContainer.java", "turn(() -> -m_driverController.getLeftY())"),
        ("exercise5/robotcontainer.py", "turn(lambda: -self.driver.getLeftY())"),
    ],
)
def test_forward_is_plus_for_the_right_side_and_for_the_stick(folder, file, words):
    assert words in (ROOT / folder / file).read_text(encoding="utf-8")


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


def test_the_readme_of_exercise_4_warns_once_of_a_step_that_slips():
    text = " ".join((ROOT / "exercises/exercise4/README.md").read_text(encoding="utf-8").split())

    assert text.count("slips below 3.5 V") == 1
    assert "spin the wheels" not in text


def test_lesson_9_reaches_the_current_limit_with_the_hard_step_only():
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
