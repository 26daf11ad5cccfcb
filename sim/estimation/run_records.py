"""The runs of a log, prepared for fitting: fresh samples, start, travel and clock."""

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array, Log
from sim.estimation.measurements import ROBUST, RunMeasurements, measure_runs
from sim.physics.voltage_residual import list_run_start_times, shares_clock

FEWEST = 4  # samples of a run that can be compared, as ``measure_runs`` takes them
AT_REST = 0.05  # [share of the top speed] that a position may creep in one sample of a rest
SAME_PLACE = 0.01  # [share of a run's way] within which a place is the place it began at
SANK = 5.0  # [1] times the roughness of its position, by which a run sank below where it began
AROUND = 0.03  # [s] on both sides of what is set aside
MOST_RUNS = 1_000_000  # of one log
AFTER = 1e-6  # [s] by which a log begins after another: nobody knows how long the pause was


@dataclass(frozen=True)
class ExcludedInterval:
    """An interval of a run that is not fitted: damaged, or outside the model.

    Args:
        run: which one, from 0.
        start: [s] on the run's own clock.
        end: [s].
        to_the_end: nothing after it is believed, unless the run begins so: it leans on a stop.
    """

    run: int
    start: float
    end: float
    to_the_end: bool = False


@dataclass(frozen=True, eq=False)
class RunRecord:
    """One run, prepared for fitting.

    Args:
        measurements: what was measured.
        test: its name.
        low: [unit] the stop on which it lay when it began; minus infinity if none shows.
        high: [unit] the same above.
        clock: [s] when it began, since the first log did.
        session: which log it is from.
        memory_group: runs of one number followed one another: what one heated, the next found warm.
    """

    measurements: RunMeasurements
    test: str
    low: float
    high: float
    clock: float
    session: int
    memory_group: int

    def exclude_interval(self, aside: ExcludedInterval) -> "RunRecord":
        """A copy in which the samples of an interval are not used."""
        time = self.measurements.time
        begins = aside.start <= time[0] + AROUND  # on the stop: it leaves it, and all is well
        end = np.inf if aside.to_the_end and not begins else aside.end + AROUND
        return self._leave_out((time >= aside.start - AROUND) & (time <= end))

    def exclude(self) -> "RunRecord":
        """A copy of which no sample is used; it is still simulated."""
        return self._leave_out(np.ones(self.measurements.time.size, dtype=bool))

    def _leave_out(self, out: NDArray[np.bool_]) -> "RunRecord":
        """A copy in which some samples (n,) are not used."""
        seen = replace(
            self.measurements,
            informative=self.measurements.informative & ~out,
            moving=self.measurements.moving & ~out,
        )
        return replace(self, measurements=seen)


def make_run_records(
    log: Log, *, session: int = 0, since: float = 0.0, aside: Iterable[ExcludedInterval] = ()
) -> tuple[RunRecord, ...]:
    """All runs of a log that have enough samples.

    Args:
        log: any runs.
        session: number of the log.
        since: [s] of the clock at which it began.
        aside: what to leave out.
    """
    places = [number for number, run in enumerate(log.runs) if len(run) >= FEWEST]
    runs = [log.runs[number] for number in places]
    began = list_run_start_times(log)
    together = shares_clock(log)
    top = max((run.top_speed for run in runs), default=0.0)
    measured = measure_runs(log, friction=None, rest_by_position=False)
    found = {}
    for number, run, one in zip(places, runs, measured, strict=True):
        # readings at rest count here: how a mechanism leaves its rest tells effects apart
        seen = replace(_start_at_rest(one, top=top), at_rest=np.zeros_like(one.at_rest))
        memory = session * MOST_RUNS + (0 if together else number)
        clock = since + float(began[number])
        found[number] = RunRecord(seen, run.test, *_find_stops(seen), clock, session, memory)
    for part in aside:
        if part.run in found:
            found[part.run] = found[part.run].exclude_interval(part)
    return tuple(found.values())


def make_separate_records(log: Log, measured: Iterable[RunMeasurements]) -> tuple[RunRecord, ...]:
    """The runs as independent records: no common clock, and no stops.

    Args:
        log: the runs.
        measured: of those with enough samples, the measurements.
    """
    runs = [run for run in log.runs if len(run) >= FEWEST]
    return tuple(
        RunRecord(seen, run.test, -np.inf, np.inf, 0.0, 0, number)
        for number, (run, seen) in enumerate(zip(runs, measured, strict=True))
    )


def compute_session_length(*logs: Log) -> float:
    """[s] from the start of the first run to the end of the last.

    Pauses between runs count where the runs share a clock.
    """
    lasted = (one.runs[-1].time[-1] - one.runs[-1].time[0] for one in logs)
    return float(
        sum(list_run_start_times(one)[-1] + last for one, last in zip(logs, lasted, strict=True))
    )


def join_records(log: Log, later: Log) -> Log:
    """The runs of two logs, on one clock where both have one."""
    runs = later.runs
    if shares_clock(log) and shares_clock(later):
        by = log.runs[0].time[0] + compute_session_length(log) + AFTER - later.runs[0].time[0]
        runs = tuple(replace(run, time=run.time + by) for run in runs)
    return replace(log, runs=(*log.runs, *runs))


def _start_at_rest(seen: RunMeasurements, *, top: float) -> RunMeasurements:
    """The same, beginning at rest if its position says so: a noisy velocity alone cannot tell."""
    x = seen.measured[:, 0]
    fresh = np.flatnonzero(~np.isnan(x))[:2]
    if fresh.size < 2:  # noqa: PLR2004 - two make a rate
        return seen
    rate = abs(float((x[fresh[1]] - x[fresh[0]]) / (seen.time[fresh[1]] - seen.time[fresh[0]])))
    return replace(seen, velocity=0.0) if rate < AT_REST * top else seen


def _find_stops(seen: RunMeasurements) -> tuple[float, float]:
    """What lies beneath a run that began at rest and was never far beyond where it began.

    Arms and elevators begin on a stop, and stay there whatever gravity does until the voltage
    lifts them. Where it is friction that holds instead, a stop at that place changes nothing. One
    that first sank a little, more than its position is rough, found its stop there. One that comes
    back later and goes beyond that place shows that there is no stop.
    """
    told = ~np.isnan(seen.measured[:, 0])
    x, time = seen.measured[told, 0], seen.time[told]
    if seen.velocity != 0.0 or not x.size:
        return -np.inf, np.inf
    near = SAME_PLACE * float(np.ptp(x))
    low = x.min() > seen.position - near
    high = x.max() < seen.position + near
    if low == high:
        return -np.inf, np.inf
    rough = SANK * _position_roughness(x, time)
    if low:
        return _lowest_stop(x, seen.position, near=near, rough=rough), np.inf
    return -np.inf, -_lowest_stop(-x, -seen.position, near=near, rough=rough)


def _lowest_stop(x: Array, begin: float, *, near: float, rough: float) -> float:
    """[unit] The stop below a run's start; minus infinity if the run later goes below it.

    Args:
        x: (n,) [unit] positions.
        begin: [unit] where it began.
        near: [unit] how far it goes before it has left that place.
        rough: [unit] what is less is noise.
    """
    left = int(np.argmax(x > begin + near))
    sank = min(float(x[: left + 1].min()), begin)
    if x[left:].min() < sank - rough:
        return -np.inf
    return sank if sank < begin - rough else begin


def _position_roughness(x: Array, time: Array) -> float:
    """[unit] of positions, from how far each is off the line between its neighbours."""
    if x.size < 3:  # noqa: PLR2004 - one between two
        return 0.0
    between = (time[1:-1] - time[:-2]) / (time[2:] - time[:-2])
    off = x[1:-1] - x[:-2] - between * (x[2:] - x[:-2])
    return float(np.median(np.abs(off))) * ROBUST / math.sqrt(1.5)
