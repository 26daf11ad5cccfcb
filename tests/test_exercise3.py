"""Exercise 3: an elevator and an arm of one's own, held up against gravity."""

import re
from pathlib import Path

import pytest

from grader.cli import run_command
from grader.exercise import Exercise
from grader.student_data.variant import make_folder_name

ROOT = Path(__file__).resolve().parents[1]
OWN = Exercise("exercise3", ROOT / "exercises" / "exercise3")
WORDS = {
    "elevator_type": "Elevator",
    "elevator_class": "ElevatorFeedforward",
    "arm_type": "Arm",
    "arm_class": "ArmFeedforward",
}


def grade_answer(exercise, *, student="ann", **answers):
    """The results of an answer, by check."""
    path = exercise.folder / "answers.toml"
    quoted = (f'{name} = "{value}"\n' for name, value in answers.items())
    path.write_text("".join(quoted), "utf-8")
    return {check.id: check for check in exercise.grade(path, student=student).checks}


def truth(student):
    variant = OWN.module.draw(student)
    return {one.name: one.expected for one in (*variant.asked.values(), variant.offset)}


def test_fifty_students_can_solve_theirs_and_no_row_passes_for_horizontal(copy):
    ways = set()
    for number in range(50):
        student = f"student {number}"
        variant = OWN.module.draw(student)
        results = grade_answer(copy, student=student, **variant.found, **WORDS)
        highest = max(variant.arm, key=lambda hold: hold.middle)
        lazy = grade_answer(
            copy, student=student, arm_kG=highest.middle, arm_offset=-highest.reading
        )

        assert {check.status for check in results.values()} == {"passed"}
        assert sum(check.points for check in results.values()) == 10  # as the course lists it
        assert lazy["arm-kg"].status == "failed"
        assert lazy["arm-offset"].points == 0
        ways.add(variant.offset.expected > 0)
    assert ways == {True, False}


def test_a_student_gets_the_same_numbers_every_time_and_nobody_elses():
    assert truth("ann") == truth("Ann") != truth("ben")


@pytest.mark.parametrize("student", ["ann", "ben", "zoë"])
def test_nothing_a_learner_reads_holds_the_answer(copy, student, capsys):
    said = " ".join(OWN.hints) + (OWN.folder / "README.md").read_text("utf-8")
    for wrong in (
        dict.fromkeys(truth(student), 7.77),
        {name: 1.06 * value for name, value in truth(student).items()},
    ):
        grade_answer(copy, student=student, **wrong, **dict.fromkeys(WORDS, "Simple"))
        run_command(["3", "--student", student])
        run_command(["3", "--student", student, "--json"])
    said += capsys.readouterr().out
    said += (copy.folder / "data" / make_folder_name(student) / "given.toml").read_text("utf-8")
    numbers = [abs(float(text)) for text in re.findall(r"\d+\.\d+", said)]

    assert len(numbers) > 20
    for name in ("elevator_kG", "arm_kG", "arm_offset"):
        expected = abs(truth(student)[name])
        assert [n for n in numbers if abs(n - expected) < 0.002 * expected] == []


def test_numbers_that_were_changed_are_made_anew(copy):
    said = []
    copy.prepare("ann", say=said.append)
    given = copy.folder / "data" / "ann" / "given.toml"
    right = given.read_bytes()
    copy.prepare("ann", say=said.append)
    given.write_bytes(right[:100])
    copy.prepare("ann", say=said.append)

    assert given.read_bytes() == right
    assert len(said) == 2
    assert [file.name for file in given.parent.iterdir()] == ["given.toml"]


@pytest.mark.usefixtures("copy")
def test_where_no_numbers_can_be_written_it_says_so(capsys, monkeypatch):
    def full(*_args, **_more):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "mkdir", full)

    assert run_command(["3"]) == 2
    assert "your numbers cannot be written (No space left on device)" in capsys.readouterr().err


def test_edges_and_widths_as_they_stand_in_the_table_are_recognized(copy):
    for student in ("ann", "ben", "cat", "dan", "eve"):
        variant = OWN.module.draw(student)
        low, high = variant.elevator.lower, variant.elevator.upper
        for kg in (low, high, high - low, low + high):
            assert (
                grade_answer(copy, student=student, elevator_kG=f"{kg:.2f}")[
                    "elevator-kg"
                ].misconception
                == "M-KG-EDGE"
            )
        for row in variant.arm:
            width = f"{row.upper - row.lower:.2f}"
            results = grade_answer(copy, student=student, arm_kS=width)
            assert results["arm-ks"].misconception == "M-KG-EDGE"


@pytest.mark.parametrize(
    ("name", "written", "right"),
    [
        ("arm_type", " arm ", True),
        ("arm_type", "ARM", True),
        ("arm_type", "Arms", False),
        ("arm_class", "new ArmFeedforward(kS, kG, kV)", True),
        ("arm_class", "edu.wpi.first.math.controller.ArmFeedforward", True),
        ("arm_class", "Arm Feedforward", True),
        ("arm_class", "Arm", False),
        ("arm_class", "ElevatorFeedforward", False),
        ("elevator_class", "wpimath.controller.ElevatorFeedforward", True),
        ("elevator_class", "SimpleMotorFeedforwardMeters", False),
        ("elevator_type", "Drivetrain", False),
    ],
)
def test_a_word_may_be_written_in_many_ways(copy, name, written, right):
    result = grade_answer(copy, **{name: written})[name.replace("_", "-")]

    assert (result.status == "passed") == right
    assert right or "Choose one of: Simple" in result.hint


@pytest.mark.parametrize(
    ("off", "unit", "points"),
    [
        (0.0, "", 2),
        (1.9, "", 2),
        (360.0, "", 2),  # the same angle
        (-360.0, "deg", 2),
        (2.1, "", 1),
        (-4.9, "°", 1),
        (5.1, "", 0),
        (180.0, "", 0),
    ],
)
def test_an_offset_earns_full_marks_within_2_degrees_and_half_within_5(copy, off, unit, points):
    written = f"{truth('ann')['arm_offset'] + off:.3f}{unit}".replace(".", ",")

    assert grade_answer(copy, arm_offset=written)["arm-offset"].points == points


def test_an_offset_may_be_given_in_radians_if_it_says_so(copy):
    radians = truth("ann")["arm_offset"] * 3.14159 / 180

    assert grade_answer(copy, arm_offset=f"{radians:.4f} rad")["arm-offset"].status == "passed"
    assert grade_answer(copy, arm_offset=f"{radians:.4f}")["arm-offset"].misconception == "M-UNITS"
