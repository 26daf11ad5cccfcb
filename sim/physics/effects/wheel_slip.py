"""Wheel slip: traction is limited; beyond the limit the wheels spin faster than the robot moves.

    |traction| ≤ grip            wheels and rotors have ``share`` of kA

A strong step spins the wheels up at once. The robot follows with a constant acceleration, until
both speeds are equal again. The encoder in the motor measures the wheels. ``grip`` [V] is the
largest traction μ·m·g, times the volts per newton. From standstill the wheels slip above about
kS + grip/(1 - share).
"""

from collections.abc import Iterator, Mapping

import numpy as np

from sim.core.units import find_unit
from sim.physics.effect import Effect, Parameter, Scale
from sim.physics.voltage_residual import VoltageResidual

LIGHT = 0.06  # [share of kA] of rotors, gears and wheels: that of four Krakens on a 60 kg robot
GRIPS = (0.96, 0.92, 0.88, 0.84, 0.8, 0.75, 0.7, 0.64, 0.57, 0.5, 0.42, 0.35, 0.28, 0.2)


def grip_limit(grip: float) -> float:
    """[V] largest traction that the floor transmits."""
    return grip


def motor_inertia_share(share: float) -> float:
    """[1] share of the inertia that spins with the wheels: the parameter ``share``."""
    return share


def ordinary_parameters(scale: Scale, size: float) -> Mapping[str, float]:
    """Parameters of a given size; at size 1, grip is two thirds of the traction a step needs."""
    push = max(scale.step - scale.ks, 0.1 * scale.step)
    return {"grip": (1.0 - LIGHT) * push / (1.0 + 0.5 * size), "share": LIGHT}


def find_start_values(residual: VoltageResidual) -> Iterator[Mapping[str, float]]:
    """Start values: shares of the largest traction in the log; none for angular positions."""
    if find_unit(residual.log.units).angular:
        return
    push = (
        np.abs(residual.voltage - residual.gains["kV"] * residual.velocity) - residual.gains["kS"]
    )
    most = (1.0 - LIGHT) * float(np.max(push, initial=0.0))
    for grip in GRIPS:
        yield {"grip": max(grip * most, 0.1), "share": LIGHT}


EFFECT = Effect(
    name="wheel-slip",
    kind="two-body",
    summary="wheels that spin faster than the robot moves, because the floor holds no more push",
    formula="push on the robot kept within ± grip",
    parameters=(
        Parameter("grip", "push that the floor can hold, in volts", "V", least=1e-3, neutral=1e6),
        Parameter(
            "share", "inertia of wheels and rotors", "1", least=0.01, most=0.5, neutral=LIGHT
        ),
    ),
    fingerprint=(
        "After a strong step the velocity jumps up and hardly rises until the robot has caught up; "
        "a gentle step shows nothing."
    ),
    inspect="Check the tires, the carpet and the robot's weight on the driven wheels.",
    apart={
        "current-limit": (
            "Log the current. At a current limit it stays the same, with wheels that slip it falls."
        ),
        "backlash": (
            "Use a smaller step. Free play shows at every start, wheels slip only at strong starts."
        ),
        "inertia-change": (
            "Use a smaller step. Then the wheels do not slip, but a different inertia still shows."
        ),
    },
    example=ordinary_parameters,
    start_values=find_start_values,
    hooks={"grip_limit": grip_limit, "motor_inertia_share": motor_inertia_share},
    reason_against=lambda scale: (
        "it does not drive on wheels" if scale.angular or scale.type != "simple" else ""
    ),
)
