"""How long a learner waits for `grade`: whole processes, best and median of several.

    python tests/benchmarks/bench_grade.py [times]

Aims: help within 0.2 s, answers that are only read within 0.4 s, exercise 9 within 1.5 s: with a
function that fits five logs in a process of its own. Exercises 7, 8 and 12 are read, too, but the
logs they are held against have to be drawn once more, since no key is kept where a learner could
find it: half a second goes to the start of the compiled engine, and for 7 and 8 what is drawn has
to show again that it can be solved. Processor time is the median, and tells what of the waiting is
the machine being busy with other things (Windows does not tell it).
"""

import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import psutil

ROOT = Path(__file__).resolve().parents[2]
READ, FUNCTION = 0.4, 1.5  # [s]
COMMANDS: tuple[tuple[list[str], float | None], ...] = (  # and the aim [s]
    (["--help"], 0.2),
    ([], None),
    (["exercise4", "--hint"], None),
    *(([f"exercise{number}"], READ) for number in (1, 2, 3, 4, 5, 6, 7, 8, 10, 11, 12)),
    (["exercise4", "solutions/exercise4/ExampleSubsystem.java"], READ),
    (["exercise9"], FUNCTION),
    (["exercise9", "--json"], FUNCTION),
    (["exercise9", "solutions/exercise9/fit.py"], FUNCTION),
    (["start", "--no-lab"], None),
)


def course(folder: Path) -> None:
    """Lay out a course of its own, so that nobody's progress is touched."""
    for name in ("exercises", "solutions"):
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("data"))
    shutil.copy(folder / "exercises/exercise9/answers.toml", folder / "solutions/exercise9")
    (folder / "lessons").mkdir()


def seconds(arguments: list[str], *, cwd: Path) -> float:
    """One whole process."""
    code = f"import sys; sys.path.insert(0, {str(ROOT)!r}); from grader.cli import main; main()"
    begin = time.perf_counter()
    subprocess.run(
        [sys.executable, "-c", code, *arguments], cwd=cwd, capture_output=True, check=False
    )
    return time.perf_counter() - begin


def spent() -> float:
    """Processor seconds [s] of all processes that this one started and saw end."""
    times = psutil.Process().cpu_times()
    return float(times.children_user + times.children_system)


def loaded() -> str:
    """How busy the machine is with this and all else, where it says so."""
    return f"load {os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else "load unknown"


def main() -> None:
    """Print a table."""
    times = int(sys.argv[1]) if len(sys.argv) > 1 else 7
    with tempfile.TemporaryDirectory() as folder:
        course(Path(folder))
        print(f"{'grade':50}{'best s':>8}{'median s':>10}{'CPU s':>8}{'aim s':>7}")
        for arguments, aim in COMMANDS:
            took, work = [], []
            for _ in range(times):
                before = spent()
                took.append(seconds(arguments, cwd=Path(folder)))
                work.append(spent() - before)
            said, middle = " ".join(arguments), statistics.median(took)
            wanted = "" if aim is None else f"{aim:g}"
            print(
                f"{said:50}{min(took):8.3f}{middle:10.3f}{statistics.median(work):8.3f}{wanted:>7}"
                f"   {loaded()}"
            )


if __name__ == "__main__":
    main()
