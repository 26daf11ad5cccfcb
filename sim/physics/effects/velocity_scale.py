"""Velocity scale: the velocity is in another unit than the position says.

    seen = scale·v

A forgotten gear ratio, rotations per minute for per second, a wrong wheel diameter in one place.
"""

from collections.abc import Iterator, Mapping

import numpy as np

from sim.physics.effect import Effect, Parameter, Scale
from sim.physics.voltage_residual import VoltageResidual


def transform_velocity(seen: float, scale: float) -> float:
    """[unit/s] velocity that the sensor reports instead of ``seen``."""
    return scale * seen


def ordinary_parameters(_: Scale, size: float) -> Mapping[str, float]:
    """Parameters of a given size; size 1 is a velocity that is 10 % too high."""
    return {"scale": 1.0 + 0.1 * size}


def find_start_values(seen: VoltageResidual) -> Iterator[Mapping[str, float]]:
    """Start values: the velocity over the slope of the position."""
    way = time = 0.0
    for run in seen.log.runs:
        gone = float(np.sum(0.5 * (run.velocity[1:] + run.velocity[:-1]) * np.diff(run.time)))
        moved = float(run.position[-1] - run.position[0])
        way, time = way + gone * moved, time + moved * moved
    if time > 0.0 and way > 0.0:
        yield {"scale": way / time}
    yield {"scale": 1.05}
    yield {"scale": 0.95}


EFFECT = Effect(
    name="velocity-scale",
    kind="sense",
    summary="a velocity whose unit does not fit the position's",
    formula="seen = scale·v",
    parameters=(
        Parameter(
            "scale", "logged velocity / true velocity", "1", least=1e-6, most=1e6, neutral=1.0
        ),
    ),
    fingerprint="The velocity is the slope of the position times a constant, in every run.",
    inspect="Check the conversion factors of position and velocity: gear ratio, wheel size, and "
    "minutes or seconds.",
    apart={
        "asymmetric-back-emf": (
            "Compare the velocity with the slope of the position. Only velocity-scale makes the "
            "two differ by a constant factor."
        ),
    },
    example=ordinary_parameters,
    start_values=find_start_values,
    hooks={"transform_velocity": transform_velocity},
    order=2,
)
