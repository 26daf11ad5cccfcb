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

LONGEST = 120.0  # [s] for one case
SHOWN = 300  # [characters] of what went wrong
KILOBYTES = 1 if sys.platform == "darwin" else 1024  # [bytes] in which a system counts memory
MEGA = 1e6


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
        process = subprocess.Popen(asked(root / name, command), stdout=out, stderr=err)
        ender = Timer(LONGEST, process.kill)
        ender.start()
        busy, memory = _waited(process)
        ender.cancel()
        seconds = time.perf_counter() - began
        out.seek(0)
        err.seek(0)
        text, problem = (each.read().decode("utf-8", "replace") for each in (out, err))
    try:
        said = json.loads(text)
    except ValueError:
        said = None
        problem = problem or text or f"nothing said within {seconds:.0f} s"
    code = process.returncode
    return Answer(name, said, problem.strip()[-SHOWN:], code, seconds, busy, memory)


def _waited(process: subprocess.Popen[bytes]) -> tuple[float | None, float | None]:
    """Wait for the end: [s] of one core and [MB], where the system counts for each process."""
    if not hasattr(os, "wait4"):  # Windows
        process.wait()
        return None, None
    _, status, took = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return took.ru_utime + took.ru_stime, took.ru_maxrss * KILOBYTES / MEGA


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
