"""The linear-quadratic regulator of x'' = rate·x' + push·u, without NumPy and SciPy.

With two states, there are closed forms for most matrix functions, and importing SciPy takes longer
than a fit.

Sources: C. F. Van Loan, "Computing Integrals Involving the Matrix Exponential" (1978), for the
discrete model; E. K.-W. Chu et al., "A structure-preserving doubling algorithm" (2004), for the
Riccati equation; N. J. Higham, "Functions of Matrices" (2008), section 1.2.2, for the power.
"""

import cmath
import math
from typing import TypeAlias

Matrix: TypeAlias = tuple[float, float, float, float]  # rows one after another
Pair: TypeAlias = tuple[float, float]

SMALL = 0.5  # smaller arguments of exponential functions are summed as a series
TERMS = 20  # terms of the series; the last is below 1e-23
DOUBLINGS = 60  # iterations at most; each doubles the horizon, and 10 are common
SETTLED = 1e-15  # [1] relative change of the solution that ends the iteration
CLOSE = 1e-3  # [1] relative half difference; nearer eigenvalues need another formula


def design_two_state_regulator(
    rate: float, push: float, *, period: float, q: Pair, r: float, loops: float
) -> Pair:
    """Gains on position and velocity of x'' = rate·x' + push·u.

    Args:
        rate: -kV/kA [1/s].
        push: 1/kA [unit/s² per V].
        period: period of the controller's loop [s].
        q: weights of position and velocity.
        r: weight of the voltage.
        loops: delay of the measurement [periods].

    Returns:
        The gains on position [V/unit] and velocity [V·s/unit].
    """
    a, b = _discretize(rate, push, period)
    g = (b[0] * b[0] / r, b[0] * b[1] / r, b[0] * b[1] / r, b[1] * b[1] / r)
    s = solve_riccati(a, g, (q[0], 0.0, 0.0, q[1]))
    weight = r + b[0] * (s[0] * b[0] + s[1] * b[1]) + b[1] * (s[2] * b[0] + s[3] * b[1])
    sb = (s[0] * b[0] + s[2] * b[1], s[1] * b[0] + s[3] * b[1])
    k = (
        (sb[0] * a[0] + sb[1] * a[2]) / weight,
        (sb[0] * a[1] + sb[1] * a[3]) / weight,
    )
    if not loops:
        return k
    closed = (a[0] - b[0] * k[0], a[1] - b[0] * k[1], a[2] - b[1] * k[0], a[3] - b[1] * k[1])
    return _multiply_row_by_power(k, closed, loops)


def _discretize(rate: float, push: float, period: float) -> tuple[Matrix, Pair]:
    """The discrete-time model A, B with a zero-order hold of the voltage."""
    z = rate * period
    if abs(z) < SMALL:
        first = math.fsum(z**n / math.factorial(n + 1) for n in range(TERMS))
        second = math.fsum(z**n / math.factorial(n + 2) for n in range(TERMS))
    else:
        first = math.expm1(z) / z
        second = (first - 1.0) / z
    a = (1.0, period * first, 0.0, math.exp(z))
    return a, (push * period * period * second, push * period * first)


def solve_riccati(a: Matrix, g: Matrix, h: Matrix) -> Matrix:
    """The stabilizing solution S of a discrete-time Riccati equation of two states, by doubling.

    S = AᵀS(I + GS)⁻¹A + H        each iteration looks twice as far ahead

    Args:
        a: A, the state-transition matrix; transposed for a Kalman filter.
        g: G = BR⁻¹Bᵀ of a regulator; the inverse of the noise's covariance for a Kalman filter.
        h: H, the weights of the states; the process noise's covariance for a Kalman filter.
    """
    for _ in range(DOUBLINGS):
        p, q, r, s = _multiply(g, h)
        size = (1.0 + p) * (1.0 + s) - q * r
        inverse = ((1.0 + s) / size, -q / size, -r / size, (1.0 + p) / size)  # of I + GH
        onward = _multiply(inverse, a)
        more = _multiply(_transpose(a), _multiply(h, onward))
        g = _add(g, _multiply(a, _multiply(_multiply(inverse, g), _transpose(a))))
        a = _multiply(a, onward)
        h = _add(h, more)
        if max(map(abs, more)) <= SETTLED * max(map(abs, h)):
            break
    return h


def _multiply_row_by_power(k: Pair, m: Matrix, power: float) -> Pair:
    """The row vector k·Mᵖ; the real part, if the power is complex.

    Mᵖ = λ₁ᵖ I + (λ₁ᵖ - λ₂ᵖ)/(λ₁ - λ₂) · (M - λ₁ I)
    """
    mean = complex(0.5 * (m[0] + m[3]))
    half = cmath.sqrt(0.25 * (m[0] - m[3]) ** 2 + m[1] * m[2])
    one, other = mean + half, mean - half
    if abs(half) < CLOSE * abs(mean):
        h = cmath.atanh(half / mean)
        ratio = cmath.sinh(power * h) / cmath.sinh(h) if h else complex(power)
        spread = cmath.exp(0.5 * (power - 1.0) * cmath.log(1.0 - (half / mean) ** 2))
        quotient = mean ** (power - 1.0) * spread * ratio
    else:
        quotient = (one**power - other**power) / (one - other)
    own = one**power - quotient * one
    return (
        ((own + quotient * m[0]) * k[0] + quotient * m[2] * k[1]).real,
        (quotient * m[1] * k[0] + (own + quotient * m[3]) * k[1]).real,
    )


def _multiply(a: Matrix, b: Matrix) -> Matrix:
    return (
        a[0] * b[0] + a[1] * b[2],
        a[0] * b[1] + a[1] * b[3],
        a[2] * b[0] + a[3] * b[2],
        a[2] * b[1] + a[3] * b[3],
    )


def _add(a: Matrix, b: Matrix) -> Matrix:
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3])


def _transpose(a: Matrix) -> Matrix:
    return (a[0], a[2], a[1], a[3])
