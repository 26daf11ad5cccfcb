"""What a sensor makes of a motion: noise, steps, filter, delay, frames."""

from dataclasses import replace

import numpy as np
import pytest

from sim.bench.mechanism import Sensor
from sim.bench.sensor_model import read_sensor

QUIET = Sensor(resolution=1e-12, velocity_noise=0.0, noise_speed=1.0, jitter=0.0)


def rng():
    return np.random.default_rng(7)


def test_a_sensor_is_quiet_at_rest_and_coarse():
    sensor = Sensor(resolution=0.25, velocity_noise=0.1, noise_speed=0.05, jitter=0.0)
    velocity = np.concatenate((np.zeros(500), np.ones(500)))

    position, seen = read_sensor(
        sensor, position=np.linspace(0, 1, 1000), velocity=velocity, rng=rng()
    )

    assert not seen[:500].any()
    assert np.std(seen[500:]) == pytest.approx(0.1, rel=0.1)
    assert set(position) == {0.0, 0.25, 0.5, 0.75, 1.0}


def sensed(**change):
    sensor = replace(QUIET, **change)
    time = np.arange(0.0, 1.0, 0.02)
    speed = np.sin(6.0 * time)
    way = (1.0 - np.cos(6.0 * time)) / 6.0
    return time, speed, read_sensor(sensor, position=way, velocity=speed, time=time, rng=rng())


def test_a_filter_in_the_sensor_says_the_mean_of_a_while():
    time, _, seen = sensed(filter=0.1)
    mean = (np.cos(6.0 * (time - 0.1)) - np.cos(6.0 * time)) / 0.6

    assert seen.velocity[5:] == pytest.approx(mean[5:], abs=2e-3)


def test_reading_and_its_noise_stay_the_same_until_the_next_frame():
    _, _, seen = sensed(frame=0.1, velocity_noise=0.1)

    steps = np.count_nonzero(np.diff(seen.velocity))
    assert 8 <= steps <= 11
    assert np.count_nonzero(np.diff(seen.position)) <= steps
