"""The course checks itself: starters fail, solutions pass, and every mistake is caught."""

import shutil
from functools import cache

import pytest
from places import ROOT

from grader.cli import run_command
from grader.exercise.course_check import (
    STUDENTS,
    find_draw_flaws,
    find_mistake_flaws,
    find_solution_flaws,
    find_task_flaws,
    list_graded_mistakes,
    prepare_solved,
)
from grader.exercise.exercise import list_exercises
from grader.exercise.starter import remove_answers

pytestmark = [pytest.mark.slow, pytest.mark.usefixtures("robot_code_once")]

EXERCISES = {one.name: one for one in list_exercises(ROOT)}
GRADED = [
    pytest.param(one.name, student, mistake, id=f"{one.name}: {mistake.name}-{student}")
    for one in EXERCISES.values()
    for student in STUDENTS
    for mistake in list_graded_mistakes(one, student)
]
each_exercise = pytest.mark.parametrize("name", EXERCISES)


@pytest.fixture(scope="module")
def solved(tmp_path_factory):
    """Solves an exercise for a student, once."""

    @cache
    def solve(name, student):
        return prepare_solved(EXERCISES[name], student, tmp_path_factory.mktemp("course"))

    return solve


@pytest.fixture
def course(tmp_path, monkeypatch):
    """A course with exercise 3 and its solution, in whose folder the command runs."""
    ignored = shutil.ignore_patterns("data", "__pycache__")
    for top in ("exercises", "solutions"):
        shutil.copytree(ROOT / top / "exercise3", tmp_path / top / "exercise3", ignore=ignored)
    (tmp_path / "lessons").mkdir()
    monkeypatch.chdir(tmp_path)
    return tmp_path


@each_exercise
def test_an_exercise_has_a_task_hints_checks_a_starter_that_fails_and_mistakes(name):
    assert find_task_flaws(EXERCISES[name]) == []


@pytest.mark.parametrize("student", STUDENTS)
@each_exercise
def test_the_solution_gets_full_marks(name, student, solved):
    assert list(find_solution_flaws(solved(name, student))) == []


@pytest.mark.parametrize(("name", "student", "mistake"), GRADED)
def test_a_mistake_is_caught_and_named(name, student, mistake, solved):
    assert list(find_mistake_flaws(solved(name, student), mistake)) == []


@each_exercise
def test_a_class_has_numbers_of_its_own_even_in_one_process(name):
    assert list(find_draw_flaws(EXERCISES[name])) == []


def test_answers_are_taken_out_in_both_languages():
    java = "a;\n  // --- answer: Add\n  // ---   them up.\n  b += a;\n  // --- end\nc;\n"
    python = "a\n    # --- answer: Add.\n    b += a\n    # --- end\nc\n"

    assert remove_answers(java) == "a;\n  // TODO: Add\n  //       them up.\nc;\n"
    assert remove_answers(python) == "a\n    # TODO: Add.\nc\n"


@pytest.mark.parametrize(
    ("file", "change", "told"),
    [
        ("exercises/exercise3/README.md", ("# Exercise 3: ", "# "), "needs a first heading"),
        ("exercises/exercise3/README.md", ("grade exercise3", "grade"), "how to check the answer"),
        ("exercises/exercise3/README.md", ("\n\n", "\n\n[a](b.md)\n\n"), "points to b.md"),
        ("exercises/exercise3/hints.toml", ("concept", 'concept = "No."\nold'), "whole sentence"),
        ("exercises/exercise3/answers.toml", ('arm_type = ""', 'arm_type = "'), "be readable"),
        ("exercises/exercise3/drawn.py", ("make_student_rng(student", 'rng("'), "drawn.py, line"),
        ("exercises/exercise3/drawn.py", ("rng(student, ", "rng(student, secret=b'', exercise="),
            "all classes get the same files"),
        ("solutions/exercise3/solve.py", ('arm_type": "Arm"', 'arm_type": "Simple"'),
            "does not earn everything with the files of ann"),
        ("solutions/exercise3/mistakes.py", ("MISTAKES", "FEW"), "needs at least 5 mistakes"),
        ("solutions/exercise3/mistakes.py", ('"M-KG-EDGE"', '"M-KG"'), "names no misconception"),
        ("solutions/exercise3/mistakes.py", ("elevator-kg", "elevator-k"), "names no check"),
    ],
)  # fmt: skip
def test_check_course_says_what_is_wrong_with_an_exercise(file, change, told, course, capsys):
    text = (course / file).read_text(encoding="utf-8")
    assert change[0] in text
    (course / file).write_text(text.replace(*change), encoding="utf-8")

    assert run_command(["check-course", "3"]) == 1
    assert told in " ".join(capsys.readouterr().out.split())
