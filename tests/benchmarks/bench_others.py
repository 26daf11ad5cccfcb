"""Our class beside otter-grader's and nbgrader's batch: the same three numbers, whole commands.

    python tests/benchmarks/bench_others.py [SUBMISSIONS] [FOLDER]

Every submission says kS, kV and kA of one fixed log, some right and some wrong; each is right
within a tolerance. Ours read a file of answers (``grade class``, one process), the others a
notebook. Their commands come from the package index, into environments of their own in a temporary
folder, or in FOLDER, which keeps them for the next time. Otter's batch needs Docker, so that what
is timed is ``otter run``, once for each submission. Scores of all three must be the same. Aim: ten
times as many submissions a minute as each of them.
"""

import sys
import tempfile
from pathlib import Path

import numpy as np
from bench_grade import loaded
from others_tools import GAINS, Task, Timed, installed, nbgrader, otter, ours

from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.fit import fit

TIMES = 10.0  # as many submissions a minute, at least
OFF = 1.5  # [times the key] a wrong number


def task(submissions: int) -> Task:
    """The fixed log's own gains, and answers with every combination of right and wrong."""
    found = fit(
        simulate(MECHANISMS["drivetrain"], Routine(), rng=np.random.default_rng(0)),
        method="sysid",
    )
    key = {name: float(f"{found.gains[name]:.4g}") for name in GAINS}
    given = {
        f"student{one:03}": {
            name: value * (OFF if one >> place & 1 else 1.0)
            for place, (name, value) in enumerate(key.items())
        }
        for one in range(submissions)
    }
    return Task(key, given)


def main() -> None:
    """Print a table."""
    asked = task(int(sys.argv[1]) if len(sys.argv) > 1 else 20)
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        kept = Path(sys.argv[2]).resolve() if len(sys.argv) > 2 else folder / "environments"
        kept.mkdir(parents=True, exist_ok=True)
        mine = ours(folder / "ours", asked)
        print(f"{len(asked.given)} submissions{'':33}{'s':>8}{'CPU s':>8}{'a minute':>10}")
        print_times(mine, mine)
        for package, run in (("otter-grader", otter), ("nbgrader", nbgrader)):
            try:
                found = run(folder / package, asked, installed(package, kept))
            except RuntimeError as failed:
                print(f"{package} cannot be installed or run here: {failed}")
                continue
            print_times(found, mine)


def print_times(one: Timed, mine: Timed) -> None:
    """Print one tool's line; that its scores differ from ours is an end to comparing."""
    if one.scores != mine.scores:
        raise SystemExit(f"{one.command}: other scores, {one.scores} and not {mine.scores}")
    rate = 60.0 * len(one.scores) / one.seconds
    times = f"ours {one.seconds / mine.seconds:.0f} times, aim {TIMES:g}" if one != mine else ""
    print(f"{one.command:46}{one.seconds:8.2f}{one.work:8.2f}{rate:10.1f}   {loaded()}   {times}")


if __name__ == "__main__":
    main()
