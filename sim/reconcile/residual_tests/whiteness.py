"""Whiteness test: the least likely window of innovations.

A window of innovations that is far from nothing, measured by how far all such windows are: a force
at one place, a push at one moment, a voltage that was not there.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from sim.core.log import Array
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.measurements import ROBUST
from sim.estimation.run_records import RunRecord
from sim.reconcile.thresholds import FEWEST_SAMPLES, SHORTEST_WINDOW, STEP_VOLTAGE

SOON = 2.0 * SHORTEST_WINDOW  # [s] after a step, in which everything is fast


@dataclass(frozen=True)
class WorstWindow:
    """The window of innovations that is least likely.

    Args:
        size: [robust standard deviations of all windows as long].
        record: which run.
        start: [s] on the run's clock.
        end: [s].
    """

    size: float
    record: int
    start: float
    end: float


NO_WINDOW = WorstWindow(0.0, 0, 0.0, 0.0)
"""None at all."""


def find_worst_window(problem: PredictionErrorProblem, point: Estimate) -> WorstWindow:
    """Find the least likely window of innovations.

    What pushes moves position and velocity the same way: where both say so, they count together.
    """
    white = _remove_clock_errors(problem, point)
    moments = []
    for length in (SHORTEST_WINDOW, 2.0 * SHORTEST_WINDOW, 4.0 * SHORTEST_WINDOW):
        count = max(round(length / problem.period), 2)
        position, velocity = (_window_sizes(problem, white[:, column], count) for column in (0, 1))
        for record, one in position.items():
            other = velocity[record]
            together = np.where(one * other > 0.0, np.hypot(one, other), 0.0)
            size = np.max([np.abs(one), np.abs(other), together], axis=0)
            place = int(np.argmax(size))
            time = problem.records[record].measurements.time
            end = min(place + count, time.size - 1)
            moments.append(
                WorstWindow(float(size[place]), record, float(time[place]), float(time[end]))
            )
    return max(moments, key=lambda one: one.size, default=NO_WINDOW)


def _window_sizes(problem: PredictionErrorProblem, white: Array, count: int) -> dict[int, Array]:
    """Run -> (windows,) their sums, in robust standard deviations; 0 where samples are missing."""
    sums = dict(_window_sums(problem, white, count))
    every = np.concatenate([*sums.values(), np.zeros(0)])
    every = every[~np.isnan(every)]
    if every.size < FEWEST_SAMPLES:
        return {record: np.zeros(one.size) for record, one in sums.items()}
    spread = ROBUST * float(np.median(np.abs(every - np.median(every))))
    spread = max(spread, count**0.5)  # of independent innovations
    return {
        record: np.nan_to_num(one) / (spread * _ordinary_size(problem.records[record])[: one.size])
        for record, one in sums.items()
    }


def _remove_clock_errors(problem: PredictionErrorProblem, point: Estimate) -> Array:
    """(n, 2) white innovations, less what a clock of each run's own makes of them.

    A step comes a part of a sample late, another part in each run: that is of clocks, not of
    physics.
    """
    later = point.nuisance.add_lag(np.full(len(problem.records), 0.5 * problem.period))
    model = point.structure.model(point.values)
    more = problem.predict_errors(model, later, point.kalman_filter)
    white = point.innovations @ point.whitening.T
    change = np.nan_to_num(more - point.innovations) @ point.whitening.T
    for first, last in pairwise(problem.run_edges.tolist()):
        column, rest = change[first:last].ravel(), white[first:last].ravel()
        along = float(column @ column)
        share = -float(column @ rest) / along if along > 0.0 else 0.0
        white[first:last] += min(max(share, -1.0), 1.0) * change[first:last]
    return np.asarray(white)


def _ordinary_size(record: RunRecord) -> Array:
    """(n,) ordinary size of a window that begins there, relative to windows elsewhere.

    Soon after a step of the voltage everything is fast: what happens between two samples, as a
    battery that gives way and recovers, adds up to twice as much.
    """
    time = record.measurements.time
    jumps = time[np.abs(np.diff(record.measurements.voltage, prepend=0.0)) > STEP_VOLTAGE]
    last = np.searchsorted(jumps, time, side="right") - 1
    since = time - np.concatenate((jumps, [-np.inf]))[last]
    return np.where(since <= SOON, 2.0, 1.0)


def _window_sums(
    problem: PredictionErrorProblem, white: Array, count: int
) -> Iterator[tuple[int, Array]]:
    """Each run, and (windows,) sums of ``count`` innovations; nan where some are not compared."""
    for record, (first, last) in enumerate(
        zip(problem.run_edges[:-1], problem.run_edges[1:], strict=True)
    ):
        mine, compared = white[first:last], problem.informative[first:last]
        if mine.size <= count:
            continue
        total = np.concatenate(([0.0], np.cumsum(mine)))
        counts = np.concatenate(([0], np.cumsum(compared)))
        sums = total[count:] - total[:-count]
        sums[counts[count:] - counts[:-count] < count] = np.nan
        yield record, sums
