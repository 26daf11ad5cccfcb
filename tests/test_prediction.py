"""A prediction is kept, shown again, and can be made without buttons."""

import pytest

from sim.core.errors import BadRequest
from sim.teaching.prediction import Prediction


@pytest.fixture
def guess():
    """A question with two answers."""
    return Prediction("Which gain is <off>?", "kS", "kA")


def test_before_anything_is_chosen_it_says_so(guess):
    assert guess.value is None
    assert str(guess) == "nothing yet"


def test_plain_code_can_choose(guess):
    guess.value = "kA"
    assert f"You said: {guess}." == "You said: kA."
    guess.value = None
    assert str(guess) == "nothing yet"


def test_buttons_choose_the_same(guess, reads):
    guess._buttons.value = "kS"
    assert guess.value == "kS"
    reads(repr(guess))


def test_an_answer_that_is_not_there_is_refused(guess, reads):
    with pytest.raises(BadRequest) as refused:
        guess.value = "kV"
    reads(refused.value)


def test_a_notebook_gets_the_question_and_the_buttons(guess, reads):
    question, buttons = guess._box.children
    reads(question.value)
    assert buttons.options == ("kS", "kA")
    shown = guess._repr_mimebundle_()
    assert "application/vnd.jupyter.widget-view+json" in shown
    assert shown["text/plain"] == f"{guess.question}\n  ○ kS\n  ○ kA"  # without buttons


def test_the_answer_says_whether_the_prediction_was_right_and_keeps_a_score(monkeypatch, reads):
    monkeypatch.setattr(Prediction, "_results", {})
    first = Prediction("Which gain?", "kS", "kA")
    second = Prediction("Where does it go?", "it stays", "it goes up")
    first.value, second.value = "kA", "it goes up"

    reads(first.reveal("lesson0.gain"))
    reads(second.reveal("lesson2.hold"))
    assert first.reveal("lesson0.gain").endswith("(1 of 2 predictions right so far.)")


def test_without_a_prediction_only_the_answer_is_shown(guess):
    assert guess.reveal("lesson0.gain") == "Answer: kA."


def test_an_answer_that_is_no_option_cannot_be_revealed(guess, reads):
    with pytest.raises(BadRequest) as refused:
        guess.reveal("lesson1.ramp")
    reads(refused.value)


def test_a_name_without_an_answer_is_refused(guess, reads):
    with pytest.raises(BadRequest) as refused:
        guess.reveal("lesson0.nothing")
    reads(refused.value)
