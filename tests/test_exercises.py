"""The course checks itself: starters fail, solutions pass, and every mistake is caught."""

import re
import shutil
from functools import cache
from pathlib import Path

import pytest
from authored import authored_answer, mistakes_of

from grader.course import find_course
from grader.exercise import HINTS, list_exercises
from grader.misconception import MISCONCEPTIONS
from grader.starter import remove_answers
from grader.student_data.variant import use_class_secret

pytestmark = pytest.mark.slow

ROOT = find_course(Path(__file__).resolve().parent)
EXERCISES = {one.name: one for one in list_exercises(ROOT)}
STUDENTS = ("ann", "ben", "zoë")  # between them they get every kind of mechanism there is


MISTAKES = [
    pytest.param(name, mistake, id=f"{name}: {mistake.name}")
    for name in EXERCISES
    for mistake in mistakes_of(name)
]


def students_for(name, mistake, number):
    """Whose numbers a mistake is tried on: answers that are run take long, so one student's."""
    runs = not mistake.file.endswith(".toml") or not EXERCISES[name].is_personal
    return (STUDENTS[number % len(STUDENTS)],) if runs else STUDENTS


GRADED = [
    pytest.param(*param.values, student, id=f"{param.id}-{student}")
    for number, param in enumerate(MISTAKES)
    for student in students_for(*param.values, number)
]


@pytest.fixture(scope="module")
def answered(tmp_path_factory):
    """Makes the solution of an exercise for a student, once: file name -> text."""

    @cache
    def solved(name, student):
        one = EXERCISES[name]
        if not one.is_personal:
            return authored_answer(one, one.folder / "data")
        copy = tmp_path_factory.mktemp("course") / "exercises" / name
        shutil.copytree(one.folder, copy, ignore=shutil.ignore_patterns("data"))
        moved = type(one)(name, copy)
        moved.prepare(student, say=lambda _: None)
        (data,) = (copy / "data").iterdir()
        return authored_answer(moved, data)

    return lambda name, student: dict(solved(name, student))


def grade(name, texts, file, student, folder):
    """Grade one file of an answer, with what belongs to it beside it."""
    one = EXERCISES[name]
    file = one.files[0] if file in one.companion_files else file
    for part in (file, *one.companion_files):
        (folder / part).write_text(texts[part], encoding="utf-8")
    return one.grade(folder / file, student=student)


def test_there_are_exercises():
    assert {"exercise4", "exercise9"} <= EXERCISES.keys()


@pytest.mark.parametrize("name", EXERCISES)
def test_an_exercise_has_a_task_hints_checks_and_mistakes(name):
    one = EXERCISES[name]
    readme = (one.folder / "README.md").read_text(encoding="utf-8")

    assert re.search(r"^# (?:Exercise \d+|Practice): \w", readme, re.MULTILINE)
    assert f"grade {name}" in readme
    assert len(one.hints) == len(HINTS) == 3
    assert all(len(hint) > 40 for hint in one.hints)
    assert all(one.checks)
    assert len({check.id for check in one.checks}) == len(one.checks)
    assert all((one.folder / file).is_file() for file in (*one.files, *one.companion_files))
    assert len(mistakes_of(name)) >= 5


@pytest.mark.parametrize("name", EXERCISES)
def test_the_starter_is_readable_and_wrong(name):
    for file in EXERCISES[name].files:
        result = EXERCISES[name].grade(EXERCISES[name].folder / file, student="ann")

        assert result.status == "failed"
        assert result.score < result.max_score / 2


@pytest.mark.parametrize("student", STUDENTS)
@pytest.mark.parametrize("name", EXERCISES)
def test_the_solution_gets_full_marks(name, student, answered, tmp_path):
    texts = answered(name, student)
    for file in EXERCISES[name].files:
        result = grade(name, texts, file, student, tmp_path)

        assert [check for check in result.checks if check.status != "passed"] == []
        assert (result.status, result.score) == ("passed", result.max_score)
        assert result.warnings == ()


@pytest.mark.parametrize(("name", "mistake", "student"), GRADED)
def test_a_mistake_is_caught_and_named(name, mistake, student, answered, tmp_path):
    texts = answered(name, student)
    texts[mistake.file] = mistake.edit_text(texts[mistake.file])
    result = grade(name, texts, mistake.file, student, tmp_path)
    (check,) = (one for one in result.checks if one.id == mistake.check)

    assert result.status == "failed"
    assert check.status == "failed"
    assert mistake.says in f"{check.seen} {check.hint}"
    assert check.misconception == mistake.misconception


@pytest.mark.parametrize(("name", "mistake"), MISTAKES)
def test_a_mistake_names_a_known_misconception(name, mistake):
    assert mistake.check in {check.id for check in EXERCISES[name].checks}
    assert mistake.misconception in {"", *MISCONCEPTIONS}


@pytest.mark.parametrize("name", EXERCISES)
def test_a_starter_is_its_solution_with_the_answers_taken_out(name):
    for file in (*EXERCISES[name].files, *EXERCISES[name].companion_files):
        solution = ROOT / "solutions" / name / file
        if solution.is_file():
            starter = (EXERCISES[name].folder / file).read_text(encoding="utf-8")

            assert starter == remove_answers(solution.read_text(encoding="utf-8"))
            assert "TODO" in starter


def test_answers_are_taken_out_in_both_languages():
    java = "a;\n  // --- answer: Add\n  // ---   them up.\n  b += a;\n  // --- end\nc;\n"
    python = "a\n    # --- answer: Add.\n    b += a\n    # --- end\nc\n"

    assert remove_answers(java) == "a;\n  // TODO: Add\n  //       them up.\nc;\n"
    assert remove_answers(python) == "a\n    # TODO: Add.\nc\n"


@pytest.mark.parametrize("name", [name for name, one in EXERCISES.items() if one.is_personal])
def test_a_class_has_numbers_of_its_own_even_in_one_process(name, tmp_path):
    copy = tmp_path / "exercises" / name
    shutil.copytree(ROOT / "exercises", copy.parent, ignore=shutil.ignore_patterns("data"))
    moved = type(EXERCISES[name])(name, copy)
    made = []
    for secret in (b"east", b"west", b"east"):
        with use_class_secret(secret):
            moved.prepare("ann", say=lambda _: None)
        made.append(
            {path.name: path.read_bytes() for path in sorted((copy / "data" / "ann").iterdir())}
        )

    assert made[0] == made[2]
    assert made[0] != made[1]
