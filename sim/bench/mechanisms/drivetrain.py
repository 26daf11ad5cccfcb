"""A swerve or tank drivetrain going straight: four Kraken X60, 6.75:1, 4 inch wheels, 60 kg.

Frictionless theory: kV 2.524 V·s/m, kA 0.191 V·s²/m, a timescale of 76 ms.
"""

from sim.bench.mechanism import Mechanism, Sensor
from sim.physics.motors import find_motor

MECHANISM = Mechanism(
    name="drivetrain",
    summary="four Kraken X60 on 4 inch wheels, 60 kg, positions in meters",
    type="simple",
    units="meters",
    motor=find_motor("krakenX60"),
    motor_count=4,
    ratio=6.75,
    radius=0.0508,
    load=60.0,
    friction=0.15,
    travel=10.0,  # [m] 0.5 V/s for 10 s needs 9.3 m
    sensor=Sensor(resolution=2.3e-5, velocity_noise=0.0075, noise_speed=0.05, jitter=0.0004),
    spread={
        "ratio": (5.9, 7.36),
        "load": (45.0, 65.0),
        "friction": (0.12, 0.25),
        "drag": (0.0, 0.08),
        "spin": (0.03, 0.10),
    },
)
