"""``grade doctor``: what this machine has, and what is missing for which part of the course."""

import importlib.util
import os
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from grader.isolation import find_isolation_level
from sim.support.extras import format_install_command

OLDEST = (3, 11)
NEEDED = ("numpy", "matplotlib", "jupyterlab", "ipywidgets", "tree-sitter")
ROBOT = ("wpilib", "robotpy-commands-v2")


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
    yield _check_packages()
    yield _check_engine()
    yield _check_writing(course)
    yield _check_terminal()
    yield _check_isolation()
    yield _check_container()
    yield _check_robot()
    yield _check_dask()


def _check_python() -> MachineFinding:
    said = ".".join(map(str, sys.version_info[:3]))
    least = ".".join(map(str, OLDEST))
    right = sys.version_info[:2] >= OLDEST
    return MachineFinding("Python", said, right, advice=f"Install Python {least} or newer.")


def _check_packages() -> MachineFinding:
    lacking = [name for name in NEEDED if _find_version(name) is None]
    found = f"{', '.join(lacking)} missing" if lacking else "all installed"
    advice = format_install_command("course")
    return MachineFinding("packages", found, not lacking, advice=advice)


def _find_version(name: str) -> str | None:
    try:
        return version(name)
    except PackageNotFoundError:
        return None


def _check_engine() -> MachineFinding:
    from sim.physics.engine import engine_can_compile, engine_is_cached  # noqa: PLC0415 - beside its use

    if not engine_can_compile():
        advice = (
            f"The simulation works, but slowly. To make it fast: {format_install_command('fast')}"
        )
        return MachineFinding(
            "simulation", "not compiled: Numba is missing", right=False, needed=False, advice=advice
        )
    ready = engine_is_cached()
    found = "compiled" if ready else "not compiled yet; the first simulation takes twenty seconds"
    return MachineFinding(
        "simulation", found, ready, needed=False, advice="grade start compiles it."
    )


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


def _check_robot() -> MachineFinding:
    there = [f"{name} {_find_version(name)}" for name in ROBOT if _find_version(name)]
    right = len(there) == len(ROBOT)
    advice = f"For the simulated robot program of lesson 5: {format_install_command('robot')}"
    return MachineFinding(
        "RobotPy", ", ".join(there) or "not installed", right, needed=False, advice=advice
    )


def _check_dask() -> MachineFinding:
    right = importlib.util.find_spec("distributed") is not None
    found = f"distributed {_find_version('distributed')}" if right else "not installed"
    advice = f"To grade on more than one machine: {format_install_command('cluster')}"
    return MachineFinding("cluster", found, right, needed=False, advice=advice)
