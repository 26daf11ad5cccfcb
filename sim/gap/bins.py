"""Ways to bin the residuals: by run, speed, position, time after a step, voltage at rest."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim.core.log import DIRECTIONS, STANDSTILL, Array
from sim.gap.place import POSITION, REST, RUN, SPEED, STEPS
from sim.gap.residuals import Residuals

FEWEST = 4  # samples of a bin with a mean
LEAST_TIMES, TIMES, SPEEDS, POSITIONS, VOLTS = 6, 12, 8, 12, 4  # numbers of columns
AFTER = (0.0, 0.05, 0.1, 0.2, 0.4, 0.8, 1.6)  # [s] edges since a step: narrow just after it
JUMPS = ("the voltage jumps up", "the voltage jumps down")
RESTS = ("at rest under forward voltage", "at rest under reverse voltage")


@dataclass(frozen=True, eq=False)
class Bins:
    """The samples of all runs, binned in one way.

    Args:
        what: ``run``, ``direction-speed``, ``direction-position``, ``after-steps``, ``at-rest``.
        rows: name of each row.
        edges: (rows, columns + 1) [s, unit/s, unit or V] edges of the columns, increasing.
        row: (n,) row of each sample; negative for none.
        value: (n,) value that is binned, in the unit of ``edges``; nan for none.
        way: (n,) ±1, the positive direction of each residual.
    """

    what: str
    rows: tuple[str, ...]
    edges: Array
    row: NDArray[np.intp]
    value: Array
    way: Array

    @property
    def cells(self) -> NDArray[np.intp]:
        """(n,) bin of each sample, counted through all rows; -1 outside of them."""
        columns = self.edges.shape[1] - 1
        cells = np.full(self.value.size, -1, dtype=np.intp)
        for number, edges in enumerate(self.edges):
            inside = (self.row == number) & (self.value >= edges[0]) & (self.value <= edges[-1])
            found = np.searchsorted(edges, self.value[inside], side="right") - 1
            cells[inside] = columns * number + np.minimum(found, columns - 1)
        return cells


def list_bins(runs: Sequence[Residuals]) -> Iterator[Bins]:
    """Bin the samples of runs, each of which has a compared sample, in every way."""
    position, velocity = np.concatenate([run.predicted for run in runs]).T
    voltage, since = (
        np.concatenate([getattr(run, name) for run in runs]) for name in ("voltage", "run_time")
    )
    compared = np.concatenate([run.compared for run in runs])
    speed = np.abs(velocity)
    top = float(speed[compared].max())
    rests = speed <= STANDSTILL * top
    way = np.sign(np.where(rests, voltage, velocity))  # of the motion, at rest of the voltage
    way[way == 0.0] = 1.0
    direction = np.where(way > 0.0, 0, 1)
    moving = np.where(rests, -1, direction)

    times = [run.run_time[run.compared] for run in runs]
    columns = min(max(min(time.size for time in times) // FEWEST, LEAST_TIMES), TIMES)
    edges = np.stack([np.linspace(time[0], time[-1], columns + 1) for time in times])
    index = np.repeat(np.arange(len(runs)), [run.time.size for run in runs])
    yield Bins(RUN, _name_runs([run.test for run in runs]), edges, index, since, way)

    edges = _make_even_edges(0.0, top, SPEEDS)
    yield Bins(SPEED, DIRECTIONS, edges, moving, speed, way)

    kept = position[compared]
    edges = _make_even_edges(float(kept.min()), float(kept.max()), POSITIONS)
    yield Bins(POSITION, DIRECTIONS, edges, moving, position, way)

    largest = float(np.abs(voltage).max())
    steps = [run.find_steps(largest=largest, still=STANDSTILL * top) for run in runs]
    since, jump = (np.concatenate([one[part] for one in steps]) for part in (0, 1))
    yield Bins(STEPS, JUMPS, np.tile(AFTER, (2, 1)), np.where(jump > 0.0, 0, 1), since, jump)

    held = np.where(rests & compared, np.abs(voltage), np.nan)
    edges = _make_even_edges(0.0, float(np.nanmax(held, initial=0.0)), VOLTS)
    yield Bins(REST, RESTS, edges, np.where(rests, direction, -1), held, way)


def _name_runs(tests: Sequence[str]) -> tuple[str, ...]:
    """Name of each run: its test, numbered if there are several of it."""
    return tuple(
        f"{test} ({tests[: i + 1].count(test)})" if tests.count(test) > 1 else test
        for i, test in enumerate(tests)
    )


def _make_even_edges(low: float, high: float, columns: int) -> Array:
    """(2, columns + 1) edges of equal columns, the same for both directions."""
    return np.tile(np.linspace(low, max(high, low + 1e-12), columns + 1), (2, 1))
