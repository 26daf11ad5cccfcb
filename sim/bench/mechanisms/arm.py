"""A single-jointed arm: one NEO at 60:1 lifts 4 kg at half a meter.

Frictionless theory: kV 1.191 V·s/rad, kA 0.077 V·s²/rad, kG 1.51 V, a timescale of 65 ms. For a
point mass at distance L, kG/kA is g/L = 19.6 rad/s².
"""

from sim.bench.mechanism import Mechanism, Sensor
from sim.physics.motors import find_motor

MECHANISM = Mechanism(
    name="arm",
    summary="one NEO at 60:1 with 4 kg half a meter out, angles in radians from level",
    type="arm",
    units="radians",
    motor=find_motor("neo"),
    motor_count=1,
    ratio=60.0,
    load=4.0 * 0.5**2,
    lift=9.81 / 0.5,
    friction=0.25,
    lowest=-0.6,
    travel=2.2,
    sensor=Sensor(
        resolution=6.283185 / 8192, velocity_noise=0.02, noise_speed=0.05, jitter=0.0004
    ),  # a through-bore encoder on the joint
    stator=40.0,  # what a team sets for a NEO
    spread={
        "ratio": (50.0, 75.0),
        "load": (0.7, 1.3),
        "lift": (15.0, 22.0),
        "friction": (0.15, 0.35),
        "drag": (0.0, 0.08),
        "spin": (0.0, 0.06),
    },
)
