"""The same swerve drive turning on the spot: 5.8 kg·m², modules 0.41 m from the center.

Frictionless theory: kV 0.98 V·s/rad, kA 0.135 V·s²/rad, a timescale of 138 ms; rotors add a tenth.
"""

from dataclasses import replace

from sim.bench.swerve import SWERVE

MECHANISM = replace(
    SWERVE.rotation,
    spread={
        "ratio": (5.9, 6.3),
        "load": (5.4, 6.4),
        "friction": (0.18, 0.30),
        "drag": (0.0, 0.08),
        "spin": (0.06, 0.15),
    },
)
