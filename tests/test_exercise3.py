"""Exercise 3: an elevator and an arm of one's own, held up against gravity."""

import math

import pytest
from answer_grades import grade_answer
from places import ROOT

from grader.exercise.exercise import Exercise

OWN = Exercise("exercise3", ROOT / "exercises" / "exercise3")
WORDS = {
    "elevator_type": "Elevator",
    "elevator_class": "ElevatorFeedforward",
    "arm_type": "Arm",
    "arm_class": "ArmFeedforward",
}


def truth(student):
    variant = OWN.module.draw(student)
    return {one.name: one.expected for one in (*variant.asked.values(), variant.offset)}


def test_twenty_students_get_solvable_numbers_without_a_nearly_horizontal_row(copy):
    ways = set()
    for number in range(20):
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


@pytest.mark.parametrize("student", ["ann", "ben", "zoë"])
def test_the_mean_of_all_middles_is_named_and_not_taken_for_an_edge(copy, student):
    rows = OWN.module.draw(student).arm
    mean = sum(row.middle for row in rows) / len(rows)

    hint = grade_answer(copy, student=student, arm_kG=mean)["arm-kg"].hint

    assert "the mean of all middles" in hint
    assert "an edge" not in hint


def test_multiplying_by_the_cosine_is_named_even_if_the_result_equals_a_row_of_the_table(copy):
    found = OWN.module.draw("ada").found
    product = found["arm_kG"] * math.cos(math.radians(found["arm_offset"])) ** 2

    hint = grade_answer(copy, student="ada", arm_kG=product)["arm-kg"].hint

    assert "did you multiply the middle" in hint
    assert "one row of your table" in hint


def test_sum_of_both_shares_and_edge_in_place_of_ks_are_named(copy):
    rows = {row.reading: row for row in OWN.module.draw("kim").arm}
    shares = rows[0.0].middle + abs(rows[-90.0].middle)

    results = grade_answer(copy, student="kim", arm_kG=shares, arm_kS=rows[0.0].upper)

    assert "is that A + B" in results["arm-kg"].hint
    assert "an edge of the window" in results["arm-ks"].hint


@pytest.mark.parametrize(
    ("name", "written", "right"),
    [
        ("arm_type", "Arms", False),
        ("arm_class", "new ArmFeedforward(kS, kG, kV)", True),
        ("arm_class", "Arm Feedforward", True),
        ("arm_class", "ElevatorFeedforward", False),
        ("elevator_class", "wpimath.controller.ElevatorFeedforward", True),
        ("elevator_class", "SimpleMotorFeedforwardMeters", False),
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
