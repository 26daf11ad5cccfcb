"""Battery sag: a duty cycle gives less voltage while current lowers the battery's voltage.

    u - kV·v becomes (u - kV·v)/(1 + share·d²)        d = |u|/12 V, share = n·Rb/R

with n motors of resistance R on a battery of resistance Rb, for a controller whose command is a
duty cycle. The log does not show it if it contains the commanded instead of the applied voltage.
"""

from collections.abc import Iterator, Mapping

import numpy as np

from sim.core.units import BATTERY
from sim.physics.effect import Effect, Parameter, Scale
from sim.physics.voltage_residual import VoltageResidual


def transform_voltage(u: float, v: float, kv: float, share: float) -> float:
    """[V] voltage at the motor for a command ``u``."""
    duty = min(abs(u) / BATTERY, 1.0)
    emf = kv * v
    return emf + (u - emf) / (1.0 + share * duty * duty)


def ordinary_parameters(_: Scale, size: float) -> Mapping[str, float]:
    """Parameters of a given size; size 1 is four Kraken X60 on a battery of 20 milliohms."""
    return {"share": 2.4 * size}


def find_start_values(residual: VoltageResidual) -> Iterator[Mapping[str, float]]:
    """Start values: regression of the voltage residual on (u - kV·v)·d², and two more sizes."""
    duty = np.minimum(np.abs(residual.voltage) / BATTERY, 1.0)
    torque = residual.voltage - residual.gains["kV"] * residual.velocity
    (share,) = residual.fit_columns(torque * duty**2)
    yield {"share": float(np.clip(share, 0.05, 15.0))}
    yield {"share": 1.0}
    yield {"share": 6.0}


EFFECT = Effect(
    name="battery-sag",
    kind="path",
    summary=(
        "a battery whose voltage drops under current, although the log shows the commanded voltage"
    ),
    formula="(u - kV·v)/(1 + share·(u/12)²) in place of u - kV·v",
    parameters=(
        # A good battery with good plugs has a tenth; eight Kraken X60 on 60 milliohms have 15.
        Parameter(
            "share", "resistance of the battery / of the motors", "1", most=15.0, everyday=0.1
        ),
    ),
    fingerprint="Steps start more slowly than kA says, and larger steps even more so.",
    inspect="Check whether the battery is old, whether an Anderson connector is loose, and whether "
    "the log contains the commanded voltage.",
    apart={
        "drag": (
            "Run a step with another voltage, or log the applied voltage. Battery sag grows with "
            "the step."
        ),
        "current-limit": (
            "Run a step with another voltage. A limit cuts off at one current, battery sag grows "
            "gradually."
        ),
    },
    example=ordinary_parameters,
    start_values=find_start_values,
    hooks={"transform_voltage": transform_voltage},
    order=3,
)
