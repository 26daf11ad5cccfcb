"""Exercise 1: everybody gets a voltage budget of their own, and no answer by accident."""

import pytest
from answer_grades import grade_answer
from places import ROOT

from grader.exercise.exercise import Exercise

OWN = Exercise("exercise1", ROOT / "exercises" / "exercise1")
CLASS = [f"student {number}" for number in range(50)]


def test_fifty_students_get_budgets_of_every_kind_whose_sum_no_slip_gives():
    variants = [OWN.module.draw(student) for student in CLASS]

    assert {variant.kind for variant in variants} == {"drivetrain", "intake", "shooter", "turret"}
    assert {variant.largest for variant in variants} == {"kV", "kA"}
    for variant in variants:
        for name in OWN.module.MOMENTS:
            friction, speed, push = variant.terms(name)
            asked = variant.asked(name)
            slips = (speed + push, speed + push - friction, friction + speed - (push or 1))

            assert 0.8 <= abs(asked.expected) < 12  # [V] a battery's
            assert not any(asked.is_right(volts) for volts in slips)


@pytest.mark.parametrize(
    ("written", "points"),
    [
        ('"V·s/ft"', 1),
        ('"V/rpm"', 1),
        ('"m/s/V"', 0),
        ('"rot/(V·s)"', 0),
        ('"V·s"', 0),
        ('"V·s/(m·rot)"', 0),
        ('"V·s/kg"', 0),
        ('"V·s/A"', 0),
        ('"V·s·rot"', 0),
        ('"V/(s"', 0),
        ('" "', 0),
        ("[1, 2]", 0),
        ("{a = 1}", 0),
        ("3", 0),
    ],
)
def test_a_wrong_unit_of_kv_gets_the_reason(copy, written, points, reads):
    found = grade_answer(copy, f"kV_unit = {written}")["kv-unit"]

    assert (found.status, found.points) == ("failed", points)
    reads(f"got {found.seen}\ntry {found.hint}")


@pytest.mark.parametrize("written", ["{}", "{}·{}", "{} * {}", "{}·({})", " {} "])
def test_the_term_may_be_written_in_many_ways(copy, written):
    gain = OWN.module.draw("ann").largest
    word = written.format(gain, {"kV": "v", "kA": "a"}[gain])

    assert grade_answer(copy, f'largest = "{word}"')["largest"].status == "passed"
    assert grade_answer(copy, f'LARGEST = "{word.upper()}"')["largest"].status == "passed"


@pytest.mark.parametrize("student", CLASS[:12])
def test_feedback_names_missing_speed_impossible_voltage_and_swapped_gains(copy, student):
    variant = OWN.module.draw(student)
    kick, _, push = variant.terms("accelerating")
    gains, at = variant.gains, variant.moments["braking"]
    crossed = gains["kS"] + gains["kV"] * at.acceleration + gains["kA"] * at.velocity
    cases = (
        ("accelerating", kick + push, "is kV·v missing"),
        ("forward", 243.5, "no battery"),
        ("braking", crossed, "did you swap kV and kA?"),
    )
    for name, volts, says in cases:
        found = grade_answer(copy, student=student, **{name: f"{volts:.4f}"})[name]

        assert says in found.hint, (name, volts)


@pytest.mark.parametrize("student", CLASS[:12])
def test_a_decimal_point_and_inches_are_named_with_their_factor(copy, student):
    variant = OWN.module.draw(student)
    kick, speed, _ = variant.terms("forward")
    cases = [(10.0 * (kick + speed), "10 times too large"), (kick + speed / 10.0, "kV·v 10 times")]
    if variant.kind == "drivetrain":
        cases.append((kick + 12.0 * speed, "a foot is 12 inches"))
    for volts, says in cases:
        found = grade_answer(copy, student=student, forward=f"{volts:.4f}")["forward"]

        assert says in found.hint, volts
