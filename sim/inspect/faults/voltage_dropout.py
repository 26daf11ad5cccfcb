"""Voltage drop-out: the logged voltage is too small for a few samples, again and again.

On a robot: the voltage is read by another loop, a CAN frame of it is lost, or it is the mean of two
motors of which one did not answer. In some logs of real arms and elevators the voltage drops every
0.22 s and so does the velocity: there the motor really lost its command for 5 to 25 ms.

Effect on the gains: if only the log loses the voltage, there are rows with motion and hardly any
voltage. kA becomes too large and kS too small, kV a little too small. If the motor loses it as
well, the rows are right, but not for a mean of two motors, and a ramp is no longer a ramp.

Fingerprint: the voltage falls by a quarter or more for a few samples and returns to its value. A
single drop that the velocity follows may be a brownout, and is not reported here.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from sim.core.log import Log, Run
from sim.inspect.anomalies import find_intervals
from sim.inspect.fault import (
    Damage,
    DamagedLog,
    Fault,
    FaultStrike,
    LogInterval,
    replace_run,
)
from sim.inspect.launch import find_step_start
from sim.inspect.log_features import LogFeatures

EVERY = 0.22  # [s] between two drop-outs
LASTS = 0.015  # [s] at severity 1; never less than a sample
MILD, HALF = 0.7, 0.5  # [severity] below which a drop-out has this share instead of zero
VISIBLE = 0.2  # [share of the run's largest voltage] a smaller voltage does not drop

AROUND = 0.22  # [s] window of the running median, the expected voltage
NARROWEST = 7  # [samples] of that window, at least
FALL = 0.25  # [share of the expected voltage] least drop
FLOOR = 0.08  # [V] least drop
LONGEST = 0.08  # [s] longest drop-out; longer is a brownout or a released button
ECHO = 0.06  # [s] in which the velocity would follow
CLEAR = 0.1  # [share of the speed] a smaller loss is noise
LAUNCH = 0.2  # [s] after a step, in which a single drop of the voltage is no lost reading
SERIES = 3  # drop-outs that are reported together


@dataclass(frozen=True)
class Dropout:
    """A drop-out from sample ``first`` to ``last``, with the expected voltage [V]."""

    first: int
    last: int
    expected: float


def spoil(log: Log, strike: FaultStrike, rng: np.random.Generator) -> DamagedLog:
    """Drop the voltage periodically, from the given time to the end of the run."""
    run = log.runs[strike.run]
    voltage = run.voltage.copy()
    period = float(np.median(np.diff(run.time)))
    width = max(1, round(LASTS * strike.severity / period))
    most = float(np.abs(run.voltage).max())
    drops = []
    moment = float(run.time[0]) + strike.start
    while (first := int(np.searchsorted(run.time, moment))) + width < len(run) - 1:
        if first and abs(run.voltage[first]) > VISIBLE * most:
            drops.append(Dropout(first, first + width - 1, float(run.voltage[first])))
            voltage[first : first + width] *= HALF if strike.severity < MILD else 0.0
        moment += max(EVERY * rng.uniform(0.9, 1.1), 3.0 * width * period)
    spoilt = replace_run(log, strike.run, replace(run, voltage=voltage))
    return DamagedLog(spoilt, tuple(where for where, _ in _group_drops(strike.run, run, drops)))


def detect(features: LogFeatures) -> Iterable[Damage]:
    """Find short drops of the voltage that the velocity does not follow."""
    for index, run in enumerate(features.log.runs):
        if run.kind not in FAULT.kinds or len(run) < NARROWEST:
            continue
        drops = find_dropouts(run, features.period)
        answers = [measure_loss(run, drop)[0] for drop in drops]
        if len(drops) < SERIES:
            drops = [
                drop
                for drop, answer in zip(drops, answers, strict=True)
                if run.moving[max(drop.first - 1, 0)]  # only motion can contradict it
                and answer < CLEAR
                and not _is_at_launch(run, drop)
            ]
        for where, group in _group_drops(index, run, drops):
            yield _describe_damage(run, where, group, answer=float(np.median(answers)))


def find_dropouts(run: Run, period: float) -> list[Dropout]:
    """Short drops of the voltage below its running median, after which it returns."""
    window = max(NARROWEST, 2 * round(AROUND / period / 2.0) + 1)
    padded = np.pad(run.voltage, window // 2, mode="reflect" if len(run) > window else "edge")
    expected = np.median(np.lib.stride_tricks.sliding_window_view(padded, window), axis=1)
    short = (expected - run.voltage) * np.sign(expected)
    low = (short > FALL * np.abs(expected)) & (short > FLOOR)
    return [
        Dropout(first, last, float(expected[first]))
        for first, last in find_intervals(low, join=1)
        if 0 < first <= last < len(run) - 1 and run.time[last + 1] - run.time[first] <= LONGEST
    ]


def _is_at_launch(run: Run, drop: Dropout) -> bool:
    """Whether it is at the start of a step, where a controller's limits may act."""
    return bool(0.0 <= run.time[drop.first] - run.time[find_step_start(run)] < LAUNCH)


def measure_loss(run: Run, drop: Dropout) -> tuple[float, int, float]:
    """Loss of speed [share] in and after a drop-out, index of the slowest sample, speed before."""
    speed = np.abs(run.velocity)
    before = float(np.median(speed[max(drop.first - 2, 0) : drop.first + 1]))
    until = int(np.searchsorted(run.time, run.time[drop.last] + ECHO)) + 1
    slowest = drop.first + int(np.argmin(speed[drop.first : until]))
    return 1.0 - float(speed[slowest]) / before if before > 0.0 else 0.0, slowest, before


def _group_drops(
    index: int, run: Run, drops: list[Dropout]
) -> list[tuple[LogInterval, list[Dropout]]]:
    """The drop-outs grouped for the report: a series as one group, a few single ones each alone."""
    reports = [drops] if len(drops) >= SERIES else [[drop] for drop in drops]
    last = len(run) - 1
    return [
        (LogInterval.of_samples(index, run, one[0].first, min(one[-1].last + 1, last)), one)
        for one in reports
    ]


def _describe_damage(
    run: Run, where: LogInterval, group: list[Dropout], *, answer: float
) -> Damage:
    """The damage of some drop-outs; ``answer`` is the median loss of speed [share]."""
    lasts = 1e3 * sum(float(run.time[drop.last + 1] - run.time[drop.first]) for drop in group)
    deepest = min(
        float(np.abs(run.voltage[d.first : d.last + 1] / d.expected).min()) for d in group
    )
    if len(group) == 1:
        said = f"Once, for {lasts:.0f} ms, the voltage drops to {deepest:.0%} of its value"
    else:
        every = float(np.median(np.diff([run.time[drop.first] for drop in group])))
        said = (
            f"The voltage drops {len(group)} times, about every {every:.2f} s, down to "
            f"{deepest:.0%} of its value. Together the drops last {lasts:.0f} ms"
        )
    echo = (
        f"The velocity drops with it, by {answer:.0%}, so the motor really lost its voltage"
        if answer > CLEAR
        else "The velocity does not change, so only the log lost the voltage"
    )
    return Damage(
        where=where,
        confidence=1.0 - 0.3 / len(group),
        evidence=f"{said}. {echo}.",
        advice="If there are several motors, check whether one of them stops receiving its "
        "command. Look also for missing CAN frames, and for a second loop that writes the voltage. "
        "Then record again.",
    )


FAULT = Fault(
    name="voltage-dropout",
    summary="for moments the voltage in the log is too small, but the motion does not change",
    ordinary="the voltage is zero for 15 ms, every 0.22 s to the end of the run",
    spoil=spoil,
    detect=detect,
)
