"""Brownout: the robot controller cuts the motors because the battery's voltage has collapsed.

On a robot: a weak battery or a large current pulls the bus below 6.3 V (roboRIO 1) or 6.75 V
(roboRIO 2); the controller disables its outputs until the bus is back above 7.5 V.

To the gains: the mechanism slows down without a motor while the log goes on to tell the commanded
voltage. SysId sees voltage without acceleration: kA too large (by 43 % for one cut), kS too small.

Fingerprint: the velocity falls as it does with no voltage at all, along its own timescale, and
climbs back along the same one; the bus voltage, where it is logged, dips.
"""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from sim.core.log import Log
from sim.inspect.anomalies import Anomaly
from sim.inspect.fault import (
    Damage,
    DamagedLog,
    Fault,
    FaultStrike,
    LogInterval,
    replace_run,
    rescale_motion,
)
from sim.inspect.log_features import LogFeatures

CUT = 0.3  # [s] without motors at severity 1
DIP = 6.0  # [V] of the bus while it lasts: below every controller's threshold
RECOVERED = 7.5  # [V] where a controller lets the motors go on
SLACK = 0.06  # [s] how exactly an anomaly shows where it begins and ends
LOWEST = 0.6  # [V] a motor that is asked for less pulls no battery down; a dead band looks alike
MOVED = 5  # [samples] before a cut in which it was on its way
ENDS = 12  # ends of the cut that are tried at first
BELIEVED = 0.7  # [share explained] less is something else
FREE = 4.0  # a shape without a size to choose counts this much more than one that has it
NOT_BACK = 0.9  # a cut that lasts to the end of the run may be a stop it has run into
SURE = 0.9  # [share explained] at the start of a run, where current limits look alike
FASTEST = 1.2  # [times the usual speed] a cut can make what falls go, before the model is in doubt


def spoil(log: Log, blow: FaultStrike, rng: np.random.Generator) -> DamagedLog:
    """Let the mechanism go on without its motor for a moment."""
    features = LogFeatures(log)
    run = log.runs[blow.run]
    start = float(run.time[0]) + blow.start
    lasts = CUT * blow.severity * rng.uniform(0.9, 1.1)
    end = start + min(lasts, (float(run.time[-1]) - start) / 2.0)
    cut = (run.time >= start) & (run.time < end)
    if features.baseline is None or not cut.any():
        return DamagedLog(log, ())
    first = int(np.argmax(cut))
    velocity = features.predicted_velocities[blow.run][first]
    as_it_was, without = (
        features.baseline.replay(run, voltage=volts, first=first, last=len(run), velocity=velocity)
        for volts in (run.voltage, np.where(cut, 0.0, run.voltage))
    )
    moves = np.abs(as_it_was) > features.still_speed
    if not np.any(moves & (as_it_was != without)):
        return DamagedLog(log, ())
    pace = np.ones(len(run))
    pace[first:][moves] = np.clip(without[moves] / as_it_was[moves], -FASTEST, FASTEST)
    spoilt = rescale_motion(run, pace)
    if run.bus_voltage is not None:
        bus = np.where(cut, np.minimum(run.bus_voltage, DIP), run.bus_voltage)
        spoilt = replace(spoilt, bus_voltage=bus)
    return DamagedLog(
        replace_run(log, blow.run, spoilt), (LogInterval(blow.run, run.test, start, end),)
    )


def detect(features: LogFeatures) -> Iterable[Damage]:
    """Find anomalies that a cut of the whole voltage explains."""
    for anomaly in features.anomalies:
        if anomaly.recurs:
            continue
        share, first, last = _best(features, anomaly)
        run = features.log.runs[anomaly.run]
        before = np.abs(run.velocity[max(first - MOVED, 0) : first])
        moved = before.size > 0 and float(np.median(before)) > features.still_speed
        if share < (SURE if anomaly.at_start else BELIEVED) or not moved:
            continue
        volts = float(np.median(np.abs(run.voltage[first:last])))
        if volts < LOWEST:
            continue
        start = float(run.time[first])
        end = float(run.time[min(last, len(run) - 1)])
        back = bool(np.any(np.abs(run.velocity[last:]) > 2.0 * features.still_speed))
        bus = None if run.bus_voltage is None else float(run.bus_voltage[first:last].min())
        seen = bus is not None and bus < RECOVERED
        said = f"; the bus is down to {bus:.1f} V" if seen else ""
        yield Damage(
            fault="brownout",
            where=LogInterval(anomaly.run, run.test, start, end),
            confidence=_confidence(share, back=back, seen=seen),
            evidence=f"For {end - start:.2f} s it moves as if no voltage were applied, while the "
            f"log tells {volts:.1f} V{said}.",
            advice="Charge or change the battery, set supply current limits, and run this test "
            "again; log the applied voltage, not the commanded one.",
        )


def _confidence(share: float, *, back: bool, seen: bool) -> float:
    """More than the share explained, as nothing was chosen to fit; less if it never came back."""
    if not back and not seen:
        return NOT_BACK * share
    return 1.0 - (1.0 - share) / (FREE * (1.0 + seen))


def _best(features: LogFeatures, anomaly: Anomaly) -> tuple[float, int, int]:
    """Share explained by a cut, its first sample of the run, and the one behind its last."""
    best = (0.0, anomaly.first, anomaly.last + 1)
    if float(anomaly.residual @ np.sign(anomaly.expected)) >= 0.0:
        return best
    margin = max(3, round(SLACK / features.period))
    stride = max(1, margin // 3)
    ends = np.unique(np.linspace(anomaly.first + 1, anomaly.last + 1, ENDS).astype(int))
    for first in range(anomaly.first - margin, anomaly.first + 1, stride):
        if first >= anomaly.begin:
            best = max(
                best, *((_share(features, anomaly, first, e), first, e) for e in ends.tolist())
            )
    _, first, last = best
    near = range(max(last - margin, first + 1), min(last + margin, anomaly.end))
    return max([best, *((_share(features, anomaly, first, end), first, end) for end in near)])


def _share(features: LogFeatures, anomaly: Anomaly, first: int, last: int) -> float:
    """How much a cut of these samples of the run explains."""
    run, baseline = features.log.runs[anomaly.run], features.baseline
    if baseline is None:
        return 0.0
    volts = run.voltage.copy()
    volts[first:last] = 0.0
    without = baseline.replay(
        run,
        voltage=volts,
        first=anomaly.begin,
        last=anomaly.end,
        velocity=float(anomaly.expected[0]),
    )
    return anomaly.explained_share(without - anomaly.expected)


FAULT = Fault(
    name="brownout",
    summary="the controller cuts the motors, and the log goes on to tell a voltage",
    ordinary="the motors are without voltage for 0.3 s",
    spoil=spoil,
    detect=detect,
    when=(0.3, 0.6),
)
