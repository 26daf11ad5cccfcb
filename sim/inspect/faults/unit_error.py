"""Unit error: the unit of the velocity does not match the unit of the position.

On a robot: position in rotations and velocity in rotations per minute, degrees and radians mixed,
or a conversion factor that was set for only one of the two.

Effect on the gains: kV and kA are wrong by the factor; kS and R² do not change. The gravity of an
arm is fitted to a wrong angle.

A velocity can also be a copy of the position. And if a drivetrain would move at 17 m/s at 12 V,
both of its readings are in another unit than the log says.

Fingerprint: the velocity is a known multiple of the slope of the position: 2π, 60, 360 and their
products. A factor of *both* cannot be found in a log alone, because the motion is consistent in any
unit; compare kV with theory instead. So this fault changes the velocity only.
"""

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np

from sim.core.log import FOUR_TESTS, Log
from sim.core.units import find_unit
from sim.inspect.fault import Damage, DamagedLog, Fault, FaultStrike, LogInterval
from sim.inspect.log_features import LogFeatures

TURN = 2.0 * math.pi
NEAR = 0.05  # [share] largest difference from a known factor; slip and filters change it less
DRIVES = ("drive", "swerve")  # in the name of a mechanism; SysId's own tool writes Drivetrain
FULL = 12.0  # [V]
FASTEST, SLOWEST = 9.0, 1.2  # [m/s] of a drive at 12 V: two-speed gearboxes have about 2 to 7
FAR = 2.5  # [1] least factor of a wrong unit

KNOWN: Mapping[str, float] = {
    "2π, the factor between rotations and radians": TURN,
    "60, the factor between seconds and minutes": 60.0,
    "60/2π, the factor between radians per second and rpm": 60.0 / TURN,
    "360, the factor between rotations and degrees": 360.0,
    "57.3, the factor between radians and degrees": 360.0 / TURN,
    "6, the factor between rpm and degrees per second": 6.0,
    "2π·60, the factor between rotations per second and radians per minute": TURN * 60.0,
    "39.4, the factor between meters and inches": 1.0 / 0.0254,
    "3.28, the factor between meters and feet": 1.0 / 0.3048,
    "12, the factor between feet and inches": 12.0,
    "10, the factor between units per 100 ms and units per second": 10.0,
}
MILD, ORDINARY, GROSS = (TURN,), (60.0, 360.0 / TURN), (360.0, TURN * 60.0)  # by severity


def spoil(log: Log, strike: FaultStrike, rng: np.random.Generator) -> DamagedLog:
    """Scale the velocity to another unit in every run; a higher severity takes a larger factor."""
    factors = MILD if strike.severity < 0.7 else ORDINARY if strike.severity < 2.0 else GROSS  # noqa: PLR2004 - thirds of the scale
    factor = float(rng.choice(factors)) ** int(rng.choice((-1, 1)))
    runs = tuple(replace(run, velocity=run.velocity * factor) for run in log.runs)
    return DamagedLog(
        replace(log, runs=runs),
        tuple(LogInterval.of_samples(i, run) for i, run in enumerate(runs) if len(run)),
    )


def detect(features: LogFeatures) -> Iterable[Damage]:
    """Compare velocity with the slope of position, and a drivetrain with plausible speeds."""
    usual = features.usual_distance_ratio
    for index, (run, ratio) in enumerate(
        zip(features.log.runs, features.distance_ratios, strict=True)
    ):
        copied = features.position_copy_factors[index]
        said = _explain_ratio(ratio) if _explain_ratio(usual) else ""
        if copied:
            yield Damage(
                fault="unit-error",
                where=LogInterval.of_samples(index, run),
                confidence=0.97,
                evidence=f"The recorded velocity is the position, multiplied by {copied:.3g}. "
                "Where the position does not change, the velocity should be 0, and it is not.",
                advice="Log the encoder's velocity in place of its position, and record again. "
                "Without a velocity nothing can be fitted.",
            )
        elif said:
            yield Damage(
                fault="unit-error",
                where=LogInterval.of_samples(index, run),
                confidence=0.95,
                evidence=f"The velocity is {ratio:.4g} times the slope of the position. {said}.",
                advice="Make the conversion factors of position and velocity agree, and "
                f"divide the recorded velocity by {ratio:.4g}.",
            )
    yield from _check_drive_speed(features)


def _check_drive_speed(features: LogFeatures) -> Iterable[Damage]:
    """A drivetrain that is faster or slower than any: position and velocity have a wrong unit."""
    per, name = find_unit(features.log.units), features.log.mechanism
    if per.angular or not any(word in name.lower() for word in DRIVES):
        return
    speeds = [
        FULL * run.top_speed / float(np.abs(run.voltage).max())
        for run in features.log.runs
        if run.test in FOUR_TESTS and run.top_speed and run.voltage.any()
    ]
    speed = float(np.median(speeds)) if speeds else 0.0
    if not speed or SLOWEST <= speed <= FASTEST or _explain_ratio(features.usual_distance_ratio):
        return
    bound = f"faster than {FASTEST:g}" if speed > FASTEST else f"slower than {SLOWEST:g}"
    yield Damage(
        fault="unit-error",
        where=LogInterval(None, "", 0.0, 0.0),
        confidence=0.9,
        evidence=f"With {FULL:g} V this drivetrain would move at about {speed:.3g} m/s, and no "
        f"FRC robot is {bound} m/s: position and velocity are not in meters, or their "
        "factor is wrong.",
        advice="Push the robot forward by exactly 1 m and see by how much the logged position "
        "changes. Then set gear ratio and wheel circumference so that it is 1.",
    )


def _explain_ratio(ratio: float) -> str:
    """A sentence that explains a distance ratio; empty if no unit is wrong."""
    if 1.0 / FAR < ratio < FAR or not ratio > 0.0:
        return ""
    known = {f"This is {name}": factor for name, factor in KNOWN.items()}
    known |= {f"This is 1 over {name}": 1.0 / factor for name, factor in KNOWN.items()}
    nearest = min(known, key=lambda said: abs(np.log(ratio / known[said])))
    if abs(ratio / known[nearest] - 1.0) < NEAR:
        return nearest
    return (
        "This factor belongs to no unit: probably only one of the two signals contains a gear "
        "ratio or a circumference"
    )


FAULT = Fault(
    name="unit-error",
    summary="the unit of the velocity does not match the unit of the position",
    ordinary="the velocity is wrong by a factor of 60 or 57.3; at severity 0.5 by 2π, at "
    "severity 2 by 360 or 377",
    spoil=spoil,
    detect=detect,
    whole=True,
)
