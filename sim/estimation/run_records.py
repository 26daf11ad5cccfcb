"""The runs of a log, prepared for fitting: fresh samples, start, travel and clock."""

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array, Log
from sim.core.units import ROBUST
from sim.estimation.measurements import (
    MIN_SAMPLES,
    RunMeasurements,
    bend_voltage,
    measure_runs,
)
from sim.physics.voltage_residual import list_run_start_times, shares_clock

AT_REST = 0.05  # [share of the top speed] a run whose position is slower starts at rest
SAME_PLACE = 0.01  # [share of a run's way] from its start within which a position is the start
SANK = 5.0  # [noises of a position] a run that sank farther below its start did sink
AROUND = 0.03  # [s] excluded as well, on both sides of an excluded interval
MOST_RUNS = 1_000_000  # of one log; makes ``memory_group`` unique
AFTER = 1e-6  # [s] pause between two logs that are joined, because the real one is unknown


@dataclass(frozen=True)
class ExcludedInterval:
    """An interval of a run that is not fitted: damaged, or outside the model.

    Args:
        run: index of the run in its log.
        start: [s] on the clock of the run's samples.
        end: [s] on the same clock.
        to_the_end: whether the rest of the run is excluded, too; not if the interval is at the
            start of the run, where the mechanism leans on a stop and then leaves it.
    """

    run: int
    start: float
    end: float
    to_the_end: bool = False


@dataclass(frozen=True, eq=False)
class RunRecord:
    """One run, prepared for fitting.

    Args:
        measurements: its samples.
        test: name of the test.
        low: [unit] the stop on which the run started; minus infinity if none shows.
        high: [unit] the upper stop against which it started; infinity if none shows.
        clock: [s] start of the run, since the start of the first log.
        session: index of the log it is from.
        memory_group: runs with the same number share the memory of effects: a motor that one heats
            is still warm in the next.
    """

    measurements: RunMeasurements
    test: str
    low: float
    high: float
    clock: float
    session: int
    memory_group: int

    def exclude_interval(self, interval: ExcludedInterval) -> "RunRecord":
        """A copy in which the samples of an interval are not used."""
        time = self.measurements.time
        begins = interval.start <= time[0] + AROUND  # on a stop, which it leaves: the rest is good
        end = np.inf if interval.to_the_end and not begins else interval.end + AROUND
        return self._leave_out((time >= interval.start - AROUND) & (time <= end))

    def exclude(self) -> "RunRecord":
        """A copy without samples to compare; it is still simulated."""
        return self._leave_out(np.ones(self.measurements.time.size, dtype=bool))

    def raise_voltage(self) -> "RunRecord":
        """A copy with the largest voltage between samples that a motor on a joint may have had.

        On backlash or a soft joint a motor speeds up and slows down between two samples. Under a
        current limit the voltage follows it: up to the command where the limit begins or ends, and
        else by twice what a cubic through the samples bends.
        """
        volts, slides = self.measurements.voltage, self.measurements.voltage_slide
        bend, command = bend_voltage(slides), np.max(np.abs(volts), initial=0.0)
        room = (command - np.abs(volts + 0.5 * slides)) * np.sign(volts)
        more = np.where((slides != 0.0) & (bend == 0.0), room, bend)
        return self.change(voltage=volts + more)

    def change(self, **signals: Any) -> "RunRecord":  # noqa: ANN401 - as dataclasses.replace
        """A copy with other signals of its measurements."""
        return replace(self, measurements=replace(self.measurements, **signals))

    def _leave_out(self, out: NDArray[np.bool_]) -> "RunRecord":
        """A copy in which the samples marked in ``out`` (n,) are not used."""
        run = self.measurements
        return self.change(informative=run.informative & ~out, moving=run.moving & ~out)


def make_run_records(
    log: Log, *, session: int = 0, since: float = 0.0, aside: Iterable[ExcludedInterval] = ()
) -> tuple[RunRecord, ...]:
    """All runs of a log that have enough samples.

    Args:
        log: any runs.
        session: index of the log.
        since: [s] start of the log, since the start of the first one.
        aside: intervals to exclude.
    """
    places = [number for number, run in enumerate(log.runs) if len(run) >= MIN_SAMPLES]
    runs = [log.runs[number] for number in places]
    began = list_run_start_times(log)
    together = shares_clock(log)
    top = max((run.top_speed for run in runs), default=0.0)
    measured = measure_runs(log, friction=None, rest_by_position=False)
    found = {}
    for number, run, one in zip(places, runs, measured, strict=True):
        # readings at rest are compared: how a mechanism leaves its rest tells effects apart
        measurements = replace(_start_at_rest(one, top=top), at_rest=np.zeros_like(one.at_rest))
        memory = session * MOST_RUNS + (0 if together else number)
        clock = since + float(began[number])
        found[number] = RunRecord(
            measurements, run.test, *_find_stops(measurements), clock, session, memory
        )
    for part in aside:
        if part.run in found:
            found[part.run] = found[part.run].exclude_interval(part)
    return tuple(found.values())


def make_separate_records(log: Log, measured: Iterable[RunMeasurements]) -> tuple[RunRecord, ...]:
    """The runs as independent records: no common clock, and no stops.

    Args:
        log: any runs.
        measured: the measurements of each run that has enough samples.
    """
    runs = [run for run in log.runs if len(run) >= MIN_SAMPLES]
    return tuple(
        RunRecord(measurements, run.test, -np.inf, np.inf, 0.0, 0, number)
        for number, (run, measurements) in enumerate(zip(runs, measured, strict=True))
    )


def compute_session_length(*logs: Log) -> float:
    """[s] from the start of the first run to the end of the last, summed over the logs.

    Pauses between runs count where the runs share a clock.
    """
    lasted = (list_run_start_times(one)[-1] + np.ptp(one.runs[-1].time) for one in logs)
    return float(sum(lasted))


def join_records(log: Log, later: Log) -> Log:
    """The runs of two logs, on one clock where both have one."""
    runs = later.runs
    if shares_clock(log) and shares_clock(later):
        by = log.runs[0].time[0] + compute_session_length(log) + AFTER - later.runs[0].time[0]
        runs = tuple(replace(run, time=run.time + by) for run in runs)
    return replace(log, runs=(*log.runs, *runs))


def _start_at_rest(measurements: RunMeasurements, *, top: float) -> RunMeasurements:
    """A copy that starts at rest if its position does: a noisy velocity alone cannot show it."""
    x = measurements.measured[:, 0]
    fresh = np.flatnonzero(~np.isnan(x))[:2]
    if fresh.size < 2:  # noqa: PLR2004 - two make a rate
        return measurements
    (rate,) = np.abs(np.diff(x[fresh]) / np.diff(measurements.time[fresh]))
    return replace(measurements, velocity=0.0) if rate < AT_REST * top else measurements


def _find_stops(measurements: RunMeasurements) -> tuple[float, float]:
    """[unit] Lower and upper stop at the start of a run that began at rest; infinite if none.

    Arms and elevators start on a stop and stay there, whatever gravity does, until the voltage
    lifts them. Where friction holds them instead, a stop at that place changes nothing. A run that
    first sank, by more than the noise of its position, has its stop where it came to rest. A run
    that later goes beyond its start shows that there is no stop.
    """
    fresh = ~np.isnan(measurements.measured[:, 0])
    x, time = measurements.measured[fresh, 0], measurements.time[fresh]
    if measurements.velocity != 0.0 or not x.size:
        return -np.inf, np.inf
    near = SAME_PLACE * float(np.ptp(x))
    low = x.min() > measurements.position - near
    high = x.max() < measurements.position + near
    if low == high:
        return -np.inf, np.inf
    rough = SANK * _position_roughness(x, time)
    if low:
        return _find_lowest_stop(x, measurements.position, near=near, rough=rough), np.inf
    return -np.inf, -_find_lowest_stop(-x, -measurements.position, near=near, rough=rough)


def _find_lowest_stop(x: Array, begin: float, *, near: float, rough: float) -> float:
    """[unit] The stop below a run's start; minus infinity if the run later goes below it.

    Args:
        x: (n,) [unit] positions.
        begin: [unit] position at the start.
        near: [unit] the run has left its start when it is farther away than this.
        rough: [unit] a smaller difference of positions is noise.
    """
    left = int(np.argmax(x > begin + near))
    sank = min(float(x[: left + 1].min()), begin)
    if x[left:].min() < sank - rough:
        return -np.inf
    return sank if sank < begin - rough else begin


def _position_roughness(x: Array, time: Array) -> float:
    """[unit] noise of positions, from how far each is off the line between its neighbors."""
    if x.size < 3:  # noqa: PLR2004 - one between two
        return 0.0
    between = (time[1:-1] - time[:-2]) / (time[2:] - time[:-2])
    off = x[1:-1] - x[:-2] - between * (x[2:] - x[:-2])
    return float(np.median(np.abs(off))) * ROBUST / math.sqrt(1.5)
