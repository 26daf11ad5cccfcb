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


def test_buttons_choose_the_same(guess):
    guess._buttons.value = "kS"
    assert guess.value == "kS"
    assert repr(guess) == "Prediction('Which gain is <off>?': kS)"


def test_an_answer_that_is_not_there_is_refused(guess):
    with pytest.raises(BadRequest, match="Choose one of: kS, kA"):
        guess.value = "kV"


def test_a_notebook_gets_the_question_and_the_buttons(guess):
    question, buttons = guess._box.children
    assert question.value == "Which gain is &lt;off&gt;?"
    assert buttons.options == ("kS", "kA")
    assert "application/vnd.jupyter.widget-view+json" in guess._repr_mimebundle_()
