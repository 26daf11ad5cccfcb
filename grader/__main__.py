"""``python -m grader``: installs what is missing in a fresh clone, then runs ``grade``.

    python -m grader start             once, to begin
    python -m grader test              the course's own tests, but for the slow ones
    python -m grader test --all        all of them; other options are pytest's
    python -m grader exercise4         the same as: grade exercise4

This file uses nothing but Python's own library, and even an old Python can read it far enough to
say that it is too old.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from importlib.metadata import PackageNotFoundError, distribution
from importlib.util import find_spec
from pathlib import Path

from grader.setup.exec_process import INTERRUPTED, run_process

OLDEST, NEWEST = (3, 11), (3, 14)  # the newest for which every package has a wheel
OURS = "sysid-course"
ROOT = Path(__file__).resolve().parent.parent
HOPPED = "SYSID_COURSE_ENVIRONMENT"  # set in the second process, so that it cannot make a third
INSTALLED = "SYSID_COURSE_INSTALLED"  # the same for an installation that does not help
SIZE, SIZE_TO_TEST = "780 MB", "1.1 GB"  # on the disk, measured on Linux
LAST = 6  # lines of pip's complaint that are worth reading
COULD_NOT = 2
EVERYTHING = (  # all tests, a file at a time on each core, in the order of tests/conftest.py
    *("-n", "logical"),
    *("--dist", "loadscope"),
    "--no-loadscope-reorder",
)


def main(arguments: list[str]) -> int:
    """Run a command of the course, after installing the packages that it needs.

    Args:
        arguments: what came after ``python -m grader``.

    Returns:
        The exit code.
    """
    if sys.version_info < OLDEST:
        return _give_up(
            f"this is Python {sys.version.split()[0]}, and the course needs 3.11 or newer",
            "Get one from python.org, and start the course with it.",
        )
    try:
        if not find_missing_packages(arguments[:1]):
            return _run_command(arguments)
        if not (ROOT / "pyproject.toml").is_file():
            from sim.support.extras import format_install_command  # noqa: PLC0415 - an old Python must get as far as being told

            names = ", ".join(find_missing_packages(arguments[:1]))
            return _give_up(f"{names} not installed", format_install_command("course"))
        if is_in_environment() or HOPPED in os.environ:
            return _install_and_run(arguments)
        return _run_in_environment(arguments)
    except KeyboardInterrupt:
        return INTERRUPTED


def find_missing_packages(command: list[str]) -> list[str]:
    """What has to be installed before a command can run: names of packages.

    Args:
        command: the command's name alone, or nothing.
    """
    wanted = _read_requirements(testing=command == ["test"])
    if command in (["start"], ["test"]):
        wanted.append(OURS)  # lessons and tests run elsewhere, where only that finds us
    names = []
    for name in wanted:
        try:
            distribution(name)
        except PackageNotFoundError:
            names.append(name)
    return names


def _read_requirements(*, testing: bool) -> list[str]:
    """The packages pyproject.toml asks for; those only some machines need are pip's business."""
    import tomllib  # noqa: PLC0415 - an old Python has none, and must get as far as being told

    try:
        project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    except FileNotFoundError:  # an installed copy: pip saw to what it needs
        return []
    extras = project["optional-dependencies"]
    asked = [*project["dependencies"], *extras["course"], *extras["fast"]]
    if testing:
        asked += extras["test"]
    names = [re.match(r"[\w.-]+", one) for one in asked if ";" not in one]
    return [name[0] for name in names if name and name[0] != OURS]


def is_in_environment() -> bool:
    """Whether this Python is one's own to install into: a virtual or a named conda environment."""
    prefix = Path(sys.prefix)
    conda = (prefix / "conda-meta").is_dir() and not (prefix / "condabin").is_dir()
    return sys.prefix != sys.base_prefix or conda


def _run_command(arguments: list[str]) -> int:
    """Everything is there: run the command itself."""
    if arguments[:1] == ["test"]:
        chosen = {(): (*EVERYTHING, "-m", "not slow"), ("--all",): EVERYTHING}
        options = chosen.get(tuple(arguments[1:]), arguments[1:])
        command = [sys.executable, "-m", "pytest", *options]
        return run_process(command, cwd=ROOT)
    from grader.cli import run_command as grade  # noqa: PLC0415 - needs what may not be installed yet

    return grade(arguments)


def _run_in_environment(arguments: list[str]) -> int:
    """Go on in the course's own environment; make it if it is not there."""
    folder = ROOT / ".venv"
    python = folder / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    if not python.exists():
        problem = _make_environment(folder)
        if problem:
            return _give_up(*problem)
    environment = dict(os.environ, **{HOPPED: "1"})
    return run_process([str(python), "-m", "grader", *arguments], env=environment)


def _make_environment(folder: Path) -> tuple[str, str] | None:
    """Make a virtual environment; the problem and the advice if that does not work."""
    if find_spec("venv") is None or find_spec("ensurepip") is None:
        return (
            "this Python cannot make virtual environments",
            "On Debian and Ubuntu: sudo apt install python3-venv. Then try again.",
        )
    if folder.exists() and not (folder / "pyvenv.cfg").is_file() and any(folder.iterdir()):
        return f"{folder} is there already, but it is not a virtual environment", "Move it away."
    _print_line(f"Making a place for the course's packages: {folder}")
    made = _run_quietly([sys.executable, "-m", "venv", "--clear", str(folder)])
    return (f"no virtual environment could be made: {made}", "") if made else None


def _install_and_run(arguments: list[str]) -> int:
    names = find_missing_packages(arguments[:1])
    if INSTALLED in os.environ:
        return _give_up(
            f"{', '.join(names)} is still missing after installing",
            f"Try by hand: {sys.executable} -m pip install -e '{ROOT}[course]'",
        )
    problem = _install(testing=arguments[:1] == ["test"])
    if problem:
        return _give_up(*problem)
    _print_line("Installed.")
    environment = dict(os.environ, **{INSTALLED: "1"})
    return run_process([sys.executable, "-m", "grader", *arguments], env=environment)


def _install(*, testing: bool) -> tuple[str, str] | None:
    """Install the course into this Python; the problem and the advice if that does not work."""
    size = SIZE_TO_TEST if testing else SIZE
    _print_line(f"Installing what the course needs: up to {size}, which may take a few minutes ...")
    if find_spec("pip") is None:
        _run_quietly([sys.executable, "-m", "ensurepip"])
    what = ".[test]" if testing else ".[course]"
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    said = _run_quietly([*pip, "-e", what], cwd=ROOT)
    if not said:
        return None
    _print_line(said)
    if sys.version_info[:2] > NEWEST:
        said = sys.version.split()[0]
        return (
            f"pip could not install the course: some packages have no wheel for Python {said} yet",
            "Use Python {}.{}, then run the same command again.".format(*NEWEST),
        )
    return (
        "pip could not install the course; the last lines of its output are above",
        "Is this machine online, and is there room on the disk? Then run the same command again.",
    )


def _run_quietly(command: list[str], *, cwd: Path | None = None) -> str:
    """Run a command; the last lines of its error output if it failed, else an empty text."""
    done = subprocess.run(  # noqa: S603 - our own arguments, no shell
        command, cwd=cwd, capture_output=True, text=True, errors="replace", check=False
    )
    if not done.returncode:
        return ""
    lines = (done.stdout + done.stderr).strip().splitlines()
    telling = [line for line in lines if re.match(r"\s*(ERROR|error|\w*Error)\b", line)]
    return "\n".join((telling or lines)[-LAST:]) or f"exit code {done.returncode}"


def _give_up(what: str, advice: str) -> int:
    _print_line(f"grade: {what}. {advice}".rstrip())
    return COULD_NOT


def _print_line(text: str) -> None:
    print(text, file=sys.stderr, flush=True)  # noqa: T201 - a command speaks


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
