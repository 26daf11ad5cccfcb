"""Quadratic drag: air pushes back with the square of speed.

    V = ... + drag·v·|v|

It is zero near v = 0, and bends the voltage-velocity line upward at high speed. Thick grease is not
drag: viscous friction is linear in speed, so it is a part of kV, and the dry friction of a belt or
bearing is a part of kS. WPILib's docs describe both gains so:
https://github.com/wpilibsuite/frc-docs/blob/250e32128d9a93f27d58bc3cd1d0b3ab5eec43cd/source/docs/software/advanced-controls/introduction/introduction-to-feedforward.rst
"""

from collections.abc import Iterator, Mapping

from sim.physics.effect import Effect, Parameter, Scale
from sim.physics.voltage_residual import VoltageResidual


def force(v: float, drag: float) -> float:
    """[V] force against the motion."""
    return drag * v * abs(v)


def ordinary_parameters(scale: Scale, size: float) -> Mapping[str, float]:
    """Parameters of a given size; size 1 is half a volt at the speed of a step."""
    return {"drag": 0.5 * size / scale.speed**2}


def find_start_values(residual: VoltageResidual) -> Iterator[Mapping[str, float]]:
    """Start values: regression of the voltage residual on v·|v|."""
    (drag,) = residual.fit_columns(residual.velocity * abs(residual.velocity))
    yield {"drag": max(float(drag), 0.05 / max(residual.top_speed, 1e-9) ** 2)}


EFFECT = Effect(
    name="drag",
    kind="term",
    summary="air drag, which grows with the square of speed",
    formula="drag·v·|v|",
    # Warm motors, a weak battery and rolling wheels bend the voltage-velocity line by as much. In
    # 442 logs with known effects, hidden drag is 1.2 V and more at the free speed, and drag that is
    # found where none is hidden is mostly below 1 V.
    parameters=(Parameter("drag", "volts per squared speed", "V·s²/{u}²", power=2, everyday=0.9),),
    fingerprint="The missing voltage grows with speed, the same in both directions, and is zero"
    " near standstill.",
    inspect="Check whether a part moves air: a flywheel or a roller that works as a fan, spokes, "
    "or a large flat surface. Thick grease is not the cause, because it raises kV. A tight belt is "
    "not the cause, because it raises kS.",
    apart={
        "stribeck": (
            "Run a faster ramp or a larger step. Drag keeps growing with the speed, Stribeck "
            "friction stays small."
        ),
        "voltage-limit": (
            "Record a coast. Drag slows the mechanism while no voltage is applied, a voltage "
            "limit does not."
        ),
    },
    example=ordinary_parameters,
    start_values=find_start_values,
    hooks={"force": force},
)
