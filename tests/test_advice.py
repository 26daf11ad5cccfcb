"""Advice as data: each surface has its own words for it."""

import pickle

import pytest

from sim.core.advice import WORDS, Action
from sim.core.doubt import Doubt
from sim.core.errors import BadRequest

TERMINAL = {"option", "velocity-scale"}  # the page can only say what to type in a terminal


@pytest.mark.parametrize("name", WORDS)
def test_the_page_does_not_speak_of_options(name):
    action = Action(name, ("X", "Y"), before="First.")

    assert ("--" in action.on_page or "`sysid" in action.on_page) == (name in TERMINAL)
    for said in (str(action), action.on_page):
        assert said.startswith("First. ")
        assert said.endswith(".")
        assert "{" not in said


def test_a_doubt_says_cause_and_advice():
    doubt = Doubt("x", "It is an elevator.", action=Action("gravity-type", "elevator"))

    assert doubt.text == "It is an elevator. Fit it with --type elevator if gravity acts on it."
    assert Doubt("x", "So it is.").text == "So it is."


def test_a_refusal_keeps_its_action_on_the_way_through_files_and_processes():
    refusal = BadRequest("a length", where="a.csv", advice=Action("angle")).move("b.csv")

    back = pickle.loads(pickle.dumps(refusal))  # noqa: S301 - our own
    assert (back.where, back.action) == ("b.csv", Action("angle"))
    assert str(back).startswith("b.csv: a length. Add --units")
