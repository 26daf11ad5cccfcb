"""Java for gains inside a motor controller or a swerve library, parsed back to the fit's gains."""

import math
import re

import numpy as np
import pytest
from test_robot_code_snippet import ERRORS, GAINS, GRAVITY, found, java_nodes

import sim
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.cli import sysid
from sim.core.doubt import Doubt
from sim.core.errors import BadRequest
from sim.feedback import PRESETS
from sim.report.robot_code_snippet import TARGETS, round_to_error, write_robot_code
from sim.support.command_line import run_command

RADIUS = 0.0508  # [m]
TURN = 2.0 * math.pi  # [rad]
WHEEL = TURN * RADIUS  # [m/rot]
JAVA_TARGETS = [name for name, one in TARGETS.items() if one.language == "java"]

# type, unit of the log -> how many of that unit are one mechanism rotation, for a wheel of RADIUS
PER_ROTATION = [
    ("simple", "meters", WHEEL),
    ("simple", "feet", WHEEL / 0.3048),
    ("simple", "rotations", 1.0),
    ("simple", "radians", TURN),
    ("simple", "degrees", 360.0),
    ("elevator", "meters", WHEEL),
    ("arm", "radians", TURN),
    ("arm", "rotations", 1.0),
    ("arm", "degrees", 360.0),
]


def fit_in(type_, units, **changes):
    return found(type_, units=units, log_units=units, **changes)


def values(text):
    """Every constant of a Java class, its arithmetic done."""
    known = {"Math.PI": math.pi}
    for name, expression in re.findall(r"double (k\w+) = ([^;]+);", text):
        product = 1.0
        for factor in expression.split(" * "):
            product *= known[factor] if factor in known else float(factor)
        known[name] = product
    return known


def calls(text):
    """Method -> argument of the builder's chain, as the parser sees them."""
    made = {}
    for node in java_nodes(text, "method_invocation"):
        given = [one.text.decode() for one in node.child_by_field_name("arguments").named_children]
        made[node.child_by_field_name("name").text.decode()] = given
    return made


def rounded(gain):
    return float(round_to_error((GAINS | GRAVITY)[gain], (ERRORS | {"kG": 0.0076})[gain]))


@pytest.mark.parametrize(("type_", "units", "per"), PER_ROTATION)
def test_phoenix_6_gets_volts_per_mechanism_rotation(type_, units, per):
    text = write_robot_code(fit_in(type_, units), target="phoenix6", radius=RADIUS)
    given, known = calls(text), values(text)

    assert known[given["withKS"][0]] == pytest.approx(rounded("kS"), rel=1e-5)
    for method, gain in (("withKV", "kV"), ("withKA", "kA")):
        assert known[given[method][0]] / per == pytest.approx(rounded(gain), rel=1e-5)
    assert given["withStaticFeedforwardSign"] == ["StaticFeedforwardSignValue.UseVelocitySign"]
    gravity = {"elevator": "Elevator_Static", "arm": "Arm_Cosine"}.get(type_)
    assert given.get("withGravityType") == ([f"GravityTypeValue.{gravity}"] if gravity else None)
    if gravity:
        assert known[given["withKG"][0]] == pytest.approx(rounded("kG"), rel=1e-5)


@pytest.mark.parametrize(("type_", "units", "per"), PER_ROTATION)
def test_revlib_gets_volts_per_unit_of_the_log_and_an_arm_its_ratio(type_, units, per):
    text = write_robot_code(fit_in(type_, units), target="revlib")
    given, known = calls(text), values(text)

    for gain in ("kS", "kV", "kA"):
        assert known[given[gain][0]] == pytest.approx(rounded(gain), rel=1e-5)
    assert ("kG" in given) == (type_ == "elevator")
    assert ("kCos" in given) == ("kCosRatio" in given) == (type_ == "arm")
    if type_ == "arm":
        assert known[given["kCos"][0]] == pytest.approx(rounded("kG"), rel=1e-5)
        assert known[given["kCosRatio"][0]] * per == pytest.approx(1.0, rel=1e-5)


@pytest.mark.parametrize(
    ("units", "per"),
    [("meters", 1.0), ("feet", 1 / 0.3048), ("rotations", 1 / WHEEL), ("radians", 1 / RADIUS)],
)
def test_yagsl_gets_volts_per_meter_of_the_wheel(units, per):
    text = write_robot_code(fit_in("simple", units), target="yagsl", radius=RADIUS)
    (made,) = java_nodes(text, "object_creation_expression")
    given = [one.text.decode() for one in made.child_by_field_name("arguments").named_children]

    ks, kv, ka = (values(text)[name] for name in given)

    assert ks == pytest.approx(rounded("kS"), rel=1e-5)
    assert (kv / per, ka / per) == pytest.approx((rounded("kV"), rounded("kA")), rel=1e-5)
    assert "replaceSwerveModuleFeedforward(FEEDFORWARD)" in text


def test_kp_is_that_of_sysid_per_unit_and_second_of_the_target():
    fit = fit_in("simple", "meters")
    phoenix = values(write_robot_code(fit, target="phoenix6", radius=RADIUS))
    spark = values(write_robot_code(fit, target="revlib"))
    per_minute = fit.feedback(PRESETS["rev-brushless"])["velocity"].kp

    assert phoenix["kP"] == pytest.approx(
        WHEEL * fit.feedback(PRESETS["ctre-phoenix6"])["velocity"].kp, rel=0.005
    )
    assert spark["kP"] == pytest.approx(60.0 * per_minute, rel=0.005)


def test_an_arm_of_phoenix_6_is_told_what_its_sensor_reads_when_level():
    known = values(write_robot_code(fit_in("arm", "radians"), target="phoenix6"))

    assert known["kLevelReading"] == pytest.approx(0.3728 / TURN, abs=1e-4)


@pytest.mark.parametrize(
    ("type_", "target", "changes", "said"),
    [
        ("simple", "phoenix6", {}, "only with a radius"),
        ("elevator", "yagsl", {}, "an elevator for YAGSL"),
        ("simple", "talonsrx", {}, "unknown target 'talonsrx'"),
        ("simple", "revlib", {"gains": GAINS | {"kV": -2.5}}, "no code is printed for kV"),
        (
            "simple",
            "revlib",
            {"doubts": (Doubt("x", "It is wrong.", grave=True),)},
            "no code is printed",
        ),
    ],
)
def test_what_no_controller_should_get_is_refused(type_, target, changes, said):
    with pytest.raises(BadRequest, match=re.escape(said)) as refused:
        write_robot_code(fit_in(type_, "meters", **changes), target=target)

    assert refused.value.advice


@pytest.mark.parametrize("target", JAVA_TARGETS)
def test_the_command_writes_it(target, tmp_path, capsys):
    path = tmp_path / "drive.csv"
    routine = Routine(ramp=0.5, step=3.5, timeout=3.0)
    sim.write(simulate(sim.MECHANISMS["drivetrain"], routine, rng=np.random.default_rng(2)), path)
    arguments = ["fit", str(path), "--paste", target, "--radius", str(RADIUS)]

    assert run_command(sysid, name="sysid", arguments=arguments) == 0

    said = capsys.readouterr().out
    assert said.count("public final class") == 1
    per = WHEEL if TARGETS[target].units["simple"] == "rotations" else 1.0
    assert values(said)["kV"] / per == pytest.approx(2.524, rel=0.01)
