"""The answer graded at each saving; a machine looked over; grades for listening."""

import pytest
from small_course import HALF, RIGHT, answer

from grader import doctor
from grader.cli import run_command
from grader.exercise import list_exercises
from grader.watch import watch_exercise


def saves(course, *texts):
    """Somebody who saves one text after another while the watch waits."""
    left = list(texts)

    def wait(_seconds):
        if not left:
            raise KeyboardInterrupt
        text = left.pop(0)
        if text:
            answer(course, text)

    return wait


def test_each_saving_is_graded_until_all_is_right(course, monkeypatch, capsys):
    monkeypatch.setattr("time.sleep", saves(course, "", "", HALF, "size = [\n", RIGHT))
    monkeypatch.setattr(
        "grader.watch.watch_exercise.__kwdefaults__", {"wait": __import__("time").sleep}
    )

    assert run_command(["watch"]) == 0
    said = capsys.readouterr()
    assert [line for line in said.out.splitlines() if " points, " in line] == [
        "✗ exercise1: 0 of 3 points, not all right yet  (answers.toml)",
        "✗ exercise1: 2.5 of 3 points, not all right yet  (answers.toml)",
        "✓ exercise1: 3 of 3 points, all right  (answers.toml)",
    ]
    assert "cannot be read" in said.err  # half a file, saved on the way
    assert "Waiting for exercises/exercise1/answers.toml to be saved" in said.out
    assert said.out.endswith("Everything here is done.\n")


def test_the_watch_ends_at_once_when_asked(course):
    (one,) = list_exercises(course)
    grades = []

    with pytest.raises(KeyboardInterrupt):
        watch_exercise(one, grade=lambda: grades.append(1) or 1, wait=saves(course))
    assert grades == [1]


def test_a_file_that_is_away_for_a_moment_is_waited_for(course):
    (one,) = list_exercises(course)
    path = one.folder / "answers.toml"
    codes = [1, 1, 0]
    steps = [path.unlink, lambda: answer(course, RIGHT)]

    assert watch_exercise(one, grade=lambda: codes.pop(0), wait=lambda _: steps.pop(0)()) == 0
    assert codes == []


def test_a_grade_can_be_listened_to(course, capsys):
    answer(course, HALF)
    run_command(["1", "--plain"])
    out = capsys.readouterr().out

    assert out.splitlines()[:3] == [
        "not right yet: exercise1: 2.5 of 3 points, not all right yet  (answers.toml)",
        "",
        "right: The size is 3, 2 of 2 points",
    ]
    assert not set("✓✗–") & set(out)
    run_command(["--plain"])
    assert "exercise1, Measure: 2.5 of 3\n" in capsys.readouterr().out


def test_a_finished_exercise_shows_where_the_solution_is(course, capsys):
    answer(course, RIGHT)
    run_command(["1"])
    assert "for comparison" not in capsys.readouterr().out  # a class's package has none
    (course / "solutions" / "exercise1").mkdir(parents=True)
    run_command(["1"])
    assert "A solution, for comparison: solutions/exercise1" in capsys.readouterr().out
    answer(course, HALF)
    run_command(["1"])
    assert "for comparison" not in capsys.readouterr().out


@pytest.mark.usefixtures("course")
def test_the_doctor_finds_this_machine_fit(capsys):
    assert run_command(["doctor"]) == 0
    out = capsys.readouterr().out
    for what in ("Python", "packages", "simulation", "course", "learners' code", "RobotPy"):
        assert what in out
    assert "isolated" in out or "limited" in out


def test_the_doctor_says_what_is_missing_and_what_to_do(course, capsys, monkeypatch):
    monkeypatch.setattr(doctor, "NEEDED", ("numpy", "no-such-package"))
    monkeypatch.setattr(doctor, "ROBOT", ("no-such-robot",))

    assert run_command(["doctor"]) == 1
    out = capsys.readouterr().out
    assert "no-such-package is not installed" in out
    assert 'python -m pip install "ipywidgets' in out
    assert "– RobotPy         no-such-robot is not installed" in out
    assert course.is_dir()
