"""Mutants of the corpus of robot code, run: how they end, how long they take, and what crashes.

    python tests/benchmarks/fuzz_robotcode.py [HOW_MANY [FIRST]]

A thousand take some minutes on one core. A crash is printed with the mutant's number, from which
``mutant(number, sources())`` makes it again; any crash or slow mutant ends with status 1.
"""

import sys
import tempfile
import time
import traceback
from collections import Counter, defaultdict
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from robotcode_mutants import Mutant, mutant, sources

from grader.robotcode.running import run_routine
from sim.core.errors import Refusal

SECONDS = {".java": 5.0, ".py": 25.0}  # that no mutant may take: Python is ended after 10, twice


def run(one: Mutant, folder: Path) -> str:
    """How a mutant ends, in one word."""
    path = folder / one.source.name
    path.write_bytes(one.content)
    try:
        facts = run_routine(path, mounts={"java": {}, "python": {}}, task="no task")[0]
    except Refusal:
        return "refused"
    return str(facts.stop.outcome) if facts.stop else "errors" if facts.errors else "ran"


def main(count: int, first: int) -> int:
    """Run so many mutants, print the figures."""
    files, bad = sources(), 0
    outcomes, taken = defaultdict(Counter), defaultdict(list)
    for number in range(first, first + count):
        one = mutant(number, files)
        said, kind = f"{number} ({one.source.name}: {one.how})", one.source.suffix
        start = time.perf_counter()
        try:
            with tempfile.TemporaryDirectory() as folder:
                outcomes[kind][run(one, Path(folder))] += 1
        except Exception:  # noqa: BLE001 - a crash is what is looked for
            bad += 1
            print(f"CRASH {said}\n{traceback.format_exc(limit=-4)}")
        taken[kind].append(time.perf_counter() - start)
        if taken[kind][-1] > SECONDS[kind]:
            bad += 1
            print(f"SLOW {said}: {taken[kind][-1]:.1f} s")
    print(f"{count} mutants of {len(files)} files: {bad} crashed or were slow")
    for kind, ends in outcomes.items():
        said = ", ".join(f"{number} {end}" for end, number in sorted(ends.items()))
        half, most, every = 1e3 * np.quantile(taken[kind], [0.5, 0.99, 1.0])
        print(
            f"  {kind}: {said}; half within {half:.0f} ms, 99 % {most:.0f} ms, all {every:.0f} ms"
        )
    return min(bad, 1)


if __name__ == "__main__":
    asked = [int(word) for word in sys.argv[1:3]]
    sys.exit(main(*asked, *[1_000, 0][len(asked) :]))
