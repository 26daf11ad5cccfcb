"""A flywheel shooter: two Kraken X60 at 1:1 on 0.006 kg·m².

Frictionless theory: kV 0.1193 V·s/rot, kA 0.0319 V·s²/rot, a timescale of 267 ms.
"""

from sim.bench.mechanism import Mechanism, Sensor
from sim.core.units import TURN
from sim.physics.motors import find_motor

MECHANISM = Mechanism(
    name="shooter",
    summary="two Kraken X60 on a flywheel of 0.006 kg·m², positions in rotations",
    type="simple",
    units="rotations",
    motor=find_motor("krakenX60"),
    motor_count=2,
    ratio=1.0,
    load=0.006,
    friction=0.12,
    travel=None,
    sensor=Sensor(
        resolution=TURN / 2048, velocity_noise=0.3 * TURN, noise_speed=2.0 * TURN, jitter=0.0004
    ),
    spread={
        "ratio": (0.8, 1.5),
        "load": (0.004, 0.008),
        "friction": (0.08, 0.15),
        "drag": (0.0, 0.08),
        "spin": (0.03, 0.10),
    },
)
