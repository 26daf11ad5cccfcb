"""A solved answers.toml with one mistake loses points and says why, or is a listed right answer."""

import pytest
from mutation.report import legal_variants, survey
from mutation.toml_answers import EXERCISES, FILE, mutants

pytestmark = [pytest.mark.slow, pytest.mark.usefixtures("robot_code_once")]


@pytest.fixture(scope="module")
def made():
    """Wrong answers, each made of a right one by one change."""
    return list(mutants())


@pytest.fixture(scope="module")
def report(made, robot_code_once):  # noqa: ARG001 - before practice is graded
    """What became of the mutants."""
    return survey(made)


def test_there_are_several_hundred_mutants_of_every_kind(made):
    assert len(made) > 1500
    assert {one.exercise for one in made} == set(EXERCISES)
    assert len({one.operator for one in made}) >= 30


def test_every_mutant_loses_points_with_advice_or_is_listed(report):
    left = [(one.exercise, one.operator, one.line, said.said) for one, said in report.survivors]

    assert left == []


def test_every_listed_right_answer_is_one_and_has_its_reason(report):
    """A listed kind of mutant that always loses points is stale."""
    assert all(len(one.reason) > 10 for one in legal_variants())
    assert [one for one in report.stale if one.file == FILE] == []
