"""Hard stop: the mechanism runs into its end, and the test goes on.

On a robot: nobody lets go of the button in time, or a soft limit is missing. The arm, elevator or
turret stands against metal while the voltage pushes on; the first impact lets it bounce a little.

To the gains: voltage without speed and without acceleration, and an acceleration no voltage made.
Past 90 % of a step's top speed SysId cuts it away by itself; in a ramp nothing does, except that
samples slower than its threshold go, if the standing sensor is quiet.

Fingerprint: from full speed to none within a few samples, the position stays, the voltage does not,
until the end of the run.
"""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from sim.core.log import Array, Log, Run
from sim.inspect.anomalies import find_first_motion
from sim.inspect.fault import (
    Damage,
    DamagedLog,
    Fault,
    FaultStrike,
    LogInterval,
    replace_run,
    rescale_motion,
    select_samples,
)
from sim.inspect.log_features import LogFeatures

PRESSED = 0.6  # [s] against the stop at severity 1, until somebody lets go
BOUNCE, FADES = 0.15, 0.02  # [share of the speed, s] how it comes back from the stop, and how long
SHORTEST = 0.06  # [s] against the stop, at least three samples, that leave no doubt
FAST = 4.0  # [speeds of standstill] it came with
BRISK, WHOLE = 2.0, 0.7  # [the same, share of it one sample before] where it rests at once
ON, LATELY = 0.5, 0.2  # [share of the most voltage, s before the impact] that is there afterwards
PUSHED = 0.1  # [share of the largest voltage] less is none, and it came to rest by itself
SETTLES = 0.1  # [s] after the impact, for the bounce and the sensor's filter
BEFORE = 0.1  # [s] before the impact, where the speed it came with is read
AT_END = 0.02  # [share of the travel] that close to the end of it a stop may be
GIVEN = (0.005, 0.05)  # [share of the travel] by which a stop of rubber, or a slack chain, gives
CREPT, CREEPS = 0.2, 1.0  # [share, s] from this share of the give on it takes so long
PRESSES = 1.5  # [times kS] that gravity exceeds friction by, where it presses onto a stop
LATE = 0.25  # [V] above what would move it, where it comes off
LEANS = 0.7  # confidence: a chain that is pulled taut looks the same
GIVES = 0.25  # [share of the way it would have gone] a stop that gives more is none


def spoil(log: Log, strike: FaultStrike, rng: np.random.Generator) -> DamagedLog:
    """Add a stop to the travel, with the voltage still on for a while after it."""
    pressed = PRESSED * strike.severity * rng.uniform(0.9, 1.1)
    run = log.runs[strike.run]
    longer = _pushed_on(run, until=float(run.time[0]) + strike.start + pressed)
    impact = int(np.searchsorted(longer.time, run.time[0] + strike.start, side="right"))
    end = int(np.searchsorted(longer.time, run.time[0] + strike.start + pressed, side="right"))
    if impact >= end - 1 or not np.any(longer.velocity[impact:end]):
        return DamagedLog(log, ())
    cut = select_samples(longer, slice(end))
    since = cut.time - cut.time[impact]
    pace = np.where(since < 0.0, 1.0, -BOUNCE * np.exp(-since / FADES) * (since < 4.0 * FADES))
    spoilt = rescale_motion(cut, pace)
    late = float(spoilt.time[-1] - run.time[-1])
    damaged = replace_run(log, strike.run, spoilt)
    if late > 0.0:  # what comes after this run comes that much later
        for index in range(strike.run + 1, len(log.runs)):
            follows = log.runs[index]
            damaged = replace_run(damaged, index, replace(follows, time=follows.time + late))
    where = LogInterval.of_samples(strike.run, spoilt, impact)
    return DamagedLog(damaged, (where,))


def detect(features: LogFeatures) -> Iterable[Damage]:
    """Find runs that end at a stop with the voltage still on, or begin leaning on one."""
    yield from _leaning(features)
    for index, run in enumerate(features.log.runs):
        for fast in (FAST, BRISK):
            found = _stopped(
                index, run, fast=fast, still=features.still_speed, period=features.period
            )
            if found:
                yield found
                break


def _stopped(index: int, run: Run, *, fast: float, still: float, period: float) -> Damage | None:
    """What came with so many speeds of standstill, and rests until the end of the run."""
    impact = _impact(run, speed=fast * still, still=still)
    if impact is None:
        return None
    before = (run.time >= run.time[impact] - BEFORE) & (run.time < run.time[impact])
    speed = float(np.median(np.abs(run.velocity[before]))) if before.any() else 0.0
    lasts = float(run.time[-1] - run.time[impact])
    volts = np.abs(run.voltage)
    lately = (run.time >= run.time[impact] - LATELY) & (run.time < run.time[impact])
    pushed = float(volts[lately].max(initial=0.0))
    if (
        speed < fast * still
        or (fast < FAST and not _at_once(run, impact, speed=speed, still=still))
        or lasts < max(SHORTEST, 2.5 * period)
        or volts[impact:].min() < max(ON * pushed, PUSHED * volts.max())
    ):
        return None
    moved = abs(float(run.position[-1] - run.position[impact]))
    share = 1.0 - moved / (speed * lasts)
    if share < 1.0 - GIVES:
        return None
    return Damage(
        fault="hard-stop",
        where=LogInterval.of_samples(index, run, impact),
        confidence=share,
        evidence=f"The mechanism stops from {_percent(speed, run)} of its top speed within "
        f"{SETTLES:g} s and stays there for {lasts:.2f} s, although the voltage stays "
        f"at up to {volts[impact:].max():.1f} V: it hit its end, "
        f"{_way(run, impact):.3g} from where the run started.",
        advice="Keep only the part of the run before the impact. Or set soft limits, run the test "
        "again, and let go of the button earlier.",
    )


def _way(run: Run, impact: int) -> float:
    return abs(float(run.position[impact] - run.position[0]))


def _at_once(run: Run, impact: int, *, speed: float, still: float) -> bool:
    """Whether it came at its whole speed and rests from the next sample on, as by no friction."""
    size = np.abs(run.velocity)
    return bool(size[impact - 1] > WHOLE * speed and np.all(size[impact + 1 :] < still))


def _leaning(features: LogFeatures) -> Iterable[Damage]:
    """Find runs that begin pressed onto a stop which gives, and come off it too late."""
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
        gone = np.abs(run.position[: off + 1] - run.position[0])
        creeps = float(run.time[off] - run.time[int(np.argmax(gone > CREPT * gone[-1]))])
        if (
            pressed > PRESSES * baseline.ks
            and abs(float(run.position[0]) - end) < AT_END * (highest - lowest)
            and GIVEN[0] < given < GIVEN[1]
            and creeps > CREEPS
            and volts - pressed - baseline.ks > max(LATE, PRESSES * baseline.ks)
        ):
            yield Damage(
                fault="hard-stop",
                where=LogInterval.of_samples(index, run, last=off),
                confidence=LEANS,
                evidence=f"For the first {run.time[off] - run.time[0]:.1f} s gravity presses the"
                " mechanism against the end of its travel. It moves by only "
                f"{given:.1%} of its travel, and leaves the end at {volts:.2f} V "
                f"although {pressed + baseline.ks:.2f} V would be enough.",
                advice="Cut these seconds out, or start the run a little away from the stop.",
            )


def _impact(run: Run, *, speed: float, still: float) -> int | None:
    """The first sample at the stop; None if the run does not end at rest, or never moves."""
    fast = np.flatnonzero(np.abs(run.velocity) > speed)
    if not fast.size or fast[-1] + 2 >= len(run):
        return None
    way = np.sign(run.velocity[fast[-1]])
    with_it = np.flatnonzero(run.velocity * way > speed)
    if not with_it.size:
        return None
    impact = int(with_it[-1]) + 1
    settled = run.time > run.time[min(impact, len(run) - 1)] + SETTLES
    tail = np.abs(run.velocity[settled])
    if impact >= len(run) or (tail.size and float(np.median(tail)) > still):
        return None
    return impact


def _pushed_on(run: Run, *, until: float) -> Run:
    """The run, with samples added as it would have gone on, if it ends before a time."""
    period = float(np.median(np.diff(run.time)))
    count = int(np.ceil((until - float(run.time[-1])) / period))
    if count <= 0:
        return run
    more = np.arange(1, count + 1) * period
    grows = 0.0
    if run.kind == "quasistatic" and len(run) > 1:
        grows = float((run.voltage[-1] - run.voltage[0]) / (run.time[-1] - run.time[0]))
    last = run.velocity[-5:].mean()

    def on(values: Array | None) -> Array | None:
        return None if values is None else np.append(values, np.full(count, values[-1]))

    return replace(
        run,
        time=np.append(run.time, run.time[-1] + more),
        voltage=np.append(run.voltage, run.voltage[-1] + grows * more),
        position=np.append(run.position, run.position[-1] + last * more),
        velocity=np.append(run.velocity, np.full(count, last)),
        current=on(run.current),
        bus_voltage=on(run.bus_voltage),
    )


def _percent(speed: float, run: Run) -> str:
    return f"{min(1.0, speed / float(np.abs(run.velocity).max())):.0%}"


FAULT = Fault(
    name="hard-stop",
    summary="the mechanism hits its end while the voltage stays on",
    ordinary="the mechanism pushes against its stop for 0.6 s",
    spoil=spoil,
    detect=detect,
    when=(0.6, 0.95),
)
