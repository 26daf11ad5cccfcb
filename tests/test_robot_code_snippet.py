"""Gains as robot code, in WPILib's classes and inside motor controllers."""

import ast
import math
import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import tree_sitter_java
from hypothesis import given
from hypothesis import strategies as st
from tree_sitter import Language, Parser

import sim
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.cli import sysid
from sim.core.advice import Action
from sim.core.doubt import Doubt
from sim.core.errors import BadRequest
from sim.core.leave_out import LeftOutPart
from sim.core.units import UNITS
from sim.feedback import PRESETS
from sim.fit import Fit
from sim.physics.model import Part
from sim.report.robot_code_snippet import (
    CLASSES,
    ORDER,
    SEASONS,
    SPELLINGS,
    TARGETS,
    round_to_error,
    write_robot_code,
)
from sim.support.command_line import run_command

TYPES = tuple(ORDER)
UNIT = {"simple": "meters", "elevator": "meters", "arm": "radians"}
GAINS = {"kS": 0.16134, "kV": 2.523321, "kA": 0.190848}
ERRORS = {"kS": 0.0044, "kV": 0.0027, "kA": 0.0011}
GRAVITY = {"kG": 1.50177}
LANGUAGES = ("java", "python")
DT = 0.020  # [s] WPILib's default period

# WPILib's own order of arguments; a kG at another place is a robot that falls.
RIGHT_ORDER = {
    "simple": ["kS", "kV", "kA"],
    "elevator": ["kS", "kG", "kV", "kA"],
    "arm": ["kS", "kG", "kV", "kA"],
}


@pytest.mark.parametrize("target", TARGETS)
def test_code_of_each_target_names_effects_left_out_parts_and_moved_gains(target):
    fit = make_fit("simple", parts=(Part("drag", {"drag": 0.1}),))
    parts = [LeftOutPart("dynamic-forward", 5.5, 6.0)]
    code = write_robot_code(fit, target=target, radius=0.05, left_out=parts, moved=["kV"])

    mark = "#" if target == "python" else "//"
    for line in (
        "Effect in the model: drag",
        "Left out: dynamic-forward, 5.50 to 6.00 s",
        "Moved by hand, not measured: kV",
    ):
        assert f"\n{mark} {line}\n" in code


def test_refused_code_has_advice_that_each_surface_words():
    doubt = Doubt("model-strays", "It strays.", grave=True, action=Action("inspect-and-reconcile"))
    with pytest.raises(BadRequest) as refused:
        write_robot_code(make_fit("simple", doubts=(doubt,)), target="java")

    assert refused.value.what.endswith("It strays.")
    assert refused.value.action == doubt.action


def make_fit(type_, **changes):
    gains, errors = GAINS, ERRORS
    if type_ != "simple":
        gains, errors = gains | GRAVITY, errors | {"kG": 0.0076}
    if type_ == "arm":
        gains, errors = gains | {"offset_rad": -0.3728}, errors | {"offset_rad": 0.0066}
    fit = Fit(
        type=type_,
        method="output-error",
        units=UNIT[type_],
        log_units=UNIT[type_],
        gains=gains,
        errors=errors,
        acceleration_r2=0.9,
        acceleration_rmse=0.1,
        simulated_velocity_r2=0.9,
        simulated_velocity_rmse=0.1,
        samples_used={},
        position_delay=0.0,
        velocity_delay=0.0,
        velocity_threshold=0.0,
        step_duration=1.0,
    )
    return replace(fit, **changes)


def constants(text):
    """Every constant of a snippet, whichever language it is in, its arithmetic done."""
    known = {}
    for name, product in re.findall(r"(k\w+) = (-?\d+\.\d+(?: \* k\w+)?)(?=;|  )", text):
        number, _, factor = product.partition(" * ")
        known[name] = float(number) * known.get(factor, 1.0)
    return known


def java_nodes(text, kind):
    tree = Parser(Language(tree_sitter_java.language())).parse(text.encode())
    assert not tree.root_node.has_error, text
    waiting, nodes = [tree.root_node], []
    while waiting:
        node = waiting.pop()
        waiting.extend(node.children)
        if node.type == kind:
            nodes.append(node)
    return nodes


def run(text, wpimath=None):
    """The class that a Python snippet makes, with WPILib's classes or recording stand-ins."""
    if wpimath is not None:
        text = re.sub(r"^from \S+ import (\w+)$", "", text, flags=re.MULTILINE)
    space = dict(vars(wpimath)) if wpimath else {}
    exec(compile(text, "pasted.py", "exec"), space)  # noqa: S102 - the snippet under test
    return next(value for name, value in space.items() if name.endswith("Gains"))


def stand_ins():
    simple = (f"SimpleMotorFeedforward{ending}" for ending in ("Meters", "Radians"))
    return SimpleNamespace(**{name: lambda *gains: gains for name in (*CLASSES.values(), *simple)})


@pytest.mark.parametrize("season", SEASONS)
@pytest.mark.parametrize("type_", TYPES)
def test_a_java_snippet_parses_and_hands_the_gains_over_in_wpilibs_order(type_, season):
    text = write_robot_code(make_fit(type_), target="java", season=season, name="left drive")

    (made,) = java_nodes(text, "object_creation_expression")
    arguments = [
        node.text.decode() for node in made.child_by_field_name("arguments").named_children
    ]
    (imported,) = java_nodes(text, "import_declaration")
    (class_,) = java_nodes(text, "class_declaration")
    cls = made.child_by_field_name("type").text.decode()
    assert arguments == RIGHT_ORDER[type_]
    assert cls == CLASSES.get(type_, "SimpleMotorFeedforward")
    home = {2026: "edu.wpi.first", 2027: "org.wpilib"}[season]
    assert imported.text.decode() == f"import {home}.math.controller.{cls};"
    assert class_.child_by_field_name("name").text.decode() == "LeftDriveGains"


@pytest.mark.parametrize("season", SEASONS)
@pytest.mark.parametrize("type_", TYPES)
def test_a_python_snippet_runs_and_hands_the_gains_over_in_wpilibs_order(type_, season):
    text = write_robot_code(make_fit(type_), target="python", season=season)

    made = run(text, stand_ins())

    assert tuple(getattr(made, gain) for gain in RIGHT_ORDER[type_]) == made.FEEDFORWARD
    imported = next(node for node in ast.parse(text).body if isinstance(node, ast.ImportFrom))
    assert imported.module == {2026: "wpimath.controller", 2027: "wpimath"}[season]


@pytest.mark.parametrize(("language", "season"), SPELLINGS)
@pytest.mark.parametrize("type_", TYPES)
def test_the_numbers_come_back_within_a_tenth_of_their_errors(type_, language, season):
    fit = make_fit(type_)

    read = constants(write_robot_code(fit, target=language, season=season))
    for gain in RIGHT_ORDER[type_]:
        assert read[gain] == pytest.approx(fit.gains[gain], abs=0.1 * fit.errors[gain]), gain
    for loop, gains in fit.feedback().items():
        assert read[f"k{loop.capitalize()}P"] == pytest.approx(gains.kp, rel=5e-3)
        assert read.get(f"k{loop.capitalize()}D", 0.0) == pytest.approx(gains.kd, rel=5e-3)


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("units", ["rotations", "degrees"])
def test_an_arm_counted_in_turns_is_pasted_per_radian_and_says_so(units, language):
    fit = make_fit("arm")
    turned = fit.in_units(units)

    text = write_robot_code(turned, target=language)
    read, radians = constants(text), constants(write_robot_code(fit, target=language))

    for name in (*RIGHT_ORDER["arm"], "kAngleOffset"):
        assert read[name] == pytest.approx(radians[name], rel=1e-3), name
    factor = f"k{units.capitalize()}PerRadian"
    assert f"angle from horizontal [rad] = measured / {factor} + kAngleOffset" in text
    assert read[factor] == pytest.approx(1.0 / UNITS[units].si)
    # The same volts for the same error: what the table of the fit says per turn, per radian.
    volts = turned.feedback()["velocity"].kp / UNITS[units].si
    assert read["kVelocityP"] == pytest.approx(volts, rel=5e-3)


def discrete(type_, gains, *, now, then, angle=0.0):
    """Volts that bring v' = (V - kS·sgn v - gravity - kV·v)/kA from one velocity to the next."""
    decay = math.exp(-gains["kV"] / gains["kA"] * DT)
    gravity = {"simple": 0.0, "elevator": gains.get("kG", 0.0)}.get(
        type_, gains.get("kG", 0.0) * math.cos(angle)
    )
    moving = gains["kV"] * (then - decay * now) / (1.0 - decay)
    return gains["kS"] * math.copysign(1.0, now) + gravity + moving


@pytest.mark.robot
@pytest.mark.parametrize("type_", TYPES)
def test_the_object_that_robotpy_makes_calculates_our_formula(type_):
    pytest.importorskip("wpimath.controller", reason="RobotPy is not installed (extra `robot`)")
    fit = make_fit(type_)
    text = write_robot_code(fit, target="python", season=2026)
    made, gains = run(text), constants(text)
    place, angle = -0.4, -0.4 + gains.get("kAngleOffset", 0.0)
    first = (place + made.kAngleOffset,) if type_ == "arm" else ()
    steady = made.FEEDFORWARD.calculate(*first, 0.7)
    rising = made.FEEDFORWARD.calculate(*first, 0.7, 0.75)

    weight = {"simple": 0.0, "elevator": GRAVITY["kG"], "arm": GRAVITY["kG"] * math.cos(angle)}
    expected = gains["kS"] + gains["kV"] * 0.7 + weight[type_]
    assert steady == pytest.approx(expected, abs=1e-4)
    # An arm's gravity turns by 0.7·0.02 rad within the period, which only WPILib's solver follows.
    slack = GRAVITY["kG"] * 0.75 * DT if type_ == "arm" else 1e-9
    assert rising == pytest.approx(
        discrete(type_, gains, now=0.7, then=0.75, angle=angle), abs=slack
    )


@given(
    value=st.floats(-1e6, 1e6).filter(lambda value: abs(value) > 1e-12),
    error=st.floats(0.0, 1e6),
)
def test_a_rounded_number_is_code_in_both_languages_and_near_the_value(value, error):
    text = round_to_error(value, error)

    assert re.fullmatch(r"-?\d+\.\d+", text)
    assert float(text) == pytest.approx(value, abs=0.05 * error + 6e-5 * abs(value))


GRAVE = Doubt("negative-gain", "kG = -1 is negative: is forward up in this log?", grave=True)


@pytest.mark.parametrize(
    ("changes", "asked"),
    [
        ({}, {"target": "c++"}),
        ({}, {"season": 2025}),
        ({}, {"name": "2 arms"}),
        ({"doubts": (GRAVE,)}, {}),
        ({"gains": GAINS | {"kV": -2.5}}, {}),
        ({"gains": GAINS | {"kA": -0.1}}, {}),
        ({"gains": GAINS | {"kS": math.nan}}, {}),
    ],
)
def test_snippet_that_cannot_be_pasted_is_refused_in_one_line(changes, asked):
    with pytest.raises(BadRequest) as refused:
        write_robot_code(make_fit("simple", **changes), **({"target": "java"} | asked))

    assert refused.value.advice
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_loop_without_gains_says_so_and_has_no_constant(language):
    # A light intake's gains: with a period of delay the regulator's kP comes out negative.
    light = {"kS": 0.46, "kV": 0.0498, "kA": 0.001525}
    slow = make_fit("simple", units="radians", gains=light, position_delay=DT)
    late = write_robot_code(slow, target=language)
    none = write_robot_code(make_fit("simple", gains=GAINS | {"kA": 0.0}), target=language)

    assert "No gains for the position loop" in late
    assert "kPositionP" not in late
    assert "kVelocityP" in late
    assert "No gains for the velocity loop" in none
    assert "kVelocityP" not in none


RADIUS = 0.0508  # [m]
TURN = 2.0 * math.pi  # [rad]
WHEEL = TURN * RADIUS  # [m/rot]

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
    return make_fit(type_, units=units, log_units=units, **changes)


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


def round_gain(gain):
    return float(round_to_error((GAINS | GRAVITY)[gain], (ERRORS | {"kG": 0.0076})[gain]))


@pytest.mark.parametrize(("type_", "units", "per"), PER_ROTATION)
def test_phoenix_6_gets_volts_per_mechanism_rotation(type_, units, per):
    text = write_robot_code(fit_in(type_, units), target="phoenix6", radius=RADIUS)
    given, known = calls(text), values(text)

    assert known[given["withKS"][0]] == pytest.approx(round_gain("kS"), rel=1e-5)
    for method, gain in (("withKV", "kV"), ("withKA", "kA")):
        assert known[given[method][0]] / per == pytest.approx(round_gain(gain), rel=1e-5)
    assert given["withStaticFeedforwardSign"] == ["StaticFeedforwardSignValue.UseVelocitySign"]
    gravity = {"elevator": "Elevator_Static", "arm": "Arm_Cosine"}.get(type_)
    assert given.get("withGravityType") == ([f"GravityTypeValue.{gravity}"] if gravity else None)
    if gravity:
        assert known[given["withKG"][0]] == pytest.approx(round_gain("kG"), rel=1e-5)


@pytest.mark.parametrize(("type_", "units", "per"), PER_ROTATION)
def test_revlib_gets_volts_per_unit_of_the_log_and_an_arm_its_ratio(type_, units, per):
    text = write_robot_code(fit_in(type_, units), target="revlib")
    given, known = calls(text), values(text)

    for gain in ("kS", "kV", "kA"):
        assert known[given[gain][0]] == pytest.approx(round_gain(gain), rel=1e-5)
    assert ("kG" in given) == (type_ == "elevator")
    assert ("kCos" in given) == ("kCosRatio" in given) == (type_ == "arm")
    if type_ == "arm":
        assert known[given["kCos"][0]] == pytest.approx(round_gain("kG"), rel=1e-5)
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

    assert ks == pytest.approx(round_gain("kS"), rel=1e-5)
    assert (kv / per, ka / per) == pytest.approx((round_gain("kV"), round_gain("kA")), rel=1e-5)
    assert "replaceSwerveModuleFeedforward(FEEDFORWARD)" in text


def test_kp_is_sysids_converted_to_the_units_of_the_target():
    fit = fit_in("simple", "meters")
    phoenix = values(write_robot_code(fit, target="phoenix6", radius=RADIUS))
    spark = values(write_robot_code(fit, target="revlib"))
    per_minute = fit.feedback(PRESETS["rev-brushless"])["velocity"].kp

    assert phoenix["kP"] == pytest.approx(
        WHEEL * fit.feedback(PRESETS["ctre-phoenix6"])["velocity"].kp, rel=0.005
    )
    assert spark["kP"] == pytest.approx(60.0 * per_minute, rel=0.005)


def test_the_code_for_an_arm_of_phoenix_6_says_what_its_sensor_reads_when_level():
    known = values(write_robot_code(fit_in("arm", "radians"), target="phoenix6"))

    assert known["kLevelReading"] == pytest.approx(0.3728 / TURN, abs=1e-4)


@pytest.mark.parametrize(
    ("type_", "target", "changes", "said"),
    [
        ("simple", "phoenix6", {}, "only with a radius"),
        ("elevator", "yagsl", {}, "an elevator for YAGSL"),
        ("simple", "talonsrx", {}, "unknown target 'talonsrx'"),
        ("simple", "revlib", {"gains": GAINS | {"kV": -2.5}}, "no code is written for kV"),
        (
            "simple",
            "revlib",
            {"doubts": (Doubt("x", "It is wrong.", grave=True),)},
            "no code is written",
        ),
    ],
)
def test_gains_that_no_controller_should_get_are_refused(type_, target, changes, said):
    with pytest.raises(BadRequest, match=re.escape(said)) as refused:
        write_robot_code(fit_in(type_, "meters", **changes), target=target)

    assert refused.value.advice


@pytest.mark.parametrize("target", sorted({*TARGETS} - {"python"}))
def test_the_command_prints_robot_code(target, tmp_path, capsys):
    path = tmp_path / "drive.csv"
    routine = Routine(ramp=0.5, step=3.5, timeout=3.0)
    sim.write(simulate(sim.MECHANISMS["drivetrain"], routine, rng=np.random.default_rng(2)), path)
    arguments = ["fit", str(path), "--paste", target, "--radius", str(RADIUS)]

    assert run_command(sysid, name="sysid", arguments=arguments) == 0

    said = capsys.readouterr().out
    assert said.count("public final class") == 1
    per = WHEEL if TARGETS[target].units["simple"] == "rotations" else 1.0
    assert values(said)["kV"] / per == pytest.approx(2.524, rel=0.01)
