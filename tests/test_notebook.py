"""Answers from a notebook: the same result as from the file, and the same file afterwards."""

import json
import subprocess
import sys
import tomllib

import numpy as np
import pytest
from page_flaws import page_flaws
from small_course import HALF, RIGHT, answer, lay_out

from grader import ExerciseQuestions, submit
from grader.cli import run_command
from grader.course.progress import load_progress
from grader.exercise.exercise import find_exercise
from grader.feedback.report import COLORS
from grader.notebook.submit import write_answers
from sim.core.errors import BadRequest

STARTER = '# Measure it.\nsize = ""  # in units\ncolor = "" # a word\n'
PAGE = "<!DOCTYPE html><html lang='en'><head><title>t</title></head><body>{}</body></html>"


@pytest.fixture
def course(tmp_path, monkeypatch):
    """A small course, in whose folder the notebook runs."""
    lay_out(tmp_path)
    monkeypatch.chdir(tmp_path)
    answer(tmp_path, STARTER)
    return tmp_path


def text_of(course):
    return (course / "exercises" / "exercise1" / "answers.toml").read_text("utf-8")


def test_answers_go_into_the_file_and_its_comments_stay(course):
    shown = submit("exercise1", size=3, color="blue")

    assert text_of(course) == '# Measure it.\nsize = 3  # in units\ncolor = "blue" # a word\n'
    assert (shown.grade.score, shown.grade.status) == (2.5, "failed")
    submit(1, COLOR="green")
    assert 'color = "green" # a word' in text_of(course)
    assert load_progress(course)[0].find_standing("me", "exercise1").is_done


@pytest.fixture
def exercise12(all_exercises):
    """A copy of the exercise that asks for effects, each with parameters of its own."""
    return find_exercise("exercise12", all_exercises)


def test_parameters_of_an_effect_go_below_its_name(exercise12):
    effects = {"effects": ["delay", "velocity-filter"], "velocity_filter": {"lag": "20 ms"}}
    write_answers(exercise12, effects | {"delay": {"lag": np.float64(0.02)}, "gap_before": 6.5})
    write_answers(exercise12, {"delay": {"lag": 0.03}})
    text = (exercise12.folder / "answers.toml").read_text("utf-8")

    assert "# with gains alone" in text
    assert "delay.lag = 0.03\n" in text
    assert 'velocity-filter.lag = "20 ms"\n' in text
    assert tomllib.loads(text)["effects"] == effects["effects"]


@pytest.mark.parametrize(
    ("answers", "said"),
    [
        ({"delay": 0.03}, 'Write it in this form: delay={"lag": 0.03}'),
        ({"gap_before": {"lag": 1}}, "Write it in this form: gap_before=0.03"),
        ({"delai": {"lag": 1}}, "Did you mean delay?"),
        ({"delay": {"lag": object()}}, "cannot be written down"),
    ],
)
def test_invalid_parameter_of_an_effect_is_refused(exercise12, answers, said):
    before = (exercise12.folder / "answers.toml").read_text("utf-8")

    with pytest.raises(BadRequest) as refused:
        write_answers(exercise12, answers)
    assert said in str(refused.value)
    assert (exercise12.folder / "answers.toml").read_text("utf-8") == before


@pytest.fixture
def questions(all_exercises):  # noqa: ARG001 - its folder
    """Two questions of exercise 11 as buttons, in a course of its own."""
    return ExerciseQuestions("exercise11", "Q0_guess", "Q0_brace")


def test_buttons_write_the_letter_of_the_chosen_option(questions, tmp_path):
    _, _, brace, gains, button, graded = questions._box.children
    gains.value = next(letter for text, letter in gains.options if text == "kA")
    button.click()
    written = tomllib.loads((tmp_path / "exercises/exercise11/answers.toml").read_text("utf-8"))

    assert "a steel brace" in brace.value
    assert written["Q0_brace"] == gains.value
    assert written["Q0_guess"] == ""
    assert "1 of 39 points, all right so far" in graded.value
    assert "a steel brace" in questions._repr_mimebundle_()["text/plain"]


def test_buttons_without_a_course_say_what_is_missing(tmp_path):
    alone = ExerciseQuestions("exercise11", "Q0_guess", course=tmp_path)
    button, said = alone._box.children

    assert button.disabled
    assert "there is no exercise" in said.value


@pytest.mark.usefixtures("all_exercises")
def test_a_cell_counts_what_is_not_answered_yet():
    shown = submit(11, Q0_guess="With which gain does")
    count = len(shown.grade.checks)

    assert f"all right so far, {count - 1} not answered" in shown.html
    assert f"{count - 2} more not answered yet" in shown.html
    assert COLORS["red"] not in shown.html


@pytest.mark.parametrize("text", [RIGHT, HALF, "size = 1\n"])
def test_notebook_and_file_get_the_same_grade(course, capsys, text):
    answer(course, text)
    shown = submit("exercise1")
    run_command(["1", "--json"])
    by_command = json.loads(capsys.readouterr().out)

    assert [one.points for one in shown.grade.checks] == [
        one["points"] for one in by_command["checks"]
    ]
    run_command(["1"])
    said = capsys.readouterr().out
    assert said.startswith(f"{shown}\n")  # the terminal goes on with what is next


@pytest.mark.parametrize("size", [3, 3.0, np.float64(3), np.int32(3), np.array(3), np.array([3])])
@pytest.mark.usefixtures("course")
def test_number_of_numpy_counts_as_an_answer(size):
    assert submit(1, size=size, color="green").grade.status == "passed"


@pytest.mark.parametrize(
    ("answers", "said"),
    [
        ({"colour": "green"}, "asks for no 'colour'. Did you mean color?"),
        ({"size": object()}, "cannot be written down"),
        ({"size": np.array([3, 4])}, "cannot be written down"),
    ],
)
def test_invalid_answer_is_refused_and_the_file_stays_unchanged(course, answers, said):
    shown = submit(1, **answers)

    assert said in str(shown)
    assert said.split(".")[0].replace("'", "&#x27;") in shown.html
    assert shown.grade is None
    assert text_of(course) == STARTER


@pytest.mark.parametrize(
    ("exercise", "said"), [("exercise7", "there is no exercise"), ("1", "cannot be read")]
)
def test_answer_that_cannot_be_graded_gets_one_line(course, exercise, said):
    answer(course, "size = [\n")

    assert said in str(submit(exercise))
    assert "Traceback" not in str(submit(exercise))


def test_a_cell_shows_marks_as_words_too_and_escapes_what_was_given(course):
    shown = submit(1, size="<b>7</b>")
    bundle = shown._repr_mimebundle_()

    assert page_flaws(PAGE.format(bundle["text/html"])) == []
    assert "not right yet" in bundle["text/html"]
    assert "&lt;b&gt;7&lt;/b&gt;" in bundle["text/html"]
    assert bundle["text/plain"] == str(shown)
    assert course.is_dir()


@pytest.mark.usefixtures("all_exercises")
def test_a_file_of_code_is_graded_as_it_stands():
    assert submit(4).grade.status == "failed"
    assert "is answered in ExampleSubsystem.java or" in str(submit(4, ramp=0.5))


def test_answers_of_a_class_package_get_a_receipt_and_no_grade(course):
    checks = course / "exercises" / "exercise1" / "checks.py"
    checks.write_text(
        checks.read_text("utf-8") + "\ndef make_files(student):\n    return {}\n", encoding="utf-8"
    )
    place = course / ".course"
    place.mkdir()
    (place / "class.toml").write_text('class = "East"\nstudent = "me"\n', "utf-8")
    shown = submit(1, size=3)

    assert "1 of 2 answered" in str(shown)
    assert "only your instructor can grade" in str(shown)
    assert shown.grade is None
    assert submit(1, "practice").grade is not None


def test_the_package_itself_imports_nothing():
    code = "import sys; import grader; print(*sorted(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)

    assert not {"numpy", "tomlkit", "click", "rich"} & set(done.stdout.split())
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        __import__("grader").nothing  # noqa: B018 - asking is the test
