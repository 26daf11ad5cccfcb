"""The questions of the lessons: answered, and told at once."""

import pytest

from grader import ask_question, enable_checkboxes
from grader.lesson_questions import ChoiceQuestion, NumberQuestion
from sim.core.errors import BadRequest


@pytest.fixture
def check():
    """A question with two answers."""
    return ChoiceQuestion(
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
        ChoiceQuestion("?", {"kS": "…"}, right="kA")


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (0.0191, "Right."),
        ("0,0191", "Right."),
        ("0.12 V·s/rot", "Right. 0.12 V·s/rot is 0.0191 V·s/rad"),
        (0.12, "radians"),
        (0.754, "39.5 = (2π)²."),
        ("many", "not one number"),
        (float("nan"), "nan"),
    ],
)
def test_a_number_is_diagnosed(given, said):
    asked = "kV is 0.12 V·s/rot. Per radian?"
    check = NumberQuestion(asked, 0.0191, "V·s/rad", gain="kV", angular=True)

    assert said in check.answer(given)


def test_what_is_typed_is_told_the_same():
    check = NumberQuestion("Half of 3?", 1.5)
    _, typed, told = check._box.children
    typed.value = "3"
    assert "Not yet." in told.value
    typed.value = "1,5"
    assert told.value == "<p><b>Right.</b></p>"
    typed.value = " "
    assert told.value == ""


def test_a_prediction_is_answered_at_the_click_and_its_text_holds_the_numbers():
    asked = ask_question("lesson2.hold", kG=1.234, kS=0.5, less=1.0)
    assert "kG = 1.23 V" in asked.question
    assert asked.answer("it stays") == "Right. Go on, and see why."
    assert asked.answer("it sinks slowly") == "No. The answer is: it stays. Go on, and see why."


def test_a_name_without_a_question_is_refused(reads):
    with pytest.raises(BadRequest) as refused:
        ask_question("lesson0.nothing")
    reads(refused.value)


def test_ticks_are_kept_by_the_browser():
    assert "localStorage" in enable_checkboxes().data
