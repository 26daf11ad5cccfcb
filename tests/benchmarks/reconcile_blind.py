"""Solve cases without their answers: one ``sysid reconcile`` for each, in a process of its own.

    python tests/benchmarks/reconcile_blind.py FOLDER --out ANSWERS.json [--jobs 2]

Knows of a case what a team knows: three logs, the base type, the travel. Knows nothing of the
project either: Python's own library, and the command.
"""

import argparse
import json
import os
import shlex
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path
from threading import Timer
from typing import IO

LONGEST = 120.0  # [s] for one case
SHOWN = 300  # [characters] of what went wrong
KILOBYTES = 1 if sys.platform == "darwin" else 1024  # [bytes] in which a system counts memory
MEGA = 1e6
COUNT = """
import os, signal, subprocess, sys
from threading import Timer
process = subprocess.Popen(sys.argv[3:])
ender = Timer(float(sys.argv[1]), os.kill, (process.pid, signal.SIGKILL))
ender.start()
_, status, took = os.wait4(process.pid, 0)
ender.cancel()
code = os.waitstatus_to_exitcode(status)
with open(sys.argv[2], "w", encoding="utf-8") as report:
    print(code, took.ru_utime + took.ru_stime, took.ru_maxrss, file=report)
"""


@dataclass(frozen=True)
class Answer:
    """What the command said of a case.

    Args:
        case: its folder's name.
        said: the command's JSON; None if there was none.
        problem: what it said instead.
        code: its exit code; negative if it was ended.
        seconds: [s] by the clock, the whole process.
        busy: [s] of one core; None where the system does not count.
        memory: [MB] at most; None where the system does not count.
    """

    case: str
    said: dict[str, object] | None
    problem: str
    code: int
    seconds: float
    busy: float | None
    memory: float | None


def asked(folder: Path, command: Sequence[str]) -> list[str]:
    """What to run for the case in a folder."""
    known = json.loads((folder / "case.json").read_text(encoding="utf-8"))
    words = [*command, str(folder / "train.csv"), "--validation", str(folder / "validation.csv")]
    words += ["--held-out", str(folder / "test.csv"), "--type", known["type"]]
    if known["travel"]:
        words += ["--travel", str(known["travel"])]
    return [*words, "--json"]


def solve(name: str, *, root: Path, command: Sequence[str]) -> Answer:
    """Run the command on one case.

    Args:
        name: of the case's folder.
        root: where it is.
        command: how to call ``sysid reconcile``.
    """
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        began = time.perf_counter()
        code, busy, memory = _run(asked(root / name, command), out=out, err=err)
        seconds = time.perf_counter() - began
        out.seek(0)
        err.seek(0)
        text, problem = (each.read().decode("utf-8", "replace") for each in (out, err))
    try:
        said = json.loads(text)
    except ValueError:
        said = None
        problem = problem or text or f"nothing said within {seconds:.0f} s"
    return Answer(name, said, problem.strip()[-SHOWN:], code, seconds, busy, memory)


def _run(
    command: Sequence[str], *, out: IO[bytes], err: IO[bytes]
) -> tuple[int, float | None, float | None]:
    """Run to the end: the exit code, [s] of one core and [MB], where the system counts those.

    A new process counts the memory of the one that forked it as its own, so a small one stands
    between.
    """
    counts = hasattr(os, "wait4")  # Windows does not
    between = [sys.executable, "-S", "-c", COUNT, str(LONGEST)] if counts else []
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "took"
        if counts:
            between.append(str(report))
        process = subprocess.Popen([*between, *command], stdout=out, stderr=err)
        ender = Timer(LONGEST + counts, process.kill)
        ender.start()
        process.wait()
        ender.cancel()
        if not report.exists():
            return process.returncode, None, None
        code, busy, memory = report.read_text(encoding="utf-8").split()
    return int(code), float(busy), float(memory) * KILOBYTES / MEGA


def folders(root: Path) -> list[str]:
    """The names of all cases under a folder."""
    return sorted(path.parent.relative_to(root).as_posix() for path in root.rglob("case.json"))


def main() -> None:
    """Solve all cases of a folder and write the answers."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--command", default="sysid reconcile")
    given = parser.parse_args()
    names = folders(given.folder)
    work = partial(solve, root=given.folder, command=shlex.split(given.command))
    answers = []
    with ThreadPoolExecutor(given.jobs) as pool:
        for done, answer in enumerate(pool.map(work, names), start=1):
            answers.append(asdict(answer))
            if sys.stderr.isatty():
                print(f"\r{done} of {len(names)} cases", end="", file=sys.stderr, flush=True)
    given.out.write_text(json.dumps(answers, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
