"""Exercise 9: everybody gets a mechanism of their own, and its log."""

import shutil
import sys

import numpy as np
import pytest
from places import ROOT

from grader.exercise.exercise import Exercise, load_module

OWN = Exercise("exercise9", ROOT / "exercises" / "exercise9")


def unseen():
    """The module with the five logs, as the exercise loaded it."""
    return sys.modules[f"{OWN.module.__name__}.unseen"]


def logs_of(student):
    return unseen().draw_hidden(student)


def grade_answer(folder, text, student="ann"):
    """What the check of the function says of a text."""
    (folder / "fit.py").write_text(text, "utf-8")
    result = Exercise("exercise9", folder).grade(None, student=student)
    return next(check for check in result.checks if check.id == "function")


def test_ten_students_get_five_logs_each_that_the_authored_function_fits():
    fit = load_module(OWN.solution / "fit.py").fit
    for number in range(10):
        for log in logs_of(f"student {number}"):
            found = fit(**log.data)
            for name, asked in log.key.asked.items():
                assert asked.is_right(found[name]), f"{number}, {log.recipe.kind}: {name}"


def test_tests_of_a_log_follow_one_another_with_pauses():
    for log in logs_of("ann"):
        test, time = log.data["test"], log.data["time"]
        between = np.flatnonzero(test[1:] != test[:-1])

        assert len(between) == len(np.unique(test)) - 1
        assert np.diff(time).min() > 0.0
        assert np.diff(time)[between].min() > 0.5


def test_the_five_logs_differ_as_the_task_says():
    logs = logs_of("ann")
    periods = [float(f"{np.median(np.diff(log.data['time'])):.3f}") for log in logs]

    assert [log.recipe.kind for log in logs] == [
        "drivetrain",
        "intake",
        "turret",
        "shooter",
        "drivetrain",
    ]
    assert periods == [0.02, 0.005, 0.02, 0.008, 0.01]
    assert [len(np.unique(log.data["test"])) for log in logs] == [4, 4, 4, 4, 3]
    assert {len(column) for column in logs[0].data.values()} == {len(logs[0].data["time"])}


def test_function_file_is_graded_with_the_answers_next_to_it(copy):
    shutil.copy(ROOT / "solutions" / "exercise9" / "fit.py", copy.folder)
    result = copy.grade(copy.folder / "fit.py", student="ann")

    assert result.file.name == "answers.toml"
    assert (result.score, result.max_score) == (5.0, 10.0)


def test_function_without_its_answers_file_is_not_graded(copy, tmp_path):
    alone = tmp_path / "alone" / "fit.py"
    alone.parent.mkdir()
    alone.write_text("def fit(): pass\n", "utf-8")
    result = copy.grade(alone, student="ann")

    assert result.status == "ungradable"
    assert "answers.toml is not in the same folder" in result.reason


def test_numbers_are_graded_where_there_is_no_function(copy):
    (copy.folder / "fit.py").unlink()
    *numbers, function = copy.grade(None, student="ann").checks

    assert (function.status, function.points) == ("not-reached", 0.0)
    assert "no fit.py next to your answers" in function.seen
    assert {check.status for check in numbers} == {"failed"}


@pytest.mark.parametrize(("most", "points"), [(0, 0.0), (2000, 2.0), (9999, 5.0)])
def test_every_log_that_is_right_earns_a_point(copy, most, points):
    lengths = [len(log.data["time"]) for log in logs_of("ann")]
    expected = float(sum(length <= most for length in lengths))
    text = (ROOT / "solutions" / "exercise9" / "fit.py").read_text("utf-8")
    early = f"    if len(time) > {most}:\n        raise ValueError('too long')\n"
    check = grade_answer(copy.folder, text.replace("    ks = kv = ka = None\n", early))

    assert check.points == expected == points


def test_feedback_on_a_wrong_fit_names_what_is_special_about_the_log(copy):
    text = (ROOT / "solutions" / "exercise9" / "fit.py").read_text("utf-8")
    wrong = "    if len(set(test)) == 3:\n        ka *= 1.4\n    return {"
    check = grade_answer(copy.folder, text.replace("    return {", wrong))

    assert check.points == 4.0
    assert "use them all; loop over the tests that the log has" in check.hint
    assert check.misconception == ""  # the reverse runs are there, and were used


def test_fifty_students_get_mechanisms_that_can_be_fitted():
    variants = [OWN.module.draw(f"student {number}") for number in range(50)]

    assert {variant.mechanism.name for variant in variants} == set(OWN.module.KINDS)
    for variant in variants:
        for name, asked in variant.asked.items():
            assert asked.is_right(variant.fit.gains[name])


def test_gain_of_a_fit_that_explains_the_voltage_is_recognized(copy):
    for student in ("ann", "ben", "cat", "dan", "eve", "fay"):
        variant = OWN.module.draw(student)
        lookalike = OWN.module.read(
            OWN.folder / "answers.toml", student=student
        ).key.scene.lookalikes["kA"][0]
        if variant.asked["kA"].is_right(lookalike.value):
            continue
        text = f"kA = {lookalike.value}"
        (copy.folder / "answers.toml").write_text(text, "utf-8")
        result = copy.grade(None, student=student)
        (check,) = (one for one in result.checks if one.id == "ka")

        assert "the result with the voltage" in check.hint
        return
    pytest.fail("no student's log shows the difference")


NAIVE = """import numpy as np


def fit(time, voltage, position, velocity, test):
    a = {slope}
    known = np.column_stack([np.sign(velocity), velocity, a])
    ks, kv, ka = np.linalg.lstsq(known, voltage, rcond=None)[0]
    return {{"{ks}": ks, "kV": kv, "kA": ka}}
"""


@pytest.mark.parametrize(
    "slope", ["np.gradient(velocity, time)", "np.gradient(velocity, 0.02)", "velocity / 12"]
)
def test_a_number_that_a_program_computed_is_not_blamed_on_a_calculator(copy, slope):
    hint = grade_answer(copy.folder, NAIVE.format(slope=slope, ks="kS")).hint

    assert not any(words in hint for words in ("round", "battery", "diameter", "started from"))
    assert "Check four steps: take the tests one by one" in hint


def test_friction_column_that_is_the_same_in_every_row_is_named(copy):
    text = (OWN.solution / "fit.py").read_text("utf-8")
    assert "np.sign(" in text
    hint = grade_answer(copy.folder, text.replace("np.sign(", "np.ones_like(")).hint

    assert "Then forward and reverse cancel" in hint


def test_a_gain_under_another_name_is_shown_the_names(copy):
    check = grade_answer(copy.folder, NAIVE.format(slope="np.gradient(velocity, time)", ks="ks"))

    assert "no kS; your function returned ks, kV, kA" in check.seen
    assert check.hint.startswith("Return all three under these names")
