"""Right robot code with one change loses points and says why, or is a listed right variant."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parent))

from java_compiler import JavaProgram, compile_java
from mutation import robot_code
from mutation.report import legal_variants, survey

from grader.exercise.exercise import find_exercise
from grader.robotcode.java.program import Program
from grader.robotcode.java.steps import allow_deep_calls
from sim.core.errors import UnreadableFile

pytestmark = pytest.mark.slow

BASES = Path(__file__).resolve().parent / "mutation" / "bases"
EXERCISES = ("exercise4", "exercise5", "exercise10")
EACH = 18  # mutants of an exercise are run
STRIDE = 4  # of the mutants of the right answers, one in so many is compiled
LEAST_FOUND = 0.5  # of the mutants that javac refuses: the others stop when they are run


@pytest.mark.parametrize("name", EXERCISES)
def test_mutants_of_robot_code_lose_points_with_advice_or_are_listed(name):
    """Some of them: ``python tests/mutation/report.py`` runs them all in a quarter of an hour."""
    made = [one for one in robot_code.mutants() if one.exercise == name]
    report = survey(made[:: max(len(made) // EACH, 1)])
    left = [(one.file, one.operator, one.line, said.said) for one, said in report.survivors]

    assert left == []
    assert report.killed.total() > EACH / 2


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

    javacs = compile_java(programs, stubs)
    ours = [_find_errors(one.files[0]) for one in programs]

    assert sum(map(bool, javacs)) > len(made) / 4  # of each kind there have to be many
    assert sum(not one for one in javacs) > len(made) / 4
    pairs = list(zip(made, javacs, ours, strict=True))
    assert [
        (one.file, one.line, errors) for one, javac, errors in pairs if errors and not javac
    ] == []
    assert sum(map(bool, ours)) > LEAST_FOUND * sum(map(bool, javacs))


def _find_errors(path):
    allow_deep_calls()
    try:
        program = Program(path)
    except UnreadableFile as problem:
        return [problem]
    program.compile_all()
    return list(program.errors)


def test_every_listed_variant_has_a_reason():
    assert all(len(one.reason) > 10 for one in legal_variants())


@pytest.mark.parametrize("path", sorted(BASES.rglob("*.java")), ids=str)
def test_unchanged_variants_of_the_solution_earn_full_marks(path, root):
    one = find_exercise(path.parent.name, root)
    grade = one.grade(path, student="ann")

    assert (grade.status, grade.score) == ("passed", grade.max_score)
