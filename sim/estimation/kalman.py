"""The steady-state gain of the Kalman filter that predicts each sample from those before it.

A sample is first predicted from the last state and the voltage since then. The innovation is the
measurement minus this prediction, and the state is corrected by K times the innovation. K is the
gain of the stationary Kalman filter for

    d(x, v) = (v, -kV/kA·v + ...)·dt + (0, √q)·dW        measured with noise of known size

With q = 0 nothing is corrected: the simulation is open loop. The larger q, the less the
disturbances of a single run (a slope in the floor, a worn tooth) bias the gains.
"""

import math
from collections.abc import Collection
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array
from sim.estimation.measurements import SensorNoise
from sim.feedback.linear_quadratic import Matrix, solve_riccati
from sim.physics.engine import NO_CORRECTION

RELEVANT = 0.01  # [share of an innovation's variance] less, from a voltage, is ignored


@dataclass(frozen=True, eq=False)
class GainSchedule:
    """Time-varying Kalman gain, and the scale of the innovations where a voltage is uncertain.

    Args:
        gains: (n, 4) the (2, 2) gain at each sample, row by row.
        uncertain: (m,) indices of the samples whose gain is not the steady-state one.
        scales: (m, 2, 2) factors that give their innovations the steady-state covariance.
    """

    gains: Array
    uncertain: NDArray[np.intp]
    scales: Array


@dataclass(frozen=True, eq=False)
class KalmanFilter:
    """A steady-state Kalman filter, and the covariances for samples with an uncertain voltage.

    Args:
        steady: (2, 2) gain, from innovations to corrections of position and velocity.
        predicted_cov: (2, 2) covariance of the predicted position and velocity.
        measured_var: (2,) variances of a measured position and velocity.
        transition: (2, 2) state-transition matrix over one period.
        process_cov: (2, 2) covariance that process noise adds in a period, that of a double
            integrator.
        voltage_cov: (2, 2) covariance of position and velocity after one period whose mean voltage
            has a variance of one volt squared.

    All covariances are divided by the variance of a measured velocity.
    """

    steady: Array
    predicted_cov: Array
    measured_var: Array
    transition: Array
    process_cov: Array
    voltage_cov: Array

    def schedule(self, voltage_error: Array, starts: Collection[int] = ()) -> GainSchedule:
        """The gain at each sample, larger after an uncertain voltage.

        An uncertain voltage widens the predicted covariance. The next measurements reduce it, until
        the filter is in its steady state again or another run begins.

        Args:
            voltage_error: (n,) [V] standard deviation of the mean voltage since the sample before.
            starts: indices of the samples at which a run begins.
        """
        uncertain, (xx, xv, vv) = self._follow_covariance(voltage_error, frozenset(starts))
        noise_x, noise_v = self.measured_var
        innovation_x, innovation_v, determinant = xx + noise_x, vv + noise_v, xx * vv - xv * xv
        size = innovation_x * innovation_v - xv * xv
        gain = np.array(
            [
                determinant + xx * noise_v, xv * noise_x,
                xv * noise_v, determinant + vv * noise_x,
            ]
        )  # fmt: skip
        gains = np.tile(self.steady.ravel(), (voltage_error.size, 1))
        gains[uncertain] = (gain / size).T
        whitening = np.zeros((uncertain.size, 2, 2))  # the inverse of the Cholesky factor
        whitening[:, 0, 0] = 1.0 / np.sqrt(innovation_x)
        whitening[:, 1, 1] = np.sqrt(innovation_x / size)
        whitening[:, 1, 0] = -xv / np.sqrt(innovation_x * size)
        steady_root = np.linalg.cholesky(self.predicted_cov + np.diag(self.measured_var))
        return GainSchedule(gains, uncertain, steady_root @ whitening)

    def _follow_covariance(
        self, voltage_error: Array, starts: frozenset[int]
    ) -> tuple[NDArray[np.intp], Array]:
        """Samples at which the predicted covariance is not the steady one, and its values (3, m).

        Written with plain floats: a search does this for thousands of samples, again and again.
        """
        steady_x, steady, _, steady_v = _flatten_matrix(self.predicted_cov)
        process_x, process, _, process_v = _flatten_matrix(self.process_cov)
        volt_x, volt, _, volt_v = _flatten_matrix(self.voltage_cov)
        _, reach, _, decay = _flatten_matrix(self.transition)
        noise_x, noise_v = self.measured_var.tolist()
        near_x, near_v = (1.0 + RELEVANT) * steady_x, (1.0 + RELEVANT) * steady_v
        variances = np.square(voltage_error).tolist()
        places: list[int] = []
        covs: list[tuple[float, float, float]] = []
        usual = np.diag(self.predicted_cov) + self.measured_var
        changes = voltage_error**2 * np.max(np.diag(self.voltage_cov) / usual) > RELEVANT
        for first in np.flatnonzero(changes).tolist():
            if places and first <= places[-1]:
                continue
            xx, xv, vv = steady_x, steady, steady_v
            for now in range(first, len(variances)):
                volts = variances[now]
                xx, xv, vv = xx + volt_x * volts, xv + volt * volts, vv + volt_v * volts
                if now > first and (now in starts or (xx <= near_x and vv <= near_v)):
                    break
                places.append(now)
                covs.append((xx, xv, vv))
                determinant = xx * vv - xv * xv
                size = (xx + noise_x) * (vv + noise_v) - xv * xv
                after_x = noise_x * (determinant + xx * noise_v) / size  # after the correction
                after_v = noise_v * (determinant + vv * noise_x) / size
                after = noise_x * noise_v * xv / size
                xx = after_x + reach * (2.0 * after + reach * after_v) + process_x
                xv = decay * (after + reach * after_v) + process
                vv = decay * decay * after_v + process_v
        return np.array(places, dtype=np.intp), np.array(covs).reshape(-1, 3).T


OPEN_LOOP = KalmanFilter(
    NO_CORRECTION, np.zeros((2, 2)), np.ones(2), np.eye(2), np.zeros((2, 2)), np.zeros((2, 2))
)
"""A filter that corrects nothing: its predictions are a simulation."""


@lru_cache(maxsize=2)  # a search that does not move kV and kA needs the same filter each time
def make_steady_state_filter(
    kv: float, ka: float, *, noise: SensorNoise, process_noise: float, period: float
) -> KalmanFilter:
    """The Kalman filter of position and velocity in its steady state.

    Args:
        kv: [V·s/unit].
        ka: [V·s²/unit]; kV/kA is the rate at which velocity decays.
        noise: standard deviations of the measurements.
        process_noise: [unit²/s³] spectral density of the random acceleration; 0 corrects nothing.
        period: [s] time between samples.
    """
    rate, dt = kv / ka, period
    # both states are divided by the velocity noise, so that the numbers are near one
    decay = math.exp(-rate * dt)
    transition = np.array([[1.0, (1.0 - decay) / rate], [0.0, decay]])
    process_cov = (process_noise / noise.velocity**2) * np.array(
        [[dt**3 / 3.0, dt**2 / 2.0], [dt**2 / 2.0, dt]]
    )
    variance = np.array([(noise.position / noise.velocity) ** 2, 1.0])
    voltage_cov = _compute_voltage_covariance(rate, dt) / (kv * noise.velocity) ** 2
    if process_noise <= 0.0:
        return replace(
            OPEN_LOOP, measured_var=variance, transition=transition, voltage_cov=voltage_cov
        )
    # the covariance of the prediction solves X = A X Aᵀ - A X (X + R)⁻¹ X Aᵀ + Q, the Riccati
    # equation that is the dual of a regulator's
    a, g, h = map(_flatten_matrix, (transition.T, np.diag(1.0 / variance), process_cov))
    predicted = np.array(solve_riccati(a, g, h)).reshape(2, 2)
    steady = np.ascontiguousarray(predicted @ np.linalg.inv(predicted + np.diag(variance)))
    return KalmanFilter(steady, predicted, variance, transition, process_cov, voltage_cov)


def _compute_voltage_covariance(rate: float, period: float) -> Array:
    """(2, 2) covariance that a voltage variance of 1 V² adds to the state in a period, times kV².

    When within the period the voltage was off is unknown, so the voltages of its first and second
    half are independent, and their mean has a variance of one volt squared.
    """
    half = 0.5 * period
    decay = math.exp(-rate * half)
    late = np.array([half - (1.0 - decay) / rate, 1.0 - decay])
    early = np.array([late[0] + late[1] * (1.0 - decay) / rate, late[1] * decay])
    return np.asarray(2.0 * (np.outer(early, early) + np.outer(late, late)))


def _flatten_matrix(matrix: Array) -> Matrix:
    a, b, c, d = matrix.ravel().tolist()
    return a, b, c, d
