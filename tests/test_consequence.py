"""What a wrong answer would do on the robot: told, drawn, and without the key."""

import html
import re
import subprocess
import sys
from pathlib import Path

import pytest
from page_flaws import page_flaws
from places import ROOT

from grader import submit
from grader.cli import run_command
from grader.exercise.exercise import list_exercises

EXERCISES = {one.name: one for one in list_exercises(ROOT)}
PAGE = "<!DOCTYPE html><html lang='en'><head><title>t</title></head><body>{}</body></html>"


@pytest.fixture
def course(all_exercises):
    """Exercises by their names, in whose folder the command runs."""
    return {one.name: one for one in list_exercises(all_exercises)}


def key(name, student):
    """The numbers that are right for a student, by their names in the answer file."""
    module = EXERCISES[name].module
    drawn = module.draw(student)
    if name == "exercise1":
        return {moment: drawn.asked(moment).expected for moment in drawn.moments}
    if name == "exercise3":
        right = {one: asked.expected for one, asked in drawn.asked.items()}
        return right | {"arm_offset": drawn.offset.expected}
    return {one: asked.expected for one, asked in drawn.asked.items()}


def write(one, **answers):
    """An answer file with these numbers alone."""
    told = "".join(f"{name} = {value!r}\n" for name, value in answers.items())
    (one.folder / "answers.toml").write_text(told, encoding="utf-8")


def consequence(one, *, student="ann", **answers):
    if answers:
        write(one, **answers)
    return one.find_consequence(one.grade(None, student=student))


TABLE = [
    (
        "exercise3",
        {"elevator_kG": 0.0},
        "When the elevator should stand still, it sinks about 0.4 m",
    ),
    ("exercise3", {"elevator_kG": 2.0}, "When the elevator should stand still, it climbs"),
    ("exercise3", {"arm_kG": 0.0}, "When the arm should stand still, it sinks"),
    ("exercise3", {"arm_kS": 0.0}, "the arm"),
    (
        "exercise9",
        {"kV": 2 * 3.14159},
        "When the drivetrain should move at 2 m/s, it reaches about 4 m/s.",
    ),
    ("exercise9", {"kV": 1 / 60}, "When the drivetrain should move at 2 m/s, it hardly moves."),
    ("exercise9", {"kV": -1.0}, "it goes the other way"),
    ("exercise9", {"kA": 0.0}, "While the drivetrain speeds up, its velocity is up to about"),
    ("exercise1", {"forward": 1 / 12}, "Forward, with your volts: it hardly moves."),
    ("exercise1", {"backward": -1.0}, "Backward, with your volts: it goes the other way."),
    ("exercise1", {"braking": 2.0}, "Braking, with your volts: it is about"),
]


@pytest.mark.parametrize(("name", "factors", "words"), TABLE)
def test_a_wrong_number_is_explained_by_its_effect_on_the_robot(course, name, factors, words):
    right = key(name, "ann")
    wrong = right | {gain: factor * right[gain] for gain, factor in factors.items()}
    found = consequence(course[name], **wrong)

    assert words in found.words


@pytest.mark.parametrize("student", ["ann", "ben", "zoë"])
@pytest.mark.parametrize("name", ["exercise1", "exercise3", "exercise9"])
def test_words_hold_no_key(course, name, student):
    right = key(name, student)
    found = consequence(course[name], student=student, **{g: 1.5 * v for g, v in right.items()})
    alt = found.draw().alt
    told = [float(one) for one in re.findall(r"\d+\.?\d*", alt)]

    assert told
    assert found.words in alt
    for value in map(abs, right.values()):
        digits = f"{value:.3g}"
        assert digits not in alt or len(digits) < 4
    assert all(len(re.sub(r"^0\.0*|\.|0+$", "", f"{one:g}")) <= 2 for one in told)  # two digits


@pytest.mark.parametrize("name", ["exercise1", "exercise3", "exercise9"])
@pytest.mark.parametrize("kind", ["right", "nothing", "text", "infinite"])
def test_an_answer_without_effect_gets_no_consequence(course, name, kind):
    given = {"right": None, "nothing": "", "text": "fast", "infinite": "inf"}[kind]
    right = key(name, "ann")
    write(course[name], **{g: v if given is None else given for g, v in right.items()})

    assert consequence(course[name]) is None


@pytest.mark.parametrize("size", [9e299, -9e299, 1e-300])
@pytest.mark.parametrize("name", ["exercise1", "exercise3", "exercise9"])
def test_huge_or_tiny_number_still_gets_a_finite_picture(course, name, size):
    found = consequence(course[name], **dict.fromkeys(key(name, "ann"), size))

    assert "nan" not in found.draw().alt
    assert "inf" not in found.words


def test_a_plan_that_runs_too_far_gets_a_consequence(course, reads):
    machines = EXERCISES["exercise6"].module.draw("ann").machines
    lines = {"ramp": 1.0, "step": 3.0, "timeout": 10.0, "release": "timeout"}
    write(course["exercise6"], **{f"turret_{what}": value for what, value in lines.items()})
    found = consequence(course["exercise6"])

    reads(found.words)
    assert f"{machines['turret'].travel:g} rot" in found.words
    (axes,) = found.draw().figure.axes
    wanted, ramp, *_ = axes.get_lines()
    assert set(wanted.get_ydata()) == {machines["turret"].travel}
    assert ramp.get_ydata()[-1] > machines["turret"].travel


def code_for(student, *, factor=1.0, order=None):
    """A robot's feedforward for a student: its kV times a factor, its gains in another order."""
    variant = EXERCISES["exercise10"].module.draw(student)
    gains = {name: variant.needed(name) for name in variant.gains}
    gains["kV"] *= factor
    handed = ", ".join(f"Constants.{name}" for name in (order or variant.gains))
    lines = [f"  static final double {name} = {value!r};" for name, value in gains.items()]
    made = f"  {variant.made} ff = new {variant.made}({handed});"
    return "\n".join(["class Mechanism {", made, "}", "class Constants {", *lines, "}", ""])


@pytest.mark.parametrize("student", ["ann", "dan", "fay", "zoë"])
def test_robot_code_is_explained_by_its_effect_on_the_robot(course, student):
    one = course["exercise10"]
    variant = one.module.draw(student)
    other = one.folder / "example_mechanism.py"
    other.unlink()

    def found(**how):
        (one.folder / "ExampleMechanism.java").write_text(code_for(student, **how), "utf-8")
        return consequence(one, student=student)

    assert found() is None
    assert f"the {variant.kind} " in found(factor=2 * 3.14159).words
    assert f"the {variant.kind} " in found(order=variant.gains[::-1]).words
    assert found(order=["kS", "kWhat"]) is None


def test_the_command_prints_and_draws_the_consequence(course, capsys):
    right = key("exercise9", "me")
    write(course["exercise9"], **(right | {"kV": 3.0 * right["kV"]}))

    assert run_command(["9", "--picture", "what.svg"]) == 1
    out, err = capsys.readouterr()
    assert "then  This is what your numbers do as feedforward, without feedback. When" in out
    assert "See it: grade exercise9 --picture what.svg" in out
    assert max(map(len, out.splitlines())) <= 80
    assert "what your answer would do: what.svg" in err
    assert "should move at" in Path("what.svg").read_text("utf-8")


def test_a_picture_that_cannot_be_drawn_is_refused(course, capsys, reads):
    right = key("exercise9", "me")
    write(course["exercise9"], **right)
    assert run_command(["9", "--picture", "what.svg"]) == 1  # the function is not written yet
    reads(capsys.readouterr().err)
    assert not Path("what.svg").exists()

    write(course["exercise9"], **(right | {"kV": 1.0}))
    assert run_command(["9", "--picture", "what.doc"]) == 2
    assert run_command(["--picture", "what.svg"]) == 2


def test_a_cell_shows_the_consequence_below_the_checks(course):
    right = key("exercise3", "me")
    shown = submit(3, **(right | {"elevator_kG": 0.0}))

    words = html.unescape(shown.html)
    assert words.index("On the robot") > words.index("elevator's kG")
    assert shown.html.count("<img") == 1
    assert "the elevator should stand still, it sinks" in shown.html
    assert page_flaws(PAGE.format(shown.html)) == []
    assert "<img" not in submit(3, **right).html
    assert course


def test_words_wait_for_no_drawing_library(course):
    right = key("exercise3", "me")
    write(course["exercise3"], **(right | {"elevator_kG": 0.0}))
    code = (
        "import sys; from pathlib import Path; from grader.exercise.exercise import find_exercise\n"
        "one = find_exercise('3', Path.cwd()); grade = one.grade(None, student='me')\n"
        "found = one.find_consequence(grade)\n"
        "print('matplotlib' in sys.modules, 'sinks' in found.words)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    drawn, told = done.stdout.split()

    assert (drawn, told) == ("False", "True")
