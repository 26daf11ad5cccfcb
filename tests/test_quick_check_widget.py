"""Quick checks in a lesson: answered, and told at once."""

import re
from pathlib import Path

import pytest

from grader import QuickCheck, QuickNumberCheck
from sim.core.errors import BadRequest

LESSONS = sorted((Path(__file__).resolve().parents[1] / "lessons").glob("*.py"))


@pytest.fixture
def check():
    """A question with two answers."""
    return QuickCheck(
        "Which gain <moved>?", {"kS": "Friction is the same.", "kA": "Mass."}, right="kA"
    )


def test_each_answer_is_told_something(check):
    assert check.feedback == ""
    assert check.answer("kS") == "Not yet. Friction is the same."
    assert check.answer("kA") == "Right. Mass."


def test_buttons_tell_the_same(check):
    question, buttons, told = check._box.children
    assert question.value == "Which gain &lt;moved&gt;?"
    assert told.value == ""
    buttons.value = "kS"
    assert told.value == "<p><b>Not yet. Friction is the same.</b></p>"
    buttons.value = None
    assert told.value == ""
    shown = check._repr_mimebundle_()
    assert "application/vnd.jupyter.widget-view+json" in shown
    assert "Mass" not in shown["text/plain"]


def test_an_answer_that_is_not_there_is_refused(check):
    with pytest.raises(BadRequest, match="Choose one of: kS, kA"):
        check.answer("kV")
    with pytest.raises(BadRequest, match="none of the answers"):
        QuickCheck("?", {"kS": "…"}, right="kA")


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (0.0191, "Right."),
        ("0,0191", "Right."),
        ("0.12 V·s/rot", "Right. 0.12 V·s/rot is 0.0191 V·s/rad"),
        (0.12, "radians"),
        (0.754, "Not yet."),
        ("many", "not one number"),
        (float("nan"), "nan"),
    ],
)
def test_a_number_is_diagnosed(given, said):
    asked = "kV is 0.12 V·s/rot. Per radian?"
    check = QuickNumberCheck(asked, 0.0191, "V·s/rad", gain="kV", angular=True)

    assert said in check.answer(given)


def test_what_is_typed_is_told_the_same():
    check = QuickNumberCheck("Half of 3?", 1.5)
    _, typed, told = check._box.children
    typed.value = "3"
    assert "Not yet." in told.value
    typed.value = "1,5"
    assert told.value == "<p><b>Right.</b></p>"
    typed.value = " "
    assert told.value == ""


@pytest.mark.parametrize("lesson", LESSONS, ids=lambda path: path.stem)
def test_every_lesson_has_a_quick_check(lesson):
    part = lesson.read_text(encoding="utf-8").partition("Knowledge check")[2]

    assert re.search(r"^\w+ = Quick(Number)?Check\(", part, re.MULTILINE)
