"""The Kalman filter: its steady state, and its gains where a voltage is known less well."""

import math

import numpy as np
import pytest

from sim.estimation.kalman import make_steady_state_filter
from sim.estimation.measurements import SensorNoise
from sim.physics.model import Model

MODEL = Model("simple", {"kS": 0.2, "kV": 2.5, "kA": 0.2})
NOISE = SensorNoise(position=1e-5, velocity=0.0075, resolution=(1e-6, 1e-6))
PERIOD = 0.02


def filtered(process_noise):
    return make_steady_state_filter(MODEL, noise=NOISE, process_noise=process_noise, period=PERIOD)


def by_riccati(process_noise, voltage_error, *, before=3000):
    """The gain at each sample, by the recursion of the textbook, from a state that is known."""
    rate = MODEL.gains["kV"] / MODEL.gains["kA"]
    kept = math.exp(-rate * PERIOD)
    step = np.array([[1.0, (1.0 - kept) / rate], [0.0, kept]])
    push = process_noise * np.array([[PERIOD**3 / 3, PERIOD**2 / 2], [PERIOD**2 / 2, PERIOD]])
    half = math.exp(-rate * PERIOD / 2)
    late = np.array([PERIOD / 2 - (1.0 - half) / rate, 1.0 - half]) / MODEL.gains["kV"]
    early = np.array([[1.0, (1.0 - half) / rate], [0.0, half]]) @ late
    volt = 2.0 * (np.outer(early, early) + np.outer(late, late))  # of two halves, each off alone
    rough = np.diag([NOISE.position**2, NOISE.velocity**2])
    cov, gains = np.zeros((2, 2)), []
    for error in (*np.zeros(before), *voltage_error):
        cov = step @ cov @ step.T + push + volt * error**2
        gain = cov @ np.linalg.inv(cov + rough)
        cov = cov - gain @ cov
        gains.append(gain.ravel())
    return np.array(gains[before:])


@pytest.mark.parametrize("process_noise", [1e-6, 1e-3])
def test_the_steady_gain_is_where_the_recursion_ends(process_noise):
    (gain,) = by_riccati(process_noise, [0.0])

    assert filtered(process_noise).steady.ravel() == pytest.approx(gain, rel=1e-3)


@pytest.mark.parametrize("process_noise", [1e-6, 1e-3])
def test_gains_after_an_uncertain_voltage_are_those_of_the_recursion(process_noise):
    error = np.zeros(60)
    error[5], error[6], error[20] = 0.1, 0.05, 0.3

    schedule = filtered(process_noise).schedule(error)

    expected = by_riccati(process_noise, error)
    assert schedule.gains == pytest.approx(expected, abs=0.02 * np.abs(expected).max())
    assert schedule.gains[5:8] == pytest.approx(expected[5:8], rel=0.02)
    assert {5, 6, 20} <= set(schedule.uncertain.tolist())


def test_innovations_of_uncertain_samples_are_scaled_to_the_usual_covariance():
    error = np.zeros(10)
    error[4] = 0.2
    one = filtered(1e-4)

    schedule = one.schedule(error)

    usual = one.predicted_cov + np.diag(one.measured_var)
    seen = usual + one.voltage_cov * 0.2**2
    scale = schedule.scales[schedule.uncertain.tolist().index(4)]
    assert scale @ seen @ scale.T == pytest.approx(usual, rel=1e-9)
