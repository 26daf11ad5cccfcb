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

from sim.clues import Clues
from sim.fault import Blow, Damage, Fault, Spoilt, Stretch, at_pace, only, with_run
from sim.log import Array, Log, Run

PRESSED = 0.6  # [s] against the stop at severity 1, until somebody lets go
BOUNCE, FADES = 0.15, 0.02  # [share of the speed, s] how it comes back from the stop, and how long
SHORTEST = 0.06  # [s] against the stop, at least three samples, that leave no doubt
FAST = 4.0  # [speeds of standstill] it came with
ON = 0.5  # [share of the voltage at the impact] that is still there afterwards
SETTLES = 0.1  # [s] after the impact, for the bounce and the sensor's filter
BEFORE = 0.1  # [s] before the impact, where the speed it came with is read
GIVES = 0.25  # [share of the way it would have gone] a stop that gives more is none


def spoil(log: Log, blow: Blow, rng: np.random.Generator) -> Spoilt:
    """Put a stop in the way, and let the voltage push on for a while."""
    pressed = PRESSED * blow.severity * rng.uniform(0.9, 1.1)
    run = log.runs[blow.run]
    longer = _pushed_on(run, until=float(run.time[0]) + blow.start + pressed)
    impact = int(np.searchsorted(longer.time, run.time[0] + blow.start, side="right"))
    end = int(np.searchsorted(longer.time, run.time[0] + blow.start + pressed, side="right"))
    if impact >= end - 1 or not np.any(longer.velocity[impact:end]):
        return Spoilt(log, ())
    cut = only(longer, slice(end))
    since = cut.time - cut.time[impact]
    pace = np.where(since < 0.0, 1.0, -BOUNCE * np.exp(-since / FADES) * (since < 4.0 * FADES))
    spoilt = at_pace(cut, pace)
    late = float(spoilt.time[-1] - run.time[-1])
    damaged = with_run(log, blow.run, spoilt)
    if late > 0.0:  # what comes after this run comes that much later
        for index in range(blow.run + 1, len(log.runs)):
            follows = log.runs[index]
            damaged = with_run(damaged, index, replace(follows, time=follows.time + late))
    where = Stretch(blow.run, run.test, float(spoilt.time[impact]), float(spoilt.time[-1]))
    return Spoilt(damaged, (where,))


def detect(clues: Clues) -> Iterable[Damage]:
    """Find runs that end at rest after full speed, with the voltage still on."""
    for index, run in enumerate(clues.log.runs):
        impact = _impact(run, still=clues.still)
        if impact is None:
            continue
        before = (run.time >= run.time[impact] - BEFORE) & (run.time < run.time[impact])
        speed = float(np.median(np.abs(run.velocity[before]))) if before.any() else 0.0
        lasts = float(run.time[-1] - run.time[impact])
        volts = np.abs(run.voltage)
        if (
            speed < FAST * clues.still
            or lasts < max(SHORTEST, 2.5 * clues.period)
            or volts[impact:].min() < ON * volts[impact - 1]
        ):
            continue
        moved = abs(float(run.position[-1] - run.position[impact]))
        share = 1.0 - moved / (speed * lasts)
        if share < 1.0 - GIVES:
            continue
        yield Damage(
            fault="hard-stop",
            where=Stretch(index, run.test, float(run.time[impact]), float(run.time[-1])),
            confidence=share,
            evidence=f"It goes from {_percent(speed, run)} of its top speed to rest within "
            f"{SETTLES:g} s and stays there for {lasts:.2f} s, with "
            f"{volts[impact:].max():.1f} V on.",
            advice="Trim the run to before the impact, or run it again and let go earlier; set "
            "soft limits first.",
        )


def _impact(run: Run, *, still: float) -> int | None:
    """The first sample at the stop; None if the run does not end at rest, or never moves."""
    fast = np.flatnonzero(np.abs(run.velocity) > FAST * still)
    if not fast.size or fast[-1] + 2 >= len(run):
        return None
    way = np.sign(run.velocity[fast[-1]])
    with_it = np.flatnonzero(run.velocity * way > FAST * still)
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
    summary="the mechanism hits its end while the voltage pushes on",
    ordinary="0.6 s against the stop",
    spoil=spoil,
    detect=detect,
    when=(0.6, 0.95),
)
