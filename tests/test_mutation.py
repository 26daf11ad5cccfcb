"""Right robot code with one change loses points and says why, or is a listed right variant."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parent))

from java_compiler import JavaProgram, compile_java
from mutation import robot_code
from mutation.report import all_mutants, legal_variants, survey

from grader.exercise import find_exercise
from grader.robotcode.compiling import find_compile_errors
from grader.robotcode.files import Files
from grader.robotcode.symbol_table import SymbolTable

BASES = Path(__file__).resolve().parent / "mutation" / "bases"
EXERCISES = ("exercise4", "exercise5", "exercise10")
STRIDE = 4  # of the mutants of the right answers, one in so many is compiled
# What the grader refuses although it compiles: a motor class whose methods a learner overrides.
ON_PURPOSE = "methods of its own"


@pytest.mark.parametrize("name", EXERCISES)
def test_every_mutant_of_robot_code_loses_points_with_advice_or_is_listed(name):
    report = survey(one for one in robot_code.mutants() if one.exercise == name)
    left = [(one.file, one.operator, one.line, said.said) for one, said in report.survivors]

    assert left == []
    assert report.killed.total() > 100
    assert not any(one.exercise == name for one in report.stale)


def test_the_grader_refuses_no_mutant_of_a_right_answer_that_javac_takes(tmp_path):
    made = [one for one in robot_code.mutants() if one.file.endswith(".java")][::STRIDE]
    programs = []
    for number, one in enumerate(made):
        path = tmp_path / f"mutant{number}" / Path(one.file).name
        path.parent.mkdir()
        path.write_text(one.text, encoding="utf-8")
        programs.append(JavaProgram((path,)))
    stubs = tmp_path / "stubs"
    stubs.mkdir()

    errors = compile_java(programs, stubs)

    assert sum(map(bool, errors)) > len(made) / 4  # of each kind there have to be many
    assert sum(not one for one in errors) > len(made) / 4
    refused = {
        (one.file, one.operator, one.line): graders
        for one, program, javac in zip(made, programs, errors, strict=True)
        if not javac and (graders := find_compile_errors(SymbolTable(Files(program.files[0]))))
    }
    assert {
        mutant: graders
        for mutant, graders in refused.items()
        if not all(ON_PURPOSE in one.message for one in graders)
    } == {}


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
