"""Heating: the winding gets warm, its resistance grows, and a volt drives less current.

    u - kV·v becomes (u - kV·v)/(1 + warmth)
    warmth' = rate·(u - kV·v)² - warmth/COOLING

The resistance of copper grows by 0.39 % per kelvin. A load that the motor holds heats it most.
"""

import math
from collections.abc import Iterator, Mapping

import numpy as np

from sim.physics.effect import Effect, Parameter, Scale
from sim.physics.voltage_residual import VoltageResidual, shares_clock

COOLING = 90.0  # [s] time constant with which a winding cools


def transform_voltage(u: float, v: float, kv: float, memory: float) -> float:
    """[V] voltage that would drive the same current in a cold motor."""
    emf = kv * v
    return emf + (u - emf) / (1.0 + memory)


def update_memory(memory: float, dt: float, u: float, v: float, kv: float, rate: float) -> float:
    """[1] ``warmth`` after ``dt``: the winding's resistance over that of a cold one, minus 1."""
    drop = (u - kv * v) * (1.0 + memory)
    fade = math.exp(-dt / COOLING)
    return memory * fade + rate * drop * drop * COOLING * (1.0 - fade)


def ordinary_parameters(scale: Scale, size: float) -> Mapping[str, float]:
    """Parameters of a given size; 1: 10 % more resistance after 10 s of a quarter step voltage."""
    return {"rate": 0.01 * size / (0.25 * scale.step) ** 2}


def find_start_values(residual: VoltageResidual) -> Iterator[Mapping[str, float]]:
    """Start values: regression of the voltage residual on the heat made so far."""
    torque = residual.voltage - residual.gains["kV"] * residual.velocity
    steps = np.diff(residual.clock, prepend=residual.clock[:1])
    heat = np.cumsum(np.clip(steps, 0.0, 0.1) * torque**2)
    if not shares_clock(residual.log):  # each run began cold
        begins = np.searchsorted(residual.run, residual.run)
        heat -= heat[begins]
    (rate,) = residual.fit_columns(torque * heat)
    yield {"rate": float(np.clip(rate, 1e-4, 1.0))}
    yield {"rate": 0.003}
    yield {"rate": 0.02}


EFFECT = Effect(
    name="heating",
    kind="path",
    summary="a motor that gets warm and weaker during the tests",
    formula="(u - kV·v)/(1 + warmth), warmth grows with (u - kV·v)²",
    parameters=(Parameter("rate", "warmth per squared volt and second", "1/(V²·s)", most=10.0),),
    fingerprint="Later runs react more weakly than earlier runs, above all after a large current.",
    inspect="Look at the temperature of the motor in the log, and let the motor cool between "
    "tests.",
    apart={
        "inertia-change": (
            "Repeat the first test at the end. A motor gets warm slowly, a load changes at one "
            "moment."
        ),
        "battery-sag": (
            "Repeat the first test at the end. The motor is warmer than before, battery sag is "
            "the same as before."
        ),
    },
    example=ordinary_parameters,
    start_values=find_start_values,
    hooks={"transform_voltage": transform_voltage, "update_memory": update_memory},
    order=5,
)
