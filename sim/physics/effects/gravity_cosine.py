"""Gravity on an arm: largest when it is level, zero when it is upright.

    V = ... + level·cos x + upright·sin x

Two parameters allow for an arm that is level at x = -φ: level = kG·cos φ, upright = -kG·sin φ.
"""

import math
from collections.abc import Iterator, Mapping

import numpy as np

from sim.physics.effect import Effect, Parameter, Scale
from sim.physics.voltage_residual import VoltageResidual


def force(x: float, level: float, upright: float) -> float:
    """[V] force toward negative angles."""
    return level * math.cos(x) + upright * math.sin(x)


def stored_energy(x: float, level: float, upright: float) -> float:
    """[V·rad] potential energy of the load."""
    return level * math.sin(x) - upright * math.cos(x)


def ordinary_parameters(scale: Scale, size: float) -> Mapping[str, float]:
    """Parameters of a given size; size 1 is a seventh of the step voltage when level."""
    return {"level": 0.14 * scale.step * size, "upright": 0.04 * scale.step * size}


def explain_missing_angle(scale: Scale) -> str:
    """Why the effect cannot be added where positions are in meters; empty if it can."""
    return "" if scale.angular else "its positions are lengths, not angles"


def find_start_values(residual: VoltageResidual) -> Iterator[Mapping[str, float]]:
    """Start values: regression of the voltage residual on cos x and sin x."""
    if not residual.position.size:
        return
    level, upright = residual.fit_columns(np.cos(residual.position), np.sin(residual.position))
    yield {"level": float(level), "upright": float(upright)}


def simplify(values: Mapping[str, float], residual: VoltageResidual) -> Mapping[str, float]:
    """Parameters of the spring with the same force and slope at the median position."""
    middle = float(np.median(residual.position)) if residual.position.size else 0.0
    middle_force = values["level"] * math.cos(middle) + values["upright"] * math.sin(middle)
    rate = values["upright"] * math.cos(middle) - values["level"] * math.sin(middle)
    return {"rate": max(rate, 0.0), "preload": middle_force - max(rate, 0.0) * middle}


EFFECT = Effect(
    name="gravity-cosine",
    kind="term",
    summary="gravity on an arm: largest when the arm is level, zero when it is upright",
    formula="level·cos x + upright·sin x",
    parameters=(
        Parameter("level", "voltage that holds it level", "V", least=-12.0, most=12.0),
        Parameter("upright", "the same at 90 degrees", "V", least=-12.0, most=12.0),
    ),
    fingerprint="The missing voltage follows the angle like a cosine, at every speed.",
    inspect="Check whether an arm was fitted as simple, whether the arm is level at an angle of "
    "zero, and whether a turret stands on a slope.",
    apart={
        "spring": (
            "Use the full travel, or start at another position. The voltage for gravity follows a"
            " cosine, the voltage for a spring follows a straight line."
        ),
    },
    example=ordinary_parameters,
    start_values=find_start_values,
    hooks={"force": force},
    symmetric=False,
    stored_energy=stored_energy,
    reason_against=explain_missing_angle,
    simpler="spring",
    simplify=simplify,
)
