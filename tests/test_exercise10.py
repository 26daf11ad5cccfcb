"""Exercise 10: gains written down in many ways, and what goes wrong on their way to the robot."""

import math
import re
import tomllib

import pytest
from gain_styles import BODY, IMPORTS, PYTHON_BODY, PYTHON_STYLES, STYLES
from places import ROOT

from grader.exercise.exercise import Exercise
from grader.robotcode.running import run_gains

OWN = Exercise("exercise10", ROOT / "exercises" / "exercise10")
CLASS = [f"student {number}" for number in range(50)]
JAVA, PYTHON = "ExampleMechanism.java", "example_mechanism.py"
KINDS = ("arm", "drivetrain", "elevator", "shooter", "turret")
BOTH = ("Slot0Configs", "FeedForwardConfig")
C = "CharacterizationConstants."
SI = {"Meters": 1, "Feet": 0.3048, "Inches": 0.0254, "Radians": 1, "Degrees": math.pi / 180}
SI["Rotations"] = 2 * math.pi


def of(**wanted):
    """A student whose variant has these properties."""
    return next(
        name
        for name in CLASS
        if all(getattr(OWN.module.draw(name), key) == value for key, value in wanted.items())
    )


@pytest.fixture
def checked(tmp_path):
    """Grades a text: check id -> result."""

    def grade(text, *, student, name=JAVA):
        path = tmp_path / name
        path.write_text(text, "utf-8")
        return {one.id: one for one in OWN.grade(path, student=student).checks}

    return grade


def lacking(found):
    return {one.id: (one.seen, one.hint) for one in found.values() if one.status != "passed"}


def test_fifty_students_get_every_kind_of_gain_and_each_gets_a_conversion():
    variants = [OWN.module.draw(student) for student in CLASS]

    assert {one.kind for one in variants} == {*KINDS}
    assert {one.duty for one in variants} == {True, False}
    assert len({tuple(one.shown.values()) for one in variants}) == 50
    for one in variants:
        assert one.shown_in != one.used_in
        assert abs(math.log(one.times)) > math.log(3)  # far outside every band
        assert ("kG" in one.shown) is (one.analysis != "Simple")
        assert one.analysis != "Arm" or one.used_in == "Radians"  # ArmFeedforward takes no other


def needed(given, place=""):
    """The gains a place needs, worked out from what a learner is told, by its words."""
    shown, robot, inside = (given[name] for name in ("analyzer", "robot", "motor_controller"))
    slot0 = place == "Slot0Configs"
    size = 2 * math.pi * inside.get("radius", 1.0) if slot0 else SI[robot["units"]]
    gains = {name: shown[name] for name in ("kS", "kG") if name in shown}
    times = size / SI[shown["units"]]
    gains |= {name: shown[name] * times for name in ("kV", "kA", "kP")}
    duty = robot["loop_output"] == "duty cycle" if not place else not slot0
    return gains | {"kP": gains["kP"] / (12 if duty else 1)}


def hold(gains, student, place="", language="java"):
    """The class with the constants."""
    symbol = "rot" if place == "Slot0Configs" else OWN.module.draw(student).symbol(used=True)
    said = {"kV": f"V·s/{symbol}", "kA": f"V·s²/{symbol}", "kP": "a first guess"}
    rows = [(name, f"{value:.6g}", said.get(name, "V")) for name, value in gains.items()]
    if language == "python":
        return f"class {C[:-1]}:\n" + "".join(f"    {n} = {v}  # {u}\n" for n, v, u in rows)
    lines = "".join(f"    static final double {n} = {v}; // {u}\n" for n, v, u in rows)
    return f"  static class {C[:-1]} {{\n{lines}  }}\n"


def written(student, *, language="java"):
    """A plain answer made of plain numbers."""
    variant = OWN.module.draw(student)
    gains = needed(tomllib.loads(OWN.module.describe(variant)))
    handed = ", ".join(f"{C}{name}" for name in gains if name != "kP")
    held = hold(gains, student, language=language)
    if language == "python":
        made = variant.made.replace("SimpleMotorFeedforward", "SimpleMotorFeedforwardRadians")
        return f"from wpimath.controller import {made}\n\n{held}\nff = {made}({handed})\n"
    made = f"  {variant.made} ff = new {variant.made}({handed});\n"
    return f"{IMPORTS}class A {{\n{held}{made}}}\n"


def in_place(student, place, *, language="java", swap=None, kp=1.0, without=(), **scales):
    """An answer with the gains inside a motor controller, worked out from what a learner reads.

    Args:
        student: whose numbers.
        place: ``Slot0Configs`` or ``FeedForwardConfig``.
        language: ``java`` or ``python``.
        swap: setting -> setting that gets its number.
        kp: by what kP is wrong.
        without: settings that are left out.
        scales: gain -> by what it is wrong.
    """
    given = tomllib.loads(OWN.module.describe(OWN.module.draw(student)))
    gains = needed(given, place)
    gains = {name: value * (scales | {"kP": kp}).get(name, 1.0) for name, value in gains.items()}
    python, arm = language == "python", given["analyzer"]["analysis"] == "Arm"
    held = hold(gains, student, place, language)
    calls = {name: C + (swap or {}).get(name, name) for name in gains}
    feedback = calls["kP"]
    if place == "Slot0Configs":
        calls = {
            f"with_k_{n[1].lower()}" if python else f"withK{n[1]}": s for n, s in calls.items()
        }
        gravity = "Arm_Cosine" if arm else "Elevator_Static"
        calls["with_gravity_type" if python else "withGravityType"] = "GravityTypeValue." + (
            gravity.upper() if python else gravity
        )
    else:
        del calls["kP"]
        calls = {("kCos" if arm and name == "kG" else name): s for name, s in calls.items()}
        if arm:
            calls["kCosRatio"] = f"{SI[given['robot']['units']] / (2 * math.pi)}"
    chain = "".join(f".{name}({value})" for name, value in calls.items() if name not in without)
    if python:
        slot0 = f"configured = {place}(){chain}\n"
        spark = f"config = SparkMaxConfig()\nconfig.closedLoop.p({feedback})\n"
        spark += f"config.closedLoop.feedForward{chain}\n"
        brought = "from phoenix6.configs import Slot0Configs\nfrom rev import SparkMaxConfig\n"
        brought += "from phoenix6.signals import GravityTypeValue\n"
        return f"{brought}\n{held}\n{slot0 if place == 'Slot0Configs' else spark}"
    spark = (
        f"  A() {{ config.closedLoop.p({feedback}); }}\n" if place == "FeedForwardConfig" else ""
    )
    config = "  SparkMaxConfig config = new SparkMaxConfig();\n" if spark else ""
    made = f"  {place} gains = new {place}(){chain};\n"
    return f"{IMPORTS}class A {{\n{held}{config}{made}{spark}}}\n"


@pytest.mark.parametrize("place", ["", *BOTH])
@pytest.mark.parametrize("language", ["java", "python"])
def test_a_class_can_solve_exercise_10_from_its_given_numbers(checked, language, place):
    every = [of(kind=kind, duty=duty) for duty in (False, True) for kind in KINDS]
    for student in every if language == "java" else every[::3]:
        text = written(student, language=language)
        if place:
            text = in_place(student, place, language=language)
        found = checked(text, student=student, name=JAVA if language == "java" else PYTHON)

        assert (student, lacking(found)) == (student, {})
        assert sum(one.points for one in found.values()) == 11


FEEDBACK = "class A { Object f = new FeedbackConfigs().with"


@pytest.mark.parametrize(
    ("kind", "place", "old", "new", "seen"),
    [
        ("arm", BOTH[0], ".withGravityType(GravityTypeValue.Arm_Cosine)", "", "Elevator_Static"),
        ("arm", BOTH[0], "Arm_Cosine", "Elevator_Static", "Elevator_Static"),
        ("elevator", BOTH[0], "Elevator_Static", "Arm_Cosine", "Arm_Cosine"),
        (
            "turret",
            BOTH[0],
            ".withGravityType(GravityTypeValue.Elevator_Static)",
            ".withStaticFeedforwardSign(StaticFeedforwardSignValue.UseClosedLoopSign)",
            "UseClosedLoopSign",
        ),
        ("turret", BOTH[0], "class A {", f"{FEEDBACK}SensorToMechanismRatio(1.0);", "Ratio = 1"),
        ("turret", BOTH[0], "class A {", f"{FEEDBACK}RotorToSensorRatio(RATIO);", "RotorToSensor"),
        ("arm", BOTH[1], "kCos(", "kG(", "has kG"),
        ("arm", BOTH[1], ".kCosRatio(0.15915494309189535)", "", "no kCosRatio"),
        ("arm", BOTH[1], "0.15915494309189535", "1.0", "kCosRatio = 1"),
        ("elevator", BOTH[1], ".kG(", ".kCos(", "has kCos"),
    ],
)
def test_a_wrong_gravity_ratio_or_sign_setting_is_named(  # noqa: PLR0917 - a row of the table
    checked, kind, place, old, new, seen, reads
):
    student = of(kind=kind)
    text = in_place(student, place)
    assert old in text
    new = new.replace("RATIO", str(OWN.module.draw(student).ratio))
    found = checked(text.replace(old, new), student=student)["feedforward"]

    assert found.status == "failed"
    assert seen in found.seen
    reads(f"got {found.seen}\ntry {found.hint}")


@pytest.mark.parametrize("kind", KINDS)
def test_a_gear_ratio_in_the_code_is_accepted(checked, kind):
    student = of(kind=kind)
    ratio = OWN.module.draw(student).ratio
    head = f"{FEEDBACK}SensorToMechanismRatio({ratio});"
    text = in_place(student, "Slot0Configs").replace("class A {", head)

    assert lacking(checked(text, student=student)) == {}


@pytest.mark.parametrize("place", BOTH)
@pytest.mark.parametrize("kind", KINDS)
def test_motion_under_the_motor_controller_is_simulated(tmp_path, kind, place):
    student = of(kind=kind)
    path = tmp_path / JAVA

    def consequence(**wrong):
        path.write_text(in_place(student, place, **wrong), "utf-8")
        return OWN.module.consequence(OWN.module.read(path, student=student))

    assert consequence() is None
    assert "slow" in consequence(kV=0.9).words or "does about" in consequence(kV=0.9).words


@pytest.mark.parametrize("place", BOTH)
@pytest.mark.parametrize("kind", ["elevator", "shooter"])
def test_the_loop_in_the_motor_controller_has_an_output_of_its_own(checked, kind, place):
    student = of(kind=kind)
    wrong = 1 / 12 if place == "Slot0Configs" else 12.0
    found = checked(in_place(student, place, kp=wrong), student=student)["kp"]

    assert (found.status, found.points) == ("failed", 0.5)
    assert found.misconception == "M-DUTY"


@pytest.mark.parametrize("kind", ["drivetrain", "elevator"])
def test_a_kp_per_meter_in_the_motor_controller_is_named(checked, kind):
    student = of(kind=kind)
    inside = OWN.module.draw(student).convert_for_class("Slot0Configs")
    wrong = inside.get_factor_to("Meters") / inside.times
    found = checked(in_place(student, "Slot0Configs", kp=wrong), student=student)["kp"]

    assert "is this value per m? Slot0Configs counts rotations" in found.hint
    assert (found.status, found.misconception) == ("failed", "M-UNITS")


@pytest.mark.parametrize(("factor", "code"), [("/ 0.0254", "M-UNITS"), ("/ 0.3048 * 12", "M-DUTY")])
def test_feet_that_are_taken_for_inches_are_told_from_a_duty_cycle(checked, factor, code):
    student = of(shown_in="Feet", used_in="Meters")
    shown = OWN.module.draw(student).shown["kV"]
    holder = f"static class CharacterizationConstants {{ static double kV = {shown} {factor}; }}"
    found = checked(f"class A {{ {holder} }}", student=student)["kv"]

    assert (found.status, found.misconception) == ("failed", code)


def test_a_number_that_is_copied_wrong_and_converted_where_it_is_used_is_in_its_order(checked):
    student = of(kind="arm", shown_in="Degrees", used_in="Radians")
    shown = OWN.module.draw(student).shown | {}
    gains = shown | {"kV": shown["kA"]}
    held = "".join(f"static final double {name} = {value}; " for name, value in gains.items())
    made = "new ArmFeedforward(C.kS, C.kG, C.kV * 180 / Math.PI, C.kA * 180 / Math.PI)"
    holder = f"static class CharacterizationConstants {{ {held} }}"
    text = f"class A {{ {holder} final Object f = {made}; }}"
    found = checked(text.replace("C.k", "CharacterizationConstants.k"), student=student)

    assert found["order"].status == "passed"
    assert "is that the analyzer's kA" in found["kv"].hint


LATER = "config.Slot0.kV = 3;"
TALON = "TalonFXConfiguration config = new TalonFXConfiguration(); "
SPARK = "SparkMaxConfig config = new SparkMaxConfig(); "
CONTROLLER = "config.closedLoop.feedForward"


@pytest.mark.parametrize(
    ("body", "wanted"),
    [
        (f"{TALON}config.Slot0.kV = 2; config.Slot0.kS = 1;", {"kS": 1.0, "kV": 2.0}),
        ("var s = new Slot0Configs(); s.kV = 2; s.withKS(1);", {"kS": 1.0, "kV": 2.0}),
        (f"{TALON}config.Slot0.withKV(2).withKA(3);", {"kV": 2.0, "kA": 3.0}),
        ("var s = new Slot1Configs().withKV(2);", {}),
        (
            f"{TALON}config.Slot0.kV = 2; new TalonFX(1).getConfigurator().apply(config); {LATER}",
            {"kV": 2.0},  # what is used is what was applied
        ),
        (f"{SPARK}{CONTROLLER}.sv(1, 2);", {"kS": 1.0, "kV": 2.0}),
        (
            "FeedForwardConfig f = new FeedForwardConfig(); f.svacr(1, 2, 3, 4, 5);",
            {"kS": 1.0, "kV": 2.0, "kA": 3.0, "kCos": 4.0, "kCosRatio": 5.0},
        ),
        (f"{SPARK}{CONTROLLER}.kV(2, ClosedLoopSlot.kSlot0);", {"kV": 2.0}),
        (f"{SPARK}{CONTROLLER}.kV(2, ClosedLoopSlot.kSlot1);", {}),
        ("var f = new SimpleMotorFeedforward(1, 5); f.setKv(2);", {"kS": 1.0, "kV": 2.0}),
    ],
)
def test_feedforward_is_judged_by_the_object_that_the_program_made(tmp_path, body, wanted):
    (tmp_path / JAVA).write_text(f"{IMPORTS}class A {{ A() {{ {body} }} }}\n", "utf-8")
    (facts,) = run_gains(tmp_path / JAVA)
    found = [{k: v for k, v in one.gains.items() if v} for one in facts.feedforwards]

    assert facts.errors == ()
    assert found == ([wanted] if wanted else [])


@pytest.fixture
def turret():
    """One learner's numbers: a turret, shown in rotations, coded in radians, with volts."""
    student = of(kind="turret", shown_in="Rotations", duty=False)
    return student, OWN.module.draw(student).shown


@pytest.mark.parametrize("style", STYLES)
def test_java_may_have_many_styles(checked, turret, style):
    student, shown = turret
    body = BODY
    for old, new in STYLES[style]:
        keep = "K_S" if style == "other names" else ""
        assert old in body
        pattern = rf"(?<![{{\w]){old}\b" if keep else re.escape(old)
        body = re.sub(pattern, lambda _, new=new: new, body)
    text = f"{IMPORTS}class A {{\n{body.format(**shown)}}}\n"

    assert lacking(checked(text, student=student)) == {}


@pytest.mark.parametrize("style", PYTHON_STYLES)
def test_python_may_have_many_styles(checked, turret, style):
    student, shown = turret
    body = PYTHON_BODY
    for old, new in PYTHON_STYLES[style]:
        assert old in body
        body = body.replace(old, new)
    found = checked(body.format(**shown), student=student, name=PYTHON)

    assert [*lacking(found)] == (["named"] if style == "a module's names" else [])


def test_constants_may_stand_in_a_file_of_their_own(tmp_path, turret):
    student, shown = turret
    head, _, tail = BODY.format(**shown).partition("  SimpleMotorFeedforward ff")
    (tmp_path / "Constants.java").write_text(f"class Constants {{\n{head}}}\n", "utf-8")
    path = tmp_path / JAVA
    tail = tail.replace("CharacterizationConstants", "Constants.CharacterizationConstants")
    path.write_text(f"{IMPORTS}class A {{\n  SimpleMotorFeedforward ff{tail}}}\n", "utf-8")
    grade = OWN.grade(path, student=student)

    assert (grade.score, grade.max_score) == (11, 11)


@pytest.mark.parametrize(
    ("settings", "double"),
    [
        (".withKP(CharacterizationConstants.kP)", ""),  # feedback alone is no second feedforward
        (".withKS(0).withKV(0).withKP(CharacterizationConstants.kP)", ""),
        (".withKS(CharacterizationConstants.kS)", "kS twice"),
        (".withKS(0.11).withKV(CharacterizationConstants.kV)", "kS, kV twice"),
    ],
)
def test_a_gain_in_the_code_and_in_the_motor_controller_is_a_double_feedforward(
    checked, settings, double
):
    field = f"  Slot0Configs slot0 = new Slot0Configs(){settings};\n}}\n"
    found = checked(written("ann").removesuffix("}\n") + field, student="ann")["feedforward"]

    assert (found.status == "failed") == bool(double)
    assert double in found.seen
    assert ("This is a double feedforward" in found.hint) == bool(double)


PID = "Constants.kA);\n  PIDController pid = new PIDController("


@pytest.mark.parametrize(
    ("old", "new", "check", "points", "code"),
    [
        ("{kV} / (2 * Math.PI)", "-{kV}", "kv", 0, ""),
        ("{kV} / (2 * Math.PI)", "{kV} / (2 * 3)", "kv", 0, ""),
        ("{kV} / (2 * Math.PI)", "{kV} * 60", "kv", 0, "M-UNITS"),
        ("{kV} / (2 * Math.PI)", "Elsewhere.kV", "kv", 0, ""),
        ("{kV} / (2 * Math.PI)", "Elsewhere.kV", "order", 0, ""),
        ("{kV} / (2 * Math.PI)", "{kV} / (1 / 0)", "feedforward", 0, ""),  # stops the robot
        (f"{C}kS,", "kick,", "feedforward", 0, ""),
        (", CharacterizationConstants.kA)", ")", "order", 1, ""),
        ("Constants.kA);\n", f"{PID}0.0, {C}kP, 0.0);\n", "kp", 0.5, "M-ARGORDER"),
        ("Constants.kA);\n", f"{PID}6.2832 * {C}kP, 0, 0);\n", "kp", 0.5, "M-UNITS"),
    ],
)  # fmt: skip
def test_wrong_code_of_exercise_10_fails_its_check(checked, turret, old, new, check, points, code):  # noqa: PLR0917 - a row of the table
    student, shown = turret
    assert old in BODY
    text = f"{IMPORTS}class A {{\n{BODY.replace(old, new).format(**shown)}}}\n"
    found = checked(text, student=student)[check]

    assert (found.status, found.points, found.misconception) == ("failed", points, code)
