"""How long a learner waits for `grade`: whole processes, the first, and best and median of several.

    python tests/benchmarks/bench_grade.py [times]

Aims: help within 0.2 s, answers that are only read within 0.4 s, exercise 9 within 1.5 s: with a
function that fits five logs in a process of its own; robot code, which is run, within 2 s (Java)
and 4 s (Python, in WPILib's simulation if RobotPy is installed, else on fakes). The logs of
exercises 7, 8 and 12 are drawn by the first process and kept (`draw_cache`); only exercise 12
simulates. ``solved`` is an answer that earns everything, where that makes the examiner work harder
than the file as it comes.
Processor time is the median, and tells what of the waiting is the machine being busy with other
things (Windows does not tell it).
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

from grader.course.progress import load_progress
from grader.exercise.course_check import solve
from grader.exercise.exercise import find_exercise
from sim.support.student_names import make_folder_name

ROOT = Path(__file__).resolve().parents[2]
READ, FUNCTION, JAVA, PYTHON = 0.4, 1.5, 2.0, 4.0  # [s]
SOLVED = (7, 8, 12)
COMMANDS: tuple[tuple[list[str], float | None], ...] = (  # and the aim [s]
    (["--help"], 0.2),
    ([], None),
    (["exercise4", "--hint"], None),
    *(([f"exercise{number}"], READ) for number in (1, 2, 3, 4, 5, 6, 7, 8, 10, 11, 12)),
    (["exercise4", "solutions/exercise4/ExampleSubsystem.java"], JAVA),
    (["exercise4", "solutions/exercise4/example_subsystem.py"], PYTHON),
    (["exercise5", "solutions/exercise5/RobotContainer.java"], JAVA),
    *(([f"exercise{number}", f"solved/exercise{number}"], READ) for number in SOLVED),
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
    student = load_progress(folder)[0].student
    for number in SOLVED:
        one = find_exercise(str(number), folder)
        one.prepare(student, say=lambda _: None)
        made = solve(one, one.folder / "data" / make_folder_name(student))
        (folder / "solved" / one.name).mkdir(parents=True)
        for name, text in made.items():
            (folder / "solved" / one.name / name).write_text(text, encoding="utf-8")


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
        print(f"{'grade':50}{'first s':>8}{'best s':>8}{'median s':>10}{'CPU s':>8}{'aim s':>7}")
        for arguments, aim in COMMANDS:
            took, work = [], []
            for _ in range(times):
                before = spent()
                took.append(seconds(arguments, cwd=Path(folder)))
                work.append(spent() - before)
            said, middle = " ".join(arguments), statistics.median(took)
            wanted = "" if aim is None else f"{aim:g}"
            print(
                f"{said:50}{took[0]:8.3f}{min(took):8.3f}{middle:10.3f}{statistics.median(work):8.3f}{wanted:>7}"
                f"   {loaded()}"
            )


if __name__ == "__main__":
    main()
