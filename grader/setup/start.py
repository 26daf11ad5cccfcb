"""``grade start``: where you stand, your own data, and the first lesson in JupyterLab."""

import importlib.util
import os
import shutil
import sys
import sysconfig
from pathlib import Path
from urllib.parse import quote

from grader.course.learner import Learner
from grader.exercise.exercise import list_exercises
from grader.feedback.report import find_next_step, format_next_step, format_overview, read_exercises
from grader.feedback.terminal import print_lines, style_line
from grader.setup.exec_process import INTERRUPTED, run_process
from grader.student_data.draw_cache import enable_draw_cache
from sim.core.errors import BadRequest
from sim.physics.engine import load_engine
from sim.support.command_line import COULD_NOT, DONE

# Nothing leaves the machine: no news, no look for updates, no catalogue of extensions. And no chat.
# The folder of settings answers JupyterLab's question about news, which would cover the lesson.
QUIET = (
    f"--LabApp.app_settings_dir={Path(__file__).with_name('lab_settings')}",
    "--LabApp.news_url=None",
    "--LabApp.check_for_updates_class=jupyterlab.handlers.announcements.NeverCheckForUpdate",
    "--LabApp.extension_manager=readonly",
    "--log-level=ERROR",
)
IN_JUPYTER = ("JUPYTER_SERVER_URL", "JPY_PARENT_PID")  # of its terminals; of its kernels
# Jupyter's own, and ours
HIDDEN = ("__pycache__", "*.pyc", "*.pyo", ".DS_Store", "*~", "solutions")


def is_in_jupyter() -> bool:
    """Whether this process runs inside Jupyter, in its terminal or in a notebook."""
    return any(name in os.environ for name in IN_JUPYTER)


def start(learner: Learner, *, lab: bool) -> int:
    """Show where a learner stands, make their data, and open the first lesson.

    Args:
        learner: who, and where.
        lab: whether to open JupyterLab.

    Returns:
        The exit code.

    Raises:
        BadRequest: JupyterLab is wanted, and is not installed.
    """
    course = learner.course
    print_lines([style_line("Welcome to the SysId course.", "bold"), style_line()])
    print_lines([*format_overview(learner), style_line()])
    sys.stdout.flush()
    load_engine()  # what is compiled now, the first lesson need not wait for
    with enable_draw_cache():  # what is drawn now, the first answer need not wait for
        for one in list_exercises(course):
            one.prepare(learner.name, say=_print_line)
    command = "grade"
    if is_in_jupyter():
        _print_line(f"Your name is {learner.name} here. JupyterLab is open already: stay in it.")
        print_lines(format_next_step(learner))
        return DONE
    if not _is_on_path(command):
        command = "python -m grader"
        if sys.prefix != sys.base_prefix:
            _print_line(
                "To type grade and sysid in this terminal:  "
                f"{describe_activation(Path(sys.prefix))}"
            )
        _print_line(f"Without that, type  {command} exercise4  for  grade exercise4")
    if lab:
        lesson, exercise = find_next_step(course, learner.standings)
        return _open_lab(course, course / lesson if lesson else _find_last_lesson(course, exercise))
    _print_line(f"Ready. To work in JupyterLab:  {command} start")
    print_lines(format_next_step(learner))
    return DONE


def _find_last_lesson(course: Path, exercise: str) -> Path:
    """The file to open next to an exercise: the last lesson that names it, or the course folder."""
    lessons = sorted((course / "lessons").glob("*.ipynb"))
    there = [one for one in lessons if exercise in read_exercises(one)]
    return there[-1] if there else lessons[0] if lessons else course


def describe_activation(prefix: Path, *, windows: bool = os.name == "nt") -> str:
    """What to type to make a virtual environment's commands known to a terminal."""
    place = prefix.relative_to(Path.cwd()) if prefix.is_relative_to(Path.cwd()) else prefix
    return rf"{place}\Scripts\activate" if windows else f"source {place}/bin/activate"


def _is_on_path(command: str) -> bool:
    return shutil.which(command) is not None


def choose_root_option() -> tuple[str, ...]:
    """Jupyter's option to run as root, if this process is root; else none."""
    return ("--allow-root",) if hasattr(os, "geteuid") and os.geteuid() == 0 else ()


def _open_lab(course: Path, what: Path) -> int:
    if importlib.util.find_spec("jupyterlab") is None:
        raise BadRequest(
            "JupyterLab is not installed",
            advice="Install it (python -m pip install jupyterlab), or: grade start --no-lab",
        )
    place = what.relative_to(course).as_posix()
    _print_line("To end JupyterLab later: press Ctrl-C here, twice.")
    _print_line(f"Next: read {place} in your browser, which opens now.")
    sys.stdout.flush()
    scripts = sysconfig.get_path("scripts")
    paths = os.pathsep.join(part for part in (scripts, os.environ.get("PATH", "")) if part)
    address = "/lab" if what == course else f"/lab/tree/{quote(place)}"
    command = [
        *(sys.executable, "-m", "jupyterlab", *QUIET, *choose_root_option()),
        f"--ServerApp.root_dir={course}",
        f"--LabApp.default_url={address}",  # what the browser opens, and the terminal shows
        *(f"--ContentsManager.hide_globs={name}" for name in _list_hidden_names(course)),
    ]
    code = run_process(command, cwd=course, env={**os.environ, "PATH": paths})
    return DONE if code in {DONE, INTERRUPTED} else COULD_NOT


def _list_hidden_names(course: Path) -> list[str]:
    """What JupyterLab's list of files leaves out: solutions, and a lesson's second file."""
    lessons = sorted((course / "lessons").glob("*.ipynb"))
    return [*HIDDEN, *(lesson.with_suffix(".py").name for lesson in lessons)]


def _print_line(text: str) -> None:
    print_lines([style_line(text)])
    sys.stdout.flush()
