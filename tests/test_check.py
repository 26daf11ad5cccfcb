"""A check passes, fails, is not reached, or breaks; and the learner is told which."""

import pytest

from grader.checks.check import NotReachedError, Status, WrongAnswer, check, run_checks


@check(points=1)
def positive(number):
    """The number is positive.

    What stands here is for the author.
    """
    if number <= 0:
        raise WrongAnswer(f"{number}", hint="Turn the sign around.", misconception="M-UNITS")


@check(points=2, after=positive)
def large_enough(number):
    """The number is at least 10."""
    if number < 5:
        raise WrongAnswer(f"{number}", hint="More.")
    if number < 10:
        raise WrongAnswer(f"{number}", hint="A little more.", earned=1.5)


@check(points=1, after=(positive, large_enough))
def even(number):
    """The number is even."""
    if number % 1:
        raise NotReachedError("checked after it is whole")
    return "Zero is even, too." if number == 10 else None


@check(points=1)
def broken(number):
    """The number has a name."""
    return {}[number]


CHECKS = (positive, large_enough, even)


def test_a_check_is_named_and_described_by_its_function():
    assert (large_enough.id, large_enough.description) == (
        "large-enough",
        "The number is at least 10",
    )
    assert positive.description == "The number is positive"


@pytest.mark.parametrize(
    ("number", "statuses", "points"),
    [
        (12, ["passed", "passed", "passed"], [1, 2, 1]),
        (12.5, ["passed", "passed", "not-reached"], [1, 2, 0]),
        (7, ["passed", "failed", "not-reached"], [1, 1.5, 0]),
        (2, ["passed", "failed", "not-reached"], [1, 0, 0]),
        (-2, ["failed", "not-reached", "not-reached"], [0, 0, 0]),
    ],
    ids=["all", "nothing-to-look-at", "in-part", "second-wrong", "first-wrong"],
)
def test_checks_after_a_wrong_answer_do_not_run(number, statuses, points):
    results = run_checks(CHECKS, number)

    assert [result.status for result in results] == statuses
    assert [result.points for result in results] == points


def test_wrong_answer_gets_the_value_found_and_a_next_step():
    result = positive.run(-3)

    assert (result.seen, result.hint, result.misconception) == (
        "-3",
        "Turn the sign around.",
        "M-UNITS",
    )


def test_check_that_is_not_reached_names_the_one_that_must_pass_first():
    _, second, _ = run_checks(CHECKS, -1)

    assert "The number is positive" in second.seen


def test_error_in_our_check_is_not_blamed_on_the_learner():
    result = broken.run(1)

    assert result.status is Status.ERROR
    assert "KeyError" in result.seen


@pytest.mark.parametrize("earned", [-1.0, 7.0])
def test_partial_credit_stays_between_nothing_and_everything(earned):
    @check(points=2)
    def greedy(_subject):
        """Anything."""
        raise WrongAnswer("", hint="", earned=earned)

    assert 0 <= greedy.run(None).points <= 2


def test_a_check_without_a_sentence_is_refused():
    with pytest.raises(ValueError, match="needs a docstring"):

        @check(points=1)
        def silent(_subject):
            pass
