"""The drivetrains and routines of the cases: four motors, 60 kg."""

import math
from dataclasses import dataclass, replace

import numpy as np

from sim.bench.mechanism import Mechanism
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.log import Log
from sim.physics.battery import Battery
from sim.physics.model import Part
from sim.physics.motors import find_motor

NOISE = 0.01  # [m/s] standard deviation of the velocity while it moves
ROUTINE = Routine(ramp=1.0, step=3.5, timeout=7.0)
AVERAGED = 0.224  # [s] averaging window; its mean is 112 ms late, as the velocity of a NEO
FORWARD, REVERSE = 0.15, 0.45  # [V] friction of the case in which it differs


@dataclass(frozen=True)
class Setup:
    """A mechanism and the routine run on it."""

    mechanism: Mechanism
    routine: Routine = ROUTINE

    def log(self, *, rng: np.random.Generator) -> Log:
        """The log that a correct robot program records of the mechanism."""
        return simulate(self.mechanism, self.routine, rng=rng)


def _make_drivetrain() -> Mechanism:
    plain = MECHANISMS["drivetrain"]
    sensor = replace(plain.sensor, velocity_noise=NOISE)
    return replace(plain, sensor=sensor, travel=None, supply=math.inf, brownout=0.0)


DRIVETRAIN = _make_drivetrain()
UNLIMITED = replace(DRIVETRAIN, stator=math.inf, battery=Battery(resistance=0.0))

PLAIN = Setup(DRIVETRAIN)
GOOD_BATTERY = Setup(
    replace(DRIVETRAIN, battery=Battery(resistance=0.020)), replace(ROUTINE, step=7.0)
)
WEAK_BATTERY = Setup(
    replace(DRIVETRAIN, battery=Battery(resistance=0.035)), replace(ROUTINE, step=10.0)
)
LIMITED = Setup(replace(DRIVETRAIN, stator=40.0))
SLOW_FILTER = Setup(
    replace(
        DRIVETRAIN,
        motor=find_motor("neo"),
        sensor=replace(DRIVETRAIN.sensor, filter=AVERAGED),
    )
)
GRIPPING = tuple(Setup(UNLIMITED, replace(ROUTINE, step=step)) for step in (3.5, 4.0, 7.0))
LEANING = Setup(
    replace(
        DRIVETRAIN,
        friction=0.5 * (FORWARD + REVERSE),
        hidden=(Part("asymmetric-friction", {"lean": 0.5 * (FORWARD - REVERSE)}),),
    )
)
