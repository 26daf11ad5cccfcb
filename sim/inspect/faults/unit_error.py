"""Unit error: velocity is counted in another unit than the position it belongs to.

On a robot: position in rotations and velocity in rotations per minute, degrees beside radians, or
a conversion factor that was set for one of the two and not for the other.

To the gains: kV and kA are off by the factor, and so is everything they are compared with; kS and
R² are untouched. An arm fits its gravity to an angle that is none.

Fingerprint: the velocity is a known multiple of the slope of the position: 2π, 60, 360 and what
they make together. A factor on *both* cannot be known from a log alone, because motion in another
unit is just as consistent: compare kV with theory for that. So this fault strikes velocity only.
"""

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np

from sim.core.log import Log, Run
from sim.inspect.fault import Damage, DamagedLog, Fault, FaultStrike, LogInterval
from sim.inspect.log_features import LogFeatures

TURN = 2.0 * math.pi
NEAR = 0.05  # [share] how closely a factor must be met; slip and filters bend it less
FAR = 2.5  # [times] a factor that is none of the known ones but too large to be a bent measurement

KNOWN: Mapping[str, float] = {
    "2π, radians for rotations": TURN,
    "60, minutes for seconds": 60.0,
    "60/2π, rpm for radians per second": 60.0 / TURN,
    "360, degrees for rotations": 360.0,
    "57.3, degrees for radians": 360.0 / TURN,
    "6, degrees per second for rpm": 6.0,
    "2π·60, radians per minute for rotations per second": TURN * 60.0,
    "39.4, inches for meters": 1.0 / 0.0254,
    "3.28, feet for meters": 1.0 / 0.3048,
    "12, inches for feet": 12.0,
    "10, units per 100 ms for units per second": 10.0,
}
MILD, ORDINARY, GROSS = (TURN,), (60.0, 360.0 / TURN), (360.0, TURN * 60.0)  # by severity


def spoil(log: Log, blow: FaultStrike, rng: np.random.Generator) -> DamagedLog:
    """Count velocity in another unit, in every run; a harder blow takes a larger factor."""
    factors = MILD if blow.severity < 0.7 else ORDINARY if blow.severity < 2.0 else GROSS  # noqa: PLR2004 - thirds of the scale
    factor = float(rng.choice(factors)) ** int(rng.choice((-1, 1)))
    runs = tuple(replace(run, velocity=run.velocity * factor) for run in log.runs)
    return DamagedLog(
        replace(log, runs=runs), tuple(_whole(i, run) for i, run in enumerate(runs) if len(run))
    )


def detect(features: LogFeatures) -> Iterable[Damage]:
    """Divide what the velocities sum up to by what the position changes, and look it up."""
    for index, (run, ratio) in enumerate(
        zip(features.log.runs, features.distance_ratios, strict=True)
    ):
        said = _named(ratio)
        if said:
            yield Damage(
                fault="unit-error",
                where=_whole(index, run),
                confidence=0.95,
                evidence=f"Velocity is {ratio:.4g} times the slope of position: {said}.",
                advice="Set both conversion factors of the encoder alike, and divide the recorded "
                f"velocity by {ratio:.4g}.",
            )


def _named(ratio: float) -> str:
    """What a ratio is; empty if nothing is wrong."""
    if 1.0 / FAR < ratio < FAR or not ratio > 0.0:
        return ""
    sought = {f"a factor of {name}": factor for name, factor in KNOWN.items()}
    sought |= {f"one over {name}": 1.0 / factor for name, factor in KNOWN.items()}
    nearest = min(sought, key=lambda said: abs(np.log(ratio / sought[said])))
    if abs(ratio / sought[nearest] - 1.0) < NEAR:
        return nearest
    return "no unit's factor, so a gear ratio or a circumference that only one of them counts"


def _whole(index: int, run: Run) -> LogInterval:
    return LogInterval(index, run.test, float(run.time[0]), float(run.time[-1]))


FAULT = Fault(
    name="unit-error",
    summary="velocity is counted in another unit than position",
    ordinary="velocity is off by 60 or 57.3, up or down; by 2π below, by 360 and more above",
    spoil=spoil,
    detect=detect,
    whole=True,
)
