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
from grader.robotcode.gain_constants import gain_of, gains_of

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
    ("made", "handed", "says"),
    [
        (
            "CharacterizationConstants(kV=load())",
            "C.kS, C.kV, C.kA",
            "the grader cannot see the number",
        ),
        ("CharacterizationConstants", "*gains", "the grader cannot see by reading"),
    ],
)
def test_what_reading_cannot_tell_is_asked(checked, turret, made, handed, says):
    student, shown = turret
    body = PYTHON_BODY.replace("C = CharacterizationConstants", f"C = {made}")
    body = body.replace("C.kS, C.kV, C.kA", handed)
    found = checked(body.format(**shown), student=student, name=PYTHON)["conversion"]

    assert says in found.seen


def test_a_constant_that_is_made_of_itself_ends(tmp_path):
    path = tmp_path / JAVA
    rows = "double a = b + kT; double b = a + c; double c = a + b; double kV = a + b + c;"
    path.write_text(
        f"class A {{ {rows} Object f = new ArmFeedforward(a, b, c, a + b); }}\n", "utf-8"
    )

    assert gains_of(path).feedforwards[0].arguments["kS"].value is None


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
    ("old", "new", "check", "points", "says", "code"),
    [
        ("{kV} / (2 * Math.PI)", "{kV}", "conversion", 1, "6.28 times too large", "M-UNITS"),
        (
            "{kV} / (2 * Math.PI)",
            "{kV} * 2 * Math.PI",
            "kv",
            0,
            "converted in the wrong direction: a larger",
            "M-UNITS",
        ),
        ("{kV} / (2 * Math.PI)", "{kA}", "kv", 0, "that is the analyzer's kA", "M-ARGORDER"),
        ("{kV} / (2 * Math.PI)", "-{kV}", "kv", 0, "the sign is not", ""),
        (
            "{kV} / (2 * Math.PI)",
            "{kV} / (2 * 3)",
            "kv",
            0,
            "close, but rounded too much. Keep three",
            "",
        ),
        ("{kV} / (2 * Math.PI)", "{kV} * 60", "kv", 0, "wrong by a factor of 60. Did", "M-UNITS"),
        ("{kV} / (2 * Math.PI)", "load()", "kv", 0, "the grader cannot see the number", ""),
        ("volts per (rad/s)", "V·s/rot", "units", 0, "This is the right kind of unit", "M-UNITS"),
        ("volts per (rad/s)", "velocity gain", "units", 0, "no unit of kV", ""),
        ("Constants.kS,", "Constants.kA,", "order", 0, "kA is where", "M-ARGORDER"),
        ("Constants.kS,", "kick,", "order", 0, "the grader cannot see which gain", ""),
        (", CharacterizationConstants.kA)", ")", "order", 1, "counts as 0", ""),
        (" / (2 * Math.PI); // where", "; // where", "kp", 0.5, "as the analyzer", "M-UNITS"),
        (" / (2 * Math.PI); // where", " / 75.4; // where", "kp", 0.5, "output is not", "M-DUTY"),
        (
            "// where tuning starts",
            "// V·s/rad",
            "kp",
            0.5,
            "The number fits. Write in a comment",
            "",
        ),
    ],
)
def test_what_is_not_right_is_told(checked, turret, old, new, check, points, says, code):  # noqa: PLR0917 - a row of the table
    student, shown = turret
    assert old in BODY
    text = f"class A {{\n{BODY.replace(old, new).format(**shown)}}}\n"
    found = checked(text, student=student)[check]

    assert (found.status, found.points, found.misconception) == ("failed", points, code)
    assert says in f"{found.seen} {found.hint}"


@pytest.mark.parametrize("kind", ["arm", "elevator"])
@pytest.mark.parametrize(
    ("order", "says"),
    [
        ("kS kV kA kG", "kV is where"),
        ("kG kS kV kA", "kG is where"),
        ("kS kV kG kA", "expects kG"),
    ],
)
def test_gravity_in_the_wrong_place_is_named(checked, kind, order, says):
    student = of(kind=kind)
    text = written(student)
    right = ", ".join(f"CharacterizationConstants.{gain}" for gain in ["kS", "kG", "kV", "kA"])
    wrong = ", ".join(f"CharacterizationConstants.{gain}" for gain in order.split())
    assert right in text
    found = checked(text.replace(right, wrong), student=student)

    assert says in found["order"].hint
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


def test_a_simple_feedforward_for_an_arm_has_no_place_for_gravity(checked):
    student = of(kind="arm")
    text = written(student).replace("ArmFeedforward", "SimpleMotorFeedforward")
    text = text.replace("CharacterizationConstants.kG, ", "")
    found = checked(text, student=student)["feedforward"]

    assert found.misconception == "M-NO-KG-IN-SYSID"
    assert "This class has no argument for kG" in found.hint


def test_a_loop_with_duty_cycle_is_told_about_its_output(checked):
    student = of(kind="shooter", duty=True)
    text = written(student)
    kp = re.search(r"kP = (\S+);", text)[1]
    found = checked(text.replace(f"kP = {kp}", f"kP = 12 * {kp}"), student=student)["kp"]

    assert found.misconception == "M-DUTY"
    assert "a duty cycle, where 1 is 12 V" in found.hint


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
    assert gain_of(name) == gain


@pytest.mark.parametrize("name", [JAVA, PYTHON])
def test_no_damage_to_a_file_brings_the_reader_down(tmp_path, name):
    text = written("ann", language="java" if name == JAVA else "python")
    path = tmp_path / name
    for found in [*re.finditer(r"\w+|[^\w\s]", text)][1::3]:
        for broken in (text[: found.start()] + text[found.end() :], text[: found.start()]):
            path.write_text(broken, "utf-8")

            assert gains_of(path).language == ("java" if name == JAVA else "python")


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
        text = mistake.make(answers[mistake.file])
        found = checked(text, student=student, name=mistake.file)[mistake.check]

        assert (mistake.name, found.status) == (mistake.name, "failed")
        assert mistake.says in f"{found.seen} {found.hint}"
        assert (mistake.name, found.misconception) == (mistake.name, mistake.misconception)
