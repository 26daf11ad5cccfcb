"""SysId's regression: ordinary least squares of the acceleration, converted into gains.

    a = α·v + β·V + γ·sgn(v) [+ δ | + δ·cos θ + ε·sin θ]

    kS = -γ/β    kV = -α/β    kA = 1/β    kG = -δ/β  or  hypot(δ, ε)/β    offset = atan2(ε, -δ)

The acceleration is the dependent variable because it is the noisiest column. Source: WPILib SysId
2026.2.2, ``analysis/FeedforwardAnalysis.cpp`` and ``analysis/OLS.cpp``.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from sim.core.errors import NotIdentifiable
from sim.core.log import FOUR_TESTS, Array
from sim.fit.sysid_rows import Rows

LEAST_EIGENVALUE = 1e-11  # [1] of the scaled normal equations; a smaller one is rounding


@dataclass(frozen=True, eq=False)
class Regression:
    """Gains with their standard errors, and goodness of fit of the acceleration.

    Args:
        gains: gain -> value [V, V·s/m, V·s²/m; angles in rad].
        errors: gain -> one standard error, from noise in the acceleration alone.
        r2: SysId's adjusted R² of the acceleration.
        rmse: [m/s² or rad/s²] of the acceleration.
    """

    gains: Mapping[str, float]
    errors: Mapping[str, float]
    r2: float
    rmse: float


def regress_acceleration(rows: Mapping[str, Rows], *, type: str) -> Regression:  # noqa: A002 - SysId's word
    """Fit the gains of one type of mechanism.

    Args:
        rows: test name -> rows of that test.
        type: ``simple``, ``elevator`` or ``arm``.

    Raises:
        NotIdentifiable: the rows cannot tell the gains apart.
    """
    stacked = [rows[test] for test in FOUR_TESTS]
    columns = np.concatenate([_list_regressors(part, type=type) for part in stacked], axis=1)
    acceleration = np.concatenate([part.acceleration for part in stacked])
    beta, inverse = _solve_least_squares(columns, acceleration)
    if not beta[1]:
        raise NotIdentifiable(
            "the voltage has no effect on the motion", advice="Check what the log calls voltage."
        )
    n, p = acceleration.size, beta.size
    if n <= p + 1:
        raise NotIdentifiable(
            f"{n} samples are left for {p} unknowns",
            advice="Let each test run longer, or log faster.",
        )
    residual = acceleration - beta @ columns
    sse = float(residual @ residual)
    spread = acceleration - acceleration.mean()
    r2 = 1.0 - sse / float(spread @ spread)
    gains, slopes = _convert_to_gains(beta, type=type)
    covariance = inverse * (sse / (n - p))
    errors = {
        name: math.sqrt(max(0.0, float(slope @ covariance @ slope)))
        for name, slope in slopes.items()
    }
    return Regression(gains, errors, 1.0 - (1.0 - r2) * (n - 1) / (n - p - 1), math.sqrt(sse / n))


def _list_regressors(rows: Rows, *, type: str) -> Array:  # noqa: A002 - SysId's word
    """(columns, n) the regressors of the acceleration."""
    columns = [rows.velocity, rows.voltage, np.copysign(1.0, rows.velocity)]
    if type == "elevator":
        columns.append(np.ones(len(rows)))
    elif type == "arm":
        columns += [np.cos(rows.position), np.sin(rows.position)]
    return np.asarray(np.stack(columns))


def _solve_least_squares(columns: Array, y: Array) -> tuple[Array, Array]:
    """Coefficients (k,) of the regressors (k, n), and (k, k) the inverse of XᵀX.

    Raises:
        NotIdentifiable: the tests do not excite a combination of columns.
    """
    size = np.sqrt(np.einsum("ij,ij->i", columns, columns))
    size[size == 0.0] = 1.0
    scaled = columns / size[:, None]
    normal = scaled @ scaled.T
    values, vectors = np.linalg.eigh(normal)
    if not values[0] > LEAST_EIGENVALUE:
        weak = ("kV", "kA", "kS", "kG", "kG's angle")[int(np.argmax(np.abs(vectors[:, 0])))]
        raise NotIdentifiable(
            f"these tests cannot separate {weak} from the other gains",
            advice="Move at two or more steady speeds in both directions, and use a large step "
            "in the dynamic tests.",
        )
    inverse = (vectors / values) @ vectors.T
    beta = inverse @ (scaled @ y)
    beta += inverse @ (scaled @ (y - beta @ scaled))  # one step of iterative refinement
    return beta / size, inverse / np.outer(size, size)


def _convert_to_gains(beta: Array, *, type: str) -> tuple[dict[str, float], dict[str, Array]]:  # noqa: A002
    """Gains, and the derivatives (k,) of each gain by the coefficients ``beta`` (k,)."""
    alpha, per_volt, gamma = beta[:3]
    unit = np.eye(beta.size)

    def compute_ratio(index: int) -> Array:
        return np.asarray(-unit[index] / per_volt + unit[1] * beta[index] / per_volt**2)

    gains = {"kS": -gamma / per_volt, "kV": -alpha / per_volt, "kA": 1.0 / per_volt}
    slopes = {"kS": compute_ratio(2), "kV": compute_ratio(0), "kA": -unit[1] / per_volt**2}
    if type == "elevator":
        gains["kG"], slopes["kG"] = -beta[3] / per_volt, compute_ratio(3)
    elif type == "arm":
        cosine, sine = beta[3], beta[4]
        swing = math.hypot(cosine, sine)
        gains["kG"], gains["offset_rad"] = swing / per_volt, math.atan2(sine, -cosine)
        if swing > 0:
            toward = (cosine * unit[3] + sine * unit[4]) / swing
            slopes["kG"] = toward / per_volt - unit[1] * swing / per_volt**2
            slopes["offset_rad"] = (sine * unit[3] - cosine * unit[4]) / swing**2
    return {name: float(value) for name, value in gains.items()}, slopes
