"""Velocity scale: the velocity is the slope of the position times a constant.

    seen = scale·v

Causes are a forgotten gear ratio, rotations per minute instead of per second, and a wheel diameter
that is wrong in one place.
"""

from collections.abc import Iterator, Mapping

from sim.core.log import integrate_velocity
from sim.physics.effect import Effect, Parameter, Scale
from sim.physics.voltage_residual import VoltageResidual


def transform_velocity(seen: float, scale: float) -> float:
    """[unit/s] velocity that the sensor reports instead of ``seen``."""
    return scale * seen


def ordinary_parameters(_: Scale, size: float) -> Mapping[str, float]:
    """Parameters of a given size; size 1 is a velocity that is 10 % too high."""
    return {"scale": 1.0 + 0.1 * size}


def find_start_values(residual: VoltageResidual) -> Iterator[Mapping[str, float]]:
    """Start values: regression of the integrated velocity on the change of position, and ± 5 %."""
    product = square = 0.0
    for run in residual.log.runs:
        integral = float(integrate_velocity(run.time, run.velocity)[-1])
        moved = float(run.position[-1] - run.position[0])
        product, square = product + integral * moved, square + moved * moved
    if square > 0.0 and product > 0.0:
        yield {"scale": product / square}
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
