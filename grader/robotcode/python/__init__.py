"""RobotPy programs on the bench: run in a process of their own that reaches nothing else.

    file ──tampering, sandbox_files──▶ a copy ──run_program──▶ child: subject, bench ──JSON──▶ facts

``imports`` serves the fakes of ``grader.robotcode.library`` to the program. A learner's code shares
its process with the bench. What keeps it from forging a run: only the bench knows the nonce that
has to come with the facts, private names of the fakes are out of its reach, and code that could
find the nonce or change a fake is refused before it is run (``tampering``).
"""

import ast
import json
import re
import secrets
import warnings
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

from grader.isolation import Limits, run_program, scratch_folder
from grader.robotcode.bench import find_bench
from grader.robotcode.bench.facts import Outcome, Stop, from_json
from grader.robotcode.bench.simulation import Mount
from grader.robotcode.python.sandbox_files import copy_program
from grader.robotcode.python.tampering import refuse_tampering
from sim.core.errors import UnreadableFile

SECONDS = 10.0  # [s] a run takes about one alone on a machine, and several on one that is busy
LARGEST = 4 * 1024**2  # [bytes] of the facts, and of one file that a program writes
HERE = Path(__file__).parent
ENDED = "the code ends the robot program in the middle of its run"
JAVA = re.compile(r"^[ \t]*(package [\w.]+;|import [\w.]+;|public class )", re.MULTILINE)


def run_python(
    path: Path, kind: str, mounts: Mapping[Any, Mount], *, seconds: float = SECONDS
) -> tuple[Any, ...]:
    """Run a RobotPy program with unknown conditions false, then true if that matters.

    Args:
        path: the learner's file.
        kind: a key of ``bench.BENCHES``.
        mounts: how the task's motors are built in, by the number of their port.
        seconds: after which a program that does not end is ended.

    Returns:
        The facts of each run; whatever the learner's code does is an answer.

    Raises:
        UnreadableFile: it is no Python, or could change what is seen of it.
    """
    _refuse_syntax(path)
    refuse_tampering(path)
    built = [[port, asdict(mount)] for port, mount in mounts.items()]
    orders = {"kind": kind, "mounts": built}
    found = []
    for assume in (False, True):
        facts, undecided = _run_once(path, {**orders, "assume": assume}, seconds)
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
    """The facts of one run, and whether they depend on an unknown condition."""
    kind = find_bench(orders["kind"]).kind
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
            packages=("numpy",),
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
