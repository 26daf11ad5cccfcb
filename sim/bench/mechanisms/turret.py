"""A turret: one Kraken X44 at 45:1 on 0.8 kg·m², with a little more than one turn of travel.

Frictionless theory: kV 0.659 V·s/rad, kA 0.052 V·s²/rad, a timescale of 78 ms.
"""

from sim.bench.mechanism import Mechanism, Sensor
from sim.physics.motors import find_motor

MECHANISM = Mechanism(
    name="turret",
    summary="one Kraken X44 at 45:1 on 0.8 kg·m², a turn between its stops, positions in degrees",
    type="simple",
    units="degrees",
    motor=find_motor("krakenX44"),
    motor_count=1,
    ratio=45.0,
    load=0.8,
    friction=0.30,
    lowest=-3.25,
    travel=6.5,
    sensor=Sensor(
        resolution=6.283185 / 2048 / 45.0, velocity_noise=0.02, noise_speed=0.05, jitter=0.0004
    ),
    spread={
        "ratio": (36.0, 60.0),
        "load": (0.5, 1.1),
        "friction": (0.2, 0.45),
        "drag": (0.0, 0.08),
        "spin": (0.03, 0.10),
    },
)
