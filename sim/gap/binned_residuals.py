"""Residuals in bins: mean, standard error and count of each.

    mean = Σ r/n        error = s·√((1 + ρ)/(1 - ρ))/√n

r is the residual in the direction of motion, divided by the noise. s is the standard deviation
within the bin, at least 1, and ρ the lag-one autocorrelation within bins. For white innovations s =
1 and ρ = 0.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array
from sim.gap.place import SIGNALS, STEPS, Place

FEWEST = 4  # samples of a bin with a mean
LARGEST_RHO = 0.98  # [1] upper limit of ρ
SURE = 4.0  # [standard errors] with pure noise, one log in fifty has one of 300 bins beyond it


@dataclass(frozen=True, eq=False)
class BinnedResiduals:
    """Residuals in bins along one axis.

    Args:
        what: ``run``, ``direction-speed``, ``direction-position``, ``after-steps``, ``at-rest``.
        rows: name of each row.
        edges: (rows, columns + 1) [s, unit/s, unit or V] edges of the columns.
        edges_as_shares: whether texts give the edges as shares of the largest one, because they are
            in SI and not in the log's unit.
        mean: (2, rows, columns) [noise] mean residuals of position and velocity; nan if too few.
        error: (2, rows, columns) [noise] standard errors of the means.
        count: (2, rows, columns) numbers of samples.
    """

    what: str
    rows: tuple[str, ...]
    edges: Array
    edges_as_shares: bool
    mean: Array
    error: Array
    count: NDArray[np.intp]

    @property
    def significance(self) -> Array:
        """(2, rows, columns) mean residual in standard errors; 0 where samples are too few."""
        return np.nan_to_num(self.mean / self.error)

    def find_places(self) -> Iterator[Place]:
        """The significant bins; neighbors of one sign are merged into one place."""
        sure = self.significance
        way = np.where(np.abs(sure) >= SURE, np.sign(sure), 0.0)
        for signal, row in zip(*np.nonzero(np.any(way, axis=2)), strict=True):
            signs = way[signal, row]
            breaks = np.flatnonzero(np.diff(signs)) + 1
            for part in np.split(np.arange(signs.size), breaks):
                if signs[part[0]]:
                    yield self._describe_place(int(signal), int(row), slice(part[0], part[-1] + 1))

    def _describe_place(self, signal: int, row: int, part: slice) -> Place:
        """The place of neighboring bins, with their weighted mean."""
        mean, error = self.mean[signal, row, part], self.error[signal, row, part]
        weight = self.count[signal, row, part].astype(np.float64)
        weight /= weight.sum()
        together = float(weight @ mean)
        spread = float(np.sqrt(np.sum((weight * error) ** 2)))
        where = self.describe_bin(row, part)
        return Place(self.what, where, together, abs(together) / spread, SIGNALS[signal])

    def describe_bin(self, row: int, part: slice) -> str:
        """Neighboring bins in words, like ``forward, 40 to 60% of the top speed``.

        Args:
            row: the row of the bins.
            part: the range of their columns.
        """
        edges = self.edges[row]
        low, high = float(edges[part.start]), float(edges[part.stop])
        if not self.edges_as_shares:
            if self.what == STEPS:
                return f"{_write_range(low, high)} s after {self.rows[row]}"
            return f"{self.rows[row]}, {_write_range(low, high)} {_UNITS[self.what]}"
        least, most = float(self.edges.min()), float(self.edges.max())
        low, high = (100.0 * (edge - least) / ((most - least) or 1.0) for edge in (low, high))
        return f"{self.rows[row]}, {low:.0f} to {high:.0f}% of {_WHOLES[self.what]}"


_UNITS = {"run": "s", "at-rest": "V"}
_WHOLES = {"direction-speed": "the top speed", "direction-position": "the way"}


def _write_range(low: float, high: float) -> str:
    """A range in words, with enough digits to tell its ends apart."""
    digits = 1 if high - low >= 0.5 else 2  # noqa: PLR2004 - half a second, or half a volt
    return f"{low:.{digits}f} to {high:.{digits}f}"


@dataclass(frozen=True, eq=False)
class SampleTable:
    """The residuals of all runs in one table.

    Args:
        table: (n, 2) [noise] residuals of position and velocity; nan where not compared.
        run: (n,) index of the run of each sample.
    """

    table: Array
    run: NDArray[np.intp]

    def bin_samples(
        self, what: str, rows: tuple[str, ...], edges: Array, *, row: NDArray[np.intp],
        value: Array, way: Array, shares: bool = False,
    ) -> BinnedResiduals:  # fmt: skip
        """Bin all samples along one axis.

        Args:
            what: kind of the bins, as in ``BinnedResiduals``.
            rows: names of the rows.
            edges: (rows, columns + 1) edges of the columns, increasing.
            row: (n,) row of each sample; negative for none.
            value: (n,) value that is binned, in the unit of ``edges``; nan for none.
            way: (n,) ±1, the positive direction of each residual.
            shares: whether texts give the edges as shares.
        """
        columns = edges.shape[1] - 1
        cell = _find_column(value, edges, row)
        cell[cell >= 0] += columns * row[cell >= 0]
        shape = (2, len(rows), columns)
        mean, error = (
            np.full((2, shape[1] * columns), np.nan),
            np.full((2, shape[1] * columns), np.nan),
        )
        count = np.zeros_like(mean, dtype=np.intp)
        for signal in range(2):
            mean[signal], error[signal], count[signal] = self._average_bins(
                self.table[:, signal] * way, cell, size=mean.shape[1]
            )
        return BinnedResiduals(
            what,
            rows,
            edges,
            shares,
            mean.reshape(shape),
            error.reshape(shape),
            count.reshape(shape),
        )

    def _average_bins(
        self, signed: Array, cell: NDArray[np.intp], *, size: int
    ) -> tuple[Array, Array, NDArray[np.intp]]:
        """(size,) mean, standard error and count of residuals (n,) in the bins ``cell`` (n,)."""
        there = (cell >= 0) & ~np.isnan(signed)
        cells, values = cell[there], signed[there]
        count = np.bincount(cells, minlength=size)
        mean = np.bincount(cells, values, minlength=size) / np.maximum(count, 1)
        rest = values - mean[cells]
        square = np.bincount(cells, rest**2, minlength=size) / np.maximum(count - 1, 1)
        place = np.flatnonzero(there)
        next_to = (np.diff(place) == 1) & (np.diff(cells) == 0) & (np.diff(self.run[place]) == 0)
        products = float(np.sum((rest[1:] * rest[:-1])[next_to]))
        squares = float(np.sum((rest[1:] ** 2)[next_to]))
        rho = min(max(products / squares, 0.0), LARGEST_RHO) if squares > 0.0 else 0.0
        inflation = (1.0 + rho) / (1.0 - rho)
        few = count < FEWEST
        mean[few] = np.nan
        error = np.sqrt(np.maximum(square, 1.0) * inflation / np.maximum(count, 1))
        error[few] = np.nan
        return mean, error, count


def _find_column(value: Array, edges: Array, row: NDArray[np.intp]) -> NDArray[np.intp]:
    """(n,) column of each value (n,), by the edges of its row; -1 outside of them."""
    column = np.full(value.size, -1, dtype=np.intp)
    last = edges.shape[1] - 2
    for number in range(edges.shape[0]):
        mine = row == number
        found = np.searchsorted(edges[number], value[mine], side="right") - 1
        found[value[mine] == edges[number, -1]] = last
        column[mine] = np.where(found > last, -1, found)
    column[np.isnan(value)] = -1
    return column
