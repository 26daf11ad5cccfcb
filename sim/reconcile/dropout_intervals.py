"""The intervals to exclude within a stretch of voltage dropouts.

An inspection tells a series of drop-outs as one stretch. Where the motor really lost its voltage,
the log between them is as good as any, and there may be no other: only those moments are left out,
until the speed has recovered. Where the record alone lost it, an open loop over the rest would lack
those volts, and the whole stretch is left out.
"""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array, Run
from sim.reconcile.thresholds import DROPPED, SHORTEST_WINDOW


def find_dropout_intervals(
    run: Run, *, start: float, end: float
) -> tuple[tuple[float, float], ...]:
    """Start and end times [s] to exclude; the whole interval where the motion did not react.

    Args:
        run: that was inspected.
        start: [s] on its clock, of the first drop-out.
        end: [s] of the last one's end.
    """
    found = list(_find_falls(run, start=start, end=end))
    if not found or np.median([_kept_speed(run, *one) for one in found]) > DROPPED:
        return ((start, end),)
    return tuple(
        (float(run.time[first]), float(run.time[_find_return(run, first, last)]))
        for first, last in found
    )


def _find_return(run: Run, first: int, last: int) -> int:
    """Index of the first sample after a voltage drop at which the speed has recovered."""
    speed = np.abs(run.velocity)
    usual = _running_median(speed, float(np.median(np.diff(run.time))))
    slowest = first + int(np.argmin(speed[first : _find_end_of_answer(run, last)]))
    back = np.flatnonzero(speed[slowest:] >= DROPPED * usual[slowest:])
    return max(last, slowest + int(back[0])) if back.size else last


def _find_end_of_answer(run: Run, last: int) -> int:
    """Index after the samples in which the speed would react to a voltage drop."""
    return int(np.searchsorted(run.time, run.time[last] + SHORTEST_WINDOW)) + 1


def _find_falls(run: Run, *, start: float, end: float) -> Iterator[tuple[int, int]]:
    """First and last sample of each fall of the voltage."""
    size = np.abs(run.voltage)
    low = size < DROPPED * _running_median(size, float(np.median(np.diff(run.time))))
    places = np.flatnonzero(low & (run.time >= start) & (run.time <= end))
    for group in _join_falls(places):
        yield int(group[0]), int(group[-1])


def _running_median(size: Array, period: float) -> Array:
    """(n,) running median."""
    half = max(round(SHORTEST_WINDOW / period), 2)
    padded = np.pad(size, half, mode="edge")
    return np.asarray(
        np.median(np.lib.stride_tricks.sliding_window_view(padded, 2 * half + 1), axis=1)
    )


def _join_falls(places: NDArray[np.intp]) -> list[NDArray[np.intp]]:
    if not places.size:
        return []
    return np.split(places, np.flatnonzero(np.diff(places) > 1) + 1)


def _kept_speed(run: Run, first: int, last: int) -> float:
    """[share] of its speed that it has in and after a fall."""
    speed = np.abs(run.velocity)
    before = float(np.median(speed[max(first - 2, 0) : first + 1]))
    slowest = float(np.min(speed[first : _find_end_of_answer(run, last)]))
    return slowest / before if before > 0.0 else 1.0
