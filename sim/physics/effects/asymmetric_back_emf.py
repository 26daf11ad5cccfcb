"""Asymmetric back-EMF: a motor that is faster in one direction, mostly by its timing.

V = ... + (kV + lean·sgn v)·v
"""

from collections.abc import Iterator, Mapping

import numpy as np

from sim.physics.effect import Effect, Parameter, Scale
from sim.physics.voltage_residual import VoltageResidual


def force(v: float, lean: float) -> float:
    """[V] additional force; with ``lean`` > 0 it opposes forward and assists reverse motion."""
    return lean * abs(v)


def ordinary_parameters(scale: Scale, size: float) -> Mapping[str, float]:
    """Parameters of a given size; size 1 is an eighth of kV."""
    return {"lean": 0.125 * scale.kv * size}


def find_start_values(residual: VoltageResidual) -> Iterator[Mapping[str, float]]:
    """Start values: regression of the voltage residual on |v|."""
    (lean,) = residual.fit_columns(np.abs(residual.velocity))
    yield {"lean": float(lean)}


EFFECT = Effect(
    name="asymmetric-back-emf",
    kind="term",
    summary="kV that differs between forward and reverse",
    formula="lean·|v| (kV + lean forward, kV - lean in reverse)",
    parameters=(
        Parameter(
            "lean",
            "added to kV forward, subtracted in reverse",
            "V·s/{u}",
            power=1,
            least=-1e6,
            most=1e6,
        ),
    ),
    fingerprint="The voltage-velocity lines of forward and reverse have different slopes.",
    inspect="Check whether the motor is a brushed motor with advanced timing, and whether a roller "
    "or belt folds in one direction.",
    apart={
        "asymmetric-friction": (
            "Run at two speeds. A difference in back-EMF grows with the speed, a difference in "
            "friction does not."
        ),
        "constant-load": (
            "Run at two speeds. A difference in back-EMF grows with the speed, a difference from "
            "a constant load does not."
        ),
    },
    example=ordinary_parameters,
    start_values=find_start_values,
    hooks={"force": force},
    symmetric=False,
)
