"""The start of a step response: whether the speed falls, or stops rising, on the way up.

Under a constant voltage the speed of a single mass rises all the time. It never falls, and never
stops rising and then rises again. The speed is the slope of the position here, because a recorded
velocity is often averaged over a tenth of a second, which hides both. An event counts if it is
clearly larger than the same in the rest of the run, where nothing happens.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array, Run

HALF = 0.02  # [s] half of the time over which a slope is taken; less shows the encoder's noise
WAIT_HALF = 0.04  # [s] the same for a wait, which lasts longer
LAUNCH = 0.8  # [s] after the step, in which a robot starts
REST = 0.4  # [s] of the run after that, at least, for comparison
ON, STAYS = 0.3, 2  # [share of the largest voltage, samples] from which on a step is applied
UP = 0.3  # [share of the top speed] below it the motor crosses a backlash
LEAST = 0.12  # [share of the speed] a fall, [of the top speed] the climb after a wait
WAITS = 0.03  # [share of the top speed] largest rise in a wait
LASTS = 0.15  # [s] length of a wait
LARGER = 1.5  # [times] the size of the same event later in the run
SAGS = 0.15  # [share of the voltage] if it falls by more, the speed falls with the voltage
HELD = 2  # [samples] that repeat a position, from which on single frames show as spikes


@dataclass(frozen=True)
class LaunchEvent:
    """An interval in which the speed fell or stood still while it should have risen.

    Args:
        size: [1] share of the speed by which it fell, or of the top speed by which it then rose.
        begin: index of the highest speed before a fall, or of the begin of a wait.
        end: index of the lowest speed of a fall, or of the end of a wait.
        speed: [m/s or rad/s] speed before the fall, or at the end of the wait.
        kind: ``fall`` or ``wait``.
    """

    size: float
    begin: int
    end: int
    speed: float
    kind: str


def find_launch_event(run: Run) -> LaunchEvent | None:
    """Find a fall or a wait in the launch of a step test; None if there is none, or no launch."""
    first = find_step_start(run)
    since = run.time - run.time[first]
    if len(run) <= first + 2 * STAYS or since[-1] < LAUNCH + REST:
        return None
    period = float(np.median(np.diff(run.time)))
    top = float(
        np.percentile(_compute_position_slope(run, half=max(HALF, period))[since > 0.0], 90)
    )
    if not top > 0.0:
        return None
    for find, half, wait in (
        (_find_largest_fall, HALF, 0.0),
        (_find_largest_climb, WAIT_HALF, LASTS),
    ):
        speed = _compute_position_slope(run, half=max(half, period))
        event = find(since, speed, (0.0, LAUNCH), top=top)
        later = find(since, speed, (LAUNCH + wait, float(since[-1]) - 2.0 * WAIT_HALF), top=top)
        if (
            event
            and event.size >= max(LEAST, LARGER * later.size if later else 0.0)
            and not _voltage_sags(run, first, event)
        ):
            return event
    return None


def find_step_start(run: Run) -> int:
    """Index of the sample from which on the voltage is applied and stays."""
    size = np.abs(run.voltage)
    on = size > ON * float(size.max(initial=0.0))
    if on.size <= STAYS:
        return int(np.argmax(on)) if on.size else 0
    stays = on[:-STAYS] & on[1 : on.size - STAYS + 1] & on[STAYS:]
    return int(np.argmax(stays)) if stays.any() else int(np.argmax(on))


def _compute_position_slope(run: Run, *, half: float) -> Array:
    """(n,) [m/s or rad/s] slope of the position over twice ``half`` [s], positive on the way."""
    early = np.clip(run.time - half, run.time[0], run.time[-1])
    late = np.clip(run.time + half, run.time[0], run.time[-1])
    way = np.interp(late, run.time, run.position) - np.interp(early, run.time, run.position)
    speed = way / (late - early) * np.sign(run.position[-1] - run.position[0])
    moving = int(np.count_nonzero(run.velocity))
    changes = int(np.count_nonzero(np.diff(run.position[run.velocity != 0.0])))
    if half > HALF or moving >= HELD * max(changes, 1):
        wide = 2 * round(half / float(np.median(np.diff(run.time)))) + 1
        padded = np.pad(speed, wide // 2, mode="edge")
        speed = np.median(np.lib.stride_tricks.sliding_window_view(padded, wide), axis=1)
    return np.asarray(speed)


def _find_largest_fall(
    since: Array, speed: Array, within: tuple[float, float], *, top: float
) -> LaunchEvent | None:
    """The largest fall below an earlier speed that the run reaches again."""
    at = _find_samples_within(since, within)
    if not at.size:
        return None
    inside = speed[at]
    peak = np.maximum.accumulate(inside)
    recovers = np.maximum.accumulate(inside[::-1])[::-1] >= peak
    share = 1.0 - inside / np.maximum(peak, UP * top)
    fall = np.where((peak > UP * top) & recovers, share, 0.0)
    low = int(np.argmax(fall))
    begin = int(np.argmax(inside[: low + 1] >= peak[low]))
    return LaunchEvent(float(fall[low]), int(at[begin]), int(at[low]), float(peak[low]), "fall")


def _find_largest_climb(
    since: Array, speed: Array, within: tuple[float, float], *, top: float
) -> LaunchEvent | None:
    """The largest rise after an interval of ``LASTS`` in which the speed hardly rose."""
    best = None
    at_end = since > since[-1] - REST  # a rise until the end is a load that changes
    for k in _find_samples_within(since, (within[0], within[1] - LASTS)).tolist():
        ends = int(np.searchsorted(since, since[k] + LASTS))
        behind = int(np.searchsorted(since, min(since[k] + LAUNCH, within[1] + LASTS)))
        if behind <= ends:
            continue
        waits = float(speed[k : ends + 1].max() - speed[k]) <= WAITS * top
        reached = float(speed[ends:behind].max())
        climb = (reached - float(speed[ends])) / top if waits else 0.0
        larger = climb > (best.size if best else 0.0)
        if larger and float(np.median(speed[at_end])) < reached + WAITS * top:
            best = LaunchEvent(climb, k, ends, float(speed[ends]), "wait")
    return best


def _find_samples_within(since: Array, within: tuple[float, float]) -> NDArray[np.intp]:
    """Indices of the samples within an interval [s]."""
    return np.flatnonzero((since >= within[0]) & (since <= within[1]))


def _voltage_sags(run: Run, first: int, found: LaunchEvent) -> bool:
    """Whether the voltage drops, too, a little before the speed or with it."""
    begin = int(np.searchsorted(run.time, run.time[found.begin] - 2.0 * HALF))
    size = np.abs(run.voltage)
    usual = float(np.median(size[first:]))
    meanwhile = size[max(begin, first + STAYS) : found.end + 1]
    return bool(meanwhile.min(initial=usual) < (1.0 - SAGS) * usual)
