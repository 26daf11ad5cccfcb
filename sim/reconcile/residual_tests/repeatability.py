"""Residuals that runs of one direction share, by position or by speed.

    size = Σ a·b/(√pairs · mean(a²))        a, b residuals of two runs in the same bin

Random disturbances differ from run to run, so their products average out. Missing physics repeats
in every run: a bump at one position, or drag that follows an unknown law.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim.core.log import STANDSTILL, Array
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.reconcile.thresholds import CELLS, FEWEST_SAMPLES

POSITION, SPEED = "position", "speed"
FEWEST_IN_BIN = 2  # samples of a run: a single one may be in this bin only because of noise


@dataclass(frozen=True)
class RepeatedResidual:
    """A residual that several runs share.

    Args:
        size: [standard deviations of what chance gives].
        what: what it depends on, ``position`` or ``speed``.
        way: direction of motion in which it is largest: 1 forward, -1 reverse.
        low: [unit or unit/s] lower edge of the bin where it is largest.
        high: [unit or unit/s] upper edge of that bin.
    """

    size: float = 0.0
    what: str = POSITION
    way: int = 1
    low: float = 0.0
    high: float = 0.0


@dataclass(frozen=True, eq=False)
class _BinnedProducts:
    """Products of the residuals of runs in one direction, summed in bins.

    Args:
        cross: (bins,) sum of the products of two different runs.
        pairs: (bins,) number of these products.
        squares: (bins,) sum of the squares of each run.
        counts: (bins,) number of these squares.
        edges: (bins + 1,) [unit or unit/s] edges of the bins.
    """

    cross: Array
    pairs: Array
    squares: Array
    counts: Array
    edges: Array


def find_repeated_residual(problem: PredictionErrorProblem, point: Estimate) -> RepeatedResidual:
    """Find the residual that runs share most, by position or by speed.

    Args:
        problem: the measurements.
        point: the estimate whose residuals are tested.
    """
    disturbance = estimate_disturbance(problem, point)
    track = problem.simulate(point.model, point.nuisance, point.kalman_filter)
    speed, position = track.seen, problem.measured[:, 0]
    position = np.where(np.isnan(position), track.position, position)
    used = ~problem.ignored_readings.all(axis=1)
    used &= np.abs(speed) > STANDSTILL * problem.top_speed
    run = np.repeat(np.arange(len(problem.records)), np.diff(problem.run_edges))
    found = []
    for what, value in ((POSITION, position), (SPEED, speed)):
        ways = {
            way: binned
            for way in (1, -1)
            for rows in [used & (np.sign(speed) == way)]
            for binned in _bin_products(disturbance[rows], value[rows], run[rows])
        }
        found.append(_combine_directions(what, ways))
    return max(found, key=lambda one: one.size)


def estimate_disturbance(problem: PredictionErrorProblem, point: Estimate) -> Array:
    """(n,) disturbance at each sample, estimated from whitened innovations."""
    period = problem.period
    response = problem.whiten(point, np.array([[0.5 * period**2, period]]))  # to 1 unit/s²
    white = problem.whiten(point, point.innovations).reshape(-1, 2)
    return np.asarray(white @ (response / np.linalg.norm(response)))


def _bin_products(
    residual: Array, value: Array, run: NDArray[np.intp]
) -> Iterator[_BinnedProducts]:
    """The products of one direction; none if fewer than two runs have enough samples of it.

    The mean of each run is subtracted, because friction may differ from run to run.
    """
    counts = np.bincount(run)
    long = counts[run] >= FEWEST_SAMPLES
    residual, value, run = residual[long], value[long], run[long]
    runs, run = np.unique(run, return_inverse=True)
    if runs.size < 2:  # noqa: PLR2004 - a pair
        return
    residual = residual - (np.bincount(run, residual) / np.bincount(run))[run]
    edges = np.linspace(value.min(), value.max(), CELLS + 1)
    bin_ = np.clip(np.searchsorted(edges, value, side="right") - 1, 0, CELLS - 1)
    shape = (runs.size, CELLS)
    place, size = run * CELLS + bin_, runs.size * CELLS
    sums = np.bincount(place, residual, size).reshape(shape)
    samples = np.bincount(place, minlength=size).reshape(shape)
    enough = samples >= FEWEST_IN_BIN
    each = np.where(enough, sums / np.sqrt(np.maximum(samples, 1)), 0.0)
    squares, count = np.sum(each**2, axis=0), enough.sum(axis=0).astype(np.float64)
    cross = 0.5 * (np.sum(each, axis=0) ** 2 - squares)
    yield _BinnedProducts(cross, 0.5 * count * (count - 1.0), squares, count, edges)


def _combine_directions(what: str, ways: dict[int, _BinnedProducts]) -> RepeatedResidual:
    """The statistic of all bins, and the bin with the largest products."""
    every = ways.values()
    pairs = sum(float(one.pairs.sum()) for one in every)
    squares = sum(float(one.squares.sum()) for one in every)
    counts = sum(float(one.counts.sum()) for one in every)
    if not (pairs > 0.0 and squares > 0.0):
        return RepeatedResidual(what=what)
    cross = sum(float(one.cross.sum()) for one in every)
    size = cross / (math.sqrt(pairs) * squares / counts)
    way, most = max(ways.items(), key=lambda one: float(one[1].cross.max()))
    bin_ = int(np.argmax(most.cross))
    low, high = sorted(map(float, most.edges[bin_ : bin_ + 2]))
    return RepeatedResidual(size, what, way, low, high)
