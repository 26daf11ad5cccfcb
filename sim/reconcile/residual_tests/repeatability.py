"""Residuals that runs of one direction share, by position or by speed.

    alike = Σ a·b/(√pairs · mean(a²))        a, b what two runs miss in the same cell

What shakes a robot is another in each run, and adds up to nothing. What physics is missing is there
in every run: a bump at one place, a drag that no formula has.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.reconcile.thresholds import CELLS, FEWEST_SAMPLES, STANDSTILL

POSITION, SPEED = "position", "speed"
FEWEST_IN_CELL = 2  # samples of a run: one alone may have come there by a moment's noise


@dataclass(frozen=True)
class RepeatedResidual:
    """A residual that several runs share.

    Args:
        size: [standard deviations of chance].
        what: ``position`` or ``speed``.
        way: 1 where it is most while they go forward, -1 in reverse.
        low: [unit or unit/s] between this
        high: and this it is most.
    """

    size: float = 0.0
    what: str = POSITION
    way: int = 1
    low: float = 0.0
    high: float = 0.0


@dataclass(frozen=True, eq=False)
class _Cells:
    """What the runs that go one way miss, in cells.

    Args:
        cross: (cells,) sum of products of different runs.
        pairs: (cells,) how many of these.
        squares: (cells,) sum of each run's own squares.
        counts: (cells,) how many of those.
        edges: (cells + 1,) [unit or unit/s].
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
        point: what is believed.
    """
    missed = estimate_disturbance(problem, point)
    track = problem.simulate(
        point.structure.model(point.values), point.nuisance, point.kalman_filter
    )
    speed, position = track.seen, problem.measured[:, 0]
    position = np.where(np.isnan(position), track.position, position)
    told = ~problem.ignored_readings.all(axis=1)
    told &= np.abs(speed) > STANDSTILL * problem.top_speed
    run = np.repeat(np.arange(len(problem.records)), np.diff(problem.run_edges))
    found = []
    for what, value in ((POSITION, position), (SPEED, speed)):
        ways = {
            way: cells
            for way in (1, -1)
            for mine in [told & (np.sign(speed) == way)]
            for cells in _cells(missed[mine], value[mine], run[mine])
        }
        found.append(_sum_cells(what, ways))
    return max(found, key=lambda one: one.size)


def estimate_disturbance(problem: PredictionErrorProblem, point: Estimate) -> Array:
    """(n,) disturbance at each sample, estimated from whitened innovations."""
    period = problem.period
    push = problem.whiten(point, np.array([[0.5 * period**2, period]]))
    white = problem.whiten(point, point.innovations).reshape(-1, 2)
    return np.asarray(white @ (push / np.linalg.norm(push)))


def _cells(missed: Array, value: Array, run: NDArray[np.intp]) -> Iterator[_Cells]:
    """The cells of one way; none where fewer than two runs go it.

    What a run misses on the whole is taken off: its own friction is no physics.
    """
    counts = np.bincount(run)
    long = counts[run] >= FEWEST_SAMPLES
    missed, value, run = missed[long], value[long], run[long]
    runs, run = np.unique(run, return_inverse=True)
    if runs.size < 2:  # noqa: PLR2004 - that is a pair
        return
    missed = missed - (np.bincount(run, missed) / np.bincount(run))[run]
    edges = np.linspace(value.min(), value.max(), CELLS + 1)
    cell = np.clip(np.searchsorted(edges, value, side="right") - 1, 0, CELLS - 1)
    shape = (runs.size, CELLS)
    place, size = run * CELLS + cell, runs.size * CELLS
    sums = np.bincount(place, missed, size).reshape(shape)
    samples = np.bincount(place, minlength=size).reshape(shape)
    there = samples >= FEWEST_IN_CELL
    each = np.where(there, sums / np.sqrt(np.maximum(samples, 1)), 0.0)
    squares, count = np.sum(each**2, axis=0), there.sum(axis=0).astype(np.float64)
    cross = 0.5 * (np.sum(each, axis=0) ** 2 - squares)
    yield _Cells(cross, 0.5 * count * (count - 1.0), squares, count, edges)


def _sum_cells(what: str, ways: dict[int, _Cells]) -> RepeatedResidual:
    """What all cells come to, and where it is most."""
    every = ways.values()
    pairs = sum(float(one.pairs.sum()) for one in every)
    squares = sum(float(one.squares.sum()) for one in every)
    counts = sum(float(one.counts.sum()) for one in every)
    if not (pairs > 0.0 and squares > 0.0):
        return RepeatedResidual(what=what)
    cross = sum(float(one.cross.sum()) for one in every)
    size = cross / (math.sqrt(pairs) * squares / counts)
    way, most = max(ways.items(), key=lambda one: float(one[1].cross.max()))
    cell = int(np.argmax(most.cross))
    low, high = sorted(map(float, most.edges[cell : cell + 2]))
    return RepeatedResidual(size, what, way, low, high)
