"""Constant load: a force in one direction, like weight or a slope.

    V = ... + load

One direction needs more voltage than the other by twice the load.
"""

from collections.abc import Iterator, Mapping

import numpy as np

from sim.physics.effect import Effect, Parameter, Scale
from sim.physics.voltage_residual import VoltageResidual


def force(load: float) -> float:
    """[V] force toward negative positions."""
    return load


def stored_energy(x: float, load: float) -> float:
    """[V·unit] potential energy of the load."""
    return load * x


def ordinary_parameters(scale: Scale, size: float) -> Mapping[str, float]:
    """Parameters of a given size; size 1 is an eighth of the step voltage."""
    return {"load": 0.125 * scale.step * size}


def find_start_values(residual: VoltageResidual) -> Iterator[Mapping[str, float]]:
    """Start values: regression of the voltage residual on a constant."""
    (load,) = residual.fit_columns(np.ones_like(residual.missing))
    yield {"load": float(load)}


EFFECT = Effect(
    name="constant-load",
    kind="term",
    summary="a constant force in one direction (weight, constant-force spring, slope)",
    formula="load",
    parameters=(
        # friction varies as much between runs, no floor is level, and no gear is the same both ways
        Parameter("load", "constant voltage", "V", least=-12.0, most=12.0, everyday=0.025),
    ),
    fingerprint="The missing voltage is the same at every speed and position, and has one sign.",
    inspect="Check whether an elevator was fitted as simple, whether a constant-force spring "
    "pulls, and whether the field slopes.",
    apart={
        "spring": (
            "Use the full travel. The force of a spring changes with the position, a constant "
            "load does not."
        ),
        "gravity-cosine": (
            "Use the full travel. Gravity on an arm changes with the angle, a constant load does "
            "not."
        ),
    },
    example=ordinary_parameters,
    start_values=find_start_values,
    hooks={"force": force},
    symmetric=False,
    stored_energy=stored_energy,
)
