"""Deadband: the controller ignores small commands.

    u = 0 where |u| < band

Phoenix calls it the neutral deadband (4 % by default, 0.48 V of 12); it hides friction below it.
"""

from collections.abc import Iterator, Mapping

import numpy as np

from sim.physics.effect import Effect, Parameter, Scale
from sim.physics.voltage_residual import VoltageResidual

STARTED = 0.02  # [share of the top speed] at which a run has begun to move


def transform_voltage(u: float, band: float) -> float:
    """[V] voltage at the motor for a command ``u``."""
    return u if abs(u) >= band else 0.0


def ordinary_parameters(scale: Scale, size: float) -> Mapping[str, float]:
    """Parameters of a given size; size 1 is a third of a volt more than kS already holds."""
    return {"band": scale.ks + 0.33 * size}


def find_start_values(seen: VoltageResidual) -> Iterator[Mapping[str, float]]:
    """Start values: shares of the voltages at which the ramps began to move (it is a threshold).

    What a load draws along moves before any voltage does, until a ramp turns it.
    """
    started = STARTED * seen.top_speed
    onset = [
        abs(float(run.voltage[np.argmax(run.velocity * np.sign(run.voltage) > started)]))
        for run in seen.log.runs
        if run.kind == "quasistatic" and len(run)
    ]
    around = {float(np.median(onset)), max(onset)} if onset else {0.4}
    for part in (1.0, 0.92, 0.84, 0.76, 0.68, 0.6, 1.1):
        yield from ({"band": max(part * one, 0.02)} for one in sorted(around))


EFFECT = Effect(
    name="deadband",
    kind="path",
    summary="small voltages that the motor controller ignores",
    formula="u = 0 where |u| < band",
    parameters=(Parameter("band", "smallest voltage that is applied", "V", most=12.0),),
    fingerprint="Ramps start late and then jump to their speed; below one voltage it coasts.",
    inspect="Check the neutral deadband in the motor controller's configuration.",
    apart={
        "stribeck": (
            "Let the voltage fall slowly (triangle test). Below one voltage a deadband gives no "
            "voltage at all, friction only slows the mechanism."
        ),
        "delay": (
            "Run two ramps. With a deadband the motion starts at the same voltage, with a delay "
            "it starts after the same time."
        ),
    },
    example=ordinary_parameters,
    start_values=find_start_values,
    hooks={"transform_voltage": transform_voltage},
    order=1,
)
