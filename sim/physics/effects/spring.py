"""Spring: a force that grows linearly with position.

    V = ... + rate·x + preload

Causes are surgical tubing, a gas spring, an energy chain that bends, and a cable that winds up.
"""

from collections.abc import Iterator, Mapping

import numpy as np

from sim.physics.effect import Effect, Parameter, Scale
from sim.physics.voltage_residual import VoltageResidual


def force(x: float, rate: float, preload: float) -> float:
    """[V] force toward negative positions."""
    return rate * x + preload


def stored_energy(x: float, rate: float, preload: float) -> float:
    """[V·unit] energy in the spring."""
    return 0.5 * rate * x * x + preload * x


def ordinary_parameters(scale: Scale, size: float) -> Mapping[str, float]:
    """Parameters of a given size; size 1 is half a volt between the ends of the travel."""
    return {"rate": 0.5 * size / scale.reach, "preload": -0.25 * size}


def explain_missing_limits(scale: Scale) -> str:
    """Why a spring cannot be added to a mechanism without travel limits; empty if it can."""
    return "" if scale.bounded else "it turns without end, and a spring does not"


def find_start_values(residual: VoltageResidual) -> Iterator[Mapping[str, float]]:
    """Start values: regression of the voltage residual on position and a constant."""
    if not residual.position.size or residual.is_unbounded:
        return
    rate, preload = residual.fit_columns(residual.position, np.ones_like(residual.position))
    least = 0.02 / max(float(np.ptp(residual.position)), 1e-9)
    yield {"rate": max(float(rate), least), "preload": float(preload)}


def simplify(values: Mapping[str, float], residual: VoltageResidual) -> Mapping[str, float]:
    """Parameters of the constant load with the spring's force at the median position."""
    middle = float(np.median(residual.position)) if residual.position.size else 0.0
    return {"load": values["rate"] * middle + values["preload"]}


EFFECT = Effect(
    name="spring",
    kind="term",
    summary="a force that grows with position (tubing, gas spring, cable chain)",
    formula="rate·x + preload",
    parameters=(
        Parameter("rate", "volts per position", "V/{u}", power=1),
        Parameter("preload", "volts at position zero", "V", least=-1e3, most=1e3),
    ),
    fingerprint="The missing voltage is a straight line over position, at every speed.",
    inspect="Check for tubing or gas springs that hold up an arm, for a cable chain, and for a "
    "hose that winds up.",
    example=ordinary_parameters,
    start_values=find_start_values,
    hooks={"force": force},
    symmetric=False,
    stored_energy=stored_energy,
    reason_against=explain_missing_limits,
    simpler="constant-load",
    simplify=simplify,
)
