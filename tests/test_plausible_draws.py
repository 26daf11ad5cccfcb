"""What any student is given is believable, and the authored way earns full marks on it.

The gate looks at a few students of each exercise. ``SYSID_STUDENTS=300`` looks at so many.
"""

import os

import pytest
from places import ROOT

from grader.exercise.course_check import find_solution_flaws, prepare_solved
from grader.exercise.exercise import Exercise, find_exercise

pytestmark = pytest.mark.slow

FEW = 20  # students in the gate
FEWER = {  # where logs are simulated, fitted and reconciled, or Python is run
    "exercise7": 5,
    "exercise8": 5,
    "exercise9": 5,
    "exercise10": 5,
    "exercise12": 1,
    "exercise13": 8,
    "practice": 3,
}
GRAVITY = 9.81  # [m/s²]
BATTERY = 12.6  # [V] of a good one, charged
KS = {  # [V] kS of real mechanisms: shooters 0.11 to elevators and arms 0.74, and a margin
    "least": 0.05,
    "most": 0.8,
}
STOP = 1.4  # [V] kS of exercise 2's mechanism that must not be tested on
ANSWERED = [  # exercise 12 takes 20 s, and students of the instructor's day solve it
    path.parent.name
    for path in sorted((ROOT / "solutions").glob("*/solve.py"))
    if path.parent.name != "exercise12" or "SYSID_STUDENTS" in os.environ
]


def students(name):
    few = FEWER.get(name, FEW)
    return [f"student {number}" for number in range(int(os.environ.get("SYSID_STUDENTS", few)))]


def drawn(name):
    module = Exercise(name, ROOT / "exercises" / name).module
    return [(student, module.draw(student)) for student in students(name)]


def test_exercise_1_has_ordinary_gains_and_needs_no_more_than_a_battery_and_a_grip():
    for student, variant in drawn("exercise1"):
        assert KS["least"] <= variant.gains["kS"] <= KS["most"], student
        for name, at in variant.moments.items():
            assert abs(variant.asked(name).expected) < BATTERY, student
            assert abs(variant.gains["kV"] * at.velocity) < BATTERY, student
            if variant.kind == "drivetrain":
                assert abs(at.acceleration) < GRAVITY, student  # friction of 1.0, the least


def test_exercise_2_has_a_ks_that_goes_with_what_the_mechanic_noticed():
    for student, variant in drawn("exercise2"):
        mechanic = variant.told["noticed"]["mechanic"]

        assert KS["least"] <= variant.friction <= STOP, student
        assert variant.flag == "fine" or "as it did when it was new" not in mechanic, student
        assert variant.measured * variant.speed < BATTERY / 2, student
        assert 0.4 < variant.measured / variant.parts.theoretical_kv < 2.2, (
            student
        )  # a radius for a diameter
        if variant.kind == "drivetrain":
            assert 0.4 < variant.speed < 3.5, (
                student
            )  # [m/s] as the log, or its wrong wheel, has it


GRIP = 1.2 * GRAVITY  # [m/s²] of good wheels on carpet
MOVED = ("exercise8", "exercise9")  # a mechanism of the learner's own, and its log


def check_log(log, mechanism, student):
    """A log is one that such a mechanism can leave, with wheels that grip and a real battery."""
    gains = mechanism.gains
    assert KS["least"] <= gains["kS"] <= KS["most"], student
    for run in log.runs:
        most = float(abs(run.voltage).max())
        assert most < BATTERY, student
        assert float(abs(run.velocity).max()) < BATTERY / gains["kV"], student
        if mechanism.name == "drivetrain" and run.test.startswith("dynamic"):
            assert (most - gains["kS"]) / gains["kA"] < GRIP, student


@pytest.mark.parametrize("name", MOVED)
def test_a_learners_own_log_is_one_that_a_robot_can_leave(name):
    for student, variant in drawn(name):
        check_log(variant.log, variant.mechanism, student)


def test_exercise_3_has_mechanisms_that_weigh_more_than_they_rub():
    for student, variant in drawn("exercise3"):
        for kind in ("elevator", "arm"):
            kg, ks = (variant.asked[f"{kind}_{gain}"].expected for gain in ("kG", "kS"))
            assert KS["least"] <= ks <= KS["most"], student
            assert ks < kg < BATTERY / 3, student


def test_exercise_6_has_machines_within_their_motors_and_their_grip():
    for student, variant in drawn("exercise6"):
        for machine in variant.machines.values():
            assert KS["least"] <= machine.ks <= KS["most"], student
            assert machine.limit <= machine.stall, student
            assert machine.kg < BATTERY / 3, student
            assert machine.travel is None or machine.travel > 0.0, student


def test_exercise_10_shows_gains_of_real_mechanisms():
    for student, variant in drawn("exercise10"):
        assert KS["least"] <= variant.shown["kS"] <= KS["most"], student
        assert variant.shown.get("kG", 0.0) < BATTERY / 3, student
        assert variant.shown["kV"] > 0.0, student
        assert variant.shown["kA"] > 0.0, student


@pytest.mark.parametrize("name", ANSWERED)
def test_the_authored_way_earns_full_marks_for_every_student(name, tmp_path):
    for student in students(name):
        solved = prepare_solved(find_exercise(name, ROOT), student, tmp_path / student)

        assert list(find_solution_flaws(solved)) == []
