"""A name in a file of answers that is not asked for gets a warning, and costs nothing."""

import base64
import json
import tomllib

import pytest
from click.testing import CliRunner
from places import ROOT
from small_course import lay_out

from grader.answers.answer_names import find_similar_name, find_unknown_names
from grader.cli import grade as command
from grader.cli import run_command
from grader.exercise.exercise import find_exercise, list_exercises
from grader.notebook.submit import submit

ANSWERED_IN_TOML = [one for one in list_exercises(ROOT) if one.files == ("answers.toml",)]
GAINS = ("kS", "kV", "kA")
MISSPELLED = 'size = 3\ncolour = "green"\n'
SAID = (
    "answers.toml, line 2: exercise1 does not ask for colour, so this line does not count. "
    "Did you mean color?"
)


def starter(one):
    return (one.folder / "answers.toml").read_text("utf-8")


def warnings(text, known=GAINS):
    answers = tomllib.loads(text)
    return find_unknown_names(answers, known, text=text, file="a.toml", exercise="exercise9")


UNKNOWN = "exercise9 does not ask for"
IGNORED = "so this line does not count"
ANSWERED = "That name already has an answer: keep the right one"
TABLE = "[gains] starts a table, and nothing below it counts. Delete the line with [gains]"
TWICE = "kv is the same name as kV, and only the last one counts. Delete the other one"


@pytest.mark.parametrize(
    ("text", "where", "why"),
    [
        ("kS = 1\nks_ = 2\n", ", line 2", f"{UNKNOWN} ks_, {IGNORED}. Did you mean kS? {ANSWERED}"),
        ('kV = ""\n\nkVv = 2\n', ", line 3", f"{UNKNOWN} kVv, {IGNORED}. Did you mean kV?"),
        ("g = 9.81\n", ", line 1", f"{UNKNOWN} g, {IGNORED}. exercise9 asks for kS, kV, kA"),
        ("k.V = 2\n", ", line 1", f"{UNKNOWN} k.V, {IGNORED}. Did you mean kV?"),
        ("[gains]\nkS = 1\n", ", line 1", TABLE),
        ("kS = 1\n[kV]\nkA = 2\n", ", line 2", TABLE.replace("gains", "kV")),
        ('kV = 2.1\nkv = ""\n', ", line 2", TWICE),
        ('"k\\u0056x" = 2\n', "", f"{UNKNOWN} kVx, {IGNORED}. Did you mean kV?"),
    ],
    ids=[
        "answered",
        "misspelled",
        "extra",
        "dotted",
        "table",
        "table of a name",
        "twice",
        "escaped",
    ],
)
def test_a_name_that_does_not_count_is_named_with_its_line(text, where, why):
    assert warnings(text) == (f"a.toml{where}: {why}",)


def test_upper_and_lower_case_are_the_same_name():
    assert warnings("ks = 1\nKV = 2\nka = 3\n") == ()


def test_file_of_another_exercise_gets_few_warnings():
    found = warnings("".join(f"reading_{number} = 1\n" for number in range(50)))

    assert len(found) == 6
    assert found[-1] == "a.toml: more names do not count. Correct these first"


def test_a_very_long_name_is_shortened_and_compared_quickly():
    (said,) = warnings(f"{'k' * 1900} = 1\n")

    assert len(said) < 160
    assert find_similar_name("k" * 100_000, ["kV"]) == ""


@pytest.mark.parametrize("one", ANSWERED_IN_TOML, ids=lambda one: one.name)
def test_a_starter_gets_no_warning_and_each_misspelled_name_of_it_gets_one(one, tmp_path):
    path = tmp_path / "answers.toml"
    right = starter(one)
    path.write_text(right, encoding="utf-8")

    assert one.answer_names
    assert one.find_unknown_names(path) == ()
    for name in tomllib.loads(right):
        path.write_text(right.replace(f"\n{name} = ", f"\n{name}z = "), encoding="utf-8")
        (said,) = one.find_unknown_names(path)

        assert f"does not ask for {name}z, so this line does not count" in said
        assert f"Did you mean {name}?" in said
        assert said.startswith("answers.toml, line ")


def test_an_effect_may_be_written_with_either_sign_and_a_misspelled_one_is_named(tmp_path):
    one = find_exercise("exercise12", ROOT)
    path = tmp_path / "answers.toml"
    path.write_text("velocity-filter.lag = 0.02\nvelocity_filter.lag = 0.02\n", encoding="utf-8")
    assert one.find_unknown_names(path) == ()

    path.write_text("dealy.lag = 0.03\n", encoding="utf-8")
    (said,) = one.find_unknown_names(path)
    assert "does not ask for dealy.lag" in said


@pytest.fixture
def course(tmp_path):
    """A course of one small exercise, whose answer has a misspelled name."""
    lay_out(tmp_path / "course")
    folder = tmp_path / "course" / "exercises" / "exercise1"
    checks = (folder / "checks.py").read_text("utf-8")
    files = 'FILES = ("answers.toml",)\n'
    checks = checks.replace(files, f'{files}ANSWER_NAMES = ("size", "color")\n')
    (folder / "checks.py").write_text(checks, encoding="utf-8")
    (folder / "answers.toml").write_text(MISSPELLED, encoding="utf-8")
    return tmp_path / "course"


def test_the_command_prints_an_unknown_name_under_the_verdict_and_in_its_json(course, monkeypatch):
    monkeypatch.chdir(course)
    shown = CliRunner().invoke(command, ["exercise1"]).output.splitlines()
    told = json.loads(CliRunner().invoke(command, ["exercise1", "--json"]).output)

    assert shown[1].startswith("  note  answers.toml, line 2: exercise1 does not ask for colour")
    assert told["score"] == 2.5
    assert told["warnings"] == [SAID]


def test_a_notebook_shows_the_warning_and_proposes_a_name(course):
    assert SAID in submit("exercise1", course=course).html
    assert "Did you mean color?" in str(submit("exercise1", course=course, colour="green"))


def test_a_class_gets_an_unknown_name_on_the_students_page_and_in_exports(
    course, tmp_path, monkeypatch
):
    (tmp_path / "in" / "ann").mkdir(parents=True)
    (tmp_path / "in" / "ann" / "answers.toml").write_text(MISSPELLED, encoding="utf-8")
    monkeypatch.chdir(course)
    out = tmp_path / "out"
    exports = ["--export", "gradescope", "--export", "github"]
    run_command(["class", str(tmp_path / "in"), "-o", str(out), *exports])
    (page,) = (out / "students").glob("*.html")
    (gradescope,) = (out / "gradescope").rglob("results.json")
    (github,) = (out / "github").glob("*.txt")
    line = base64.b64decode(github.read_text("ascii").removeprefix("result="))

    assert SAID in page.read_text("utf-8")
    assert json.loads(gradescope.read_text("utf-8"))["output"] == f"exercise1: {SAID}"
    assert json.loads(line)["tests"][0]["output"].startswith(SAID)
