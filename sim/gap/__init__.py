"""The gap between simulation and measurement: where a velocity is wrong.

    find_gap_places(residuals, noise=noise)    # the bins with the most significant residuals

The residual of each sample is binned by run and time, by direction and speed, by direction and
position, by the time since a voltage step, and by voltage at rest. All numbers are multiples of the
noise, so mechanisms of any kind can be compared. In a bin of n samples

    mean = Σ r/n        error = s·√((1 + ρ)/(1 - ρ))/√n

r is the residual in the direction of motion, divided by the noise. s is the standard deviation
within the bin, at least 1, and ρ the lag-one autocorrelation within bins. For white innovations s =
1 and ρ = 0.
"""

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from sim.core.errors import BadRequest
from sim.core.log import Array
from sim.gap.bins import FEWEST, Bins, list_bins
from sim.gap.place import POSITION, REST, RUN, SPEED, STEPS, Place
from sim.gap.residuals import Residuals

__all__ = ["Place", "Residuals", "find_gap_places"]

PER_WAY = 2  # places of one way of binning that are listed; the others are mostly the same
LARGEST_RHO = 0.98  # [1] upper limit of ρ
SURE = 4.0  # [standard errors] with pure noise, one log in fifty has one of 300 bins beyond it
_UNITS = {RUN: "s after its start", REST: "V"}
_WHOLES = {SPEED: "the top speed", POSITION: "the way"}


def find_gap_places(runs: Sequence[Residuals], *, noise: float, most: int = 5) -> tuple[Place, ...]:
    """The bins with the most significant residuals, the largest residual first.

    Args:
        runs: residuals of each run.
        noise: [unit/s] standard deviation of a velocity, the unit of the residuals.
        most: number of places, at most.

    Raises:
        BadRequest: no sample is compared.
    """
    runs = [run for run in runs if run.compared.any()]
    if not runs:
        raise BadRequest(
            "there is nothing to compare", advice="Give a run in which the mechanism moves."
        )
    residual = np.concatenate([run.error for run in runs]) / noise
    begins = np.cumsum([0, *(run.time.size for run in runs)])
    kept = []
    for bins in list_bins(runs):
        found = _find_places(bins, residual * bins.way, begins)
        kept += sorted(found, key=lambda one: -one.sure)[:PER_WAY]
    surest = sorted(kept, key=lambda one: -one.sure)[:most]
    return tuple(sorted(surest, key=lambda one: -abs(one.error)))


def _find_places(bins: Bins, signed: Array, begins: NDArray[np.intp]) -> Iterator[Place]:
    """The significant bins; neighbors of one sign are merged into one place."""
    table = _average_bins(signed, bins.cells, begins, size=bins.edges[:, 1:].size)
    means, errors, counts = (one.reshape(len(bins.rows), -1) for one in table)
    significance = np.nan_to_num(means / errors)
    signs = np.where(np.abs(significance) >= SURE, np.sign(significance), 0.0)
    for row, ways in enumerate(signs):
        for part in np.split(np.arange(ways.size), np.flatnonzero(np.diff(ways)) + 1):
            if not ways[part[0]]:
                continue
            weight = counts[row, part] / counts[row, part].sum()
            mean = float(weight @ means[row, part])
            spread = float(np.sqrt(np.sum((weight * errors[row, part]) ** 2)))
            where = _describe_bins(bins, row, int(part[0]), int(part[-1]) + 1)
            yield Place(bins.what, where, mean, abs(mean) / spread)


def _average_bins(
    signed: Array, cell: NDArray[np.intp], begins: NDArray[np.intp], *, size: int
) -> tuple[Array, Array, NDArray[np.intp]]:
    """(size,) mean, standard error and count of residuals (n,) in the bins ``cell`` (n,)."""
    place = np.flatnonzero((cell >= 0) & ~np.isnan(signed))
    cells, values = cell[place], signed[place]
    count = np.bincount(cells, minlength=size)
    mean = np.bincount(cells, values, minlength=size) / np.maximum(count, 1)
    rest = values - mean[cells]
    square = np.bincount(cells, rest**2, minlength=size) / np.maximum(count - 1, 1)
    next_to = (np.diff(place) == 1) & (np.diff(cells) == 0) & ~np.isin(place[1:], begins)
    products = float(np.sum((rest[1:] * rest[:-1])[next_to]))
    squares = float(np.sum((rest[1:] ** 2)[next_to]))
    rho = min(max(products / squares, 0.0), LARGEST_RHO) if squares > 0.0 else 0.0
    error = np.sqrt(np.maximum(square, 1.0) * (1.0 + rho) / (1.0 - rho) / np.maximum(count, 1))
    mean[count < FEWEST] = np.nan
    return mean, error, count


def _describe_bins(bins: Bins, row: int, first: int, end: int) -> str:
    """Neighboring bins in words, like ``forward, 40 to 60% of the top speed``.

    Edges in SI are given as shares of the largest one, because they are not in the log's unit.
    """
    edges = bins.edges[row]
    low, high = float(edges[first]), float(edges[end])
    if bins.what == STEPS:
        return f"{_write_range(low, high)} s after {bins.rows[row]}"
    if bins.what in _UNITS:
        return f"{bins.rows[row]}, {_write_range(low, high)} {_UNITS[bins.what]}"
    least, most = float(edges[0]), float(edges[-1])
    low, high = (100.0 * (edge - least) / ((most - least) or 1.0) for edge in (low, high))
    return f"{bins.rows[row]}, {low:.0f} to {high:.0f}% of {_WHOLES[bins.what]}"


def _write_range(low: float, high: float) -> str:
    """A range in words, with enough digits to tell its ends apart."""
    digits = 1 if high - low >= 0.5 else 2  # noqa: PLR2004 - half a second, or half a volt
    return f"{low:.{digits}f} to {high:.{digits}f}"
