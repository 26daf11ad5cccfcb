"""The noise of a log, measured without a model."""

import numpy as np
import pytest

from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.log import Log, Run
from sim.estimation.measurements import (
    bend_voltage,
    compute_noise_at_speed,
    compute_third_differences,
    estimate_noise,
    measure_runs,
)

NOISE = 1e-3  # [m]


def even(count=400, period=0.02):
    return np.arange(count) * period


def uneven(count=400, period=0.02, *, seed=1):
    rng = np.random.default_rng(seed)
    return even(count, period) + rng.uniform(-0.2, 0.2, count) * period


def test_with_even_times_they_are_the_ordinary_third_differences():
    values = np.random.default_rng(0).standard_normal(50)

    assert compute_third_differences(even(50), values) == pytest.approx(np.diff(values, 3))


def test_nothing_is_left_of_a_parabola_however_uneven_its_times():
    time = uneven()

    left = compute_third_differences(time, 3.0 - 2.0 * time + 5.0 * time**2)

    assert np.abs(left).max() < 1e-10


def test_noise_that_grows_with_the_speed_counts_at_the_speeds_of_the_log():
    # a velocity from the time between two edges of an encoder is off by a share of the speed
    time = even(4000, 0.005)
    share = 0.05 * np.random.default_rng(4).standard_normal(time.size)
    velocity = 0.6 * time * (1.0 + share)
    run = Run("dynamic-forward", time, np.full(time.size, 4.0), 0.3 * time**2, velocity)
    seen = measure_runs(Log((run,), units="meters", type="simple"), friction=None)
    noise = estimate_noise(seen)

    found = compute_noise_at_speed(seen, noise)

    assert found == pytest.approx(float(np.std(0.6 * time * share)), rel=0.1)
    assert found > 1.1 * noise.velocity


@pytest.mark.parametrize("name", sorted(MECHANISMS))
def test_the_noise_of_a_position_is_that_of_its_sensor(name):
    # the smallest change from one sample to the next says how slow it was, not how coarse it is
    mechanism = MECHANISMS[name]
    log = simulate(mechanism, Routine(step=3.5), rng=np.random.default_rng(1))

    noise = estimate_noise(measure_runs(log, friction=None))

    rounding = mechanism.sensor.resolution / 12**0.5
    assert 0.8 * rounding < noise.position < 1.5 * rounding
    assert noise.velocity == pytest.approx(mechanism.sensor.velocity_noise, rel=0.15)


def test_a_count_that_single_precision_reads_as_two_numbers_is_one_count():
    time, step = even(2000, 0.005), 2e-3  # [m/s], longer on one count than on the way to the next
    counts = np.round(0.05 * time / step)
    rounded = (counts * step) * (1.0 + 1e-7 * np.random.default_rng(5).choice([-1, 1], time.size))
    run = Run("quasistatic-forward", time, np.full(time.size, 4.0), 0.025 * time**2, rounded)

    found = estimate_noise(measure_runs(Log((run,)), friction=None))

    assert found.velocity == pytest.approx(step / np.sqrt(12.0), rel=0.01)


def test_bent_voltage_has_the_mean_of_the_smooth_voltage_between_its_samples():
    def volts(time):
        return 3.0 + 40.0 * time - 150.0 * time**2

    time, period = even(12), 0.02
    slides = np.append(np.diff(volts(time)), 0.0)
    true = [np.mean(volts(one + np.linspace(0.0, period, 2001))) for one in time[:-1]]
    straight = volts(time) + 0.5 * slides
    bent = straight + bend_voltage(slides)
    assert bent[1:-2] == pytest.approx(true[1:-1], abs=1e-4)  # their mean is over 2001 points


def test_voltage_beside_one_that_is_held_is_not_bent():
    assert not bend_voltage(np.array([0.0, 1.2, 0.6, 0.0, 0.0])).any()
