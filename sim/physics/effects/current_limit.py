"""Current limit: the controller limits the motor's current, and so its torque.

    |u - kV·v| ≤ limit        limit = R·I, the voltage that drives the limiting current

While the limit is active, the velocity of a step rises in a straight line instead of an
exponential.
"""

from collections.abc import Iterator, Mapping

import numpy as np

from sim.physics.effect import Effect, Parameter, Scale
from sim.physics.voltage_residual import VoltageResidual


def transform_voltage(u: float, v: float, kv: float, limit: float) -> float:
    """[V] voltage at the motor for a command ``u``."""
    emf = kv * v
    return emf + min(max(u - emf, -limit), limit)


def ordinary_parameters(scale: Scale, size: float) -> Mapping[str, float]:
    """Parameters of a given size; size 1 is just over half of the step voltage."""
    return {"limit": max(0.55 * scale.step / size, 1.2 * scale.ks)}


def find_start_values(residual: VoltageResidual) -> Iterator[Mapping[str, float]]:
    """Start values: the largest u - kV·v that the motion needs, and shares of the commanded one."""
    torque = residual.voltage - residual.gains["kV"] * residual.velocity
    most = float(np.max(np.abs(torque), initial=0.0))
    needed = np.abs(torque - residual.missing)
    if needed.size:
        yield {"limit": max(float(np.quantile(needed, 0.98)), 0.1)}
    for part in (0.8, 0.6, 0.4):
        yield {"limit": max(part * most, 0.1)}


EFFECT = Effect(
    name="current-limit",
    kind="path",
    summary="a bound on the motor's current, and so on its torque",
    formula="u - kV·v kept within ± limit",
    parameters=(
        Parameter(
            "limit", "limit, as the voltage that drives this current", "V", least=1e-3, neutral=1e6
        ),
    ),
    fingerprint="A step's velocity rises in a straight line before it bends, instead of bending "
    "from the start.",
    inspect="Check the stator and supply limits in the motor controller's configuration.",
    apart={
        "delay": (
            "Log every 5 ms, or run a step with another voltage. A delay is the same for both "
            "steps."
        ),
    },
    example=ordinary_parameters,
    start_values=find_start_values,
    hooks={"transform_voltage": transform_voltage},
    order=4,
)
