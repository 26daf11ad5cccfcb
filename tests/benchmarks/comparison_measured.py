"""Everything the comparison measures, in one go, and what of it is shown first."""

import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from bench_real import HeldOutScore, held_out
from comparison_dirt import NOISES, one_cell
from comparison_fits import BUILT, METHODS, SUBSETS, Found, found, outcomes
from comparison_plan import SECTIONS, Row

from sim.bench.mechanisms import MECHANISMS

SOME = 4  # times fewer logs of each of the 16 subsets of three mechanisms
DIRTY_PERIOD = 0.02  # [s]


@dataclass(frozen=True, eq=False)
class Measured:
    """The figures of the page.

    Args:
        logs: how many there are for each row.
        rows: row -> method -> what it found.
        dirty: mechanism and noise -> method -> gain -> median error.
        subsets: tests, mechanism and method -> outcome -> how often.
        real: the runs that were held out; empty without logs of real robots.
    """

    logs: int
    rows: Mapping[Row, Mapping[str, Found]]
    dirty: Mapping[tuple[str, float], Mapping[str, Mapping[str, float]]]
    subsets: Mapping[tuple[tuple[str, ...], str, str], Mapping[str, int]]
    real: tuple[HeldOutScore, ...]

    @property
    def few(self) -> int:
        """How many logs there are of each subset of a mechanism's tests."""
        return fewer(self.logs)


def fewer(logs: int) -> int:
    """How many logs of each subset go with so many of each row."""
    return max(logs // SOME, 1)


def measured(*, logs: int, real: Path, first: int | None = None) -> Measured:
    """Fit everything.

    Args:
        logs: for each row.
        real: folder with logs of real robots; there may be none.
        first: only so many rows of each section, for a quick look.
    """
    rows = {
        row: {method: found(row, method=method, logs=logs) for method in METHODS}
        for row in _told([row for section in SECTIONS for row in section.rows[:first]])
    }
    dirty = {
        (name, noise): one_cell(name, noise=noise, period=DIRTY_PERIOD, seeds=logs)[0]
        for name, noise in _told([(n, x) for n in list(MECHANISMS)[:first] for x in NOISES[:first]])
    }
    subsets = {
        (tests, name, method): outcomes(tests, name=name, method=method, logs=fewer(logs))
        for tests in _told(SUBSETS[:first])
        for name in BUILT
        for method in METHODS
    }
    return Measured(logs, rows, dirty, subsets, tuple(held_out(real)))


def totals(figures: Measured, method: str) -> dict[str, int]:
    """Outcome -> how often, over all subsets and mechanisms."""
    some = [counts for (_, _, way), counts in figures.subsets.items() if way == method]
    return {outcome: sum(counts[outcome] for counts in some) for outcome in some[0]}


def ratios(figures: Measured) -> np.ndarray:
    """(runs,) our error over the recipe's, of the real runs that both predict."""
    both = np.array([one.ours / one.recipe for one in figures.real])
    return both[np.isfinite(both)]


def _told(some: "list | tuple") -> Iterator:
    """Each of some, with a dot for whoever waits."""
    for one in some:
        print(".", end="", file=sys.stderr, flush=True)
        yield one
