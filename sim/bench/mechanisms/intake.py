"""An intake: one NEO Vortex at 3:1 spins rollers and belts of 0.0013 kg·m².

Frictionless theory: kV 0.313 V·s/rot, kA 0.0090 V·s²/rot, a timescale of 29 ms: hardly
longer than one loop of the robot program, so kA is hard to identify.
"""

from sim.bench.mechanism import Mechanism, Sensor
from sim.core.units import TURN
from sim.physics.motors import find_motor

MECHANISM = Mechanism(
    name="intake",
    summary="one NEO Vortex at 3:1 on rollers of 0.0013 kg·m², positions in rotations",
    type="simple",
    units="rotations",
    motor=find_motor("neoVortex"),
    motor_count=1,
    ratio=3.0,
    load=0.0013,
    friction=0.45,
    travel=None,
    sensor=Sensor(
        resolution=TURN / 7168 / 3.0,
        velocity_noise=0.05 * TURN,
        noise_speed=0.5 * TURN,
        jitter=0.0004,
    ),
    stator=80.0,
    spread={
        "ratio": (2.0, 4.0),
        "load": (0.0008, 0.002),
        "friction": (0.3, 0.6),
        "drag": (0.0, 0.10),
        "spin": (0.03, 0.10),
    },
)
