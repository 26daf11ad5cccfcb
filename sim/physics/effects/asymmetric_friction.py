"""Asymmetric friction: dry friction that is larger in one direction.

    V = (kS + lean)·sgn(v) + ...  forward          (kS - lean)·sgn(v) + ...  in reverse

In motion this is equal to a constant load. At rest friction holds the mechanism, and a load does
not.
"""

from collections.abc import Iterator, Mapping

import numpy as np

from sim.physics.effect import Effect, Parameter, Scale
from sim.physics.voltage_residual import VoltageResidual


def coulomb_friction(way: float, lean: float) -> float:
    """[V] dry friction beyond kS in direction ``way``."""
    return lean * way


def ordinary_parameters(scale: Scale, size: float) -> Mapping[str, float]:
    """Parameters of a given size; size 1 is two thirds of kS."""
    return {"lean": 0.67 * scale.ks * size}


def find_start_values(residual: VoltageResidual) -> Iterator[Mapping[str, float]]:
    """Start values: regression of the voltage residual on a constant."""
    (lean,) = residual.fit_columns(np.ones_like(residual.missing))
    yield {"lean": float(lean)}


EFFECT = Effect(
    name="asymmetric-friction",
    kind="term",
    summary="dry friction that differs between forward and reverse",
    formula="lean (kS + lean forward, kS - lean in reverse)",
    parameters=(
        Parameter(
            "lean",
            "added to kS forward, subtracted in reverse",
            "V",
            least=-12.0,
            most=12.0,
            everyday=0.025,  # a tenth of a usual kS, by which friction varies between runs, too
        ),
    ),
    fingerprint="Forward needs more voltage than reverse by the same amount at every speed.",
    inspect="Check for a worm gear or ratchet, a bearing that is loaded on one side, and a brake "
    "that drags.",
    apart={
        "constant-load": (
            "Let the mechanism go at rest. A load moves it, friction does not. While the "
            "mechanism moves, the two look the same."
        ),
    },
    example=ordinary_parameters,
    start_values=find_start_values,
    hooks={"coulomb_friction": coulomb_friction},
    same_in_motion="constant-load",
    symmetric=False,
)
