"""A cascade elevator: two NEO at 8:1 on a drum of 22.2 mm, a 12 kg carriage and an 8 kg stage.

The rope pulls the stage, and the stage pulls the carriage at twice its own speed. In meters of the
carriage the drum therefore has twice its radius. The stage moves half as far and half as fast. Its
work against gravity adds half its mass to the weight; its kinetic energy adds a quarter of its
mass to the inertia. The weight is that of 16 kg and the inertia is 14 kg, so kG/kA is 11.2 m/s². It
approaches 2 g if the stage is much heavier than the carriage.

Frictionless theory: kV 3.575 V·s/m, kA 0.179 V·s²/m, kG 2.01 V, a timescale of 50 ms.
"""

from sim.bench.mechanism import Mechanism, Sensor
from sim.physics.motors import find_motor

DRUM = 0.0222  # [m] radius
CARRIAGE, STAGE = 12.0, 8.0  # [kg] moved at full speed, and at half of it
WEIGHT, INERTIA = CARRIAGE + STAGE / 2.0, CARRIAGE + STAGE / 4.0  # [kg] in meters of the carriage

MECHANISM = Mechanism(
    name="cascade-elevator",
    summary="two NEO at 8:1, a carriage of 12 kg, a lower stage of 8 kg at half its speed",
    type="elevator",
    units="meters",
    motor=find_motor("neo"),
    motor_count=2,
    ratio=8.0,
    radius=2.0 * DRUM,
    load=INERTIA,
    lift=9.81 * WEIGHT / INERTIA,
    friction=0.30,
    lowest=0.0,
    travel=1.6,
    sensor=Sensor(resolution=8e-5, velocity_noise=0.006, noise_speed=0.03, jitter=0.0004),
    stator=60.0,
    spread={
        "ratio": (7.0, 9.5),
        "load": (10.0, 16.0),
        "lift": (10.6, 13.0),  # [m/s²] a stage of a third to twice the mass of the carriage
        "friction": (0.20, 0.40),
        "drag": (0.0, 0.08),
        "spin": (0.03, 0.10),
    },
)
