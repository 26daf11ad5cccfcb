"""``grade start``: where you stand, your own data, and the first lesson in JupyterLab."""

import importlib.util
import os
import shutil
import sys
import sysconfig
from pathlib import Path

from grader.course import Progress
from grader.draw_cache import draw_cache_enabled
from grader.exec_process import INTERRUPTED, run
from grader.exercise import exercises
from grader.report import overview
from grader.terminal import line, show
from sim.core.errors import BadRequest
from sim.physics.engine import engine_is_cached, load_engine
from sim.support.command_line import COULD_NOT, DONE

# Nothing leaves the machine: no news, no look for updates, no catalogue of extensions. And no chat.
QUIET = (
    "--LabApp.news_url=None",
    "--LabApp.check_for_updates_class=jupyterlab.handlers.announcements.NeverCheckForUpdate",
    "--LabApp.extension_manager=readonly",
    "--log-level=ERROR",
)


def start(course: Path, progress: Progress, *, student: str, lab: bool) -> int:
    """Show where a learner stands, make their data, and open the first lesson.

    Args:
        course: the course folder.
        progress: what is known of the learner.
        student: who.
        lab: whether to open JupyterLab.

    Returns:
        The exit code.

    Raises:
        BadRequest: JupyterLab is wanted, and is not installed.
    """
    found = exercises(course)
    show([line("Welcome to the SysId course.", "bold"), line()])
    show([*overview(course, found, progress, student=student), line()])
    sys.stdout.flush()
    if not engine_is_cached():
        _say("Compiling the simulation, once; this takes about twenty seconds…")
        load_engine()
    with draw_cache_enabled():  # what is drawn now, the first answer need not wait for
        for one in found:
            one.prepare(student, say=_say)
    command = "grade"
    if not _on_path(command):
        command = "python -m grader"
        if sys.prefix != sys.base_prefix:
            _say(f"To type grade and sysid in this terminal:  {activation(Path(sys.prefix))}")
        _say(f"Without that, type  {command} exercise4  for  grade exercise4")
    lessons = sorted((course / "lessons").glob("*.ipynb"))
    if not lab:
        place = lessons[0].relative_to(course).as_posix() if lessons else "exercises"
        _say(f"Ready. Begin with {place}; to open it in JupyterLab:  {command} start")
        return 0
    return _open_lab(course, lessons[0] if lessons else course)


def activation(prefix: Path, *, windows: bool = os.name == "nt") -> str:
    """What to type to make a virtual environment's commands known to a terminal."""
    place = prefix.relative_to(Path.cwd()) if prefix.is_relative_to(Path.cwd()) else prefix
    return rf"{place}\Scripts\activate" if windows else f"source {place}/bin/activate"


def _on_path(command: str) -> bool:
    return shutil.which(command) is not None


def as_root() -> tuple[str, ...]:
    """Jupyter refuses the administrator unless told; in a container there is nobody else."""
    return ("--allow-root",) if hasattr(os, "geteuid") and os.geteuid() == 0 else ()


def _open_lab(course: Path, what: Path) -> int:
    if importlib.util.find_spec("jupyterlab") is None:
        raise BadRequest(
            "JupyterLab is not installed",
            advice="Install it (python -m pip install jupyterlab), or: grade start --no-lab",
        )
    place = what.relative_to(course).as_posix()
    _say("Opening JupyterLab in your browser. To end it: Ctrl-C here, twice.")
    sys.stdout.flush()
    scripts = sysconfig.get_path("scripts")
    paths = os.pathsep.join(part for part in (scripts, os.environ.get("PATH", "")) if part)
    root = f"--ServerApp.root_dir={course}"  # else it shows the lessons' folder alone
    command = [sys.executable, "-m", "jupyterlab", *QUIET, *as_root(), root, place]
    code = run(command, cwd=course, env={**os.environ, "PATH": paths})
    return DONE if code in {DONE, INTERRUPTED} else COULD_NOT


def _say(text: str) -> None:
    show([line(text)])
    sys.stdout.flush()
