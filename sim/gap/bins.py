"""Ways to bin the residuals: by run, speed, position, time after a step, voltage at rest."""

from collections.abc import Sequence
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from sim.core.log import DIRECTIONS, STANDSTILL, Array
from sim.estimation.measurements import SensorNoise
from sim.gap.binned_residuals import FEWEST, BinnedResiduals, SampleTable
from sim.gap.place import POSITION, REST, RUN, SPEED, STEPS
from sim.gap.residuals import Residuals

LEAST_TIMES, TIMES, SPEEDS, POSITIONS, VOLTS = 6, 12, 8, 12, 4  # numbers of columns
AFTER = (0.0, 0.05, 0.1, 0.2, 0.4, 0.8, 1.6)  # [s] edges since a step: narrow just after it
JUMPS = ("the voltage jumps up", "the voltage jumps down")
RESTS = ("at rest under forward voltage", "at rest under reverse voltage")


class ResidualBins:
    """The residuals of some runs, binned in several ways.

    Args:
        runs: residuals of the runs, each with at least one compared sample.
        noise: standard deviations of a position and a velocity.
    """

    def __init__(self, runs: Sequence[Residuals], *, noise: SensorNoise) -> None:
        self.runs = runs
        self.predicted = np.concatenate([run.predicted for run in runs])
        self.voltage = np.concatenate([run.voltage for run in runs])
        self.run_index = np.repeat(np.arange(len(runs)), [run.time.size for run in runs])
        residuals = np.concatenate([run.error for run in runs])
        self.compared = ~np.isnan(residuals).all(axis=1)
        self.samples = SampleTable(
            residuals / np.array([noise.position, noise.velocity]), self.run_index
        )
        self.speed = np.abs(self.predicted[:, 1])
        self.top = float(self.speed[self.compared].max())
        self.rests = self.speed <= STANDSTILL * self.top

    @cached_property
    def direction(self) -> Array:
        """(n,) ±1, the direction of motion, or of the voltage while at rest."""
        way = np.sign(np.where(self.rests, self.voltage, self.predicted[:, 1]))
        way[way == 0.0] = 1.0
        return np.asarray(way)

    @cached_property
    def direction_row(self) -> NDArray[np.intp]:
        """(n,) row of each sample's direction: 0 forward, 1 reverse."""
        return np.where(self.direction > 0.0, 0, 1)

    @cached_property
    def moving_row(self) -> NDArray[np.intp]:
        """(n,) row of the direction of each sample that moves; -1 while at rest."""
        return np.where(self.rests, -1, self.direction_row)

    def bin_by_run(self) -> BinnedResiduals:
        """The residuals binned by run and time."""
        ends = [run.run_time[run.compared][[0, -1]] for run in self.runs]
        shortest = min(int(np.count_nonzero(run.compared)) for run in self.runs)
        columns = min(max(shortest // FEWEST, LEAST_TIMES), TIMES)
        edges = np.stack([np.linspace(start, end, columns + 1) for start, end in ends])
        since = np.concatenate([run.run_time for run in self.runs])
        names = _name_runs([run.test for run in self.runs])
        return self.samples.bin_samples(
            RUN, names, edges, row=self.run_index, value=since, way=self.direction
        )

    def bin_by_speed(self) -> BinnedResiduals:
        """The residuals binned by direction and speed."""
        edges = _make_even_edges(0.0, self.top, SPEEDS)
        return self.samples.bin_samples(
            SPEED,
            DIRECTIONS,
            edges,
            row=self.moving_row,
            value=self.speed,
            way=self.direction,
            shares=True,
        )

    def bin_by_position(self) -> BinnedResiduals:
        """The residuals binned by direction and position."""
        position = self.predicted[:, 0]
        kept = position[self.compared]
        edges = _make_even_edges(float(kept.min()), float(kept.max()), POSITIONS)
        return self.samples.bin_samples(
            POSITION,
            DIRECTIONS,
            edges,
            row=self.moving_row,
            value=position,
            way=self.direction,
            shares=True,
        )

    def bin_after_steps(self) -> BinnedResiduals:
        """The residuals after a voltage step, binned by its direction and the time since."""
        largest = float(np.abs(self.voltage).max())
        found = [run.find_steps(largest=largest, still=STANDSTILL * self.top) for run in self.runs]
        since, jump = (np.concatenate([one[part] for one in found]) for part in (0, 1))
        row = np.where(jump > 0.0, 0, 1)
        return self.samples.bin_samples(
            STEPS, JUMPS, np.tile(AFTER, (2, 1)), row=row, value=since, way=jump
        )

    def bin_at_rest(self) -> BinnedResiduals:
        """The residuals at rest, binned by direction and voltage."""
        held = np.where(self.rests & self.compared, np.abs(self.voltage), np.nan)
        most = float(np.max(held, initial=0.0, where=~np.isnan(held)))
        row = np.where(self.rests, self.direction_row, -1)
        return self.samples.bin_samples(
            REST, RESTS, _make_even_edges(0.0, most, VOLTS), row=row, value=held, way=self.direction
        )


def _name_runs(tests: Sequence[str]) -> tuple[str, ...]:
    """Name of each run: its test, numbered if there are several of it."""
    return tuple(
        f"{test} ({tests[: i + 1].count(test)})" if tests.count(test) > 1 else test
        for i, test in enumerate(tests)
    )


def _make_even_edges(low: float, high: float, columns: int) -> Array:
    """(2, columns + 1) edges of equal columns, the same for both directions."""
    return np.tile(np.linspace(low, max(high, low + 1e-12), columns + 1), (2, 1))
