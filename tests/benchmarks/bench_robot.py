"""How long RobotPy code takes to be graded: whole processes, with the run and without.

    python tests/benchmarks/bench_robot.py [times]

Aim: 4 s for `grade exercise4 example_subsystem.py` with the run in WPILib's simulation. Needs the
extra `robot`.
"""

import sys
import tempfile
from pathlib import Path

from bench_grade import course, seconds
from timing import HEADER, line
from timing import seconds as several

from grader.robotcode import bench

ROOT = Path(__file__).resolve().parents[2]
ANSWER = ROOT / "solutions" / "exercise4" / "example_subsystem.py"
TARGET = 4.0  # [s]


def main() -> None:
    """Print a table."""
    times = int(sys.argv[1]) if len(sys.argv) > 1 else 7
    if not bench.is_robotpy_installed():
        print("RobotPy (extra `robot`) is not installed: there is nothing to run")
        return
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        course(folder)
        starter = folder / "exercises" / "exercise4" / ANSWER.name
        print(HEADER)
        for name, work, target in (
            (
                "grade the solution: read and run",
                lambda: seconds(["4", str(ANSWER)], cwd=folder),
                TARGET,
            ),
            (
                "grade the starter: read only",
                lambda: seconds(["4", str(starter)], cwd=folder),
                None,
            ),
            (
                "the run by itself",
                lambda: bench.run_sysid_routine(ANSWER, "ExampleSubsystem"),
                None,
            ),
        ):
            print(line(name, several(work, repeats=times), target=target))


if __name__ == "__main__":
    main()
