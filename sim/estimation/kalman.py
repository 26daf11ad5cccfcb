"""The steady-state gain of the Kalman filter that predicts each sample from those before it.

A sample is first predicted, from the last state and the voltage since; the difference to what was
measured is the innovation; then the state is corrected by the gain K times it. K is that of

    d(x, v) = (v, -kV/kA·v + ...)·dt + (0, √q)·dW        measured with noise of known size

With q = 0 nothing is corrected, and the simulation is open loop; the larger q, the less one run's
small unknowns (a slope in the floor, a worn tooth) are charged to the gains.
"""

import math

import numpy as np

from sim.core.log import Array
from sim.estimation.measurements import SensorNoise
from sim.physics.engine import NO_CORRECTION
from sim.physics.model import Model

DOUBLINGS = 40  # rounds; 2⁴⁰ samples are for ever


def steady_state_gain(
    model: Model, *, noise: SensorNoise, process_noise: float, period: float
) -> Array:
    """(2, 2) steady-state Kalman gain for position and velocity.

    Args:
        model: whose kV/kA is the rate at which velocity forgets.
        noise: of the measurements.
        process_noise: [unit²/s³] size of what pushes the velocity at random; 0 corrects nothing.
        period: [s] between samples.
    """
    if process_noise <= 0.0:
        return NO_CORRECTION
    rate, dt = model.gains["kV"] / model.gains["kA"], period
    # velocities in units of their noise and positions in as many: so the numbers are near one
    kept = math.exp(-rate * dt)
    step = np.array([[1.0, (1.0 - kept) / rate], [0.0, kept]])
    push = (process_noise / noise.velocity**2) * np.array(
        [[dt**3 / 3.0, dt**2 / 2.0], [dt**2 / 2.0, dt]]
    )
    rough = np.array([(noise.position / noise.velocity) ** 2, 1.0])
    spread = _steady_covariance(step, push, rough)
    return np.ascontiguousarray(spread @ np.linalg.inv(spread + np.diag(rough)))


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


# Two by two in plain numbers: of so little, NumPy makes ten times as much work.
_Four = tuple[float, float, float, float]


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
