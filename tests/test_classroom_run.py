"""A class's robot code is run where it can be shut in, or where whoever grades says so."""

import json
import shutil

import pytest
from robot_mistakes import RIGHT, ROOT
from small_course import lay_out

import grader.isolation
from grader.classroom.class_grading import GradedClass
from grader.classroom.submissions import find_submissions
from grader.cli import run_command
from grader.exercise.exercise import Exercise, list_exercises

CHECKS = '''
"""An exercise that says whether it was asked to run what it was given."""
from grader.checks.check import check
from grader.answers.submission import read_answers
FILES = ("answers.toml",)

def read(path, *, student, run=True):
    read_answers(path)
    return run

@check(points=1)
def there(run):
    """Something is there."""
    return f"run={run}"
'''
ISOLATED, LIMITED = "isolated (Landlock ABI 6)", "limited: time only"
SAID = f"students' code is not run: this machine is {LIMITED}. Robot code is only read"
WARNED = f"students' code is run although this machine is {LIMITED}. It can read what you can read"


@pytest.fixture
def course(tmp_path, monkeypatch):
    """A small course whose exercise can run code, and what ann handed in."""
    lay_out(tmp_path / "course")
    (tmp_path / "course" / "exercises" / "exercise1" / "checks.py").write_text(CHECKS, "utf-8")
    monkeypatch.chdir(tmp_path / "course")
    answer = tmp_path / "in" / "ann" / "exercise1" / "answers.toml"
    answer.parent.mkdir(parents=True)
    answer.write_text("a = 1\n", "utf-8")
    return tmp_path / "course"


def note(tmp_path):
    text = (tmp_path / "in-graded" / "results" / "ann.json").read_text("utf-8")
    return json.loads(text)["grades"][0]["checks"][0]["hint"]


@pytest.fixture
def level(request, monkeypatch):
    """What this machine can do, as the command is told."""
    monkeypatch.setattr("grader.cli.class_run.find_isolation_level", lambda: request.param)
    return request.param


@pytest.mark.usefixtures("course")
@pytest.mark.parametrize(
    ("level", "options", "asked"),
    [
        (ISOLATED, [], True),
        (LIMITED, [], False),
        (ISOLATED, ["--no-run"], False),
        (LIMITED, ["--run"], True),
    ],
    ids=["isolated", "limited", "isolated, but told not to", "limited, but told to"],
    indirect=["level"],
)
def test_code_is_run_where_it_can_be_isolated_or_as_the_option_asks(
    tmp_path, capsys, level, options, asked
):
    assert run_command(["class", str(tmp_path / "in"), "--processes", "1", *options]) == 0
    assert note(tmp_path) == f"run={asked}"

    said = " ".join(capsys.readouterr().err.split())
    assert (SAID in said) is (level == LIMITED and not options)
    assert (WARNED in said) is (level == LIMITED and options == ["--run"])


@pytest.mark.usefixtures("course")
def test_results_of_running_are_not_taken_for_results_of_reading(tmp_path):
    for option, asked in (("--run", True), ("--no-run", False), ("--run", True)):
        assert run_command(["class", str(tmp_path / "in"), "--processes", "1", option]) == 0
        assert note(tmp_path) == f"run={asked}"


def test_the_digest_says_whether_code_was_run(course, tmp_path):
    def digest(*, run):
        there = list_exercises(course)
        work = GradedClass(find_submissions(tmp_path / "in", there), there, course, run=run)
        return work.make_jobs(travel=False)[0].digest

    assert digest(run=True) == digest(run=True)
    assert digest(run=True) != digest(run=False)


def test_an_exercise_that_only_reads_is_not_asked_to_run(tmp_path, monkeypatch, capsys):
    lay_out(tmp_path)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(
        grader.isolation, "find_isolation_level", lambda: pytest.fail("nobody needs to know")
    )
    shutil.copytree(tmp_path / "exercises", tmp_path / "in" / "ann")

    assert list_exercises(tmp_path)[0].runs_code is False
    assert run_command(["class", str(tmp_path / "in"), "--processes", "1"]) == 0
    assert "students' code" not in capsys.readouterr().err


@pytest.mark.parametrize("name", ["exercise4", "exercise5", "exercise9", "practice"])
def test_an_exercise_that_runs_code_can_be_graded_without_running_it(name):
    assert Exercise(name, ROOT / "exercises" / name).runs_code


def test_python_robot_code_that_may_not_be_run_is_left_to_the_instructor(tmp_path):
    path = tmp_path / "example_subsystem.py"
    path.write_text(RIGHT, "utf-8")
    fourth = Exercise("exercise4", ROOT / "exercises" / "exercise4")

    assert fourth.grade(path, student="ann", run=False).status == "ungradable"


def test_java_robot_code_is_graded_where_no_code_of_others_may_run(tmp_path):
    shutil.copy(ROOT / "solutions" / "exercise4" / "ExampleSubsystem.java", tmp_path)
    fourth = Exercise("exercise4", ROOT / "exercises" / "exercise4")
    grade = fourth.grade(tmp_path / "ExampleSubsystem.java", student="ann", run=False)

    assert grade.score == grade.max_score


def test_function_that_may_not_be_run_is_left_to_the_instructor(tmp_path, monkeypatch):
    monkeypatch.setattr(
        grader.isolation, "run_functions", lambda *_, **__: pytest.fail("it was run")
    )
    shutil.copy(ROOT / "exercises" / "exercise9" / "answers.toml", tmp_path)
    shutil.copy(ROOT / "solutions" / "exercise9" / "fit.py", tmp_path)
    ninth = Exercise("exercise9", ROOT / "exercises" / "exercise9")
    grade = ninth.grade(tmp_path, student="ann", run=False)

    assert grade.status == "ungradable"
    assert grade.reason.startswith("the check function was not run: this machine")
    assert [one.status for one in grade.checks if one.id == "function"] == ["not-run"]


def test_learner_who_grades_alone_has_their_function_run(tmp_path):
    shutil.copy(ROOT / "exercises" / "exercise9" / "answers.toml", tmp_path)
    shutil.copy(ROOT / "solutions" / "exercise9" / "fit.py", tmp_path)
    ninth = Exercise("exercise9", ROOT / "exercises" / "exercise9")

    assert ninth.grade(tmp_path, student="ann").score == 5.0
