"""The command `grade`: what it prints, what it keeps, and the exit code it leaves with."""

import json
import os
import subprocess
import sys

import pytest
from places import ROOT
from small_course import HALF, RIGHT, answer

from grader.cli import run_command
from grader.course.progress import Standing
from grader.exercise.exercise import find_exercise
from grader.feedback.report import SPOKEN, find_next_step, format_checks


@pytest.mark.parametrize(
    ("text", "code", "verdict"),
    [
        (RIGHT, 0, "✓ exercise1: 3 of 3 points, all right"),
        (HALF, 1, "✗ exercise1: 2.5 of 3 points, not all right yet"),
        ("size = 1", 1, "✗ exercise1: 0 of 3 points, not all right yet"),
    ],
    ids=["right", "in-part", "wrong"],
)
def test_the_verdict_comes_first_and_the_exit_code_says_the_same(
    course, capsys, text, code, verdict
):
    answer(course, text)

    assert run_command(["exercise1"]) == code
    assert capsys.readouterr().out.startswith(verdict)


def test_feedback_on_a_wrong_answer_shows_the_value_the_reason_and_what_to_try(
    course, capsys, reads
):
    answer(course, "size = 1")
    run_command(["1"])
    out = capsys.readouterr().out

    assert "got  1" in out
    assert "try  Measure again: ≈ ±1 is enough." in out
    reads(out)
    assert max(map(len, out.splitlines())) <= 80
    assert "\x1b" not in out


@pytest.mark.parametrize(
    ("right", "wrong", "verdict"),
    [
        (1, 0, "✓ exercise11: 1 of 39 points, all right so far, {} not answered"),
        (1, 1, "✗ exercise11: 1 of 39 points, not all right, {} not answered"),
        (0, 0, "○ exercise11: 0 of 39 points, nothing answered yet"),
    ],
    ids=["right", "one wrong", "none"],
)
def test_unanswered_question_is_no_mistake(root, tmp_path, right, wrong, verdict):
    file = tmp_path / "answers.toml"
    answers = ['Q0_sysid = ""', *['Q0_guess = "With which gain does"'] * right]
    answers += ['KC2_volts = "x"'] * wrong
    file.write_text("\n".join(answers), "utf-8")
    grade = find_exercise("11", root).grade(file, student="ann")
    lines = ["".join(span.text for span in row) for row in format_checks(grade)]
    signs = [line[0] for line in lines[1:] if line[:1] in {*SPOKEN}]

    assert lines[0].startswith(verdict.format(len(grade.checks) - right - wrong))
    assert (signs.count("✓"), signs.count("✗")) == (right, wrong)
    assert signs.count("○") == 2  # the next question, and how many more there are
    assert not any("nothing yet" in line for line in lines)


def test_json_has_these_keys_and_no_others(course, capsys):
    answer(course, HALF)

    assert run_command(["exercise1", "--student", "Zoë", "--json"]) == 1
    out = capsys.readouterr().out
    result = json.loads(out)

    assert out.isascii()
    assert [*result] == ["exercise", "student", "score", "max_score", "status", "checks"]
    assert result | {"checks": []} == {
        "exercise": "exercise1",
        "student": "Zoë",
        "score": 2.5,
        "max_score": 3,
        "status": "failed",
        "checks": [],
    }
    assert result["checks"][1] == {
        "id": "color",
        "description": "The color is green",
        "status": "failed",
        "points": 0.5,
        "max_points": 1,
        "seen": "blue",
        "hint": "Look again.",
        "misconception": "",
    }


def test_error_in_the_grader_is_not_blamed_on_the_learner(course, capsys, reads):
    answer(course, 'size = "boom"')

    assert run_command(["exercise1", "--json"]) == 2
    out, err = capsys.readouterr()
    result = json.loads(out)

    assert result["status"] == "ungradable"
    assert [check["status"] for check in result["checks"]] == ["error", "not-reached"]
    assert err.count("\n") == 1
    reads(err)


def test_an_exercise_that_breaks_is_our_fault_and_says_how_to_see_more(
    course, capsys, monkeypatch, reads
):
    (course / "exercises" / "exercise1" / "checks.py").write_text("1 / 0", "utf-8")

    assert run_command(["exercise1"]) == 2
    err = capsys.readouterr().err
    assert err.count("\n") == 1
    reads(err)

    monkeypatch.setenv("SYSID_TRACEBACK", "1")
    with pytest.raises(ZeroDivisionError):
        run_command(["exercise1"])


@pytest.mark.parametrize(
    "arguments",
    [
        ["exercise2"],
        ["exrcise1"],
        ["exercise1", "nowhere.toml"],
        ["exercise1", "lessons"],
        ["--json"],
        ["--hint"],
        ["exercise1", "--color"],
        ["exercise1", "a", "b"],
        ["exercise1", "--student", "a/b"],
        ["exercise1", "--student", "a\\b"],
        ["exercise1", "--student", " "],
        ["exercise1", "--student", "x" * 65],
        ["exercise1", "--student", "a\x07"],
    ],
)
@pytest.mark.usefixtures("course")
def test_a_command_that_cannot_be_done_prints_one_line_and_leaves_with_code_2(
    capsys, arguments, reads
):
    assert run_command(arguments) == 2
    out, err = capsys.readouterr()

    assert out == ""
    assert err.startswith("grade: ")
    assert err.count("\n") == 1
    reads(err)


@pytest.mark.parametrize(
    "text",
    [
        "size = 0,5",
        "color = 1\nsize =",
        "size is 3",
        "size = 3\ncolor = 1\nsize = 3\n",
        "size = 3\n[more]\nsize = [4,5]\n size=[4,5]",
        "size = 3\n[more]\nsize = 4 4\n",
        "",
        " \n\n",
        "size = 3\0",
    ],
)
def test_an_answer_file_that_cannot_be_read_names_the_line(course, capsys, text, reads):
    answer(course, text)

    assert run_command(["exercise1"]) == 2
    reads(capsys.readouterr().err)


@pytest.mark.parametrize("name", ["exercise1", "exercise01", "Exercise1", "ex1", "1", "exercise 1"])
def test_an_exercise_is_known_by_its_name_or_number(course, name):
    answer(course, RIGHT)

    assert run_command([name]) == 0


@pytest.mark.parametrize(("word", "meant"), [("startt", "grade start"), ("wach", "grade watch")])
def test_a_mistyped_command_is_no_exercise(course, capsys, word, meant):  # noqa: ARG001 - its folder
    assert run_command([word]) == 2
    assert f"Did you mean '{meant}'? See 'grade --help'." in capsys.readouterr().err


def test_a_file_may_be_a_folder_or_any_file(course):
    elsewhere = course / "mine"
    elsewhere.mkdir()
    (elsewhere / "anything.toml").write_text(RIGHT, "utf-8")

    assert run_command(["exercise1", "mine"]) == 0
    assert run_command(["exercise1", str(elsewhere / "anything.toml")]) == 0
    assert run_command(["exercise1"]) == 1


@pytest.mark.parametrize("issued", [False, True], ids=["self-study", "class"])
@pytest.mark.parametrize(
    ("given", "said"),
    [
        ("b.ipynb", "b.ipynb: this file cannot be handed in for this exercise. Hand in answers."),
        ("README.md", "README.md: this file cannot be handed in for this exercise. Hand in "),
        ("exercises", "exercises: answers.toml is missing. Name the file itself."),
        ("exercises/starters.toml", "cannot be handed in for this exercise. Hand in answers.toml."),
    ],
)
def test_a_file_that_is_no_answer_is_refused(course, capsys, given, said, issued):
    (course / "exercises" / "starters.toml").write_text('a = "0"\n', encoding="utf-8")
    for name in ("b.ipynb", "README.md"):
        (course / name).write_text("kaputt", encoding="utf-8")
    if issued:
        checks = course / "exercises" / "exercise1" / "checks.py"
        text = checks.read_text(encoding="utf-8")
        checks.write_text(f"{text}\n\ndef make_files(student):\n    return {{}}\n", "utf-8")
        (course / ".course").mkdir()
        (course / ".course" / "class.toml").write_text('class = "A"\nstudent = "me"\n', "utf-8")

    assert run_command(["exercise1", given]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert said in err


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16"])
def test_files_saved_by_windows_editors_are_read(course, encoding):
    path = course / "exercises" / "exercise1" / "answers.toml"
    path.write_bytes(RIGHT.encode(encoding))

    assert run_command(["exercise1"]) == 0


@pytest.mark.usefixtures("course")
def test_hints_come_one_by_one_and_then_all_again(capsys, reads):
    shown = []
    for _ in range(5):
        assert run_command(["exercise1", "--hint"]) == 0
        shown.append(capsys.readouterr().out)

    assert shown[3] == shown[4]
    for text in shown[:4]:
        reads(text)


def test_grade_without_a_name_shows_progress_and_the_next_step(course, capsys, reads):
    assert run_command([]) == 0
    reads(capsys.readouterr().out)
    answer(course, RIGHT)
    run_command(["exercise1"])
    capsys.readouterr()
    assert run_command([]) == 0
    reads(capsys.readouterr().out)


@pytest.mark.parametrize(
    ("standings", "step"),
    [
        ({}, ("lessons/00_guess_or_measure.ipynb", "")),
        ({"exercise11": "tried"}, ("lessons/01_motor_model.ipynb", "")),
        ({"exercise11": "tried", "exercise1": "tried"}, ("", "exercise1")),
        ({"exercise11": "tried", "exercise1": "done"}, ("", "exercise2")),
        (
            {"exercise11": "tried", "exercise1": "done", "exercise2": "done"},
            ("lessons/02_gravity.ipynb", ""),
        ),
        (
            dict.fromkeys(("exercise1", "exercise2", "exercise3", "exercise4", "exercise5"), "done")
            | dict.fromkeys(("exercise11", "exercise6"), "tried"),
            ("lessons/05_preflight_and_run.ipynb", ""),
        ),
        (
            {f"exercise{number}": "done" for number in range(1, 11)} | {"exercise11": "tried"},
            ("", "exercise11"),
        ),
        (
            {f"exercise{number}": "done" for number in range(1, 7)},
            ("lessons/06_read_the_data.ipynb", ""),
        ),
        ({"exercise1": "done", "exercise3": "tried"}, ("", "exercise2")),
    ],
    ids=[
        *("new", "lesson 0", "half", "the second", "lesson 2", "part (b)", "the rest of 11"),
        *("lesson 0 passed over", "an exercise passed over"),
    ],
)
def test_the_next_step_is_one_lesson_or_one_exercise(root, standings, step):
    score = {"done": 2.0, "tried": 1.0}
    names = [f"exercise{number}" for number in range(1, 13)]
    found = {name: Standing() for name in names} | {
        name: Standing(score[how], 2.0) for name, how in standings.items()
    }

    assert find_next_step(root, found) == step


def grade(*arguments, cwd, **environment):
    return subprocess.run(
        [sys.executable, "-m", "grader", *arguments],
        cwd=cwd,
        env={**os.environ, "PYTHONPATH": str(ROOT), **environment},
        capture_output=True,
        check=False,
        timeout=120,
    )


@pytest.mark.parametrize("encoding", ["ascii", "cp1252", "utf-8"])
def test_symbol_that_the_terminal_lacks_becomes_ascii(course, encoding):
    answer(course, "size = 1")
    done = grade("1", cwd=course, PYTHONIOENCODING=encoding)
    out = done.stdout.decode(encoding)

    assert done.returncode == 1
    assert out.startswith("✗ exercise1" if encoding == "utf-8" else "x exercise1")
    assert {"ascii": "~ +-1", "cp1252": "~ ±1", "utf-8": "≈ ±1"}[encoding] in out


def test_help_imports_nothing_heavy():
    code = (
        "import sys; from grader.cli import run_command; "
        "run_command(['--help']); print(*sorted(sys.modules))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )

    assert "grade [EXERCISE [FILE]]" in done.stdout
    assert not {"numpy", "scipy", "rich", "numba", "tomlkit"} & set(done.stdout.split())


def test_a_closed_output_pipe_causes_no_traceback(course):
    writer = subprocess.Popen(
        [sys.executable, "-m", "grader"],
        cwd=course,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
    writer.stdout.close()
    _, err = writer.communicate(timeout=60)

    assert err == b""


@pytest.mark.usefixtures("course")
def test_hints_are_counted_for_each_student(capsys):
    run_command(["exercise1", "--hint"])
    run_command(["exercise1", "--hint", "--student", "ann"])

    assert capsys.readouterr().out.count("Hint 1 of 3") == 2
