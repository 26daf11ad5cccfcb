"""An elevator with a counterweight: two NEO at 5:1 on a drum of 22.2 mm, 15 kg up and 6 kg down.

The counterweight carries a part of the carriage's weight, and has to be accelerated with it. The
weight is that of 15 - 6 kg and the inertia is 15 + 6 kg, so kG/kA is 4.2 m/s². A spring of constant
force would carry weight, too, and add no inertia.

Frictionless theory: kV 4.469 V·s/m, kA 0.215 V·s²/m, kG 0.90 V, a timescale of 48 ms.
"""

from sim.bench.mechanism import Mechanism, Sensor
from sim.physics.motors import find_motor

CARRIAGE, COUNTERWEIGHT = 15.0, 6.0  # [kg]
WEIGHT, INERTIA = CARRIAGE - COUNTERWEIGHT, CARRIAGE + COUNTERWEIGHT  # [kg]

MECHANISM = Mechanism(
    name="counterweight-elevator",
    summary="two NEO at 5:1 on a drum of 22 mm, 15 kg and a counterweight of 6 kg",
    type="elevator",
    units="meters",
    motor=find_motor("neo"),
    motor_count=2,
    ratio=5.0,
    radius=0.0222,
    load=INERTIA,
    lift=9.81 * WEIGHT / INERTIA,
    friction=0.25,
    lowest=0.0,
    travel=1.3,
    sensor=Sensor(resolution=4e-5, velocity_noise=0.006, noise_speed=0.03, jitter=0.0004),
    stator=60.0,
    spread={
        "ratio": (4.5, 6.5),
        "load": (16.0, 24.0),
        "lift": (3.5, 6.0),
        "friction": (0.15, 0.40),
        "drag": (0.0, 0.08),
        "spin": (0.03, 0.10),
    },
)
