"""`grade start`: where one stands first, then the data, then JupyterLab."""

import io
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from grader import exec_process
from grader import start as starting
from grader.cli import run_command
from grader.course import load_progress

MAKER = '''
"""An exercise with data of its own."""
from grader.check import check
FILES = ("answers.toml",)

def make_files(student):
    print(f"made for {student}")
    return {}

@check(points=1)
def anything(_):
    """Anything will do."""
'''


class Lab:
    """What stands in for JupyterLab: it notes how it was started, and ends as told."""

    ends: tuple = (0,)
    command: tuple = ()
    place = ""
    path = ""

    def __init__(self, command, cwd, env):
        Lab.command, Lab.place, Lab.path = tuple(command), Path(cwd), env["PATH"]
        self.waits = iter(Lab.ends)

    def wait(self):
        """The next thing that happens: an exit code, or Ctrl-C."""
        end = next(self.waits)
        if isinstance(end, type):
            raise end
        return end


@pytest.fixture
def course(tmp_path, monkeypatch):
    """A course with one lesson and one exercise, and a JupyterLab that opens no window."""
    folder = tmp_path / "exercises" / "exercise1"
    folder.mkdir(parents=True)
    (folder / "checks.py").write_text(MAKER, "utf-8")
    (folder / "README.md").write_text("# Exercise 1: Measure\n", "utf-8")
    (tmp_path / "lessons").mkdir()
    for name in ("01_motor.ipynb", "00_guess.ipynb"):
        (tmp_path / "lessons" / name).write_text("{}", "utf-8")
    monkeypatch.chdir(tmp_path)
    for name in starting.IN_JUPYTER:
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(exec_process.subprocess, "Popen", Lab)
    monkeypatch.setattr(Lab, "ends", (0,))
    monkeypatch.setattr(Lab, "command", ())
    return tmp_path


def test_start_shows_what_is_there_before_it_makes_anything(course, capsys):
    assert run_command(["start", "--no-lab", "--student", "ann"]) == 0
    out = capsys.readouterr().out

    assert course.is_dir()
    assert out.startswith("Welcome to the SysId course.")
    assert "0 of 1 exercises done (ann)" in out
    assert "lessons/00_guess.ipynb" in out
    assert out.index("not tried yet") < out.index("made for ann") < out.index("Ready.")
    assert out.endswith("Next: do exercises/exercise1/README.md\n")
    assert out.count("Next:") == 1
    assert Lab.command == ()


def test_who_one_is_is_remembered(course, capsys):
    run_command(["start", "--no-lab", "--student", "ann"])
    run_command(["start", "--no-lab"])
    capsys.readouterr()

    assert load_progress(course)[0].student == "ann"
    assert run_command([]) == 0
    assert "(ann)" in capsys.readouterr().out


class Keyboard(io.StringIO):
    """What somebody types on a terminal."""

    def isatty(self):
        """It is a terminal."""
        return True


@pytest.mark.parametrize(("typed", "name"), [("ann\n", "ann"), ("\n", "me"), ("a/b\nann\n", "ann")])
def test_the_first_start_on_a_terminal_asks_for_the_name(course, monkeypatch, capsys, typed, name):
    monkeypatch.setattr(sys, "stdin", Keyboard(typed))

    assert run_command(["start"]) == 0
    assert f"made for {name}\n" in capsys.readouterr().out
    assert load_progress(course)[0].student == name


@pytest.mark.parametrize("arguments", [["--no-lab"], ["--student", "ann"]])
@pytest.mark.usefixtures("course")
def test_a_script_or_a_second_start_asks_nothing(monkeypatch, arguments):
    monkeypatch.setattr(sys, "stdin", Keyboard(""))  # a question would find its end

    assert run_command(["start", *arguments]) == 0
    run_command(["start", "--no-lab", "--student", "ann"])
    assert run_command(["start"]) == 0


@pytest.mark.parametrize("variable", starting.IN_JUPYTER)
def test_inside_jupyter_it_changes_the_name_and_opens_nothing(
    course, monkeypatch, capsys, variable
):
    monkeypatch.setenv(variable, "1")

    assert run_command(["start", "--student", "ada"]) == 0
    assert Lab.command == ()
    assert load_progress(course)[0].student == "ada"
    assert "Your name is ada here." in capsys.readouterr().out


@pytest.mark.usefixtures("course")
def test_a_notebook_cell_is_asked_nothing(monkeypatch, capsys):
    monkeypatch.setattr(sys, "stdin", Keyboard(""))
    monkeypatch.setenv("JPY_PARENT_PID", "1")

    assert run_command(["start"]) == 0
    assert "Your name is me here." in capsys.readouterr().out


def test_the_list_of_files_shows_each_lesson_once_and_no_solutions(course):
    run_command(["start"])
    hidden = [part.partition("hide_globs=")[2] for part in Lab.command if "hide_globs" in part]

    assert course.is_dir()
    assert {"00_guess.py", "01_motor.py", "solutions", "__pycache__"} <= {*hidden}


def test_jupyterlab_opens_the_first_lesson_and_keeps_to_itself(course):
    assert run_command(["start"]) == 0

    assert Lab.command[:3] == (sys.executable, "-m", "jupyterlab")
    assert {
        "--LabApp.default_url=/lab/tree/lessons/00_guess.ipynb",
        "--LabApp.news_url=None",
        "--LabApp.check_for_updates_class=jupyterlab.handlers.announcements.NeverCheckForUpdate",
        "--LabApp.extension_manager=readonly",
        f"--ServerApp.root_dir={course}",
    } <= set(Lab.command)
    assert Lab.place == course


def test_commands_of_this_environment_are_found_in_its_terminals(course):
    run_command(["start"])
    scripts = Path(Lab.path.split(os.pathsep, maxsplit=1)[0])

    assert course.is_dir()
    assert any(scripts.glob("python*"))


@pytest.mark.parametrize(
    ("ends", "code"),
    [((0,), 0), ((KeyboardInterrupt, 0), 0), ((KeyboardInterrupt, -2), 0), ((3,), 2)],
    ids=["closed", "Ctrl-C", "Ctrl-C twice", "broken"],
)
@pytest.mark.usefixtures("course")
def test_start_ends_without_a_message_when_jupyterlab_ends(monkeypatch, capsys, ends, code):
    monkeypatch.setattr(Lab, "ends", ends)

    assert run_command(["start"]) == code
    assert capsys.readouterr().err == ""


def test_ctrl_c_before_jupyterlab_is_quiet_too(course, capsys):
    path = course / "exercises" / "exercise1" / "checks.py"
    path.write_text(
        MAKER.replace('print(f"made for {student}")', "raise KeyboardInterrupt"), "utf-8"
    )

    assert run_command(["start"]) == 130
    assert capsys.readouterr().err.strip() == ""


@pytest.mark.usefixtures("course")
def test_without_jupyterlab_it_says_how_to_get_it(monkeypatch, capsys):
    find = starting.importlib.util.find_spec
    monkeypatch.setattr(
        starting.importlib.util,
        "find_spec",
        lambda name, *more: None if name == "jupyterlab" else find(name, *more),
    )

    assert run_command(["start"]) == 2
    assert "python -m pip install jupyterlab" in capsys.readouterr().err


def test_without_lessons_it_opens_the_course_itself(course):
    for lesson in (course / "lessons").glob("*.ipynb"):
        lesson.unlink()

    assert run_command(["start"]) == 0
    assert "--LabApp.default_url=/lab" in Lab.command


@pytest.mark.usefixtures("course")
def test_where_grade_cannot_be_typed_it_says_what_to_type(monkeypatch, capsys):
    monkeypatch.setattr(starting, "_is_on_path", lambda _command: False)
    monkeypatch.setattr(starting.sys, "prefix", str(Path.cwd() / ".venv"))
    run_command(["start", "--no-lab"])
    out = capsys.readouterr().out

    assert str(starting.describe_activation(Path(".venv"))) in out
    assert "python -m grader exercise4" in out


def test_each_system_is_told_its_own_way_to_activate():
    place = Path("elsewhere") / ".venv"

    assert starting.describe_activation(place, windows=False) == f"source {place}/bin/activate"
    assert starting.describe_activation(place, windows=True) == rf"{place}\Scripts\activate"


def test_jupyterlab_does_not_ask_whether_to_fetch_news():
    settings = pytest.importorskip("jupyterlab_server.settings_utils")
    folder = Path(starting.__file__).with_name("lab_settings")
    found, problem = settings._get_overrides(str(folder))  # as JupyterLab reads them

    assert found["@jupyterlab/apputils-extension:notification"]["fetchNews"] == "false"
    assert problem == ""


def test_jupyterlab_knows_the_settings_that_keep_it_quiet():
    pytest.importorskip("jupyterlab")
    done = subprocess.run(
        [sys.executable, "-m", "jupyterlab", *starting.QUIET, "--show-config-json"],
        capture_output=True,
        text=True,
        check=True,
    )
    told = json.loads(done.stdout[done.stdout.index("{") :])["LabApp"]

    assert str(told["news_url"]) == "None"
    assert told["extension_manager"] == "readonly"
    assert "NeverCheckForUpdate" in str(told["check_for_updates_class"])
