"""RobotPy programs on the bench: run in a process of their own that reaches nothing else.

    file ──tampering, sandbox_files──▶ a copy ──run_program──▶ child: subject, bench ──JSON──▶ facts

``imports`` serves the fakes of ``grader.robotcode.library`` to the program, or ``wpilib_backend``
lets RobotPy run in WPILib's own simulation, where all that a program imports is installed. A
learner's code shares its process with the bench. What keeps it from forging a run: only the bench
knows the nonce that has to come with the facts, private names of the fakes are out of its reach,
and code that could find the nonce or change WPILib is refused before it is run (``tampering``).
"""

import ast
import importlib
import json
import re
import secrets
import sys
import typing
import warnings
from collections.abc import Mapping
from dataclasses import asdict
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from grader.isolation import Limits, run_program, scratch_folder
from grader.robotcode.bench.facts import Outcome, Stop, from_json
from grader.robotcode.bench.simulation import Mount
from grader.robotcode.python.sandbox_files import copy_program
from grader.robotcode.python.tampering import PACKAGES, list_foreign_imports, refuse_tampering
from sim.core.errors import UnreadableFile

SECONDS = 10.0  # [s] a run takes about one alone on a machine, and several on one that is busy
LARGEST = 4 * 1024**2  # [bytes] of the facts, and of one file that a program writes
BENCHES = {  # what is looked at: the bench, whose ``run`` gives the facts
    "routine": "routine_run.RoutineBench",
    "buttons": "button_run.ButtonBench",
    "gains": "gains_run.GainsBench",
}
HERE = Path(__file__).parent
ENDED = "the code ends the robot program in the middle of its run"
FAKES_ONLY = re.compile(r"\b(TimedRobot|TimedCommandRobot|MotorControllerGroup)\b")
"""What WPILib's simulation keeps to itself: a loop of its own, and motors that it drives alone."""
JAVA = re.compile(r"^[ \t]*(package [\w.]+;|import [\w.]+;|public class )", re.MULTILINE)


def is_robotpy_installed() -> bool:
    """Whether RobotPy is installed."""
    return all(find_spec(name) is not None for name in ("wpilib", "commands2"))


def find_bench(kind: str) -> type[Any]:
    """The bench of a kind of run."""
    module, name = BENCHES[kind].split(".")
    return getattr(importlib.import_module(f"grader.robotcode.bench.{module}"), name)  # type: ignore[no-any-return]


def run_python(
    path: Path,
    kind: str,
    mounts: Mapping[Any, Mount],
    *,
    robotpy: bool | None = None,
    seconds: float = SECONDS,
) -> tuple[Any, ...]:
    """Run a RobotPy program, with what nobody knows assumed false, then true if that matters.

    Args:
        path: the learner's file.
        kind: a key of ``BENCHES``.
        mounts: how the task's motors are built in, by the number of their port.
        robotpy: whether RobotPy itself runs it; None for where that is possible and known to show
            the same.
        seconds: after which a program that does not end is ended.

    Returns:
        The facts of each run; whatever the learner's code does is an answer.

    Raises:
        UnreadableFile: it is no Python, or could change what is seen of it.
    """
    _refuse_syntax(path)
    refuse_tampering(path)
    if robotpy is None:
        robotpy = kind == "routine" and is_robotpy_installed()
        robotpy = robotpy and not FAKES_ONLY.search(path.read_text("utf-8-sig", "replace"))
        robotpy = robotpy and list_foreign_imports(path) <= PACKAGES | sys.stdlib_module_names
    built = [[port, asdict(mount)] for port, mount in mounts.items()]
    orders = {"kind": kind, "mounts": built, "robotpy": robotpy}
    found = []
    for assume in (False, True):
        facts, undecided = _run_once(path, {**orders, "assume": assume}, seconds)
        if robotpy and facts.stop is not None and facts.stop.outcome is Outcome.CANNOT:
            return run_python(path, kind, mounts, robotpy=False, seconds=seconds)
        found.append(facts)
        if not undecided:
            break
    return tuple(found)


def _refuse_syntax(path: Path) -> None:
    text = path.read_text("utf-8-sig", "replace")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # a doubtful escape is the learner's own affair
            compile(text, str(path), "exec", ast.PyCF_ONLY_AST)
    except SyntaxError as error:
        said, line = f"this is not Python: {error.msg.partition(';')[0]}", error.lineno or 1
        if JAVA.search(text):
            said = "this is Java, and a .py file must contain Python"
    except (RecursionError, MemoryError, ValueError):
        said, line = "the code is nested deeper than Python itself can read", 1
    else:
        return
    raise UnreadableFile(
        said,
        where=f"{path}, line {max(line, 1)}",
        advice="Fix that line first: code with a mistake like this does not run.",
    )


def _run_once(path: Path, orders: dict[str, Any], seconds: float) -> tuple[Any, bool]:
    """The facts of one run, and whether they depend on what nobody knows."""
    kind = typing.get_type_hints(find_bench(orders["kind"]).run)["return"]
    nonce = secrets.token_hex(16)
    with scratch_folder() as place:
        folder, given = place / "left", place / "given"
        folder.mkdir()
        orders |= {"path": str(copy_program(path, given)), "root": str(given)}
        ended, said = run_program(
            HERE / "start_child.py",
            [json.dumps(orders)],
            folder=folder,
            given=given,
            packages=sorted(PACKAGES),
            beside=(HERE / "child.py",),
            limits=Limits(seconds=seconds, file=LARGEST, prints=LARGEST),
            stdin=nonce,
        )
    stop = Stop(Outcome.CRASHED, "start", ENDED)
    if not ended:
        stop = Stop(Outcome.ENDLESS, "start", f"it does not end within {seconds:g} s")
    try:
        signed, _, text = said.decode().partition(" ")
        if signed == nonce:
            result = json.loads(text)
            return from_json(kind, result["facts"]), bool(result["undecided"])
    except (TypeError, AttributeError, KeyError, ValueError, RecursionError):
        stop = Stop(Outcome.CRASHED, "start", "the run leaves no result that can be read")
    return kind(language="python", name=path.stem, stop=stop), False
