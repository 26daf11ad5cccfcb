"""One time base for signals with different sample times.

SysId takes the times of the voltage and interpolates the other signals linearly. That is right if
every signal is logged every loop. It fails if only changes are logged: a step test then has a
single voltage sample. In such a log, each value holds until the next one (zero-order hold).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from sim.core.log import Array
from sim.io.entries.entry import Numbers

FEWER = 2.0  # [1] a signal with so many times fewer samples than another was not logged every loop
PAUSE = 5.0  # [typical gaps] in a longer pause, the value did not change
BEYOND = 0.75  # [typical gaps] a signal is extrapolated at most so far
SAME_LOOP = 500  # [µs] values logged closer together belong to one loop; the fastest take 1 ms


@dataclass(frozen=True, eq=False)
class Series:
    """One signal over the whole log.

    Args:
        time: (n,) [µs], never decreasing.
        values: (n,).
    """

    time: Numbers
    values: Array

    def between(self, begin: int, end: int) -> "Series":
        """The samples with begin <= t < end."""
        first, last = np.searchsorted(self.time, (begin, end))
        return Series(self.time[first:last], self.values[first:last])

    def __len__(self) -> int:
        return int(self.time.size)

    @property
    def time_count(self) -> int:
        """Number of different times."""
        return int(np.count_nonzero(np.diff(self.time)) + min(len(self), 1))


def logs_only_changes(
    signals: Sequence[Series], spans: Sequence[tuple[int, int]], *, suspected: bool = False
) -> bool:
    """Whether values were logged only when they changed.

    In such a log, no signal repeats a value, and a constant signal has a long pause while the
    others go on. The signal of a slow sensor also has fewer samples, but at a constant rate.

    Args:
        signals: voltage, position and velocity of each motor.
        spans: begin and end of each run [µs].
        suspected: whether the source usually logs only changes, so that no pause is required.
    """
    parts = [[signal.between(*span) for span in spans] for signal in signals]
    if any(np.any(part.values[1:] == part.values[:-1]) for row in parts for part in row):
        return False
    return suspected or any(
        few and _has_pause(row, parts, spans)
        for row, few in zip(parts, find_sparse_signals(parts), strict=True)
    )


def find_sparse_signals(parts: Sequence[Sequence[Series]]) -> list[bool]:
    """For each signal, whether another one has ``FEWER`` times as many samples in some run.

    Args:
        parts: for each signal, its samples in each run.
    """
    counts = np.array([[len(part) for part in row] for row in parts])
    return [bool(few) for few in np.any(counts * FEWER < counts.max(axis=0), axis=1)]


def _has_pause(
    row: Sequence[Series], parts: Sequence[Sequence[Series]], spans: Sequence[tuple[int, int]]
) -> bool:
    """Whether a signal has a pause in some run that is much longer than its typical gap."""
    gaps = np.concatenate([np.diff(part.time) for part in row])
    typical = float(np.median(gaps)) if gaps.size else 0.0
    for number, (part, (begin, _)) in enumerate(zip(row, spans, strict=True)):
        last = max(
            (int(other[number].time[-1]) for other in parts if len(other[number])), default=0
        )
        if np.diff(part.time, prepend=begin, append=max(last, begin)).max() > PAUSE * typical:
            return True
    return False


def find_loop_times(signals: Sequence[Series], begin: int, end: int) -> Numbers:
    """Times in a run at which any signal changed, one per loop, after each has its first value.

    Returns:
        (n,) [µs]; the time of the last change in each loop.
    """
    changes = np.concatenate([signal.between(begin, end).time for signal in signals])
    time: Numbers = np.unique(changes)
    last = np.diff(time, append=end) > 0
    last[:-1] = np.diff(time) > SAME_LOOP
    known = max(int(signal.time[0]) for signal in signals)
    return time[last & (time >= known)]


def hold_last_value(signal: Series, time: Numbers) -> Array:
    """The last value of a signal at each time (n,); no time may be before its first sample."""
    return signal.values[np.searchsorted(signal.time, time, side="right") - 1]


def select_covered_times(parts: Sequence[Series], time: Numbers) -> Numbers:
    """The times of a run that every signal covers, or nearly covers.

    A signal may be extrapolated by less than a loop, because its times differ from those of the
    voltage, but not by a whole loop.
    """
    for part in parts:
        reach = BEYOND * float(np.median(np.diff(part.time)))
        time = time[(time >= part.time[0] - reach) & (time <= part.time[-1] + reach)]
    return time


def interpolate_linear(part: Series, time: Numbers) -> Array:
    """A signal at other times (n,): linear between its samples, extrapolated outside.

    Args:
        part: its samples in a run, at two different times or more, or exactly at ``time``.
        time: (n,) [µs].
    """
    if np.array_equal(part.time, time):
        return part.values
    fresh = np.diff(part.time, prepend=part.time[0] - 1) > 0
    at, values = part.time[fresh], part.values[fresh]
    after = np.clip(np.searchsorted(at, time, side="right"), 1, at.size - 1)
    before = after - 1
    share = (time - at[before]) / (at[after] - at[before])
    return values[before] + share * (values[after] - values[before])
