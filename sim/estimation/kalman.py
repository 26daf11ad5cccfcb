"""The steady-state gain of the Kalman filter that predicts each sample from those before it.

A sample is first predicted, from the last state and the voltage since; the difference to what was
measured is the innovation; then the state is corrected by the gain K times it. K is that of

    d(x, v) = (v, -kV/kA·v + ...)·dt + (0, √q)·dW        measured with noise of known size

With q = 0 nothing is corrected, and the simulation is open loop. The larger q, the less the
disturbances of a single run (a slope in the floor, a worn tooth) bias the gains.
"""

import math
from collections.abc import Collection
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array
from sim.estimation.measurements import SensorNoise
from sim.physics.engine import NO_CORRECTION
from sim.physics.model import Model

DOUBLINGS = 40  # rounds; 2⁴⁰ samples are for ever
MATTERS = 0.01  # [1] of an innovation's variance that an uncertain voltage adds, to be counted

_Four: TypeAlias = tuple[float, float, float, float]


@dataclass(frozen=True, eq=False)
class GainSchedule:
    """Kalman gain and innovation scale at each sample of some runs.

    Args:
        gains: (n, 4) the gain at each sample, row by row.
        uncertain: (m,) samples at which a voltage known less well still tells.
        scales: (m, 2, 2) what gives their innovations the usual covariance.
    """

    gains: Array
    uncertain: NDArray[np.intp]
    scales: Array


@dataclass(frozen=True, eq=False)
class KalmanFilter:
    """A steady-state Kalman filter, and what it needs where a voltage is uncertain.

    Args:
        steady: (2, 2) gain, from innovations to corrections of position and velocity.
        predicted: (2, 2) covariance of the predicted position and velocity.
        measured: (2,) variances of a measured position and velocity.
        step: (2, 2) from one state to the next.
        push: (2, 2) covariance that process noise adds in a period, that of a double integrator.
        disturbed: (2, 2) covariance of position and velocity after one period whose mean voltage
            has a variance of one volt squared.

    All covariances are divided by the variance of a measured velocity.
    """

    steady: Array
    predicted: Array
    measured: Array
    step: Array
    push: Array
    disturbed: Array

    def schedule(self, voltage_error: Array, starts: Collection[int] = ()) -> GainSchedule:
        """Gains and scales of samples before which the voltage is uncertain.

        What an uncertain voltage did to the state is seen in the next measurements, and corrected
        there, until the filter is in its steady state again or another run begins.

        Args:
            voltage_error: (n,) [V] standard deviation of the mean voltage since the sample before.
            starts: samples at which a run begins.
        """
        uncertain, (xx, xv, vv) = self._follow_covariance(voltage_error, frozenset(starts))
        noise_x, noise_v = self.measured
        seen_x, seen_v, free = xx + noise_x, vv + noise_v, xx * vv - xv * xv
        size = seen_x * seen_v - xv * xv
        gain = np.array([free + xx * noise_v, xv * noise_x, xv * noise_v, free + vv * noise_x])
        gains = np.tile(self.steady.ravel(), (voltage_error.size, 1))
        gains[uncertain] = (gain / size).T
        whitening = np.zeros((uncertain.size, 2, 2))  # the inverse of the Cholesky factor
        whitening[:, 0, 0], whitening[:, 1, 1] = 1.0 / np.sqrt(seen_x), np.sqrt(seen_x / size)
        whitening[:, 1, 0] = -xv / np.sqrt(seen_x * size)
        usual = np.linalg.cholesky(self.predicted + np.diag(self.measured))
        return GainSchedule(gains, uncertain, usual @ whitening)

    def _follow_covariance(
        self, voltage_error: Array, starts: frozenset[int]
    ) -> tuple[NDArray[np.intp], Array]:
        """Samples at which the predicted covariance is not the steady one, and what it is (3, m).

        In plain numbers, because a search follows thousands of samples each time.
        """
        usual_x, usual, _, usual_v = _as_four(self.predicted)
        push_x, push, _, push_v = _as_four(self.push)
        volt_x, volt, _, volt_v = _as_four(self.disturbed)
        _, reach, _, kept = _as_four(self.step)
        noise_x, noise_v = self.measured.tolist()
        near_x, near_v = (1.0 + MATTERS) * usual_x, (1.0 + MATTERS) * usual_v
        variances = np.square(voltage_error).tolist()
        places: list[int] = []
        covs: list[tuple[float, float, float]] = []
        for first in np.flatnonzero(self._matters(voltage_error)).tolist():
            if places and first <= places[-1]:
                continue
            xx, xv, vv = usual_x, usual, usual_v
            for now in range(first, len(variances)):
                volts = variances[now]
                xx, xv, vv = xx + volt_x * volts, xv + volt * volts, vv + volt_v * volts
                if now > first and (now in starts or (xx <= near_x and vv <= near_v)):
                    break
                places.append(now)
                covs.append((xx, xv, vv))
                free = xx * vv - xv * xv
                size = (xx + noise_x) * (vv + noise_v) - xv * xv
                left_x = noise_x * (free + xx * noise_v) / size  # once it is corrected
                left_v = noise_v * (free + vv * noise_x) / size
                left = noise_x * noise_v * xv / size
                xx = left_x + reach * (2.0 * left + reach * left_v) + push_x
                xv = kept * (left + reach * left_v) + push
                vv = kept * kept * left_v + push_v
        return np.array(places, dtype=np.intp), np.array(covs).reshape(-1, 3).T

    def _matters(self, voltage_error: Array) -> NDArray[np.bool_]:
        """(n,) samples before which the voltage is uncertain enough to matter."""
        ordinary = np.diag(self.predicted) + self.measured
        return np.asarray(voltage_error**2 * np.max(np.diag(self.disturbed) / ordinary) > MATTERS)


OPEN_LOOP = KalmanFilter(
    NO_CORRECTION, np.zeros((2, 2)), np.ones(2), np.eye(2), np.zeros((2, 2)), np.zeros((2, 2))
)
"""A filter that corrects nothing: its predictions are a simulation."""


def make_steady_state_filter(
    model: Model, *, noise: SensorNoise, process_noise: float, period: float
) -> KalmanFilter:
    """The Kalman filter of position and velocity in its steady state.

    Args:
        model: whose kV/kA is the rate at which velocity forgets.
        noise: of the measurements.
        process_noise: [unit²/s³] size of what pushes the velocity at random; 0 corrects nothing.
        period: [s] between samples.
    """
    gains = model.gains
    return _steady_state_filter(gains["kV"], gains["kA"], noise, process_noise, period)


@lru_cache(maxsize=2)  # a search for other parameters than kV and kA needs the same one each time
def _steady_state_filter(
    kv: float, ka: float, noise: SensorNoise, process_noise: float, period: float
) -> KalmanFilter:
    rate, dt = kv / ka, period
    # velocities in units of their noise and positions in as many: so the numbers are near one
    kept = math.exp(-rate * dt)
    step = np.array([[1.0, (1.0 - kept) / rate], [0.0, kept]])
    push = (process_noise / noise.velocity**2) * np.array(
        [[dt**3 / 3.0, dt**2 / 2.0], [dt**2 / 2.0, dt]]
    )
    rough = np.array([(noise.position / noise.velocity) ** 2, 1.0])
    disturbed = _voltage_covariance(rate, dt) / (kv * noise.velocity) ** 2
    if process_noise <= 0.0:
        return replace(OPEN_LOOP, measured=rough, step=step, disturbed=disturbed)
    spread = _steady_covariance(step, push, rough)
    steady = np.ascontiguousarray(spread @ np.linalg.inv(spread + np.diag(rough)))
    return KalmanFilter(steady, spread, rough, step, push, disturbed)


def _voltage_covariance(rate: float, period: float) -> Array:
    """(2, 2) covariance of what an uncertain voltage does in a period, times kV².

    Nobody knows when within the period the voltage was off, so its first and its second half are
    off independently. Together their mean has a variance of one volt squared.
    """
    half = 0.5 * period
    kept = math.exp(-rate * half)
    late = np.array([half - (1.0 - kept) / rate, 1.0 - kept])
    early = np.array([late[0] + late[1] * (1.0 - kept) / rate, late[1] * kept])
    return np.asarray(2.0 * (np.outer(early, early) + np.outer(late, late)))


def _steady_covariance(step: Array, push: Array, rough: Array) -> Array:
    """(2, 2) spread of what is expected, in the long run, by doubling.

    X = A X Aᵀ - A X (X + R)⁻¹ X Aᵀ + Q        each round looks twice as far ahead

    Source: the structure-preserving doubling of Chu, Fan and Lin (2005).
    """
    a, g, x = _as_four(step.T), _as_four(np.diag(1.0 / rough)), _as_four(push)
    for _ in range(DOUBLINGS):
        p, q, r, s = _multiply(g, x)
        size = (1.0 + p) * (1.0 + s) - q * r
        middle = ((1.0 + s) / size, -q / size, -r / size, (1.0 + p) / size)
        onward = _multiply(middle, a)
        more = _multiply(_transpose(a), _multiply(x, onward))
        after = _add(x, more)
        g = _add(g, _multiply(a, _multiply(_multiply(middle, g), _transpose(a))))
        a = _multiply(a, onward)
        done = max(map(abs, more)) <= 1e-9 * max(map(abs, after))
        x = after
        if done:
            break
    return np.array(x).reshape(2, 2)


# Two by two in plain numbers (``_Four``): of so little, NumPy makes ten times as much work.


def _as_four(matrix: Array) -> _Four:
    a, b, c, d = matrix.ravel().tolist()
    return a, b, c, d


def _multiply(a: _Four, b: _Four) -> _Four:
    return (
        a[0] * b[0] + a[1] * b[2], a[0] * b[1] + a[1] * b[3],
        a[2] * b[0] + a[3] * b[2], a[2] * b[1] + a[3] * b[3],
    )  # fmt: skip


def _add(a: _Four, b: _Four) -> _Four:
    return a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]


def _transpose(a: _Four) -> _Four:
    return a[0], a[2], a[1], a[3]
