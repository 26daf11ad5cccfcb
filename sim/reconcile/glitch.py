"""An encoder that slips: a velocity that leaves for a moment and is back at once.

What pushes a mechanism changes its velocity for as long as its time scale kA/kV. A sensor that
loses a few teeth shows a velocity that is far off for some samples and right again in the next, and
a position that stays off. Where the time scale is too short to tell the two apart, nothing is said.
"""

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from sim.engine import NO_TRUST
from sim.log import Array
from sim.reconcile.damage import Damaged
from sim.reconcile.lanes import Lane
from sim.reconcile.problem import Point, Problem

FAR = 10.0  # [robust standard deviations] that a slip's velocity is off at least
LONGEST = 0.1  # [s] it lasts
STARTING = 0.3  # [s] of a motion in which a model that lacks something errs by itself
BESIDE = 0.16  # [s] before and after it that must agree
BACK = 0.2  # [1] of its size that may be left after it
LONGEST_SHARP, FEWEST = 1.0, 3  # [s] the same of what comes and goes within a sample; samples of it
SLOW = 2.0  # [1] times a sample must be the time scale of the mechanism then
SUDDEN = 0.4  # [1] of its size that it comes and goes by from one sample to the next
CLEARLY = 4.0  # [1] times as long as it lasts must be the time scale of the mechanism


def glitches(problem: Problem, point: Point) -> Iterator[tuple[int, Damaged]]:
    """Which run slipped, from 0, and when.

    Args:
        problem: the measurements.
        point: the base model that follows them.
    """
    gains = point.hypothesis.model(point.values).gains
    scale = gains["kA"] / gains["kV"]
    track = problem.track(point.hypothesis.model(point.values), point.outset, NO_TRUST)
    errors = problem.measured[:, 1] - track[:, 3]
    near = max(round(BESIDE / problem.period), 3)
    for number, (first, last) in enumerate(pairwise(problem.edges.tolist())):
        lane = problem.lanes[number]
        mine = np.where(np.isnan(errors[first:last]), 0.0, errors[first:last])
        told = problem.telling[first:last]
        if mine.size < 4 * near or not told.any():
            continue
        apart = mine - _median(mine, near)
        spread = max(1.4826 * float(np.median(np.abs(apart[told]))), problem.noise.velocity)
        moves = np.flatnonzero(lane.seen.moving)
        began = float(lane.seen.time[moves[0]]) + STARTING if moves.size else np.inf
        open_ = told & (lane.seen.time > began)
        open_[:near] = open_[-near:] = False
        short = _short(apart, open_, spread, near=near, longest=scale / CLEARLY, lane=lane)
        sharp = _sharp(mine, open_, spread, near=near, scale=scale, lane=lane)
        for begin, end, size in (*short, *sharp):
            slip = _slip(lane, begin, end, size / spread, scale)
            yield number, replace(slip, run=number)


def _short(
    apart: Array, told: NDArray[np.bool_], spread: float, *, near: int, longest: float, lane: Lane
) -> Iterator[tuple[int, int, float]]:
    """First and last sample, and size, of what is over before a mechanism could have answered."""
    time = lane.seen.time
    for begin, end in _stretches((np.abs(apart) > FAR * spread) & told):
        length = float(time[end] - time[begin]) + float(time[1] - time[0])
        peak = float(np.max(np.abs(apart[begin : end + 1])))
        after = float(np.mean(apart[end + 2 : end + 2 + near // 2]))
        edges = (apart[begin] - apart[begin - 1], apart[end] - apart[end + 1])
        sudden = min(map(abs, edges)) > SUDDEN * peak
        soon = length <= min(LONGEST, longest)
        if end > begin and sudden and soon and abs(after) <= BACK * peak:
            yield begin, end, peak


def _sharp(
    errors: Array, told: NDArray[np.bool_], spread: float, *, near: int, scale: float, lane: Lane
) -> Iterator[tuple[int, int, float]]:
    """The same of what leaves from one sample to the next, stays, and is back as suddenly."""
    time = lane.seen.time
    if scale < SLOW * float(np.median(np.diff(time))):
        return  # so light a mechanism may do that
    jumps = np.diff(errors, prepend=errors[:1])
    far = np.flatnonzero((np.abs(jumps) > FAR * spread) & told)
    for begin, end in pairwise(far.tolist()):
        before, inside = errors[begin - near : begin], errors[begin:end]
        after = errors[end : end + near]
        size = abs(float(np.median(inside) - np.median(before)))
        if (
            end - begin >= FEWEST
            and time[end] - time[begin] <= LONGEST_SHARP
            and jumps[begin] * jumps[end] < 0.0
            and abs(float(np.median(after) - np.median(before))) < BACK * size
            and float(np.max(np.abs(inside - np.median(inside)))) < BACK * size
            and min(abs(jumps[begin]), abs(jumps[end])) > (1.0 - BACK) * size
        ):
            yield begin, end - 1, size


def _slip(lane: Lane, begin: int, end: int, noises: float, scale: float) -> Damaged:
    time = lane.seen.time
    length = float(time[end] - time[begin] + time[1] - time[0])
    return Damaged(
        None, float(time[begin]), float(time[end]), "encoder-slip", 1.0,
        f"In {lane.test}, {time[begin]:.2f} s, the velocity is off by {noises:.0f} times its noise "
        f"for {length * 1000:.0f} ms and right again at once, while the mechanism takes "
        f"{scale:.2f} s to change its speed.",
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
