"""Right robot code with one change loses points and says why, or is a listed right variant."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parent))

from mutation import robot_code
from mutation.report import all_mutants, legal_variants, survey

from grader.exercise import find_exercise

BASES = Path(__file__).resolve().parent / "mutation" / "bases"
EXERCISES = ("exercise4", "exercise5", "exercise10")


@pytest.mark.parametrize("name", EXERCISES)
def test_every_mutant_of_robot_code_loses_points_with_advice_or_is_listed(name):
    report = survey(one for one in robot_code.mutants() if one.exercise == name)
    left = [(one.file, one.operator, one.line, said.said) for one, said in report.survivors]

    assert left == []
    assert report.killed.total() > 100
    assert not any(one.exercise == name for one in report.stale)


def test_there_are_enough_mutants_of_enough_kinds():
    found = list(all_mutants())

    assert len(found) >= 1500
    assert len({one.operator for one in found}) >= 40
    assert {one.exercise for one in found} >= {*EXERCISES, "exercise1", "exercise12", "practice"}


def test_every_listed_variant_has_a_reason():
    assert all(len(one.reason) > 10 for one in legal_variants())


@pytest.mark.parametrize("path", sorted(BASES.rglob("*.java")), ids=str)
def test_the_other_ways_of_writing_earn_full_marks_unchanged(path, root):
    one = find_exercise(path.parent.name, root)
    grade = one.grade(path, student="ann", run=False)

    assert (grade.status, grade.score) == ("passed", grade.max_score)
