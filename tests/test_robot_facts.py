"""Facts about robots that texts and starters rely on, worked out from the mechanisms themselves."""

from pathlib import Path

import pytest

from exercises.exercise6.preflight import WHY
from exercises.exercise12.drawn import TESTS
from sim.bench.mechanisms import MECHANISMS
from sim.physics.motors import MOTORS

ROOT = Path(__file__).resolve().parents[1]
STATOR = 120.0  # [A] CTRE's default limit


def step_at_limit(mechanism):
    """[V] the step that drives the stator's limit through a motor that stands still."""
    return STATOR * mechanism.motor.resistance


def test_exercise_12_steps_the_drivetrain_below_its_limit_and_the_shooter_beyond():
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
    assert "**12.5 V or more at rest**, and for 20 mΩ or less" in lesson


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
