"""Brownout: the robot controller turns the motors off because the battery voltage is too low.

On a robot: a weak battery or a large current pulls the bus below 6.3 V (roboRIO 1) or 6.75 V
(roboRIO 2); the controller disables its outputs until the bus is back above 7.5 V.

Effect on the gains: the mechanism slows down without a motor while the log still contains the
commanded voltage. SysId gets voltage without acceleration: kA becomes too large (by 43 % for one
cut), kS too small.

If the applied voltage is logged, it drops to zero and returns, again and again. If the bus voltage
is logged, it drops below the controller's threshold just before each cut.

Fingerprint: the velocity falls as it does with no voltage at all, along its own timescale, and
climbs back along the same one; the bus voltage, where it is logged, dips.
"""

from collections.abc import Iterable
from dataclasses import replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array, Log, Run
from sim.inspect.anomalies import SLACK, Anomaly
from sim.inspect.fault import (
    Damage,
    DamagedLog,
    Fault,
    FaultStrike,
    LogInterval,
    replace_run,
    rescale_motion,
)
from sim.inspect.log_features import DRIVEN, LogFeatures

CUT = 0.3  # [s] without motors at severity 1
DIP = 6.0  # [V] of the bus during a cut: below every controller's threshold
RECOVERED = 7.5  # [V] of the bus at which a controller turns the motors on again
THRESHOLD = 6.75  # [V] of the bus: a roboRIO 2 cuts the motors below it, a roboRIO 1 below 6.3
OFF = (0.09, 2.0)  # [s] without voltage: shorter is a lost frame, longer is another test
CHOPPED = 3  # cuts in a run, at least: one or two may be a button that was let go
AT_ONCE = 2  # [samples] between the drop of the bus voltage and the cut, at most
TOGETHER = 2.0  # [s] cuts closer than this are one brownout
BUS_CONFIDENCE = 0.98  # if the bus voltage shows it
CUT_CONFIDENCE = 0.9  # if only the applied voltage shows it
LOWEST = 2.3  # [V] a lower command does not load a battery so much; a deadband looks the same
ENDS = 12  # ends of the cut that are tried at first
SHORTEST = 0.14  # [s] of a cut that only the motion shows: controllers cut for longer
BELIEVED = 0.7  # [share explained] least of a brownout
FREE = 4.0  # [1] factor on the evidence of a shape without a free size
NOT_BACK = 0.9  # [1] factor on the confidence of a cut to the end of the run: it may be a stop
FASTEST = 1.2  # [times the usual speed] limit for a load that falls without motor


def spoil(log: Log, strike: FaultStrike, rng: np.random.Generator) -> DamagedLog:
    """Damage a log: the motors are off for ``CUT`` seconds times the severity."""
    features = LogFeatures(log)
    run = log.runs[strike.run]
    start = float(run.time[0]) + strike.start
    lasts = CUT * strike.severity * rng.uniform(0.9, 1.1)
    room = (float(run.time[-1]) - start) / 2.0
    end = start + min(lasts, room)
    cut = (run.time >= start) & (run.time < end)
    if features.baseline is None or room < OFF[0] or not cut.any():
        return DamagedLog(log, ())
    first = int(np.argmax(cut))
    velocity = features.predicted_velocities[strike.run][first]
    powered, unpowered = (
        features.baseline.replay(run, voltage=volts, first=first, last=len(run), velocity=velocity)
        for volts in (run.voltage, np.where(cut, 0.0, run.voltage))
    )
    moves = np.abs(powered) > features.still_speed
    if not np.any(moves & (powered != unpowered)):
        return DamagedLog(log, ())
    pace = np.ones(len(run))
    pace[first:][moves] = np.clip(unpowered[moves] / powered[moves], -FASTEST, FASTEST)
    spoilt = rescale_motion(run, pace)
    if run.bus_voltage is not None:
        bus = np.where(cut, np.minimum(run.bus_voltage, DIP), run.bus_voltage)
        spoilt = replace(spoilt, bus_voltage=bus)
    return DamagedLog(
        replace_run(log, strike.run, spoilt), (LogInterval(strike.run, run.test, start, end),)
    )


def detect(features: LogFeatures) -> Iterable[Damage]:
    """Find brownouts: by the bus voltage, by the applied voltage, else by the motion."""
    cuts = [
        found for index in range(len(features.log.runs)) for found in _detect_cuts(features, index)
    ]
    yield from cuts
    for anomaly in features.anomalies:
        found = _detect_unpowered_motion(features, anomaly)
        if found and not any(found.where.overlap(other.where) for other in cuts):
            yield found


def _detect_cuts(features: LogFeatures, index: int) -> list[Damage]:
    """Brownouts that the recorded voltages show."""
    run = features.log.runs[index]
    size = np.abs(run.voltage)
    off = _find_gaps(size > DRIVEN * size.max(initial=0.0), run.time)
    if run.bus_voltage is None:
        low = np.zeros(len(run), dtype=bool)
        if len(off) < CHOPPED:
            return []
    else:
        low = run.bus_voltage < THRESHOLD
        off = [gap for gap in off if low[max(gap[0] - AT_ONCE, 0) : gap[0] + AT_ONCE].any()]
    struck = low.copy()
    for first, last in off:
        struck[max(first - 1, 0) : last + 1] = True
    at = np.flatnonzero(struck)
    if not at.size:
        return []
    parts = np.split(at, np.flatnonzero(np.diff(run.time[at]) > TOGETHER) + 1)
    return [_describe_cut(features, index, int(part[0]), int(part[-1])) for part in parts]


def _find_gaps(on: NDArray[np.bool_], time: Array) -> list[tuple[int, int]]:
    """First and last index of each interval of ``OFF`` seconds without voltage."""
    at = np.flatnonzero(on)
    ends = np.flatnonzero(np.diff(at) > 1)
    return [
        (int(at[k]) + 1, int(at[k + 1]) - 1)
        for k in ends
        if OFF[0] <= time[at[k + 1]] - time[at[k] + 1] <= OFF[1]
    ]


def _describe_cut(features: LogFeatures, index: int, first: int, last: int) -> Damage:
    """A brownout that the voltages show, from sample ``first`` to ``last`` of a run."""
    run = features.log.runs[index]
    behind = min(last + 1, len(run) - 1)
    start, end = float(run.time[first]), float(run.time[behind])
    size = np.abs(run.voltage[first:behind])
    off = float(np.mean(size <= DRIVEN * np.abs(run.voltage).max())) if size.size else 0.0
    bus = None if run.bus_voltage is None else float(run.bus_voltage[first : last + 1].min())
    without = f"for {off:.0%} of that time the motors got no voltage" if off else ""
    if bus is None:
        happened = f"The applied voltage drops to 0 and comes back, again and again: {without}"
    else:
        happened = f"The battery's voltage falls to {bus:.1f} V, and below 6.75 V the robot "
        happened += f"controller turns the motors off{': ' * bool(off)}{without}"
    return Damage(
        where=LogInterval(index, run.test, start, end),
        confidence=BUS_CONFIDENCE if bus is not None else CUT_CONFIDENCE,
        evidence=f"{happened}.",
        advice=_write_advice(run),
    )


def _write_advice(run: Run) -> str:
    """The advice for a run."""
    what = "step" if run.kind == "dynamic" else "end of the ramp"
    most = float(np.abs(run.voltage).max(initial=0.0))
    return (
        "Charge or change the battery, set supply current limits, and run this test again. If "
        f"it happens again, choose a smaller {what} than {most:.1f} V."
    )


def _detect_unpowered_motion(features: LogFeatures, anomaly: Anomaly) -> Damage | None:
    """A brownout that explains an anomaly; None if it does not, or something contradicts it."""
    share, first, last = _fit_cut(features, anomaly)
    run = features.log.runs[anomaly.run]
    if share < BELIEVED:
        return None
    volts = float(np.median(np.abs(run.voltage[first:last])))
    bus = None if run.bus_voltage is None else float(run.bus_voltage[first:last].min())
    if volts < LOWEST or (bus is not None and bus > RECOVERED):
        return None
    start = float(run.time[first])
    end = float(run.time[min(last, len(run) - 1)])
    if bus is None and end - start < SHORTEST:
        return None
    back = bool(np.any(np.abs(run.velocity[last:]) > 2.0 * features.still_speed))
    said = f"; the battery is down to {bus:.1f} V" if bus is not None else ""
    return Damage(
        where=LogInterval(anomaly.run, run.test, start, end),
        confidence=_rate_confidence(share, back=back, has_bus=bus is not None),
        evidence=f"For {end - start:.2f} s the mechanism slows down as if its motors were off, "
        f"but the log still shows {volts:.1f} V{said}.",
        advice=f"{_write_advice(run)} Log the applied voltage instead of the commanded voltage.",
    )


def _rate_confidence(share: float, *, back: bool, has_bus: bool) -> float:
    """Confidence from the share explained; lower if the motion never returns."""
    if not back and not has_bus:
        return NOT_BACK * share
    return 1.0 - (1.0 - share) / (FREE * (1.0 + has_bus))


def _fit_cut(features: LogFeatures, anomaly: Anomaly) -> tuple[float, int, int]:
    """The largest share that a cut explains, its first sample, and the one after its last."""
    best = (0.0, anomaly.first, anomaly.last + 1)
    if float(anomaly.residual @ np.sign(anomaly.expected)) >= 0.0:
        return best
    margin = max(3, round(SLACK / features.period))
    ends = np.unique(np.linspace(anomaly.first + 1, anomaly.last + 1, ENDS).astype(int))
    firsts = range(anomaly.first - margin, anomaly.first + 1, margin // 3)
    for first, end in product(firsts, ends.tolist()):
        if first >= anomaly.begin:
            best = max(best, _score_power_cut(features, anomaly, first, end))
    _, first, last = best
    for end in range(max(last - margin, first + 1), min(last + margin, anomaly.end)):
        best = max(best, _score_power_cut(features, anomaly, first, end))
    return best


def _score_power_cut(
    features: LogFeatures, anomaly: Anomaly, first: int, last: int
) -> tuple[float, int, int]:
    """Share of an anomaly that zero volts in samples [first, last) explain; and that range."""
    run, baseline = features.log.runs[anomaly.run], features.baseline
    if baseline is None:
        return 0.0, first, last
    volts, velocity = run.voltage.copy(), float(anomaly.expected[0])
    volts[first:last] = 0.0
    without = baseline.replay(
        run, voltage=volts, first=anomaly.begin, last=anomaly.end, velocity=velocity
    )
    return anomaly.compute_explained_share(without - anomaly.expected), first, last


FAULT = Fault(
    name="brownout",
    summary="the controller turned the motors off, but the log still shows a voltage",
    ordinary="the motors get no voltage for 0.3 s",
    spoil=spoil,
    detect=detect,
    least_voltage=2.5,
)
