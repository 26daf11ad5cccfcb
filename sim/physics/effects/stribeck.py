"""Stribeck friction: dry friction that is larger at very low speed.

    V = kS·sgn(v) + ... + extra·exp(-|v|/slow)·sgn(v)

It takes more voltage to break away than to keep moving, so a slow start jerks.
"""

import math
from collections.abc import Iterator, Mapping

import numpy as np

from sim.physics.effect import Effect, Parameter, Scale
from sim.physics.voltage_residual import VoltageResidual


def coulomb_friction(v: float, extra: float, slow: float) -> float:
    """[V] dry friction beyond kS at the velocity ``v``."""
    return extra * math.exp(-abs(v) / slow)


def ordinary_parameters(scale: Scale, size: float) -> Mapping[str, float]:
    """Parameters of a given size; size 1 is 0.25 V at rest, fading over 8 % of the step's speed."""
    return {"extra": 0.25 * size, "slow": 0.08 * scale.speed}


def shortest_time(values: Mapping[str, float], gains: Mapping[str, float]) -> float:
    """[s] time constant of the breakaway, where friction falls as speed rises."""
    return gains["kA"] * values["slow"] / max(values["extra"], 1e-9)


def smallest_speed_scale(values: Mapping[str, float]) -> float:
    """[unit/s] speed over which the additional friction fades: ``slow`` itself."""
    return values["slow"]


def find_start_values(residual: VoltageResidual) -> Iterator[Mapping[str, float]]:
    """Start values: regression of the residual, for three speeds over which friction may fade."""
    for part in (0.06, 0.02, 0.2):
        slow = max(part * residual.top_speed, 1e-6)
        (extra,) = residual.fit_columns(
            np.sign(residual.velocity) * np.exp(-np.abs(residual.velocity) / slow)
        )
        yield {"extra": max(float(extra), 0.02), "slow": slow}


EFFECT = Effect(
    name="stribeck",
    kind="term",
    summary="breakaway friction: larger at very low speed",
    formula="extra·exp(-|v|/slow)·sgn(v)",
    parameters=(
        # every gearbox has a little more friction at rest than in motion
        Parameter("extra", "friction added to kS at rest", "V", most=12.0, everyday=0.06),
        Parameter("slow", "speed over which it fades", "{u}/s", power=-1, least=1e-6, neutral=1.0),
    ),
    fingerprint=(
        "The missing voltage is large at very low speed and fades with speed; the "
        "mechanism starts with a jerk."
    ),
    inspect="Check whether a bearing is dry, whether a gasket rubs, whether a chain is too tight, "
    "and whether grease has become stiff.",
    example=ordinary_parameters,
    start_values=find_start_values,
    hooks={"coulomb_friction": coulomb_friction},
    shortest_time=shortest_time,
    smallest_speed_scale=smallest_speed_scale,
)
