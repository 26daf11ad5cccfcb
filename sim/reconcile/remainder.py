"""What a model leaves: whether its innovations are noise, or something nobody has named.

A window of innovations that is far from nothing, measured by how far all such windows are: a force
at one place, a push at one moment, a voltage that was not there.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim.log import Array
from sim.reconcile.problem import Point, Problem

WINDOWS = (0.1, 0.2, 0.4)  # [s]
JUMP, AFTER = 1.0, 0.2  # [V] of a step, and [s] after it
ROBUST = 1.4826  # standard deviations in a median absolute deviation


@dataclass(frozen=True)
class Moment:
    """The moment that a model explains least.

    Args:
        size: [robust standard deviations of all windows as long].
        lane: which run.
        start: [s] on the run's clock.
        end: [s].
    """

    size: float
    lane: int
    start: float
    end: float


def worst(problem: Problem, point: Point) -> Moment:
    """The most unlikely window of innovations."""
    inverse = np.linalg.inv(np.linalg.cholesky(problem.spread(point.ahead)))
    white = np.nan_to_num(point.ahead) @ inverse.T
    white[_stepped(problem), 0] = 0.0
    moments = []
    for length in WINDOWS:
        count = max(round(length / problem.period), 2)
        for column in (0, 1):
            sums = list(_windows(problem, white[:, column], count))
            every = np.concatenate([one for _, one in sums]) if sums else np.zeros(0)
            if every.size < 20:  # noqa: PLR2004 - too few to know what is ordinary
                continue
            spread = ROBUST * float(np.median(np.abs(every - np.median(every))))
            spread = max(spread, 0.5 * count**0.5)
            for lane, one in sums:
                if one.size:
                    place = int(np.argmax(np.abs(one)))
                    time = problem.lanes[lane].seen.time
                    moments.append(
                        Moment(
                            float(abs(one[place])) / spread, lane, float(time[place]),
                            float(time[min(place + count, time.size - 1)]),
                        )
                    )  # fmt: skip
    return max(moments, key=lambda one: one.size, default=Moment(0.0, 0, 0.0, 0.0))


def _stepped(problem: Problem) -> NDArray[np.bool_]:
    """(n,) samples soon after a step of the voltage.

    A step comes a part of a sample late, another part in each run, and the position is ahead or
    behind by so much: of clocks, not of physics.
    """
    found = []
    for lane in problem.lanes:
        time = lane.seen.time
        jumps = time[np.abs(np.diff(lane.seen.voltage, prepend=0.0)) > JUMP]
        last = np.searchsorted(jumps, time, side="right") - 1
        since = time - np.concatenate((jumps, [-np.inf]))[last]
        found.append(since <= AFTER)
    return np.concatenate(found)


def _windows(problem: Problem, white: Array, count: int) -> Iterator[tuple[int, Array]]:
    """Sums of so many innovations, of each run; windows with untold samples are left out."""
    for lane, (first, last) in enumerate(zip(problem.edges[:-1], problem.edges[1:], strict=True)):
        mine, told = white[first:last], problem.telling[first:last]
        if mine.size <= count:
            continue
        total = np.concatenate(([0.0], np.cumsum(mine)))
        there = np.concatenate(([0], np.cumsum(told)))
        sums = total[count:] - total[:-count]
        sums[there[count:] - there[:-count] < count] = 0.0
        yield lane, sums
