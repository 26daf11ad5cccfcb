"""Whiteness test: the least likely window of innovations.

The sum of the innovations in a window is compared with that of all windows of the same length. A
large one shows a force at one position, a push, or a wrong voltage reading.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from sim.core.log import Array
from sim.core.units import ROBUST
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.run_nuisance import LAG
from sim.estimation.run_records import RunRecord
from sim.reconcile.thresholds import FEWEST_SAMPLES, SHORTEST_WINDOW, STEP_VOLTAGE

AFTER_STEP = 2.0 * SHORTEST_WINDOW  # [s] in which residuals are larger after a voltage step


@dataclass(frozen=True)
class WorstWindow:
    """The window of innovations that is least likely.

    Args:
        size: [robust standard deviations] of the windows of the same length.
        record: index of the run.
        start: [s] on the run's clock.
        end: [s] on the run's clock.
    """

    size: float = 0.0
    record: int = 0
    start: float = 0.0
    end: float = 0.0


def find_worst_window(problem: PredictionErrorProblem, point: Estimate) -> WorstWindow:
    """Find the least likely window of innovations.

    A force changes position and velocity in the same direction: windows where both do are combined.
    """
    white = _remove_clock_errors(problem, point)
    moments = []
    for length in (SHORTEST_WINDOW, 2.0 * SHORTEST_WINDOW, 4.0 * SHORTEST_WINDOW):
        count = max(round(length / problem.period), 2)
        position, velocity = (
            _measure_windows(problem, white[:, column], count) for column in (0, 1)
        )
        for record, one in position.items():
            other = velocity[record]
            combined = np.where(one * other > 0.0, np.hypot(one, other), 0.0)
            size = np.max([np.abs(one), np.abs(other), combined], axis=0)
            place = int(np.argmax(size))
            time = problem.records[record].measurements.time
            end = min(place + count, time.size - 1)
            moments.append(
                WorstWindow(float(size[place]), record, float(time[place]), float(time[end]))
            )
    return max(moments, key=lambda one: one.size, default=WorstWindow())


def _measure_windows(problem: PredictionErrorProblem, white: Array, count: int) -> dict[int, Array]:
    """Run -> (windows,) sums in robust standard deviations; 0 where samples are missing."""
    sums = dict(_sum_windows(problem, white, count))
    every = np.concatenate([*sums.values(), np.zeros(0)])
    every = every[~np.isnan(every)]
    if every.size < FEWEST_SAMPLES:
        return {record: np.zeros(one.size) for record, one in sums.items()}
    spread = ROBUST * float(np.median(np.abs(every - np.median(every))))
    spread = max(spread, count**0.5)  # standard deviation of a sum of independent innovations
    return {
        record: np.nan_to_num(one)
        / (spread * _measure_ordinary_size(problem.records[record])[: one.size])
        for record, one in sums.items()
    }


def _remove_clock_errors(problem: PredictionErrorProblem, point: Estimate) -> Array:
    """(n, 2) whitened innovations, corrected for a time shift of each run by up to half a sample.

    The voltage of a step is logged up to a sample early or late, which is not physics.
    """
    later = point.nuisance.add(LAG, 0.5 * problem.period)
    shifted = problem.predict_errors(point.model, later, point.kalman_filter)
    white = point.innovations @ point.whitening.T
    change = np.nan_to_num(shifted - point.innovations) @ point.whitening.T
    for rows in problem.run_slices:
        column, residual = change[rows].ravel(), white[rows].ravel()
        square = float(column @ column)
        share = -float(column @ residual) / square if square > 0.0 else 0.0
        white[rows] += min(max(share, -1.0), 1.0) * change[rows]
    return np.asarray(white)


def _measure_ordinary_size(record: RunRecord) -> Array:
    """(n,) [1] ordinary size of a window that begins at a sample, relative to other windows.

    It is 2 soon after a voltage step, where effects between two samples, like a short sag of the
    battery, double the sums.
    """
    time = record.measurements.time
    jumps = time[np.abs(np.diff(record.measurements.voltage, prepend=0.0)) > STEP_VOLTAGE]
    last = np.searchsorted(jumps, time, side="right") - 1
    since = time - np.concatenate((jumps, [-np.inf]))[last]
    return np.where(since <= AFTER_STEP, 2.0, 1.0)


def _sum_windows(
    problem: PredictionErrorProblem, white: Array, count: int
) -> Iterator[tuple[int, Array]]:
    """Per run, its index and (windows,) sums of ``count`` innovations; nan if not all compared."""
    for record, rows in enumerate(problem.run_slices):
        values, compared = white[rows], problem.informative[rows]
        if values.size <= count:
            continue
        total = np.concatenate(([0.0], np.cumsum(values)))
        counts = np.concatenate(([0], np.cumsum(compared)))
        sums = total[count:] - total[:-count]
        sums[counts[count:] - counts[:-count] < count] = np.nan
        yield record, sums
