"""Mutants of the corpus of robot code, read: how many crash, how long they take.

    python tests/benchmarks/fuzz_robotcode.py [HOW_MANY [FIRST]]

Ten thousand take some minutes on one core. A crash is printed with the mutant's number, from which
``mutant(number, sources())`` makes it again; any crash, flaw or slow mutant ends with status 1.
"""

import sys
import tempfile
import traceback
from collections import Counter
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from robotcode_mutants import mutant, sources
from robotcode_readings import READERS, among_neighbors, faults

SECONDS = 2.0  # that no mutant may take


def main(count: int, first: int) -> int:
    """Read so many mutants, print the figures."""
    files = sources()
    found, traces, bad = [], set(), 0
    with tempfile.TemporaryDirectory() as folder, among_neighbors(Path(folder)) as readings:
        for number in range(first, first + count):
            one = mutant(number, files)
            said = f"{number} ({one.source.name}: {one.how})"
            try:
                several = readings(one)
            except Exception:  # noqa: BLE001 - a crash is what is looked for
                bad += 1
                trace = traceback.format_exc(limit=-4)
                print(f"CRASH {said}", "as before" if trace in traces else f"\n{trace}")
                traces.add(trace)
                continue
            for reading in several:
                wrong = faults(reading, one, most=SECONDS)
                bad += bool(wrong)
                if wrong:
                    print(f"FLAW {said} {reading.reader}: {wrong}")
            found += several
    print(f"{count} mutants of {len(files)} files: {bad} crashed, were slow or gave nonsense")
    for reader in READERS:
        print_readings(reader, [one for one in found if one.reader == reader])
    return min(bad, 1)


def print_readings(reader: str, readings: list) -> None:
    """One reader's outcomes and times."""
    outcomes = Counter(one.outcome for one in readings)
    half, most, all_ = 1e3 * np.quantile([one.seconds for one in readings], [0.5, 0.99, 1.0])
    said = ", ".join(f"{number} {outcome}" for outcome, number in sorted(outcomes.items()))
    print(f"  {reader}: {said}; half within {half:.1f} ms, 99 % {most:.0f} ms, all {all_:.0f} ms")


if __name__ == "__main__":
    asked = [int(word) for word in sys.argv[1:3]]
    sys.exit(main(*asked, *[10_000, 0][len(asked) :]))
