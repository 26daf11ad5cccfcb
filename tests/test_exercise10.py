"""Exercise 10: gains written down in many ways, and what goes wrong on their way to the robot."""

import importlib.util
import math
import re
import tomllib
from pathlib import Path

import pytest
from gain_styles import BODY, PYTHON_BODY, PYTHON_STYLES, STYLES

from grader.cli import run_command
from grader.exercise import Exercise
from grader.robotcode.gain_constants import find_gain_of_name, read_gains

ROOT = Path(__file__).resolve().parents[1]
OWN = Exercise("exercise10", ROOT / "exercises" / "exercise10")
CLASS = [f"student {number}" for number in range(50)]
JAVA, PYTHON = "ExampleMechanism.java", "example_mechanism.py"
KINDS = {"arm", "drivetrain", "elevator", "shooter", "turret"}


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


def test_fifty_students_get_every_kind_and_a_conversion_each():
    variants = [OWN.module.draw(student) for student in CLASS]

    assert {one.kind for one in variants} == KINDS
    assert {one.duty for one in variants} == {True, False}
    assert len({tuple(one.shown.values()) for one in variants}) == 50
    for one in variants:
        assert one.shown_in != one.used_in
        assert abs(math.log(one.times)) > math.log(3)  # far outside every band
        assert ("kG" in one.shown) is (one.analysis != "Simple")
        assert one.analysis != "Arm" or one.used_in == "Radians"  # ArmFeedforward takes no other


def test_a_student_gets_the_same_numbers_every_time_and_nobody_elses():
    first, again, other = (OWN.module.draw(name) for name in ("ann", "Ann", "ben"))

    assert first == again
    assert first != other


SI = {"Meters": 1, "Feet": 0.3048, "Inches": 0.0254, "Radians": 1, "Degrees": math.pi / 180}
SI["Rotations"] = 2 * math.pi


def needed(given):
    """The gains a robot needs, worked out from what a learner is told, by its words."""
    shown, robot = given["analyzer"], given["robot"]
    times = SI[robot["units"]] / SI[shown["units"]]
    gains = {name: shown[name] for name in ("kS", "kG") if name in shown}
    gains |= {name: shown[name] * times for name in ("kV", "kA", "kP")}
    if robot["loop_output"] == "duty cycle":
        gains["kP"] /= 12
    return gains


def written(student, *, language="java"):
    """A plain answer made of plain numbers."""
    variant = OWN.module.draw(student)
    given = tomllib.loads(OWN.module.told(variant))
    gains = needed(given)
    units = {name: variant.unit(name, used=True) for name in gains} | {"kP": "a start: tune it"}
    arguments = ", ".join(name for name in gains if name != "kP")
    if language == "python":
        rows = "".join(f"    {n} = {v:.4g}  # {units[n]}\n" for n, v in gains.items())
        handed = ", ".join(f"CharacterizationConstants.{n}" for n in gains if n != "kP")
        brought = f"from wpimath.controller import {variant.made}\n"
        held = f"class CharacterizationConstants:\n{rows}\n"
        return f"{brought}\n{held}\nff = {variant.made}({handed})\n"
    rows = "".join(
        f"    static final double {n} = {v:.4g}; // {units[n]}\n" for n, v in gains.items()
    )
    return (
        f"class A {{\n  static class CharacterizationConstants {{\n{rows}  }}\n"
        f"  {variant.made} ff = new {variant.made}({arguments});\n}}\n"
    ).replace(
        f"({arguments})", "(" + re.sub(r"(k\w)", r"CharacterizationConstants.\1", arguments) + ")"
    )


@pytest.mark.parametrize("language", ["java", "python"])
def test_fifty_students_can_solve_it_from_what_they_are_told(checked, language):
    name = JAVA if language == "java" else PYTHON
    for student in CLASS:
        found = checked(written(student, language=language), student=student, name=name)

        assert {one.id for one in found.values() if one.status != "passed"} == set()
        assert sum(one.points for one in found.values()) == 11


def in_place(student, place, *, language="java", swap=None, kp=1.0, lacking=(), **scales):
    """An answer with the gains inside a motor controller, worked out from what a learner reads.

    Args:
        student: whose numbers.
        place: ``Slot0Configs`` or ``FeedForwardConfig``.
        language: ``java`` or ``python``.
        swap: setting -> setting that gets its number.
        kp: by what kP is wrong.
        lacking: settings that are left out.
        scales: gain -> by what it is wrong.
    """
    given = tomllib.loads(OWN.module.told(OWN.module.draw(student)))
    shown, robot, inside = (given[name] for name in ("analyzer", "robot", "motor_controller"))
    size = SI[robot["units"]]
    if place == "Slot0Configs":
        size = 2 * math.pi * inside.get("radius", 1.0)
    times = size / SI[shown["units"]]
    symbol = "rot" if place == "Slot0Configs" else OWN.module.draw(student).symbol(used=True)
    units = {"kS": "V", "kG": "V", "kV": f"V·s/{symbol}", "kA": f"V·s²/{symbol}"}
    gains = {
        name: shown[name] * (times if name in {"kV", "kA"} else 1.0) * scales.get(name, 1.0)
        for name in units
        if name in shown
    }
    feedback = kp * shown["kP"] * times / (1 if place == "Slot0Configs" else 12)
    python, arm = language == "python", shown["analysis"] == "Arm"
    end, mark = ("", "#") if python else (";", "//")
    static = "" if python else "static final double "
    rows = "".join(
        f"    {static}{name} = {value:.6g}{end}  {mark} {units[name]}\n"
        for name, value in gains.items()
    )
    rows += f"    {static}kP = {feedback:.6g}{end}  {mark} a first guess\n"
    held = "CharacterizationConstants."
    sources = {name: held + (swap or {}).get(name, name) for name in gains}
    if place == "Slot0Configs":
        calls = {
            (f"with_k_{n[1].lower()}" if python else f"withK{n[1]}"): s for n, s in sources.items()
        }
        calls["with_k_p" if python else "withKP"] = f"{held}kP"
        calls["with_gravity_type" if python else "withGravityType"] = "GravityTypeValue." + (
            ("ARM_COSINE" if python else "Arm_Cosine")
            if arm
            else ("ELEVATOR_STATIC" if python else "Elevator_Static")
        )
    else:
        calls = {("kCos" if arm and name == "kG" else name): s for name, s in sources.items()}
        if arm:
            calls["kCosRatio"] = f"{size / (2 * math.pi)}"
    chain = "".join(f".{name}({value})" for name, value in calls.items() if name not in lacking)
    spark = f"    config.closedLoop.p({held}kP){end}\n" if place == "FeedForwardConfig" else ""
    slot0 = place == "Slot0Configs"
    if python:
        brought = "from phoenix6.configs import Slot0Configs\n"
        brought += "from phoenix6.signals import GravityTypeValue\n"
        if not slot0:
            brought = "from rev import SparkMaxConfig\n"
        maker = "" if slot0 else "config = SparkMaxConfig()\n"
        made = f"({place}(){chain})" if slot0 else f"config.closedLoop.feedForward{chain}"
        holder = f"class CharacterizationConstants:\n{rows}"
        return f"{brought}\n{holder}\n{maker}configured = {made}\n{spark.strip()}\n"
    imports = (
        "import com.ctre.phoenix6.configs.Slot0Configs;\n"
        "import com.ctre.phoenix6.signals.GravityTypeValue;\n"
    )
    if not slot0:
        imports = (
            "import com.revrobotics.spark.config.FeedForwardConfig;\n"
            "import com.revrobotics.spark.config.SparkMaxConfig;\n"
        )
    config = "" if slot0 else "  SparkMaxConfig config = new SparkMaxConfig();\n"
    body = "" if slot0 else f"  void configure() {{\n{spark}  }}\n"
    return (
        f"{imports}class A {{\n  static class CharacterizationConstants {{\n{rows}  }}\n{config}"
        f"  {place} gains = new {place}(){chain};\n{body}}}\n"
    )


BOTH = ("Slot0Configs", "FeedForwardConfig")


@pytest.mark.parametrize("place", BOTH)
@pytest.mark.parametrize("language", ["java", "python"])
def test_gains_inside_the_motor_controller_earn_everything_too(checked, language, place):
    name = JAVA if language == "java" else PYTHON
    for student in CLASS:
        found = checked(in_place(student, place, language=language), student=student, name=name)

        wrong = {one.id: (one.seen, one.hint) for one in found.values() if one.status != "passed"}
        assert (student, wrong) == (student, {})
        assert sum(one.points for one in found.values()) == 11


@pytest.mark.parametrize("kind", sorted(KINDS))
@pytest.mark.parametrize(
    "factor",
    [
        "rotor",
        "radians",
        "geared",
        "coded",
    ],
)
def test_another_rotation_than_the_mechanisms_is_named(checked, kind, factor, reads):
    student = of(kind=kind, used_in="Radians") if kind == "shooter" else of(kind=kind)
    variant = OWN.module.draw(student)
    inside = variant.held_by("Slot0Configs")
    factors = {
        "rotor": 1 / variant.ratio,
        "radians": 1 / (2 * math.pi),
        "geared": variant.ratio,
        "coded": variant.needed("kV") / inside.needed("kV"),
    }
    text = in_place(student, "Slot0Configs", kV=factors[factor])
    found = checked(text, student=student)
    # A constant in the unit of the code is right; where it goes, it is not.
    check = found["kv"] if found["kv"].status == "failed" else found["conversion"]

    assert check.status == "failed"
    assert check.misconception == ("M-GEARING" if factor in {"rotor", "geared"} else "M-UNITS")
    reads(f"got {check.seen}\ntry {check.hint}")


def test_the_diameter_in_place_of_the_radius_is_named(checked, reads):
    student = of(kind="elevator")
    found = checked(in_place(student, "Slot0Configs", kV=2.0), student=student)["kv"]

    reads(found.hint)


@pytest.mark.parametrize(
    ("kind", "place", "old", "new"),
    [
        ("arm", BOTH[0], ".withGravityType(GravityTypeValue.Arm_Cosine)", ""),
        ("arm", BOTH[0], "Arm_Cosine", "Elevator_Static"),
        ("elevator", BOTH[0], "Elevator_Static", "Arm_Cosine"),
        (
            "turret",
            BOTH[0],
            ".withGravityType(GravityTypeValue.Elevator_Static)",
            ".withStaticFeedforwardSign(StaticFeedforwardSignValue.UseClosedLoopSign)",
        ),
        (
            "turret",
            BOTH[0],
            "class A {",
            "class A { void feed() { config.Feedback.SensorToMechanismRatio = 1.0; }",
        ),
        ("arm", BOTH[1], "kCos(", "kG("),
        ("arm", BOTH[1], ".kCosRatio(0.15915494309189535)", ""),
        ("arm", BOTH[1], "0.15915494309189535", "1.0"),
        ("elevator", BOTH[1], ".kG(", ".kCos("),
    ],
)
def test_gravity_and_the_sign_of_ks_are_settings_too(checked, kind, place, old, new, reads):  # noqa: PLR0917 - a row of the table
    student = of(kind=kind)
    text = in_place(student, place)
    assert old in text
    found = checked(text.replace(old, new), student=student)["feedforward"]

    assert found.status == "failed"
    reads(f"got {found.seen}\ntry {found.hint}")


def test_the_ratio_itself_may_stand_in_the_code(checked):
    for kind in sorted(KINDS):
        student = of(kind=kind)
        ratio = OWN.module.draw(student).ratio
        text = in_place(student, "Slot0Configs").replace(
            "class A {",
            f"class A {{ Object f = new FeedbackConfigs().withSensorToMechanismRatio({ratio});",
        )
        text = f"import com.ctre.phoenix6.configs.FeedbackConfigs;\n{text}"

        assert all(one.status == "passed" for one in checked(text, student=student).values())


@pytest.mark.parametrize("place", BOTH)
@pytest.mark.parametrize("kind", sorted(KINDS))
def test_what_the_motor_controller_would_do_is_simulated(tmp_path, kind, place):
    student = of(kind=kind)
    path = tmp_path / JAVA

    def consequence(**wrong):
        path.write_text(in_place(student, place, **wrong), "utf-8")
        return OWN.module.consequence(OWN.module.read(path, student=student))

    assert consequence() is None
    assert "slow" in consequence(kV=0.9).words or "does about" in consequence(kV=0.9).words


def test_a_comment_with_the_unit_of_another_place_is_told(checked, reads):
    student = of(kind="elevator")
    text = in_place(student, "Slot0Configs")
    found = checked(text.replace("V·s/rot", "V·s/m"), student=student)["units"]

    assert found.misconception == "M-UNITS"
    reads(found.hint)


@pytest.mark.parametrize("place", BOTH)
@pytest.mark.parametrize("kind", ["elevator", "shooter"])
def test_the_loop_in_the_motor_controller_has_an_output_of_its_own(checked, kind, place):
    student = of(kind=kind)
    wrong = 1 / 12 if place == "Slot0Configs" else 12.0
    found = checked(in_place(student, place, kp=wrong), student=student)["kp"]

    assert (found.status, found.points) == ("failed", 0.5)
    assert found.misconception == "M-DUTY"


@pytest.mark.parametrize("place", BOTH)
def test_a_setting_with_the_wrong_gain_or_none_is_named(checked, place):
    student = of(kind="elevator")
    swapped = checked(in_place(student, place, swap={"kV": "kA", "kA": "kV"}), student=student)
    without = checked(in_place(student, place, lacking=("withKG", "kG")), student=student)

    assert f"kA is where {place} expects kV" in swapped["order"].hint
    assert swapped["order"].misconception == "M-ARGORDER"
    assert "has no kG" in without["order"].seen


@pytest.mark.parametrize(
    ("language", "body", "wanted"),
    [
        ("java", "config.Slot0.kV = C.kV; config.Slot0.kS = C.kS;", {"kS": 1.0, "kV": 2.0}),
        ("java", "var s = new Slot0Configs(); s.kV = C.kV; s.withKS(1);", {"kS": 1.0, "kV": 2.0}),
        ("java", "config.Slot0.withKV(C.kV).withKA(C.kA);", {"kV": 2.0, "kA": 3.0}),
        ("java", "var s = new Slot1Configs().withKV(C.kV);", {}),
        ("java", "config.closedLoop.feedForward.sv(C.kS, C.kV);", {"kS": 1.0, "kV": 2.0}),
        ("java", "f.svacr(C.kS, C.kV, C.kA, 4.0, 5.0);", {}),
        (
            "java",
            "FeedForwardConfig f = new FeedForwardConfig(); f.svacr(C.kS, C.kV, C.kA, 4.0, 5.0);",
            {"kS": 1.0, "kV": 2.0, "kA": 3.0, "kCos": 4.0, "kCosRatio": 5.0},
        ),
        ("java", "f.closedLoop.feedForward.kV(C.kV, ClosedLoopSlot.kSlot0);", {"kV": 2.0}),
        ("java", "f.closedLoop.feedForward.kV(C.kV, ClosedLoopSlot.kSlot1);", {}),
        ("python", "cfg.slot0.k_v = C.kV", {"kV": 2.0}),
        ("python", "cfg.slot0.with_k_v(C.kV).with_k_s(C.kS)", {"kV": 2.0, "kS": 1.0}),
        ("python", "cfg.closedLoop.feedForward.sv(C.kS, C.kV)", {"kV": 2.0, "kS": 1.0}),
        ("python", "C.kV = 7", {}),
    ],
)  # fmt: skip
def test_a_configuration_is_read_as_teams_write_it(tmp_path, language, body, wanted):
    name = JAVA if language == "java" else PYTHON
    text = (
        f"class A {{ static class C {{ static final double kS = 1, kV = 2, kA = 3; }}\n"
        f"  void configure() {{ {body} }} }}\n"
        if language == "java"
        else f"class C:\n    kS = 1\n    kV = 2\n    kA = 3\n\ndef configure(cfg):\n    {body}\n"
    )
    (tmp_path / name).write_text(text, "utf-8")
    found = read_gains(tmp_path / name).feedforwards

    assert [{k: a.value for k, a in one.arguments.items()} for one in found] == (
        [wanted] if wanted else []
    )


@pytest.fixture
def turret():
    """One learner's numbers: a turret, shown in rotations, coded in radians, with volts."""
    student = of(kind="turret", shown_in="Rotations", duty=False)
    return student, OWN.module.draw(student).shown


@pytest.mark.parametrize("style", STYLES)
def test_java_is_read_in_many_styles(checked, turret, style):
    student, shown = turret
    body = BODY
    for old, new in STYLES[style]:
        keep = "K_S" if style == "other names" else ""
        assert old in body
        pattern = rf"(?<![{{\w]){old}\b" if keep else re.escape(old)
        body = re.sub(pattern, lambda _, new=new: new, body)
    text = f"class A {{\n{body.format(**shown)}}}\n"
    found = checked(text, student=student)

    assert {one.id: (one.seen, one.hint) for one in found.values() if one.status != "passed"} == {}


@pytest.mark.parametrize("style", PYTHON_STYLES)
def test_python_is_read_in_many_styles(checked, turret, style):
    student, shown = turret
    body = PYTHON_BODY
    for old, new in PYTHON_STYLES[style]:
        assert old in body
        body = body.replace(old, new)
    found = checked(body.format(**shown), student=student, name=PYTHON)
    wrong = {one.id for one in found.values() if one.status != "passed"}

    assert wrong == ({"named"} if style == "a module's names" else set())


@pytest.mark.parametrize(
    ("made", "handed"),
    [
        (
            "CharacterizationConstants(kV=load())",
            "C.kS, C.kV, C.kA",
        ),
        ("CharacterizationConstants", "*gains"),
    ],
)
def test_what_reading_cannot_tell_is_asked(checked, turret, made, handed, reads):
    student, shown = turret
    body = PYTHON_BODY.replace("C = CharacterizationConstants", f"C = {made}")
    body = body.replace("C.kS, C.kV, C.kA", handed)
    found = checked(body.format(**shown), student=student, name=PYTHON)["conversion"]

    reads(found.seen)


def test_a_constant_that_is_made_of_itself_ends(tmp_path):
    path = tmp_path / JAVA
    rows = "double a = b + kT; double b = a + c; double c = a + b; double kV = a + b + c;"
    path.write_text(
        f"class A {{ {rows} Object f = new ArmFeedforward(a, b, c, a + b); }}\n", "utf-8"
    )

    assert read_gains(path).feedforwards[0].arguments["kS"].value is None


def test_constants_may_stand_in_a_file_of_their_own(tmp_path, turret):
    student, shown = turret
    head, _, tail = BODY.format(**shown).partition("  SimpleMotorFeedforward ff")
    (tmp_path / "Constants.java").write_text(f"class Constants {{\n{head}}}\n", "utf-8")
    path = tmp_path / JAVA
    tail = tail.replace("CharacterizationConstants", "Constants.CharacterizationConstants")
    path.write_text(f"class A {{\n  SimpleMotorFeedforward ff{tail}}}\n", "utf-8")
    grade = OWN.grade(path, student=student)

    assert (grade.score, grade.max_score) == (11, 11)


@pytest.mark.parametrize(
    ("old", "new", "check", "points", "code"),
    [
        ("{kV} / (2 * Math.PI)", "{kV}", "conversion", 1, "M-UNITS"),
        (
            "{kV} / (2 * Math.PI)",
            "{kV} * 2 * Math.PI",
            "kv",
            0,
            "M-UNITS",
        ),
        ("{kV} / (2 * Math.PI)", "{kA}", "kv", 0, ""),
        ("{kV} / (2 * Math.PI)", "-{kV}", "kv", 0, ""),
        (
            "{kV} / (2 * Math.PI)",
            "{kV} / (2 * 3)",
            "kv",
            0,
            "",
        ),
        ("{kV} / (2 * Math.PI)", "{kV} * 60", "kv", 0, "M-UNITS"),
        ("{kV} / (2 * Math.PI)", "load()", "kv", 0, ""),
        ("volts per (rad/s)", "V·s/rot", "units", 0, "M-UNITS"),
        ("volts per (rad/s)", "velocity gain", "units", 0, ""),
        ("Constants.kS,", "Constants.kA,", "order", 0, "M-ARGORDER"),
        ("Constants.kS,", "kick,", "order", 0, ""),
        (", CharacterizationConstants.kA)", ")", "order", 1, ""),
        (" / (2 * Math.PI); // where", "; // where", "kp", 0.5, "M-UNITS"),
        (" / (2 * Math.PI); // where", " / 75.4; // where", "kp", 0.5, "M-DUTY"),
        (
            "// where tuning starts",
            "// V·s/rad",
            "kp",
            0.5,
            "",
        ),
    ],
)
def test_what_is_not_right_is_told(checked, turret, old, new, check, points, reads, code):  # noqa: PLR0917 - a row of the table
    student, shown = turret
    assert old in BODY
    text = f"class A {{\n{BODY.replace(old, new).format(**shown)}}}\n"
    found = checked(text, student=student)[check]

    assert (found.status, found.points, found.misconception) == ("failed", points, code)
    reads(f"got {found.seen}\ntry {found.hint}")


@pytest.mark.parametrize(
    ("settings", "double"),
    [
        (".withKP(CharacterizationConstants.kP)", ""),  # feedback alone is no second feedforward
        (".withKS(0).withKV(0).withKP(CharacterizationConstants.kP)", ""),
        (".withKS(CharacterizationConstants.kS)", "kS twice"),
        (".withKV(CharacterizationConstants.kV)", "kV twice"),
        (".withKS(0.11).withKV(CharacterizationConstants.kV)", "kS, kV twice"),
    ],
)
def test_a_gain_in_the_code_and_in_the_motor_controller_is_a_double_feedforward(
    checked, settings, double
):
    head = "import com.ctre.phoenix6.configs.Slot0Configs;\n"
    field = f"  Slot0Configs slot0 = new Slot0Configs(){settings};\n}}\n"
    text = head + written("ann").removesuffix("}\n") + field

    found = checked(text, student="ann", name=JAVA)["feedforward"]

    assert (found.status == "failed") == bool(double)
    assert double in found.seen
    assert ("This is a double feedforward" in found.hint) == bool(double)


@pytest.mark.parametrize("kind", ["arm", "elevator"])
@pytest.mark.parametrize(
    "order",
    [
        "kS kV kA kG",
        "kG kS kV kA",
        "kS kV kG kA",
    ],
)
def test_gravity_in_the_wrong_place_is_named(checked, kind, order, reads):
    student = of(kind=kind)
    text = written(student)
    right = ", ".join(f"CharacterizationConstants.{gain}" for gain in ["kS", "kG", "kV", "kA"])
    wrong = ", ".join(f"CharacterizationConstants.{gain}" for gain in order.split())
    assert right in text
    found = checked(text.replace(right, wrong), student=student)

    reads(found["order"].hint)
    assert found["order"].misconception == "M-ARGORDER"
    assert found["conversion"].points == 2  # one mistake costs once


def test_numbers_without_names_are_told_apart_by_their_size(checked):
    student = of(kind="elevator")
    gains = needed(tomllib.loads(OWN.module.told(OWN.module.draw(student))))
    text = written(student)
    right = ", ".join(f"CharacterizationConstants.{gain}" for gain in ["kS", "kG", "kV", "kA"])
    for order, status in (("kS kG kV kA", "passed"), ("kS kV kG kA", "failed")):
        numbers = ", ".join(f"{gains[gain]:.4g}" for gain in order.split())
        found = checked(text.replace(right, numbers), student=student)["order"]

        assert found.status == status


def test_a_simple_feedforward_for_an_arm_has_no_place_for_gravity(checked, reads):
    student = of(kind="arm")
    text = written(student).replace("ArmFeedforward", "SimpleMotorFeedforward")
    text = text.replace("CharacterizationConstants.kG, ", "")
    found = checked(text, student=student)["feedforward"]

    assert found.misconception == "M-NO-KG-IN-SYSID"
    reads(found.hint)


def test_a_loop_with_duty_cycle_is_told_about_its_output(checked, reads):
    student = of(kind="shooter", duty=True)
    text = written(student)
    kp = re.search(r"kP = (\S+);", text)[1]
    found = checked(text.replace(f"kP = {kp}", f"kP = 12 * {kp}"), student=student)["kp"]

    assert found.misconception == "M-DUTY"
    reads(found.hint)


@pytest.mark.parametrize(
    ("name", "gain"),
    [
        ("kS", "kS"),
        ("KS", "kS"),
        ("k_v", "kV"),
        ("K_A", "kA"),
        ("kgVolts", "kG"),
        ("kP", "kP"),
        ("m_kP", "kP"),
        ("kPVelocity", "kP"),
        ("kvVoltSecondsPerMeter", "kV"),
        ("kStatic", ""),
        ("kAngle", ""),
        ("kVelocity", ""),
        ("key", ""),
        ("skip", ""),
    ],
)
def test_a_name_stands_for_a_gain_or_for_none(name, gain):
    assert find_gain_of_name(name) == gain


@pytest.mark.parametrize("place", ["", *BOTH])
@pytest.mark.parametrize("name", [JAVA, PYTHON])
def test_no_damage_to_a_file_brings_the_reader_down(tmp_path, name, place):
    language = "java" if name == JAVA else "python"
    text = in_place("ann", place, language=language) if place else written("ann", language=language)
    path = tmp_path / name
    for found in [*re.finditer(r"\w+|[^\w\s]", text)][1::3]:
        for broken in (text[: found.start()] + text[found.end() :], text[: found.start()]):
            path.write_text(broken, "utf-8")

            assert read_gains(path).language == ("java" if name == JAVA else "python")


@pytest.mark.parametrize("student", ["ann", "ben", "zoë"])
def test_nothing_a_learner_reads_holds_a_converted_number(copy, student, capsys):
    variant = OWN.module.draw(student)
    text = written(student)
    for wrong in ("1.5", "0.001", "40"):
        spoiled = re.sub(r"(k[SGVAP] = )[^;]+", rf"\g<1>{wrong}", text)
        (copy.folder / JAVA).write_text(spoiled, "utf-8")
        run_command(["10", "--student", student])
        run_command(["10", "--student", student, "--json"])
    said = capsys.readouterr().out + " ".join(OWN.hints)
    said += (OWN.folder / "README.md").read_text("utf-8")
    (given,) = copy.folder.glob("data/*/given.toml")
    said += given.read_text("utf-8")
    numbers = [float(one) for one in re.findall(r"\d+\.\d+", said)]

    for gain in ("kV", "kA", "kP"):
        value = variant.needed(gain)

        assert [one for one in numbers if abs(one - value) < 0.001 * value] == []


def load(name):
    path = ROOT / "solutions" / "exercise10" / name
    spec = importlib.util.spec_from_file_location(f"_exercise10_{path.stem}", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("kind", ["arm", "drivetrain", "elevator", "shooter", "turret"])
@pytest.mark.parametrize("duty", [False, True])
def test_every_mistake_is_named_whatever_the_mechanism(checked, tmp_path, kind, duty):
    student = of(kind=kind, duty=duty)
    (tmp_path / "given.toml").write_text(OWN.module.told(OWN.module.draw(student)), "utf-8")
    answers = load("solve.py").solve(OWN.folder, tmp_path)

    for mistake in load("mistakes.py").MISTAKES:
        text = mistake.edit_text(answers[mistake.file])
        found = checked(text, student=student, name=mistake.file)[mistake.check]

        assert (mistake.name, found.status) == (mistake.name, "failed")
        assert mistake.says in f"{found.seen} {found.hint}"
        assert (mistake.name, found.misconception) == (mistake.name, mistake.misconception)
