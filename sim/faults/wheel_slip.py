"""Wheel slip: the wheels break loose under a step of voltage and spin ahead of the robot.

On a robot: tires on carpet hold no more than their friction. A step that asks for more spins the
wheels up, light as they are, to where the motor's force is down to what the tires do hold; there
they wait until the robot has caught up.

    wheels:  kA_w·v' = V - kS - kV·v - F        robot:  kA·v' = F

with F [V] what the tires hold, and kA_w a tenth of kA.

To the gains: kA too large, by 39 % for a step of 3.5 V and 66 % for 7 V on four Kraken X60; kV is
not harmed.

Fingerprint: a dynamic test surges, lulls, and only then climbs as a mass does: an acceleration that
falls and rises again. The test against its look-alike, a light mechanism, is a smaller step.
"""

from collections.abc import Iterable

import numpy as np

from sim.clues import Clues
from sim.fault import Blow, Damage, Fault, Spoilt, Stretch, at_pace, with_run
from sim.log import Array, Log, Run

HELD = 0.4  # [share of the step] that the tires hold at severity 1
LIGHT = 0.1  # [share of kA] that is the wheels' and rotors' own
SLIPS = np.arange(0.3, 0.9, 0.05)  # [share of top speed] plateaus that are tried
SCALES = np.geomspace(0.4, 2.5, 12)  # [times the timescale] that are tried
DELAYS = (0, 1, 2)  # [samples] between voltage and motion that are tried
LASTS = 6.0  # [timescales] after which a step has nothing more to say
FEWEST = 6  # [samples] of a rise; fewer cannot show a lull
BELIEVED = 0.8  # [share explained] of what a plain rise leaves unexplained
CAUTION = 0.8  # [share of the voltage that still held] for the next step
CLEAR = 0.04  # [share of top speed] a plain rise misses by at least this much


def spoil(log: Log, blow: Blow, rng: np.random.Generator) -> Spoilt:
    """Let the wheels of a step break loose; where the blow falls, the step decides."""
    clues = Clues(log)
    run = log.runs[blow.run]
    if clues.balance is None:
        return Spoilt(log, ())
    first = _step(run)
    held = HELD ** (blow.severity * rng.uniform(0.9, 1.1))
    scale = clues.balance.timescale
    since = run.time - run.time[first]
    plain = _rise(since, scale)
    slipping = _slip(since, scale, 1.0 - held)
    pace = np.ones(len(run))
    pace[first + 1 :] = slipping[first + 1 :] / plain[first + 1 :]
    over = since > _caught_up(scale, 1.0 - held)
    where = Stretch(
        blow.run,
        run.test,
        float(run.time[first]),
        float(run.time[int(np.argmax(over)) if over.any() else -1]),
    )
    spoilt = at_pace(run, pace)
    return Spoilt(with_run(log, blow.run, spoilt), (where,))


def detect(clues: Clues) -> Iterable[Damage]:
    """Find steps that a surge and a lull explain better than any plain rise."""
    if clues.balance is None or clues.log.type not in ("", *FAULT.types):
        return
    usual = clues.balance.timescale
    for index, run in enumerate(clues.log.runs):
        if run.kind != "dynamic" or len(run) < FEWEST:
            continue
        first = _step(run)
        since = run.time - run.time[first]
        part = slice(first, int(np.searchsorted(since, LASTS * usual)))
        speed = np.abs(run.velocity[part])
        if speed.size < FEWEST:
            continue
        plain, _, _ = _fit(speed, since[part], usual, slips=np.zeros(1))
        loose, scale, slip = _fit(speed, since[part], usual, slips=SLIPS)
        top = float(speed.max())
        share = 1.0 - (loose / plain) ** 2 if plain > 0.0 else 0.0
        if share < BELIEVED or plain < CLEAR * top:
            continue
        end = _caught_up(scale, slip)
        most = CAUTION * (1.0 - slip) * float(np.abs(run.voltage).max())
        yield Damage(
            fault="wheel-slip",
            where=Stretch(
                index,
                run.test,
                float(run.time[first]),
                float(min(run.time[first] + end, run.time[-1])),
            ),
            confidence=share,
            evidence=f"The velocity surges to {slip:.0%} of its top, waits there for about "
            f"{end:.2f} s, and only then climbs as a mass does (timescale {scale:.3f} s).",
            advice=f"Run the dynamic tests again with a smaller step, at most {most:.1f} V, on the "
            "carpet it will drive on.",
        )


def _step(run: Run) -> int:
    """The sample where the voltage comes on."""
    on = np.abs(run.voltage) > 0.5 * float(np.abs(run.voltage).max())
    return int(np.argmax(on)) if on.any() else 0


def _rise(since: Array, scale: float) -> Array:
    """(n,) share of the top speed of what is pushed by a step at 0."""
    return np.asarray(-np.expm1(-np.maximum(since, 0.0) / scale))


def _caught_up(scale: float, slip: float) -> float:
    """[s] after which the robot is as fast as its wheels."""
    return scale * slip / (1.0 - slip)


def _slip(since: Array, scale: float, slip: float) -> Array:
    """(n,) share of the top speed of wheels that spin up to a share ``slip`` of it and wait."""
    grip = _caught_up(scale, slip)
    loose = slip * _rise(since, LIGHT * scale)
    return np.where(since < grip, loose, 1.0 - (1.0 - slip) * np.exp(-(since - grip) / scale))


def _fit(speed: Array, since: Array, scale: float, *, slips: Array) -> tuple[float, float, float]:
    """The smallest miss [m/s or rad/s, RMS] over timescales and slips, and where it is."""
    best = (float("inf"), scale, 0.0)
    period = float(np.median(np.diff(since)))
    for delay in DELAYS:
        for one in (SCALES * scale).tolist():
            for slip in slips.tolist():
                shape = _slip(since - delay * period, one, slip)
                size = float(shape @ shape)
                left = speed - shape * (float(shape @ speed) / size if size > 0.0 else 0.0)
                miss = float(np.sqrt(left @ left / left.size))
                if miss < best[0]:
                    best = (miss, one, slip)
    return best


FAULT = Fault(
    name="wheel-slip",
    summary="the wheels break loose under a step and spin ahead of the robot",
    ordinary="the tires hold 40 % of what the step asks of them",
    spoil=spoil,
    detect=detect,
    kinds=("dynamic",),
    types=("simple",),
    when=(0.0, 0.0),
)
