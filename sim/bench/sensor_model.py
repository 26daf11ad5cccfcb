"""The sensor model: filter, latency, frames, resolution and noise."""

from typing import NamedTuple

import numpy as np

from sim.bench.mechanism import Sensor
from sim.core.log import Array, integrate_velocity


class SensorReading(NamedTuple):
    """Position and velocity as the robot program reads them.

    Args:
        position: (n,) [m or rad] rounded to the resolution.
        velocity: (n,) [m/s or rad/s] with noise.
    """

    position: Array
    velocity: Array


def read_sensor(
    sensor: Sensor,
    *,
    position: Array,
    velocity: Array,
    rng: np.random.Generator,
    time: Array | None = None,
    read_at: Array | None = None,
) -> SensorReading:
    """Position and velocity that a sensor reports for a motion.

    Args:
        sensor: the sensor.
        position: (n,) [m or rad] true position.
        velocity: (n,) [m/s or rad/s] true velocity.
        rng: random generator of the noise.
        time: (n,) [s]; needed for a sensor with latency, filter or frames.
        read_at: (m,) [s] times at which the robot program reads such a sensor; by default ``time``.

    Returns:
        (m,) readings, or (n,) without ``read_at``.
    """
    read_at = time if read_at is None else read_at
    noise = rng.standard_normal(velocity.size if read_at is None else read_at.size)
    if time is not None and read_at is not None and has_sensor_lag(sensor):
        at = read_at - sensor.latency
        if sensor.frame:
            phase = sensor.frame * rng.random()
            frame = np.floor((at - phase) / sensor.frame)
            at = frame * sensor.frame + phase
            first = np.searchsorted(frame, frame)  # all readings of a frame have the same noise
            noise = noise[first]
        way = integrate_velocity(time, velocity)
        if sensor.filter:
            velocity = (
                interpolate_cubic(at, time, way, velocity)
                - interpolate_cubic(at - sensor.filter, time, way, velocity)
            ) / sensor.filter
        else:
            velocity = np.interp(at, time, velocity)
        position = interpolate_cubic(at, time, position, np.gradient(position, time))
    spread = sensor.velocity_noise * -np.expm1(-np.abs(velocity) / sensor.noise_speed)
    return SensorReading(
        np.round(position / sensor.resolution) * sensor.resolution, velocity + spread * noise
    )


def has_sensor_lag(sensor: Sensor) -> bool:
    """Whether a sensor has latency, a filter or frames, so that its readings are late."""
    return bool(sensor.latency or sensor.filter or sensor.frame)


def interpolate_cubic(at: Array, time: Array, value: Array, slope: Array) -> Array:
    """(m,) cubic Hermite interpolation of a curve with known slopes.

    Before the first and after the last value it is constant; a test begins at rest.

    Args:
        at: (m,) [s] times of the result.
        time: (n,) [s] times of the values.
        value: (n,) values.
        slope: (n,) [per s] slopes.
    """
    k = np.clip(np.searchsorted(time, at, side="right") - 1, 0, time.size - 2)
    span = time[k + 1] - time[k]
    part = np.clip((at - time[k]) / span, 0.0, 1.0)
    rest = 1.0 - part
    return np.asarray(
        rest**2 * ((1.0 + 2.0 * part) * value[k] + part * span * slope[k])
        + part**2 * ((1.0 + 2.0 * rest) * value[k + 1] - rest * span * slope[k + 1])
    )
