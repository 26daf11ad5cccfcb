"""Compliance: an elastic joint between motor and load, which oscillates.

    push = (x_motor - x_load)/softness, and damping

A belt, a long shaft, an arm that bends: the motor's encoder shows an oscillation after every change
of voltage. ``share`` of kA and ``motor_friction`` of the friction are on the motor's side;
``damping`` is a share of critical damping.
"""

import math
from collections.abc import Iterator, Mapping

from sim.physics.effect import Effect, Parameter, Scale
from sim.physics.voltage_residual import VoltageResidual

SLOWEST, NEXT, TRIED = 2.0, 1.15, 23
"""[Hz] lowest frequency of the start values, ratio of each to the one before, and their number. The
last is 43 Hz. From a neighbor a search converges, unless the motor is light."""
LIGHT, HALF = 0.15, 0.5  # [1] shares of kA: a search from one seldom finds the other


def joint_compliance(softness: float) -> float:
    """[unit/V] compliance of the joint: the parameter ``softness`` itself."""
    return softness


def motor_inertia_share(share: float) -> float:
    """[1] share of the inertia on the motor's side: the parameter ``share`` itself."""
    return share


def joint_damping(damping: float) -> float:
    """[1] damping of the joint, as a share of critical damping."""
    return damping


def motor_friction_share(motor_friction: float) -> float:
    """[1] share of the friction on the motor's side: the parameter ``motor_friction`` itself."""
    return motor_friction


def ordinary_parameters(scale: Scale, size: float) -> Mapping[str, float]:
    """Parameters of a given size; size 1 oscillates at 5 Hz with the motor held."""
    stiff = 0.7 * scale.ka * (2.0 * math.pi * 5.0) ** 2
    return {"softness": size / stiff, "share": 0.3, "damping": 0.05, "motor_friction": 0.3}


def find_start_values(residual: VoltageResidual) -> Iterator[Mapping[str, float]]:
    """Start values: resonances of 2 to 43 Hz, with little or half of the inertia in the motor."""
    for share in (LIGHT, HALF):
        reduced = share * (1.0 - share) * abs(residual.gains["kA"])
        for number in range(TRIED):
            stiff = reduced * (2.0 * math.pi * SLOWEST * NEXT**number) ** 2
            soft = 1.0 / max(stiff, 1e-9)
            yield {"softness": soft, "share": share, "damping": 0.1, "motor_friction": 0.5}


EFFECT = Effect(
    name="compliance",
    kind="two-body",
    summary="a soft joint between motor and load (belt, long shaft, bending arm)",
    formula="push = (x_motor - x_load)/softness",
    parameters=(
        Parameter("softness", "how far it bends per volt", "{u}/V", power=-1, most=1e6),
        Parameter("share", "inertia on the motor's side", "1", least=0.01, most=0.95, neutral=0.3),
        Parameter(
            "damping", "damping of the joint, of critical", "1", least=0.005, most=1.0, neutral=0.05
        ),
        Parameter("motor_friction", "friction on the motor's side", "1", most=1.0, neutral=0.3),
    ),
    fingerprint=(
        "After every change of voltage the velocity oscillates, always at the same frequency."
    ),
    inspect="Check belts, chains and long shafts: hold the motor, push the load, and watch whether "
    "it springs back.",
    example=ordinary_parameters,
    start_values=find_start_values,
    hooks={
        "joint_compliance": joint_compliance,
        "joint_damping": joint_damping,
        "motor_friction_share": motor_friction_share,
        "motor_inertia_share": motor_inertia_share,
    },
)
