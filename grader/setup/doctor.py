"""``grade doctor``: the equipment of this machine, and what each part of the course lacks."""

import os
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from grader.isolation import find_isolation_level
from sim.support.extras import format_install_command

OLDEST = (3, 11)
NEEDED = ("numpy", "matplotlib", "jupyterlab", "ipywidgets", "tree-sitter")
ROBOT = ("wpilib", "robotpy-commands-v2")
CLUSTER = ("distributed",)


@dataclass(frozen=True)
class MachineFinding:
    """One finding about this machine.

    Args:
        what: it is.
        found: how it is.
        needed: whether the course cannot do without; False for what only some of it needs.
        right: whether it is as it should be.
        advice: what to do where it is not.
    """

    what: str
    found: str
    right: bool
    needed: bool = True
    advice: str = ""


def examine_machine(course: Path) -> Iterator[MachineFinding]:
    """Examine this machine, one finding after another.

    Args:
        course: the course folder.
    """
    yield _check_python()
    install = format_install_command("course")
    yield _check_packages("packages", NEEDED, advice=install, needed=True)
    yield _check_engine()
    yield _check_writing(course)
    yield _check_terminal()
    yield _check_isolation()
    yield _check_container()
    install = format_install_command("robot")
    advice = f"For the simulated robot program of lesson 5: {install}"
    yield _check_packages("RobotPy", ROBOT, advice=advice)
    advice = f"To grade on more than one machine: {format_install_command('cluster')}"
    yield _check_packages("cluster", CLUSTER, advice=advice)


def _check_python() -> MachineFinding:
    said = ".".join(map(str, sys.version_info[:3]))
    least = ".".join(map(str, OLDEST))
    right = sys.version_info[:2] >= OLDEST
    return MachineFinding("Python", said, right, advice=f"Install Python {least} or newer.")


def _check_packages(
    what: str, names: Sequence[str], *, advice: str, needed: bool = False
) -> MachineFinding:
    """Whether packages are installed, and their versions."""
    found = []
    for name in names:
        try:
            found.append(f"{name} {version(name)}")
        except PackageNotFoundError:
            return MachineFinding(
                what, f"{name} is not installed", right=False, needed=needed, advice=advice
            )
    return MachineFinding(what, ", ".join(found), right=True, needed=needed)


def _check_engine() -> MachineFinding:
    from sim.physics.engine import engine_can_compile, engine_is_cached  # noqa: PLC0415 - beside its use

    ready, advice = engine_is_cached(), "grade start compiles it."
    found = "compiled" if ready else "not compiled yet; the first simulation takes twenty seconds"
    if not engine_can_compile():
        ready, found = False, "not compiled: Numba is missing"
        install = format_install_command("fast")
        advice = f"The simulation works, but slowly. To make it fast: {install}"
    return MachineFinding("simulation", found, ready, needed=False, advice=advice)


def _check_writing(course: Path) -> MachineFinding:
    right = all(os.access(place, os.W_OK) for place in (course, course / "exercises"))
    found = f"{course}, {'writable' if right else 'not writable'}"
    return MachineFinding("course", found, right, advice="Copy the course to a folder of your own.")


def _check_terminal() -> MachineFinding:
    encoding = (sys.stdout.encoding or "ascii").lower()
    right = encoding.replace("-", "") == "utf8"
    advice = "This terminal shows letters for signs such as ✓. To see the signs: set PYTHONUTF8=1"
    return MachineFinding("terminal", encoding, right, needed=False, advice=advice)


def _check_isolation() -> MachineFinding:
    found = find_isolation_level()
    right = found.startswith("isolated")
    advice = (
        "This is enough for your own answers. To grade the code of a class, use Linux or a "
        "container: grade class --in docker. Elsewhere, code of others is not run."
    )
    return MachineFinding("learners' code", found, right, needed=False, advice=advice)


def _check_container() -> MachineFinding:
    from grader.classroom.container import BUILD, find_engines  # noqa: PLC0415 - beside its use

    there = find_engines()
    found = f"{' and '.join(there)} found" if there else "neither docker nor podman is running"
    advice = (
        "For grade class --in docker: install Docker or Podman, start it, and in the course "
        f"folder: {BUILD.format(engine='docker')}"
    )
    return MachineFinding("container", found, bool(there), needed=False, advice=advice)
