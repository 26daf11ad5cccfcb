"""An encoder that slips: a velocity that leaves for a moment and is back at once.

What pushes a mechanism changes its velocity for as long as its time scale kA/kV. A sensor that
loses a few teeth shows a velocity that is far off for some samples and right again in the next, and
a position that stays off. Where the time scale is too short to tell the two apart, nothing is said.
"""

from collections.abc import Iterator
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from sim.engine import NO_TRUST
from sim.log import Array
from sim.reconcile.damage import Damaged
from sim.reconcile.problem import Point, Problem

FAR = 10.0  # [robust standard deviations] that a slip's velocity is off at least
LONGEST = 0.1  # [s] it lasts
STARTING = 0.3  # [s] of a motion in which a model that lacks something errs by itself
BESIDE = 0.16  # [s] before and after it that must agree
BACK = 0.2  # [1] of its size that may be left after it
CLEARLY = 4.0  # [1] times as long as it lasts must be the time scale of the mechanism


def glitches(problem: Problem, point: Point) -> Iterator[tuple[int, Damaged]]:
    """Which run slipped, from 0, and when.

    Args:
        problem: the measurements.
        point: the base model that follows them.
    """
    gains = point.hypothesis.model(point.values).gains
    scale = gains["kA"] / gains["kV"]
    track = problem.track(point.hypothesis.model(point.values), point.starts, NO_TRUST)
    errors = problem.measured[:, 1] - track[:, 3]
    near = max(round(BESIDE / problem.period), 3)
    for number, (first, last) in enumerate(pairwise(problem.edges.tolist())):
        lane = problem.lanes[number]
        mine = np.where(np.isnan(errors[first:last]), 0.0, errors[first:last])
        told = problem.telling[first:last]
        if mine.size < 4 * near:
            continue
        smooth = _median(mine, near)
        apart = mine - smooth
        spread = max(1.4826 * float(np.median(np.abs(apart[told]))), problem.noise.velocity)
        far = (np.abs(apart) > FAR * spread) & told
        moves = np.flatnonzero(lane.seen.moving)
        began = float(lane.seen.time[moves[0]]) + STARTING if moves.size else np.inf
        far &= lane.seen.time > began
        far[:near] = far[-near:] = False
        for begin, end in _stretches(far):
            time = lane.seen.time
            length = float(time[end] - time[begin]) + problem.period
            peak = float(np.max(np.abs(apart[begin : end + 1])))
            after = float(np.mean(apart[end + 2 : end + 2 + near // 2]))
            if (
                end == begin
                or length > LONGEST
                or CLEARLY * length > scale
                or abs(after) > BACK * peak
            ):
                continue
            yield number, Damaged(
                number, float(time[begin]), float(time[end]), "encoder-slip", 1.0,
                f"In {lane.test}, {time[begin]:.2f} s, the velocity is off by {peak / spread:.0f} "
                f"times its noise for {length * 1000:.0f} ms and right again at once, while the "
                f"mechanism takes {scale:.2f} s to change its speed.",
                "Check the encoder's mounting, set screw and belt; record that test again.",
            )  # fmt: skip


def _median(values: Array, reach: int) -> Array:
    """(n,) medians over so many samples on both sides."""
    wide = np.pad(values, reach, mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(wide, 2 * reach + 1)
    return np.asarray(np.median(windows, axis=1))


def _stretches(here: NDArray[np.bool_]) -> Iterator[tuple[int, int]]:
    """First and last sample of each stretch."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], here.astype(int), [0]))))
    for begin, end in zip(edges[::2], edges[1::2], strict=True):
        yield int(begin), int(end) - 1
