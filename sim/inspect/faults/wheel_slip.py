"""Wheel slip: the wheels slip in a voltage step and spin faster than the robot moves.

On a robot: the traction of tires on carpet is limited. With a larger step the light wheels spin up
until the back-EMF has reduced the motor's force to the traction. Then their speed is constant until
the robot is as fast.

    wheels:  kA_w·v' = V - kS - kV·v - F        robot:  kA·v' = F

with F [V] the traction, and kA_w a tenth of kA.

Effect on the gains: kA becomes too large, by 39 % for a step of 3.5 V and 66 % for 7 V on four
Kraken X60; kV does not change.

Fingerprint: in a dynamic test the speed jumps, stops rising, and then rises like that of a mass:
the acceleration falls and rises again. On real robots the tires grip and slip in turn, and the
speed falls and recovers within the first 0.8 s. An elastic drive looks the same, but in every step,
also in a small one.
"""

import math
from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from sim.core.log import Array, Log, Run
from sim.core.units import find_unit
from sim.inspect.fault import (
    Damage,
    DamagedLog,
    Fault,
    FaultStrike,
    LogInterval,
    replace_run,
    rescale_motion,
)
from sim.inspect.launch import LEAST, find_launch_event, find_step_start
from sim.inspect.log_features import LogFeatures
from sim.inspect.step_rise import find_rise, simulate_wheels

HELD = 0.4  # [share of the step] grip of the tires at severity 1
SPIN = 8.0  # [times the speed without slip] largest speed of spinning wheels
LIMITED = 0.9  # [share of the push] a step that never has more starts under a current limit
SHOWS = 5.0  # [samples] shortest slip
STARTS = 0.1  # [time constants] after which a motion shows
GRIPS = np.arange(0.05, 0.75, 0.05)  # [share of the step] grips that are tried
LIMITS = np.linspace(0.1, 1.0, 10)  # [share of the step] current limits that are tried
AT_REST = 0.5  # [share of the top speed] a faster first sample is not the start of a step
FASTEST = 0.4  # [times the time constant] a shorter one is that of the wheels alone
SETTLED = 30.0  # [time constants] after which a slip is over
FINE = 8  # simulation steps per sample
FEWEST = 6  # [samples] of a rise, at least
BELIEVED = 0.8  # [share] of the squared error without slip that slip must explain
CLEAR = 0.04  # [share of the top speed] least error without slip
CAUTION = 0.8  # [share of the largest step without slip] that is advised


def spoil(log: Log, strike: FaultStrike, rng: np.random.Generator) -> DamagedLog:
    """Let the wheels slip at the start of a dynamic test."""
    features = LogFeatures(log)
    run, baseline = log.runs[strike.run], features.baseline
    held = HELD ** (strike.severity * rng.uniform(0.9, 1.1))
    if baseline is None:
        return DamagedLog(log, ())
    first = find_step_start(run)
    since = run.time - run.time[first]
    speed = _smooth_by_three(np.abs(run.velocity))
    moves = (speed > features.still_speed) & (since > 0.0)
    if not moves.any():
        return DamagedLog(log, ())
    late = max(float(since[int(np.argmax(moves))]) - STARTS * baseline.timescale, 0.0)
    lasts = min(float(since[-1]), SETTLED * baseline.timescale)
    grid = np.arange(0.0, lasts, features.period / FINE)
    way = np.sign(run.voltage[first])
    push = way * baseline.compute_steady_speed(run.voltage, run.position)
    limit = float(np.max(push - speed, initial=0.0))  # of the current, or the step itself
    limited = limit < LIMITED * push.max()
    command = np.full(grid.size, push.max()) if limited else np.interp(grid, since, push)
    spun = simulate_wheels(
        command,
        grid,
        scales=np.array((baseline.timescale,)),
        grips=np.array((held * limit,)),
        limits=np.array((limit if limited else math.inf,)),
    )
    loose = np.flatnonzero(spun.loose[0])
    grips = float(grid[loose[-1]]) + late if loose.size else 0.0
    if grips < SHOWS * features.period:
        return DamagedLog(log, ())
    pace = np.ones(len(run))
    slipping = np.interp(since - late, grid, spun.speed[0])
    moves &= since < lasts
    pace[moves] = np.clip(slipping[moves] / speed[moves], 0.0, SPIN)
    spoilt = rescale_motion(run, pace)
    if limited:  # faster wheels leave the current limit earlier
        more = np.interp(since, grid, spun.push[0]) - push
        more *= way * ((since >= 0.0) & (since < lasts))
        spoilt = replace(spoilt, voltage=run.voltage + baseline.kv * more)
    start = float(run.time[first])
    where = LogInterval(strike.run, run.test, start, min(start + grips, float(run.time[-1])))
    return DamagedLog(replace_run(log, strike.run, spoilt), (where,))


def detect(features: LogFeatures) -> Iterable[Damage]:
    """Find steps in which the speed falls or stops rising, or that wheel slip explains best."""
    if features.log.type not in ("", *FAULT.types):
        return
    for index, run in enumerate(features.log.runs):
        if run.kind == "dynamic" and len(run) >= FEWEST:
            found = _fit_slip(features, index, run) or _find_event(features, index, run)
            if found:
                yield found


def _find_event(features: LogFeatures, index: int, run: Run) -> Damage | None:
    """Wheel slip by a fall or a wait of the speed, without a model; None if there is none."""
    log = features.log  # only lengths, and what is named a drive, may be of wheels
    wheels = not find_unit(log.units).angular or "drive" in log.mechanism.lower()
    event = find_launch_event(run) if wheels else None
    if event is None:
        return None
    first = find_step_start(run)
    start, end = float(run.time[first]), float(run.time[event.end])
    volts, lasts = float(np.median(np.abs(run.voltage[first:]))), end - start
    happened = (
        f"falls by {event.size:.0%} within the first {lasts:.2f} s, and then recovers"
        if event.kind == "fall"
        else f"pauses until {lasts:.2f} s after the step, and then rises by another "
        f"{event.size:.0%} of its top"
    )
    return Damage(
        where=LogInterval(index, run.test, start, end),
        confidence=1.0 - 0.5 * LEAST / event.size,
        evidence=f"By the position, the speed rises to {event.speed:.3g} m/s, {happened}, at about "
        f"{volts:.1f} V: the wheels spin, and the robot catches up later.",
        advice=f"Run the dynamic tests again with half the step, {0.5 * volts:.1f} V, on the "
        "carpet it will drive on. If the speed still drops or pauses, look for a slack "
        "belt or a bending frame.",
    )


def _fit_slip(features: LogFeatures, index: int, run: Run) -> Damage | None:
    """Wheel slip that explains a step much better than a rise without slip; else None."""
    baseline = features.baseline
    rise = find_rise(run, baseline, period=features.period) if baseline else None
    if rise is None or rise.signal[0] > AT_REST * rise.signal.max():
        return None
    least = CLEAR * float(rise.signal.max())
    plain = rise.fit(fastest=FASTEST).error
    if plain > least:
        plain = min(plain, rise.fit("current", LIMITS, fastest=FASTEST).error)
    if plain <= least:
        return None
    loose = rise.fit("grip", GRIPS, fastest=FASTEST)
    share = 1.0 - (loose.error / plain) ** 2
    if share < BELIEVED:
        return None
    start, lasts = float(run.time[find_step_start(run)]), rise.find_slip_end(loose)
    most = CAUTION * loose.share * float(np.abs(run.voltage).max())
    return Damage(
        where=LogInterval(index, run.test, start, min(start + lasts, float(run.time[-1]))),
        confidence=share,
        evidence=f"The speed jumps to {1.0 - loose.share:.0%} of its top and stops rising for "
        f"about {lasts:.2f} s. After that it rises like the speed of a heavy robot. So the wheels "
        "spin first, and grip later.",
        advice=f"Run the dynamic tests again with a smaller step, at most {most:.1f} V, on the "
        "carpet it will drive on.",
    )


def _smooth_by_three(values: Array) -> Array:
    """(n,) running mean of three samples."""
    padded = np.pad(values, 1, mode="edge")
    return np.asarray((padded[:-2] + padded[1:-1] + padded[2:]) / 3.0)


FAULT = Fault(
    name="wheel-slip",
    summary="the wheels lose their grip in a step and spin faster than the robot moves",
    ordinary="the tires have 40 % of the grip that the step needs",
    spoil=spoil,
    detect=detect,
    kinds=("dynamic",),
    types=("simple",),
    when=(0.0, 0.0),
)
