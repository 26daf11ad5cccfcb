"""Velocity filter: the sensor reports the mean velocity over a window of time.

    seen(t) = (x(t) - x(t - window))/window

Motor controllers average: by default, the velocity of a NEO's built-in encoder lags by 112 ms. The
lag is half of the window. The position is not filtered, so a comparison of the two shows it.
"""

from collections.abc import Iterator, Mapping

from sim.core.log import Array
from sim.physics.effect import Effect, Parameter, Scale
from sim.physics.velocity_lag import estimate_velocity_lag
from sim.physics.voltage_residual import VoltageResidual


def transform_velocity(
    seen: float, now: int, time: Array, position: Array, velocity: Array, window: float
) -> float:
    """[unit/s] velocity that the sensor reports instead of ``seen``."""
    began = time[now] - window
    if now == 0 or window <= 0.0:
        return seen
    if began <= time[0]:  # before the run, the velocity was that of its first sample
        back = position[0] + velocity[0] * (began - time[0])
        return float((position[now] - back) / window)
    k = now
    while time[k] > began:
        k -= 1
    span = time[k + 1] - time[k]
    part = (began - time[k]) / span
    rest = 1.0 - part
    # between two samples: the cubic with both positions and both velocities
    back = rest * rest * (
        (1.0 + 2.0 * part) * position[k] + part * span * velocity[k]
    ) + part * part * ((1.0 + 2.0 * rest) * position[k + 1] - rest * span * velocity[k + 1])
    return float((position[now] - back) / window)


def ordinary_parameters(_: Scale, size: float) -> Mapping[str, float]:
    """Parameters of a given size; size 1 is a lag of 40 ms."""
    return {"window": 0.08 * size}


def find_start_values(residual: VoltageResidual) -> Iterator[Mapping[str, float]]:
    """Start values: twice the lag of the velocity behind the position, and three more."""
    found = estimate_velocity_lag(residual.log.runs)
    if found is not None and found.lag > 0.0:
        yield {"window": 2.0 * found.lag}
    for window in (0.03, 0.08, 0.2):
        yield {"window": window}


EFFECT = Effect(
    name="velocity-filter",
    kind="sense",
    summary="a velocity that is averaged over some time, and is therefore late",
    formula="seen(t) = (x(t) - x(t - window))/window",
    # Any velocity is a difference of positions over some time. In 288 logs, hidden filters average
    # over 20 ms and more; those that are found where none is hidden average over 1 ms.
    parameters=(Parameter("window", "time over which it averages", "s", most=1.0, everyday=0.005),),
    fingerprint="The velocity follows the slope of the position with a delay; steps look rounded.",
    inspect="Check the velocity filter and the measurement period of the motor controller's "
    "encoder.",
    example=ordinary_parameters,
    start_values=find_start_values,
    inertia_shares=(0.3, 0.1),
    hooks={"transform_velocity": transform_velocity},
    order=1,
)
