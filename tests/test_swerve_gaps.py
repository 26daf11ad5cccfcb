"""The formulas that a learner writes in lesson 10: empty, right, wrong, or broken."""

import math
import re
from pathlib import Path

import numpy as np
import pytest

from sim.bench.swerve import SWERVE
from sim.teaching import swerve_gaps
from sim.teaching.swerve_gaps import check_formulas

LESSON = Path(__file__).resolve().parents[1] / "lessons" / "10_swerve.py"


def written(
    radius=lambda turned, lever, turns: turned * lever / (2 * math.pi * turns),
    inertia=lambda mass, lever, turning, straight: mass * lever * turning / straight,
    grip=lambda torque, ratio, radius, mass: 4 * torque * ratio / (radius * mass * 9.81),
):
    return check_formulas(radius=radius, inertia=inertia, grip=grip)


def test_right_formulas_are_reported_and_used():
    mine = written()

    said = ["Formula 1: right.", "Formula 2: right.", "Formula 3: right."]
    assert mine.report.splitlines() == said
    assert mine.grip is not swerve_gaps.compute_grip


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        ({"radius": lambda *_: ...}, "Formula 1: still empty"),
        ({"radius": lambda turned, lever, turns: turned * lever / turns}, "Formula 1: not yet."),
        ({"inertia": lambda *_: None}, "Formula 2: not yet. Is kA of turning"),
        ({"inertia": lambda mass, lever, a, b: mass * lever * b / a}, "Formula 2: not yet."),
        ({"grip": lambda *_: 1 / 0}, "Formula 3: it stops with an error: division by zero"),
        ({"grip": lambda torque, ratio, *_: torque * ratio}, "Formula 3: not yet. torque"),
    ],
)
def test_wrong_formula_gets_advice_and_is_replaced_by_the_right_one(wrong, says):
    mine = written(**wrong)
    (name,) = wrong

    assert says in mine.report
    assert mine.report.count("right.") == 2
    assert getattr(mine, name) is getattr(swerve_gaps, f"compute_{name}")


def test_a_rounded_pi_is_right():
    mine = written(radius=lambda turned, lever, turns: turned * lever / (2 * 3.14 * turns))

    assert mine.report.startswith("Formula 1: right.")


def test_the_grip_of_the_bench_follows_from_its_slip_current():
    """What turns the gears, kS/R, is no push: without it the grip is the one that was built in."""
    motor = SWERVE.motor
    pushing = SWERVE.slip_current - SWERVE.friction / motor.resistance
    torque = motor.torque_constant * pushing

    found = swerve_gaps.compute_grip(torque, SWERVE.ratio, SWERVE.wheel_radius, SWERVE.mass)

    assert found == pytest.approx(SWERVE.grip, rel=1e-9)


def test_the_solution_that_the_lesson_shows_is_right():
    text = re.sub(r"^# ?", "", LESSON.read_text(encoding="utf-8"), flags=re.MULTILINE)
    shown = text.partition("<summary>Solution</summary>")[2]
    code = re.search(r"```python\n(.*?)```", shown, re.DOTALL)[1]
    names = {"np": np}
    exec(code, names)  # noqa: S102 - the lesson's own lines

    mine = check_formulas(
        radius=names["my_radius"], inertia=names["my_inertia"], grip=names["my_grip"]
    )

    assert mine.report.count("right.") == 3
