"""How long robot code takes to be graded: whole processes of `grade`, the program's run included.

    python tests/benchmarks/bench_robot.py [times]

Aims: 2 s for Java, which the grader runs itself, and 4 s for Python, which runs in a process of its
own: in WPILib's simulation if RobotPy (the extra `robot`) is installed, else on fakes.
"""

import sys
import tempfile
from pathlib import Path

from bench_grade import course, seconds
from timing import HEADER, line
from timing import seconds as several

SOLUTIONS = Path(__file__).resolve().parents[2] / "solutions"
JAVA, PYTHON = 2.0, 4.0  # [s]
ANSWERS = (
    ("exercise4", "ExampleSubsystem.java", JAVA),
    ("exercise4", "example_subsystem.py", PYTHON),
    ("exercise5", "RobotContainer.java", JAVA),
)


def main() -> None:
    """Print a table."""
    times = int(sys.argv[1]) if len(sys.argv) > 1 else 7
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        course(folder)
        print(HEADER)
        for exercise, file, target in ANSWERS:
            words = [exercise, str(SOLUTIONS / exercise / file), "--json"]
            taken = several(lambda words=words: seconds(words, cwd=folder), repeats=times)
            print(line(f"grade {exercise} {file}", taken, target=target))


if __name__ == "__main__":
    main()
