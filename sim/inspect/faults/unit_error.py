"""Unit error: the unit of the velocity does not match the unit of the position.

On a robot: position in rotations and velocity in rotations per minute, degrees and radians mixed,
or a conversion factor that was set for only one of the two.

Effect on the gains: kV and kA are wrong by the factor; kS and R² do not change. The gravity of an
arm is fitted to a wrong angle.

A velocity can also be a copy of the position, and a voltage can be a duty cycle. And if a
drivetrain would move at 17 m/s at 12 V, both of its readings are in another unit than the log says.

Fingerprint: the velocity is a known multiple of the slope of the position: 2π, 60, 360 and their
products (``sim/inspect/log_units.py``). A factor of *both* cannot be found in a log alone, because
the motion is consistent in any unit; compare kV with theory instead. So this fault changes the
velocity only.
"""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from sim.core.log import Log
from sim.core.units import TURN
from sim.inspect.fault import Damage, DamagedLog, Fault, FaultStrike, LogInterval, damage_runs
from sim.inspect.log_features import LogFeatures
from sim.inspect.log_units import find_unit_errors

MILD, ORDINARY, GROSS = (TURN,), (60.0, 360.0 / TURN), (360.0, TURN * 60.0)  # by severity


def spoil(log: Log, strike: FaultStrike, rng: np.random.Generator) -> DamagedLog:
    """Scale the velocity to another unit in every run; a higher severity takes a larger factor."""
    factors = MILD if strike.severity < 0.7 else ORDINARY if strike.severity < 2.0 else GROSS  # noqa: PLR2004 - thirds of the scale
    factor = float(rng.choice(factors)) ** int(rng.choice((-1, 1)))
    runs = (replace(run, velocity=run.velocity * factor) for run in log.runs)
    return damage_runs(log, dict(enumerate(runs)))


def detect(features: LogFeatures) -> Iterable[Damage]:
    """Find voltages, positions and velocities in a wrong unit, run by run."""
    for error in find_unit_errors(features):
        where = LogInterval()
        if error.run is not None:
            where = LogInterval.of_samples(error.run, features.log.runs[error.run])
        yield Damage(
            where=where,
            confidence=error.confidence,
            evidence=error.evidence,
            advice=error.advice,
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
