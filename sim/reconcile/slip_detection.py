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

FAR = 10.0  # [robust standard deviations] that a slip's velocity is off at least
BESIDE = 0.16  # [s] before and after it that must agree
SHORT, LONG = 2, 4  # [1] times that, which a run lasts at least, and to tell what is ordinary in it
BACK = 0.2  # [1] of its size that may be left after it, or be otherwise than a slip has it

# What is over before a mechanism could have answered:
STARTING = 0.3  # [s] of a motion in which a model that lacks something errs by itself
LONGEST = 0.1  # [s] it lasts
SUDDEN = 0.4  # [1] of its size that it comes and goes by from one sample to the next
CLEARLY = 4.0  # [1] times as long as it lasts must be the time scale of the mechanism

# What is a share of the speed, and comes and goes within a sample:
STARTING_SHARP = 0.2  # [s] the same: free play is crossed by then
EDGE_EARLY = 0.6  # [1] of it, before which no edge is; one of them is after it
LONGEST_SHARP, FEWEST = 1.0, 3  # [s] it lasts at most, and samples at least, and those after it
SEEN, NOISES = 4.0, 2.0  # [robust standard deviations] of its lesser edge, and of noise at one
OTHERS = 4  # [jumps for each slip, its own two among them] with more, something else jumps
SLOW = 1.25  # [1] times a sample must be the time scale of the mechanism then
"""What pushes brings it to half of its new speed in a sample, and a slip to all of it."""


@dataclass(frozen=True, eq=False)
class _Errors:
    """What an open loop leaves of a run's velocity.

    Args:
        record: the run.
        left: (n,) measured less simulated.
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
        return np.where(self.told & (self.since > EDGE_EARLY * STARTING_SHARP), jumps, 0.0)

    @property
    def clear(self) -> list[int]:
        """Where a jump is far from ordinary, and not of the motion's start."""
        late = self.since > STARTING_SHARP
        return np.flatnonzero((np.abs(self.jumps) > FAR * self.spread) & late).tolist()


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
    sharp = _find_sharp_jumps(every.values()) if scale >= SLOW * problem.period else {}
    for number, run in every.items():
        short = _find_short_deviations(run, longest=scale / CLEARLY)
        for begin, end, size in (*short, *sharp.get(run, ())):
            slip = _is_slip(run.record, begin, end, size / run.spread, scale)
            yield number, replace(slip, run=number)


def _errors(problem: PredictionErrorProblem, point: Estimate) -> Iterator[tuple[int, _Errors]]:
    """Which run -> what is left of it."""
    speeds = problem.simulate(point.structure.model(point.values), point.nuisance).seen
    near = max(round(BESIDE / problem.period), 3)
    for number, (first, last) in enumerate(pairwise(problem.run_edges.tolist())):
        record, told = problem.records[number], problem.informative[first:last].copy()
        left = np.nan_to_num(problem.measured[first:last, 1] - speeds[first:last])
        moves = np.flatnonzero(record.measurements.moving)
        if left.size < SHORT * near or not told.any() or not moves.size:
            continue
        apart = np.abs(left - _median(left, near))[told]
        if left.size < LONG * near:  # the slip itself is a good part of it
            apart = np.abs(np.diff(left, prepend=left[:1]))[told] / math.sqrt(2.0)
        spread = max(ROBUST * float(np.median(apart)), problem.noise.velocity)
        told[:near] = told[-FEWEST:] = False
        since = record.measurements.time - float(record.measurements.time[moves[0]])
        yield number, _Errors(record, left, speeds[first:last], told, since, near, spread)


def _find_short_deviations(run: _Errors, *, longest: float) -> Iterator[tuple[int, int, float]]:
    """First and last sample, and size, of what is over before a mechanism could have answered."""
    time, near = run.record.measurements.time, run.near
    apart = run.left - _median(run.left, near)
    told = run.told & (run.since > STARTING)
    told[-near:] = False
    for begin, end in _find_intervals((np.abs(apart) > FAR * run.spread) & told):
        length = float(time[end] - time[begin]) + float(time[1] - time[0])
        peak = float(np.max(np.abs(apart[begin : end + 1])))
        after = float(np.mean(apart[end + 2 : end + 2 + near // 2]))
        edges = (apart[begin] - apart[begin - 1], apart[end] - apart[end + 1])
        sudden = min(map(abs, edges)) > SUDDEN * peak
        soon = length <= min(LONGEST, longest)
        if end > begin and sudden and soon and abs(after) <= BACK * peak:
            yield begin, end, peak


def _find_sharp_jumps(every: Iterable[_Errors]) -> dict[_Errors, list[tuple[int, int, float]]]:
    """The same, of each run, of what goes from one sample to the next and is back as suddenly.

    An encoder slips once: where more jumps are left that are none, something else makes them.
    """
    found = {run: list(_find_sharp_jump(run)) for run in every}
    jumps = sum(len(run.clear) for run in found)
    return found if jumps <= OTHERS * sum(map(len, found.values())) else {}


def _find_sharp_jump(run: _Errors) -> Iterator[tuple[int, int, float]]:
    time, jumps = run.record.measurements.time, run.jumps
    edges = np.flatnonzero(np.abs(jumps) > SEEN * run.spread).tolist()
    done = 0
    for clear in run.clear:
        others = [
            one
            for one in edges
            if abs(one - clear) >= FEWEST
            and abs(time[one] - time[clear]) <= LONGEST_SHARP
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
    alike = rest < BACK * size and edges < BACK * size + NOISES * run.spread
    return size if alike and abs(after - before) < BACK * size + run.spread else 0.0


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
