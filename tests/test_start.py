"""grade start: a course's folder, the first screen, JupyterLab."""

import io
import json
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from grader.cli import run_command
from grader.course import course_folder
from grader.course.course_folder import find_course_source, unpack_course
from grader.course.progress import load_progress
from grader.setup import exec_process
from grader.setup import start as starting
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.errors import BadRequest
from sim.core.log import Log, Run
from sim.inspect.detect_faults import inspect
from sim.inspect.faults import FAULTS
from sim.inspect.launch import find_launch_event, find_step_start
from sim.inspect.log_features import LogFeatures

MAKER = '''
"""An exercise with data of its own."""
from grader.checks.check import check
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


def test_start_shows_the_files_before_it_writes_any(course, capsys):
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


def test_name_of_the_student_is_remembered(course, capsys):
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
def test_start_inside_jupyter_changes_the_name_and_opens_nothing(
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


def test_jupyterlab_opens_the_first_lesson_and_checks_for_no_updates(course):
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
def test_start_without_jupyterlab_says_how_to_install_it(monkeypatch, capsys):
    find = starting.importlib.util.find_spec
    monkeypatch.setattr(
        starting.importlib.util,
        "find_spec",
        lambda name, *more: None if name == "jupyterlab" else find(name, *more),
    )

    assert run_command(["start"]) == 2
    assert "python -m pip install jupyterlab" in capsys.readouterr().err


def test_start_without_lessons_opens_the_course_itself(course):
    for lesson in (course / "lessons").glob("*.ipynb"):
        lesson.unlink()

    assert run_command(["start"]) == 0
    assert "--LabApp.default_url=/lab" in Lab.command


@pytest.mark.usefixtures("course")
def test_start_says_what_to_type_where_grade_is_not_on_the_path(monkeypatch, capsys):
    monkeypatch.setattr(starting, "_is_on_path", lambda _command: False)
    monkeypatch.setattr(starting.sys, "prefix", str(Path.cwd() / ".venv"))
    run_command(["start", "--no-lab"])
    out = capsys.readouterr().out

    assert str(starting.describe_activation(Path(".venv"))) in out
    assert "python -m grader exercise4" in out


def test_each_system_gets_its_own_way_to_activate():
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


TIME = np.arange(0.0, 2.5, 0.005)
PLAIN = 3.0 * (1.0 - np.exp(-TIME / 0.15))


def run_of(speed, *, volts=6.0, noise=0.0):
    """A forward step whose speed is given; position and velocity are of it."""
    shaken = speed + noise * np.random.default_rng(2).standard_normal(speed.size)
    steps = np.concatenate(([0.0], 0.005 * np.cumsum(0.5 * (speed[1:] + speed[:-1]))))
    volts = np.broadcast_to(np.asarray(volts, dtype=float), TIME.shape)
    return Run("dynamic-forward", TIME, volts, steps, shaken)


def dented(depth, *, at=0.3, wide=0.05):
    return PLAIN * (1.0 - depth * np.exp(-0.5 * ((TIME - at) / wide) ** 2))


def waiting():
    """Up to 80 % at once, on from there after 0.4 s: the two speeds of wheels and robot."""
    wheels = 0.8 * 3.0 * (1.0 - np.exp(-TIME / 0.03))
    robot = 3.0 - 0.6 * np.exp(-np.maximum(TIME - 0.4, 0.0) / 0.1)
    return np.where(TIME < 0.4, wheels, robot)


def test_plain_rise_is_no_launch_event():
    assert find_launch_event(run_of(PLAIN)) is None


@pytest.mark.parametrize("noise", [0.0, 0.3])
def test_speed_that_falls_and_recovers_is_a_launch_event(noise):
    event = find_launch_event(run_of(dented(0.4), noise=noise))

    assert event.kind == "fall"
    assert event.size == pytest.approx(0.26, abs=0.04)  # 2.12 m/s, then 1.56 m/s
    assert TIME[event.end] == pytest.approx(0.3, abs=0.05)


def test_speed_that_pauses_in_its_rise_is_a_launch_event():
    event = find_launch_event(run_of(waiting()))

    assert event.kind == "wait"
    assert event.size == pytest.approx(0.2, abs=0.03)
    assert 0.2 < TIME[event.end] < 0.45


NO_EVENTS = {
    "a small fall": lambda: run_of(dented(0.1)),
    "a fall that the voltage explains": lambda: run_of(
        dented(0.4), volts=6.0 - 3.0 * (np.abs(TIME - 0.27) < 0.08)
    ),
    "a fall as there are later, too": lambda: run_of(
        PLAIN * (1.0 - 0.3 * (np.sin(9.0 * TIME) ** 8))
    ),
    "slack that is taken up": lambda: run_of(
        PLAIN + 0.7 * np.exp(-0.5 * ((TIME - 0.01) / 0.004) ** 2)
    ),
    "a load that goes on to change": lambda: run_of(PLAIN * (0.8 + 0.12 * TIME)),
    "no launch to speak of": lambda: replace(
        Run("dynamic-forward", TIME[:150], np.full(150, 6.0), PLAIN[:150], PLAIN[:150])
    ),
    "standstill": lambda: run_of(np.zeros(TIME.size)),
}


@pytest.mark.parametrize("why", NO_EVENTS)
def test_ordinary_run_has_no_launch_event(why):
    assert find_launch_event(NO_EVENTS[why]()) is None


def test_a_step_begins_where_its_voltage_stays():
    volts = np.where(TIME < 1.0, 0.0, 6.0)
    volts[0] = 6.0  # what the test before left behind

    assert TIME[find_step_start(run_of(PLAIN, volts=volts))] == pytest.approx(1.0)


def test_only_wheels_on_a_floor_slip():
    event = run_of(dented(0.4))

    def found(**about):
        return list(FAULTS["wheel-slip"].detect(LogFeatures(Log((event,), **about))))

    (slip,) = found(units="meters")
    assert "half the step, 3.0 V" in slip.advice
    assert found(units="radians", mechanism="Drivetrain")
    assert not found(units="radians")
    assert not found(units="meters", type="elevator")


@pytest.mark.parametrize("seed", range(8))
def test_sound_simulated_starts_have_no_launch_event(seed):
    rng = np.random.default_rng(seed)
    period = (0.02, 0.005)[seed % 2]
    log = simulate(MECHANISMS["drivetrain"].draw(rng), Routine(), rng=rng, period=period)

    assert [find_launch_event(run) for run in log.runs if run.kind == "dynamic"] == [None, None]
    assert inspect(log).is_clean


def test_the_course_is_unpacked_as_it_was_written(root, tmp_path):
    target = tmp_path / "my course"

    assert unpack_course(target)
    tops = {path.name for path in target.iterdir()}
    assert tops == {"LICENSE", "README.md", "pyproject.toml", "exercises", "lessons"}
    task = "exercises/exercise4/README.md"
    assert (target / task).read_bytes() == (root / task).read_bytes()
    assert not list(target.rglob("data"))
    assert not unpack_course(target)  # what a learner wrote there stays


def test_existing_files_are_left_alone(tmp_path):
    (tmp_path / "diary.txt").write_text("mine", encoding="utf-8")
    for taken in (tmp_path, tmp_path / "diary.txt"):
        with pytest.raises(BadRequest, match="Name a folder that is empty or new"):
            unpack_course(taken)


def test_a_folder_that_cannot_be_written_is_refused(tmp_path, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(course_folder, "write_atomically", full)

    with pytest.raises(BadRequest, match="No space left on device"):
        unpack_course(tmp_path / "course")


def test_an_installation_without_the_course_says_so(tmp_path, monkeypatch):
    monkeypatch.setattr(course_folder, "INSTALLATION", tmp_path)

    with pytest.raises(BadRequest, match="contains no lessons or exercises"):
        find_course_source()


def test_course_of_an_installed_wheel_is_found_in_site_packages(tmp_path, monkeypatch):
    for name in ("exercises", "lessons"):
        (tmp_path / "sysid_course" / name).mkdir(parents=True)
    monkeypatch.setattr(course_folder, "INSTALLATION", tmp_path)

    assert find_course_source() == tmp_path / "sysid_course"


def test_the_command_refuses_in_one_line(tmp_path, monkeypatch, capsys):
    (tmp_path / "taken").mkdir()
    (tmp_path / "taken" / "diary.txt").write_text("mine", encoding="utf-8")
    monkeypatch.chdir(tmp_path)

    assert run_command(["start", "taken", "--no-lab"]) == 2
    said = capsys.readouterr().err
    assert said.startswith("grade: taken: this place already holds something else.")
    assert said.count("\n") == 1


def test_start_outside_of_a_course_says_how_to_make_one(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("grader.course.progress.__file__", str(tmp_path / "grader" / "course.py"))

    assert run_command(["exercise4"]) == 2
    assert "grade start my-course" in capsys.readouterr().err
