"""Hard stop: the mechanism hits its stop, and the test continues.

On a robot: the button is held for too long, or a soft limit is missing. The arm, elevator or turret
is pressed against its stop while the voltage stays on; at the impact it bounces a little.

Effect on the gains: voltage without speed and acceleration, and an acceleration without voltage.
SysId removes a step after 90 % of its top speed. In a ramp it only removes samples slower than its
threshold, if the sensor is quiet at rest.

Fingerprint: the speed drops to zero within a few samples, and the position stays while the voltage
is on, until the end of the run.
"""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from sim.core.log import Array, Log, Run
from sim.core.units import Unit, find_unit
from sim.inspect.anomalies import find_first_motion
from sim.inspect.fault import (
    Damage,
    DamagedLog,
    Fault,
    FaultStrike,
    LogInterval,
    rescale_motion,
)
from sim.inspect.log_features import LogFeatures

PRESSED = 0.6  # [s] against the stop at severity 1
BOUNCE, FADES = 0.15, 0.02  # [share of the speed, s] speed of the bounce, and its time constant
SHORTEST = 0.06  # [s] against the stop, at least three samples
FAST = 4.0  # [times the threshold of standstill] speed before an impact
PUSHED = 0.1  # [share of the largest voltage] with less it came to rest without a stop
SETTLES = 0.1  # [s] after the impact, for the bounce and the sensor's filter
BEFORE = 0.1  # [s] before the impact, of which the speed is the median
AT_END = 0.02  # [share of the travel] distance from its end at which a run starts on a stop
GIVEN = (0.005, 0.05)  # [share of the travel] by which a rubber stop or a slack chain gives
CREPT, CREEPS = 0.2, 1.0  # [share of the creep, s] after which the rest lasts so long, at least
PRESSES = 1.5  # [times kS] least gravity that presses a mechanism onto a stop
LEANS = 0.7  # [1] confidence: a chain that is pulled tight looks the same
LARGEST_REBOUND = 0.25  # [share of the way without a stop] largest motion after the impact


def spoil(log: Log, strike: FaultStrike, rng: np.random.Generator) -> DamagedLog:
    """Add a stop to the travel; the voltage stays on for ``PRESSED`` seconds times the severity."""
    pressed = PRESSED * strike.severity * rng.uniform(0.9, 1.1)
    run = log.runs[strike.run]
    longer = _extrapolate_run(run, until=float(run.time[0]) + strike.start + pressed)
    impact = int(np.searchsorted(longer.time, run.time[0] + strike.start, side="right"))
    end = int(np.searchsorted(longer.time, run.time[0] + strike.start + pressed, side="right"))
    if impact >= end - 1 or not np.any(longer.velocity[impact:end]):
        return DamagedLog(log, ())
    cut = longer.select(slice(end))
    since = cut.time - cut.time[impact]
    pace = np.where(since < 0.0, 1.0, -BOUNCE * np.exp(-since / FADES) * (since < 4.0 * FADES))
    spoilt = rescale_motion(cut, pace)
    late = max(float(spoilt.time[-1] - run.time[-1]), 0.0)  # by which the runs after it start later
    later = (replace(other, time=other.time + late) for other in log.runs[strike.run + 1 :])
    damaged = replace(log, runs=(*log.runs[: strike.run], spoilt, *later))
    return DamagedLog(damaged, (LogInterval.of_samples(strike.run, spoilt, impact),))


def detect(features: LogFeatures) -> Iterable[Damage]:
    """Find runs that end at a stop with the voltage on, or start pressed against one."""
    yield from _find_pressed_starts(features)
    unit = find_unit(features.log.units)
    for index, run in enumerate(features.log.runs):
        yield from _find_stop(index, run, unit, still=features.still_speed, period=features.period)


def _find_stop(
    index: int, run: Run, unit: Unit, *, still: float, period: float
) -> Iterable[Damage]:
    """The stop at which a run ends, if there is one."""
    impact = _find_impact(run, speed=FAST * still, still=still)
    if impact is None:
        return
    before = (run.time >= run.time[impact] - BEFORE) & (run.time < run.time[impact])
    speed = float(np.median(np.abs(run.velocity[before]))) if before.any() else 0.0
    lasts = float(run.time[-1] - run.time[impact])
    volts, top = np.abs(run.voltage), float(np.abs(run.velocity).max())
    if (
        speed < FAST * still
        or lasts < max(SHORTEST, 2.5 * period)
        or volts[impact:].min() < PUSHED * volts.max()
    ):
        return
    moved = abs(float(run.position[-1] - run.position[impact]))
    share = 1.0 - moved / (speed * lasts)
    if share < 1.0 - LARGEST_REBOUND:
        return
    went = abs(float(run.position[impact] - run.position[0]))
    yield Damage(
        where=LogInterval.of_samples(index, run, impact),
        confidence=share,
        evidence=f"The mechanism stops from {min(1.0, speed / top):.0%} of its top speed within "
        f"{SETTLES:g} s and stays there for {lasts:.2f} s, although the voltage stays "
        f"at up to {volts[impact:].max():.1f} V: it hit its end, "
        f"{went / unit.si:.3g} {unit.symbol} from where the run started.",
        advice="Keep only the part of the run before the impact. Or set soft limits, run the test "
        "again, and let go of the button earlier.",
    )


def _find_pressed_starts(features: LogFeatures) -> Iterable[Damage]:
    """Find runs that start pressed against a soft stop, and leave it at too high a voltage."""
    baseline = features.baseline
    if baseline is None or features.log.type == "simple":
        return
    positions = np.concatenate([run.position for run in features.log.runs])
    lowest, highest = float(positions.min()), float(positions.max())
    for index, run in enumerate(features.log.runs):
        if run.kind != "quasistatic" or not len(run):
            continue
        off = find_first_motion(run, still=features.still_speed)
        way, volts = np.sign(run.voltage[off]), abs(float(run.voltage[off]))
        pressed = float(way * baseline.compute_gravity(run.position[:1])[0])
        given = float(way * (run.position[off] - run.position[0])) / max(highest - lowest, 1e-300)
        end = lowest if way > 0.0 else highest
        moved = np.abs(run.position[: off + 1] - run.position[0])
        creeps = float(run.time[off] - run.time[int(np.argmax(moved > CREPT * moved[-1]))])
        if (
            pressed > PRESSES * baseline.ks
            and abs(float(run.position[0]) - end) < AT_END * (highest - lowest)
            and GIVEN[0] < given < GIVEN[1]
            and creeps > CREEPS
            and volts - pressed - baseline.ks > PRESSES * baseline.ks
        ):
            yield Damage(
                where=LogInterval.of_samples(index, run, last=off),
                confidence=LEANS,
                evidence=f"For the first {run.time[off] - run.time[0]:.1f} s gravity presses the"
                " mechanism against the end of its travel. It moves by only "
                f"{given:.1%} of its travel, and leaves the end at {volts:.2f} V "
                f"although {pressed + baseline.ks:.2f} V would be enough.",
                advice="Cut these seconds out, or start the run a little away from the stop.",
            )


def _find_impact(run: Run, *, speed: float, still: float) -> int | None:
    """Index of the first sample at the stop; None if it does not end at rest, or never moves."""
    fast = np.flatnonzero(np.abs(run.velocity) > speed)
    if not fast.size or fast[-1] + 2 >= len(run):
        return None
    impact = int(fast[-1]) + 1
    settled = run.time > run.time[impact] + SETTLES
    tail = np.abs(run.velocity[settled])
    if tail.size and float(np.median(tail)) > still:
        return None
    return impact


def _extrapolate_run(run: Run, *, until: float) -> Run:
    """The run, extrapolated until ``until`` [s] if it ends before."""
    period = float(np.median(np.diff(run.time)))
    count = int(np.ceil((until - float(run.time[-1])) / period))
    if count <= 0:
        return run
    more = np.arange(1, count + 1) * period
    grows = 0.0
    if run.kind == "quasistatic" and len(run) > 1:
        grows = float((run.voltage[-1] - run.voltage[0]) / (run.time[-1] - run.time[0]))
    last = run.velocity[-5:].mean()

    def repeat_last(values: Array | None) -> Array | None:
        return None if values is None else np.append(values, np.full(count, values[-1]))

    return replace(
        run,
        time=np.append(run.time, run.time[-1] + more),
        voltage=np.append(run.voltage, run.voltage[-1] + grows * more),
        position=np.append(run.position, run.position[-1] + last * more),
        velocity=np.append(run.velocity, np.full(count, last)),
        current=repeat_last(run.current),
        bus_voltage=repeat_last(run.bus_voltage),
    )


FAULT = Fault(
    name="hard-stop",
    summary="the mechanism hits its end while the voltage stays on",
    ordinary="the mechanism pushes against its stop for 0.6 s",
    spoil=spoil,
    detect=detect,
    when=(0.6, 0.95),
)
