"""Voltage limit: the controller does not apply more than a set voltage.

    |u| ≤ limit

The cause is a forgotten peak output or voltage compensation: the commanded voltage of a ramp still
rises in the log, but the velocity does not.
"""

from collections.abc import Iterator, Mapping

import numpy as np

from sim.physics.effect import Effect, Parameter, Scale
from sim.physics.voltage_residual import VoltageResidual


def transform_voltage(u: float, limit: float) -> float:
    """[V] voltage at the motor for a command ``u``."""
    return min(max(u, -limit), limit)


def ordinary_parameters(scale: Scale, size: float) -> Mapping[str, float]:
    """Parameters of a given size; size 1 is four fifths of the step voltage."""
    return {"limit": max(scale.step * (1.0 - 0.2 * size), 2.0 * scale.ks)}


def find_start_values(residual: VoltageResidual) -> Iterator[Mapping[str, float]]:
    """Start values: the largest voltage that the motion needs, and shares of the commanded one."""
    needed = np.abs(residual.voltage - residual.missing)
    most = float(np.max(np.abs(residual.voltage), initial=0.0))
    if needed.size:
        yield {"limit": max(float(np.quantile(needed, 0.97)), 0.1)}
    for part in (0.9, 0.7, 0.5):
        yield {"limit": max(part * most, 0.1)}


EFFECT = Effect(
    name="voltage-limit",
    kind="path",
    summary="a bound on the voltage that is applied (peak output)",
    formula="u kept within ± limit",
    parameters=(Parameter("limit", "largest voltage applied", "V", least=1e-3, neutral=1e6),),
    fingerprint="Above a certain voltage the mechanism gets no faster, in ramps and in steps.",
    inspect="Check the peak output and the voltage compensation in the motor controller's "
    "configuration.",
    apart={
        "current-limit": (
            "Run a ramp. With a current limit the mechanism still reaches its full speed, but "
            "later."
        ),
    },
    example=ordinary_parameters,
    start_values=find_start_values,
    hooks={"transform_voltage": transform_voltage},
    order=2,
)
