"""An elevator: two NEO at 5:1 on a drum of 22.2 mm lift 20 kg.

Frictionless theory: kV 4.469 V·s/m, kA 0.205 V·s²/m, kG 2.01 V, a timescale of 46 ms. kG/kA is g
without the inertia of rotors, and less with it.
"""

from sim.bench.mechanism import Mechanism, Sensor
from sim.physics.motors import find_motor

MECHANISM = Mechanism(
    name="elevator",
    summary="two NEO at 5:1 on a drum of 22 mm, 20 kg, positions in meters",
    type="elevator",
    units="meters",
    motor=find_motor("neo"),
    motor_count=2,
    ratio=5.0,
    radius=0.0222,
    load=20.0,
    lift=9.81,
    friction=0.25,
    lowest=0.0,
    travel=1.3,
    sensor=Sensor(resolution=4e-5, velocity_noise=0.006, noise_speed=0.03, jitter=0.0004),
    stator=60.0,
    spread={
        "ratio": (4.5, 6.5),
        "load": (12.0, 22.0),
        "friction": (0.15, 0.40),
        "drag": (0.0, 0.08),
        "spin": (0.03, 0.10),
    },
)
