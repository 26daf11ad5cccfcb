"""The steady-state gain of the Kalman filter that predicts each sample from those before it.

A sample is first predicted from the last state and the voltage since then. The innovation is the
measurement minus this prediction, and the state is corrected by K times the innovation. K is the
gain of the stationary Kalman filter for

    d(x, v) = (v, -kV/kA·v + ...)·dt + (0, √q)·dW        measured with noise of known size

With q = 0 nothing is corrected: the simulation is open loop. The larger q, the less the
disturbances of a single run (a slope in the floor, a worn tooth) bias the gains.
"""

import math
from functools import lru_cache

import numpy as np

from sim.core.log import Array
from sim.estimation.measurements import SensorNoise
from sim.feedback.linear_quadratic import Matrix, solve_riccati
from sim.physics.engine import NO_CORRECTION
from sim.physics.model import Model


def compute_kalman_gain(
    model: Model, *, noise: SensorNoise, process_noise: float, period: float
) -> Array:
    """(2, 2) steady-state gain, from innovations to corrections of position and velocity.

    Args:
        model: its kV/kA [1/s] is the rate at which velocity decays.
        noise: standard deviations of the measurements.
        process_noise: [unit²/s³] spectral density of the random acceleration; 0 corrects nothing.
        period: [s] time between samples.
    """
    if process_noise <= 0.0:
        return NO_CORRECTION
    rate = model.gains["kV"] / model.gains["kA"]
    return _compute_gain(rate, noise.position, noise.velocity, process_noise, period)


@lru_cache(maxsize=2)  # a search that does not move kV and kA needs the same gain each time
def _compute_gain(rate: float, position: float, velocity: float, q: float, dt: float) -> Array:
    # both states are divided by the velocity noise, so that the numbers are near one
    decay = math.exp(-rate * dt)
    transition = np.array([[1.0, (1.0 - decay) / rate], [0.0, decay]])
    added = np.array([[dt**3 / 3.0, dt**2 / 2.0], [dt**2 / 2.0, dt]])  # to a double integrator
    variance = np.array([(position / velocity) ** 2, 1.0])
    predicted = _compute_steady_covariance(transition, (q / velocity**2) * added, variance)
    return np.ascontiguousarray(predicted @ np.linalg.inv(predicted + np.diag(variance)))


def _compute_steady_covariance(transition: Array, process_cov: Array, variance: Array) -> Array:
    """(2, 2) steady-state covariance of the prediction: the solution X of the Riccati equation.

    X = A X Aᵀ - A X (X + R)⁻¹ X Aᵀ + Q        the dual of a regulator's
    """
    a, g, h = map(_as_four, (transition.T, np.diag(1.0 / variance), process_cov))
    return np.array(solve_riccati(a, g, h)).reshape(2, 2)


def _as_four(matrix: Array) -> Matrix:
    a, b, c, d = matrix.ravel().tolist()
    return a, b, c, d
