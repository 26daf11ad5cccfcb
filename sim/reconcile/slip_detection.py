"""Detect encoder slips: a velocity that jumps and returns faster than the mechanism could.

What pushes a mechanism changes its velocity for as long as its time scale kA/kV. A sensor that
loses a few teeth shows a velocity that is far off for some samples and right again in the next, and
one that slips reads a share of the speed for a while; either goes and comes within a sample. Where
the time scale is too short to tell that from a push, nothing is said.
"""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.measurements import ROBUST
from sim.estimation.run_records import RunRecord
from sim.reconcile.damage import DamagedInterval
from sim.reconcile.thresholds import (
    LONG_RUN,
    SHARP_EDGE_EARLY,
    SHARP_FEWEST,
    SHARP_LONGEST,
    SHARP_NOISES,
    SHARP_OTHERS,
    SHARP_SEEN,
    SHARP_SLOW,
    SHARP_STARTING,
    SHORT_RUN,
    SLIP_CLEARLY,
    SLIP_FAR,
    SLIP_LONGEST,
    SLIP_NEIGHBORHOOD,
    SLIP_REST,
    SLIP_STARTING,
    SLIP_SUDDEN,
)


@dataclass(frozen=True, eq=False)
class _Errors:
    """The velocity residual of a run in an open-loop simulation.

    Args:
        record: the run.
        left: (n,) measured minus simulated.
        speed: (n,) simulated.
        told: (n,) whether it is compared, and not at the very beginning or end.
        since: (n,) [s] since it moved.
        near: samples before and after a slip that must agree.
        spread: what is ordinary from one sample to the next.
    """

    record: RunRecord
    left: Array
    speed: Array
    told: NDArray[np.bool_]
    since: Array
    near: int
    spread: float

    @property
    def jumps(self) -> Array:
        """(n,) from the sample before, where a slip may begin or end."""
        jumps = np.diff(self.left, prepend=self.left[:1])
        return np.where(self.told & (self.since > SHARP_EDGE_EARLY * SHARP_STARTING), jumps, 0.0)

    @property
    def clear(self) -> list[int]:
        """Where a jump is far from ordinary, and not of the motion's start."""
        late = self.since > SHARP_STARTING
        return np.flatnonzero((np.abs(self.jumps) > SLIP_FAR * self.spread) & late).tolist()


def detect_slips(
    problem: PredictionErrorProblem, point: Estimate
) -> Iterator[tuple[int, DamagedInterval]]:
    """The slips: index of the run, and time.

    Args:
        problem: the measurements.
        point: the base model that follows them.
    """
    gains = point.structure.model(point.values).gains
    scale = gains["kA"] / gains["kV"]
    every = dict(_errors(problem, point))
    sharp = _find_sharp_jumps(every.values()) if scale >= SHARP_SLOW * problem.period else {}
    for number, run in every.items():
        short = _find_short_deviations(run, longest=scale / SLIP_CLEARLY)
        for begin, end, size in (*short, *sharp.get(run, ())):
            slip = _is_slip(run.record, begin, end, size / run.spread, scale)
            yield number, replace(slip, run=number)


def _errors(problem: PredictionErrorProblem, point: Estimate) -> Iterator[tuple[int, _Errors]]:
    """Index of a run -> its residual."""
    speeds = problem.simulate(point.structure.model(point.values), point.nuisance).seen
    near = max(round(SLIP_NEIGHBORHOOD / problem.period), 3)
    for number, (first, last) in enumerate(pairwise(problem.run_edges.tolist())):
        record, told = problem.records[number], problem.informative[first:last].copy()
        left = np.nan_to_num(problem.measured[first:last, 1] - speeds[first:last])
        moves = np.flatnonzero(record.measurements.moving)
        if left.size < SHORT_RUN * near or not told.any() or not moves.size:
            continue
        apart = np.abs(left - _median(left, near))[told]
        if left.size < LONG_RUN * near:  # the slip itself is a good part of it
            apart = np.abs(np.diff(left, prepend=left[:1]))[told] / math.sqrt(2.0)
        spread = max(ROBUST * float(np.median(apart)), problem.noise.velocity)
        told[:near] = told[-SHARP_FEWEST:] = False
        since = record.measurements.time - float(record.measurements.time[moves[0]])
        yield number, _Errors(record, left, speeds[first:last], told, since, near, spread)


def _find_short_deviations(run: _Errors, *, longest: float) -> Iterator[tuple[int, int, float]]:
    """First and last sample, and size, of what is over before a mechanism could have answered."""
    time, near = run.record.measurements.time, run.near
    apart = run.left - _median(run.left, near)
    told = run.told & (run.since > SLIP_STARTING)
    told[-near:] = False
    for begin, end in _find_intervals((np.abs(apart) > SLIP_FAR * run.spread) & told):
        length = float(time[end] - time[begin]) + float(time[1] - time[0])
        peak = float(np.max(np.abs(apart[begin : end + 1])))
        after = float(np.mean(apart[end + 2 : end + 2 + near // 2]))
        edges = (apart[begin] - apart[begin - 1], apart[end] - apart[end + 1])
        sudden = min(map(abs, edges)) > SLIP_SUDDEN * peak
        soon = length <= min(SLIP_LONGEST, longest)
        if end > begin and sudden and soon and abs(after) <= SLIP_REST * peak:
            yield begin, end, peak


def _find_sharp_jumps(every: Iterable[_Errors]) -> dict[_Errors, list[tuple[int, int, float]]]:
    """The same, of each run, of what goes from one sample to the next and is back as suddenly.

    An encoder slips once: where more jumps are left that are none, something else makes them.
    """
    found = {run: list(_find_sharp_jump(run)) for run in every}
    jumps = sum(len(run.clear) for run in found)
    return found if jumps <= SHARP_OTHERS * sum(map(len, found.values())) else {}


def _find_sharp_jump(run: _Errors) -> Iterator[tuple[int, int, float]]:
    time, jumps = run.record.measurements.time, run.jumps
    edges = np.flatnonzero(np.abs(jumps) > SHARP_SEEN * run.spread).tolist()
    done = 0
    for clear in run.clear:
        others = [
            one
            for one in edges
            if abs(one - clear) >= SHARP_FEWEST
            and abs(time[one] - time[clear]) <= SHARP_LONGEST
            and jumps[one] * jumps[clear] < 0.0
            and min(one, clear) >= done
        ]
        if not others:
            continue
        begin, end = sorted((clear, max(others, key=lambda one: abs(jumps[one]))))
        size = _lost_speed(run, begin, end)
        if size > 0.0:
            done = end
            yield begin, end - 1, size


def _lost_speed(run: _Errors, begin: int, end: int) -> float:
    """[unit/s] of a share of the speed that is lost between two samples; 0 if it is no such."""
    before = float(np.median(run.left[begin - run.near : begin]))
    after = float(np.median(run.left[end : end + run.near]))
    left, speed = run.left[begin:end] - 0.5 * (before + after), run.speed[begin:end]
    share = float(left @ speed) / max(float(speed @ speed), 1e-300)
    size = abs(share) * float(np.sqrt(np.mean(np.square(speed))))
    rest = float(np.sqrt(np.mean(np.square(left - share * speed))))
    jumps = run.jumps
    edges = max(abs(jumps[begin] - share * speed[0]), abs(jumps[end] + share * speed[-1]))
    alike = rest < SLIP_REST * size and edges < SLIP_REST * size + SHARP_NOISES * run.spread
    return size if alike and abs(after - before) < SLIP_REST * size + run.spread else 0.0


def _is_slip(
    record: RunRecord, begin: int, end: int, noises: float, scale: float
) -> DamagedInterval:
    time = record.measurements.time
    length = float(time[end] - time[begin] + time[1] - time[0])
    return DamagedInterval(
        None, float(time[begin]), float(time[end]), "encoder-slip", 1.0,
        f"In {record.test}, {time[begin]:.2f} s, the velocity is off by {noises:.0f} times its "
        f"noise for {length * 1000:.0f} ms and right again at once, while the mechanism takes "
        f"{scale:.2f} s to change its speed.",
        "Check the encoder's mounting, set screw and belt; record that test again.",
    )  # fmt: skip


def _median(values: Array, reach: int) -> Array:
    """(n,) medians over so many samples on both sides."""
    wide = np.pad(values, reach, mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(wide, 2 * reach + 1)
    return np.asarray(np.median(windows, axis=1))


def _find_intervals(here: NDArray[np.bool_]) -> Iterator[tuple[int, int]]:
    """First and last sample of each stretch."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], here.astype(int), [0]))))
    for begin, end in zip(edges[::2], edges[1::2], strict=True):
        yield int(begin), int(end) - 1
