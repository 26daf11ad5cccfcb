"""The intervals to exclude within a series of voltage dropouts.

An inspection reports a series of dropouts as one interval. If the motor really lost its voltage,
the samples between the dropouts are good: only each dropout is excluded, until the speed has
recovered. If only the record lost the voltage, a simulation of the rest would lack those volts, and
the whole interval is excluded.
"""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array, Run

DROPPED = 0.9
"""[1] A voltage below this share of its median has dropped, and a speed below this share of what it
was has followed."""

RESPONSE = 0.1
"""[s] Time within which the speed responds to a dropout."""


def find_dropout_intervals(
    run: Run, *, start: float, end: float
) -> tuple[tuple[float, float], ...]:
    """Start and end times [s] to exclude; the whole interval where the motion did not react.

    Args:
        run: that was inspected.
        start: [s] on its clock, of the first drop-out.
        end: [s] of the last one's end.
    """
    found = list(_find_dropouts(run, start=start, end=end))
    if not found or np.median([_compute_kept_speed(run, *one) for one in found]) > DROPPED:
        return ((start, end),)
    return tuple(
        (float(run.time[first]), float(run.time[_find_recovery(run, first, last)]))
        for first, last in found
    )


def _find_recovery(run: Run, first: int, last: int) -> int:
    """Index of the first sample after a voltage drop at which the speed has recovered."""
    speed = np.abs(run.velocity)
    usual = _running_median(speed, float(np.median(np.diff(run.time))))
    slowest = first + int(np.argmin(speed[first : _find_response_end(run, last)]))
    back = np.flatnonzero(speed[slowest:] >= DROPPED * usual[slowest:])
    return max(last, slowest + int(back[0])) if back.size else last


def _find_response_end(run: Run, last: int) -> int:
    """Index after the samples in which the speed would react to a voltage drop."""
    return int(np.searchsorted(run.time, run.time[last] + RESPONSE)) + 1


def _find_dropouts(run: Run, *, start: float, end: float) -> Iterator[tuple[int, int]]:
    """First and last sample of each dropout."""
    size = np.abs(run.voltage)
    low = size < DROPPED * _running_median(size, float(np.median(np.diff(run.time))))
    places = np.flatnonzero(low & (run.time >= start) & (run.time <= end))
    for group in _group_samples(places):
        yield int(group[0]), int(group[-1])


def _running_median(size: Array, period: float) -> Array:
    """(n,) running median."""
    half = max(round(RESPONSE / period), 2)
    padded = np.pad(size, half, mode="edge")
    return np.asarray(
        np.median(np.lib.stride_tricks.sliding_window_view(padded, 2 * half + 1), axis=1)
    )


def _group_samples(places: NDArray[np.intp]) -> list[NDArray[np.intp]]:
    """The indices in groups of consecutive ones."""
    if not places.size:
        return []
    return np.split(places, np.flatnonzero(np.diff(places) > 1) + 1)


def _compute_kept_speed(run: Run, first: int, last: int) -> float:
    """[1] Least speed during and after a dropout, over the speed before it."""
    speed = np.abs(run.velocity)
    before = float(np.median(speed[max(first - 2, 0) : first + 1]))
    slowest = float(np.min(speed[first : _find_response_end(run, last)]))
    return slowest / before if before > 0.0 else 1.0
