"""A solved answers.toml with one mistake loses points and says why, or is a listed right answer."""

import fnmatch
import re
import sys
import tomllib
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

from mutation.answers import answer, judge  # noqa: E402 - the path is set above
from mutation.mutant import Mutant  # noqa: E402 - the same
from mutation.toml_answers import EXERCISES, mutants  # noqa: E402 - the same
from mutation.toml_operators import changes_of  # noqa: E402 - the same

pytestmark = pytest.mark.slow

LEGAL = tomllib.loads((HERE / "mutation" / "legal_toml.toml").read_text("utf-8"))["legal"]


def covers(row, mutant):
    names = ("exercise", "file", "operator")
    if not all(fnmatch.fnmatch(getattr(mutant, name), row[name]) for name in names):
        return False
    return re.search(row["line"], mutant.text.splitlines()[mutant.line - 1]) is not None


def survivors(some, folder):
    """The mutants that neither lose points with advice nor are listed."""
    for mutant in some:
        verdict = judge(mutant, folder)
        if not verdict.killed and not any(covers(row, mutant) for row in LEGAL):
            yield mutant.exercise, mutant.operator, mutant.line, verdict.said


def test_there_are_several_hundred_mutants_of_every_kind():
    found = list(mutants())

    assert len(found) > 1500
    assert {one.exercise for one in found} == set(EXERCISES)
    assert len({one.operator for one in found}) >= 30


@pytest.mark.parametrize("name", EXERCISES)
def test_every_mutant_loses_points_with_advice_or_is_listed(name, tmp_path):
    made = changes_of(answer(name)["answers.toml"])
    each = 8 if name == "practice" else 1  # its robot programs run with each of them
    some = [Mutant(name, "answers.toml", *change) for change in list(made)[::each]]

    assert list(survivors(some, tmp_path)) == []


def test_every_listed_right_answer_is_one_and_has_its_reason(tmp_path):
    """A listed kind of mutant that always loses points is stale."""
    made = list(mutants())
    for row in LEGAL:
        assert len(row["reason"]) > 20
        mine = (one for one in made if covers(row, one))
        assert any(not judge(one, tmp_path).killed for one in mine), row
