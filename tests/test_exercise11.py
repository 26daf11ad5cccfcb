"""Exercise 11: choosing an answer and a reason, and a decision with a reason that carries it."""

import itertools
import re
import sys
import tomllib
from dataclasses import replace

import numpy as np
import pytest
from answer_grades import grade_answer
from places import ROOT

from grader.answers.answer_key import load_answer_key
from grader.checks.misconception import MISCONCEPTIONS
from grader.cli import run_command
from grader.exercise.exercise import Exercise
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.fit import fit

OWN = Exercise("exercise11", ROOT / "exercises" / "exercise11")
KEY = load_answer_key(OWN.module.__name__)
DRAWN = sys.modules[KEY.draw.__module__]
QUESTIONS = KEY.QUESTIONS
POINTS = 12 * 1 + 3 * (2 + 2) + 1 + 7 * (1 + 1)  # short questions, knowledge checks, voltage, table


def letter(student, name, words):
    """Where an option stands for a student."""
    letters = KEY.draw(student).letters[name]
    (found,) = (one for one, option in letters.items() if option.text.startswith(words))
    return found


def right(student):
    """All letters and numbers that are right for a student."""
    variant = KEY.draw(student)
    picks = {
        name: next(
            one
            for one, option in letters.items()
            if option.share == 1.0 and not option.needs_reason
        )
        for name, letters in variant.letters.items()
    }
    reasons = {key: one for one, key in variant.reasons.items()}
    for row in KEY.ROWS:
        picks |= {row.name: row.decision, f"{row.name}_reason": reasons[row.reasons[0]]}
    return picks | {"KC2_volts": f"{variant.volts.expected:.4g}"}


def test_fifty_students_can_earn_all_points(copy):
    for number in range(50):
        student = f"student {number}"
        results = grade_answer(copy, student=student, **right(student))

        assert {check.status for check in results.values()} == {"passed"}
        assert sum(check.points for check in results.values()) == POINTS


def test_three_recordings_differ_by_more_than_their_error_bars_for_fifty_students():
    for number in range(50):
        numbers = KEY.draw(f"student {number}").numbers
        kas = sorted(numbers[f"ka_{name}"] for name in ("first", "second", "third"))
        error = numbers["ka_error"]

        assert kas[0] > 0.1  # [V·s²/m] of a light drivetrain
        assert kas[2] < 0.4  # of a heavy one
        assert min(kas[1] - kas[0], kas[2] - kas[1]) > 2 * error


@pytest.mark.parametrize("frame", [20, 50])
def test_the_ka_of_repeated_readings_is_what_the_recipe_finds_in_such_a_log(frame):
    robot = MECHANISMS["drivetrain"]
    framed = replace(robot, sensor=replace(robot.sensor, frame=frame / 1000.0))
    routine = Routine(ramp=0.5, step=2.0, timeout=8.0)
    log = simulate(framed, routine, rng=np.random.default_rng(3), period=0.005)
    found = fit(log, method="sysid").gains

    share = DRAWN.FRAMES[frame]
    assert found["kA"] / robot.gains["kA"] == pytest.approx(share, rel=0.05)
    assert found["kV"] == pytest.approx(robot.gains["kV"], rel=0.01)
    for number in range(50):
        numbers = KEY.draw(f"student {number}").numbers
        if numbers["frame"] == frame:
            assert numbers["ka_frames"] / numbers["ka_mass"] == pytest.approx(share, rel=0.02)


def test_the_letters_of_a_neighbor_earn_little(copy):
    earned = [
        sum(
            check.points
            for check in grade_answer(copy, student=f"student {n}", **right("ann")).values()
        )
        for n in range(20)
    ]

    assert sum(earned) / len(earned) < POINTS / 2  # decisions are words, and the same for all
    assert right("ann") != right("ben")
    assert right("ann") == right("Ann")


@pytest.mark.parametrize("name", QUESTIONS)
def test_every_wrong_option_says_why_and_names_no_right_one(copy, name):
    answers = [one for one in QUESTIONS[name].options if one.share == 1.0]
    assert len(answers) == (2 if name == "KC1_answer" else 1)
    for option in QUESTIONS[name].options:
        picks = right("ann") | {name: letter("ann", name, option.text)}
        check = grade_answer(copy, **picks)[name.lower().replace("_", "-")]
        assert (check.status == "passed") == (option.share == 1.0)
        if option.share < 1.0:
            assert check.points == pytest.approx(option.share * check.max_points)
            assert len(check.hint) > 40
            assert check.misconception in {"", *MISCONCEPTIONS}
            for one in answers:
                assert one.text not in check.hint
                assert len(one.text) < 5 or f" {one.text[:20].lower()}" not in check.hint.lower()


@pytest.mark.parametrize(
    ("name", "words", "share"),
    [
        ("KC1_answer", "The encoder slipped", 1.0),
        ("KC2_answer", "Only add a kP", 0.6),
        ("KC3_answer", "Raise kP", 0.4),
        ("KC3_answer", "Add kI", 0.3),
        ("KC3_answer", "Use the mean", 0.5),
        ("KC3_answer", "Run SysId without", 0.0),
    ],
)
def test_half_a_solution_earns_its_part_with_the_right_reason(copy, name, words, share):
    picks = right("ann") | {name: letter("ann", name, words)}
    check = name.lower().replace("_", "-")

    assert grade_answer(copy, **picks)[check].points == pytest.approx(2 * share)
    reason = name.replace("_answer", "_reason")
    wrong = next(one for one in "abcde" if one != picks[reason])
    for other in ("", wrong):
        assert grade_answer(copy, **picks | {reason: other})[check].points == 0


def test_random_letters_earn_at_most_a_quarter_of_each_knowledge_check(copy):
    for story in ("KC1", "KC2", "KC3"):
        answer, reason = f"{story}_answer", f"{story}_reason"
        letters = KEY.draw("ann").letters
        earned = []
        for picks in itertools.product(letters[answer], letters[reason]):
            results = grade_answer(copy, **dict(zip((answer, reason), picks, strict=True)))
            earned.append(sum(check.points for check in results.values()))

        assert sum(earned) / len(earned) <= (2 + 2) / 4


@pytest.mark.parametrize(
    ("row", "decision", "reason", "earned"),
    [
        ("intake", "usually not", "on-off", (1, 1)),
        ("intake", "recommended", "if-speed", (1, 1)),
        ("intake", "recommended", "motor", (0, 0)),
        ("climber", "usually not", "place", (1, 1)),
        ("climber", "Optional", "if-profile", (1, 1)),
        ("climber", "always", "place", (0, 0)),
        ("intake", "always", "shot", (0, 0)),
        ("arm", "optional", "light", (0, 0)),
        ("arm", "recommended", "light", (1, 0)),
        ("arm", "optional", "angle", (0, 0)),
        ("drivetrain", "optional", "path", (0, 0)),
        ("elevator", "recommended", "heavy", (1, 0)),
        ("conveyor", "usually not needed", "on-off", (1, 1)),
    ],
)
def test_unusual_decision_needs_a_reason_that_supports_it(copy, row, decision, reason, earned):
    (own,) = (one for one, key in KEY.draw("ann").reasons.items() if key == reason)
    results = grade_answer(copy, **{row: decision, f"{row}_reason": own})

    assert tuple(results[f"{kind}-{row}"].points for kind in ("decision", "reason")) == earned


@pytest.mark.parametrize("written", ["{}", "{})", " {}. ", "({})", "kA"])
def test_a_letter_may_be_written_in_many_ways(copy, written):
    given = written.format(letter("ann", "Q0_brace", "kA").upper())

    assert grade_answer(copy, Q0_brace=given)["q0-brace"].status == "passed"


@pytest.mark.parametrize("student", ["ann", "ben", "zoë"])
def test_questions_contain_the_numbers_but_not_the_answers(copy, student, capsys):
    run_command(["11", "--student", student])
    capsys.readouterr()
    (file,) = (copy.folder / "data").glob("*/questions.md")
    told = file.read_text("utf-8")
    volts = KEY.draw(student).volts.expected

    assert [
        float(one) for one in re.findall(r"\d+\.\d+", told) if abs(float(one) - volts) < 0.02
    ] == []
    assert "{" not in told
    assert all(f"### {name}" in told for name in QUESTIONS)
    asked = tomllib.loads((OWN.folder / "answers.toml").read_text("utf-8"))
    assert {*right(student)} == {*asked}
