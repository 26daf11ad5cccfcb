"""A swerve drive going straight: four NEO, 6.12:1, 4 inch wheels, a full-weight robot of 64 kg.

Frictionless theory: kV 2.39 V·s/m, kA 0.613 V·s²/m, a timescale of 256 ms; rotors add a twentieth.
"""

from dataclasses import replace

from sim.bench.swerve import SWERVE

MECHANISM = replace(
    SWERVE.translation,
    spread={
        "ratio": (5.9, 6.3),
        "load": (62.0, 68.0),
        "friction": (0.15, 0.25),
        "drag": (0.0, 0.08),
        "spin": (0.03, 0.10),
    },
)
