"""Exercise 13: a swerve drive of one's own, from its logs to the settings of a planner."""

import csv
import math
import tomllib

import pytest
from answer_grades import grade_answer
from places import ROOT

from grader.exercise.exercise import Exercise
from sim.bench.slip import compute_slip_voltage
from sim.fit import fit
from sim.inspect.detect_faults import inspect
from sim.io import list_entries, read, read_motors
from sim.support.student_names import make_folder_name

OWN = Exercise("exercise13", ROOT / "exercises" / "exercise13")
CLASS = [f"student {number}" for number in range(50)]
GYRO = {
    "voltage": "Phoenix6/TalonFX-1/MotorVoltage",
    "position": "Phoenix6/Pigeon2-1/Yaw",
    "velocity": "Phoenix6/Pigeon2-1/AngularVelocityZWorld",
}
TWO = CLASS[:2]


def data_of(exercise, student):
    exercise.prepare(student, say=lambda _: None)
    return exercise.folder / "data" / make_folder_name(student)


def test_class_as_a_whole_draws_every_motor_and_every_worn_module():
    variants = [OWN.module.draw(student) for student in CLASS]

    assert {one.motor for one in variants} == {"krakenX60", "falcon500", "neoVortex"}
    assert len({one.worn for one in variants}) == 4
    assert len({one.ratio for one in variants}) >= 5


def test_a_drive_is_one_that_a_team_can_have():
    for student in CLASS:
        variant = OWN.module.draw(student)
        drive = variant.drive
        plate = variant.mass * variant.trackwidth**2 / 6.0  # an even plate within the wheels

        assert 0.02 < drive.wheel_mass / drive.mass < 0.10, student
        assert 1.2 * plate < variant.inertia < 3.0 * plate, student
        assert 40.0 < drive.slip_current < 120.0, (
            student
        )  # the limit of Phoenix 6 is not in the way
        assert 0.7 < variant.step / compute_slip_voltage(drive.translation) < 0.81, student
        assert variant.step < compute_slip_voltage(drive.rotation), student


@pytest.mark.parametrize("student", TWO)
def test_the_logs_are_sound_and_what_they_say_to_be(copy, student):
    data, variant = data_of(copy, student), OWN.module.draw(student)

    modules = read_motors(data / "straight.wpilog")
    turning = read(data / "turning.wpilog", entries=GYRO)

    assert set(modules) == {"front-left", "front-right", "back-left", "back-right"}
    for log in (*modules.values(), turning):
        assert inspect(log).is_clean
        assert len(log.runs) == 4
    assert turning.units == "degrees"
    names = {entry.name for entry in list_entries(data / "turning.wpilog")}
    assert names >= {*GYRO.values(), "Rotational_Rate", "SysIdRotation_State"}
    with (data / "push.csv").open(encoding="utf-8", newline="") as lines:
        rows = list(csv.DictReader(lines))
    assert max(float(row["stator_current"]) for row in rows) == pytest.approx(
        variant.drive.slip_current, rel=0.05
    )


@pytest.mark.parametrize("student", TWO)
def test_gains_of_the_wrong_log_are_named(copy, student):
    turning = read(data_of(copy, student) / "turning.wpilog", entries=GYRO)
    ks = fit(turning).in_units("radians").gains["kS"]

    graded = grade_answer(copy, f"kS = {ks:.5g}", student=student)["ks"]

    assert "is this the kS of turning on the spot" in graded.hint


@pytest.mark.parametrize("student", TWO)
def test_the_radius_of_each_wheel_follows_from_the_spin(copy, student):
    data, variant = data_of(copy, student), OWN.module.draw(student)
    given = tomllib.loads((data / "given.toml").read_text("utf-8"))
    angle = math.radians(given["spin"]["gyro"])
    for module, turns in given["spin"]["motor_turns"].items():
        way = angle * given["robot"]["trackwidth"] / math.sqrt(2.0)
        radius = way / (2.0 * math.pi * turns / given["robot"]["ratio"])
        real = variant.worn_radius if module == variant.worn else variant.radius

        assert radius == pytest.approx(real, rel=3e-3), module


@pytest.mark.parametrize("word", ["rad/s", "Radians per second", "radians_per_second"])
def test_the_unit_of_a_rate_may_be_written_in_many_ways(copy, word):
    assert grade_answer(copy, rate_unit=word)["rate-unit"].status == "passed"


@pytest.mark.parametrize("student", CLASS[:12])
def test_a_missing_mass_and_the_share_of_a_planner_are_named(copy, student):
    variant = OWN.module.draw(student)
    right = {name: one.expected for name, one in variant.asked.items()}
    free = variant.drive.motor.free_speed * variant.radius / variant.ratio
    cases = (
        ("inertia", right["inertia"] / variant.mass, "is the mass missing?"),
        ("inertia", right["inertia"] * math.pi / 180.0, "Is your kA of turning per degree?"),
        ("top_speed", 0.85 * right["top_speed"], "is this 85 % of"),
        ("top_speed", 0.85 * free, "is this 85 % of"),
    )
    for name, value, says in cases:
        found = grade_answer(copy, student=student, **{name: f"{value:.5g}"})

        assert says in found[name.replace("_", "-")].hint, (name, value)
