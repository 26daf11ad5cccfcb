"""How long a learner waits for `grade`: whole processes, best and median of several.

    python tests/benchmarks/bench_grade.py [times]

Aims: help within 0.2 s, exercise 4 within 0.4 s, exercise 9 within 1.5 s: with a function that fits
five logs in a process of its own.
"""

import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
COMMANDS = (
    ["--help"],
    [],
    ["exercise4", "--hint"],
    ["exercise4"],
    ["exercise4", "solutions/exercise4/ExampleSubsystem.java"],
    ["exercise4", "solutions/exercise4/example_subsystem.py", "--json"],
    ["exercise9"],
    ["exercise9", "--json"],
    ["exercise9", "solutions/exercise9/fit.py"],
    ["start", "--no-lab"],
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


def main() -> None:
    """Print a table."""
    times = int(sys.argv[1]) if len(sys.argv) > 1 else 7
    with tempfile.TemporaryDirectory() as folder:
        course(Path(folder))
        print(f"{'grade':56}{'best s':>8}{'median s':>10}")
        for arguments in COMMANDS:
            took = [seconds(arguments, cwd=Path(folder)) for _ in range(times)]
            said = " ".join(arguments)
            print(f"{said:56}{min(took):8.3f}{statistics.median(took):10.3f}")


if __name__ == "__main__":
    main()
