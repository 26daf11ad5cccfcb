"""SysId's simulation metrics: R² and RMSE of the simulated velocity.

    RMSE = sqrt( Σ (v - v̂)² / N )        R² = 1 - RMSE / sqrt( Σ v² / N )

This R² is SysId's own: it has no squares, and no mean is subtracted. Its 0.9 is 0.99 in the usual
definition. SysId computes both for the direction that its plots show, by default forward.
Source: WPILib SysId 2026.2.2, ``view/AnalyzerPlot.cpp`` and ``analysis/*Sim.cpp``; checked against
its figures.
"""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from sim.core.log import Array
from sim.fit.sysid_rows import Rows


@dataclass(frozen=True)
class SimulationScore:
    """Goodness of fit of the simulated velocity, open loop.

    Args:
        r2: SysId's simulated velocity R².
        rmse: [m/s or rad/s] RMS velocity error.
    """

    r2: float
    rmse: float


def score_simulated_velocity(
    rows: Iterable[Rows],
    gains: Mapping[str, float],
    *,
    type: str,  # noqa: A002 - SysId's word
) -> SimulationScore:
    """Compare measured velocities with those the gains give for the same voltage.

    Each test starts from its measured state; between samples the voltage is held, and the signs of
    friction (and an arm's gravity, taken half a step on) are frozen, as SysId does.

    Args:
        rows: rows of the tests, as recorded.
        gains: the fitted gains, in SI.
        type: ``simple``, ``elevator`` or ``arm``.

    Returns:
        R² and RMSE; minus infinity and infinity if the simulation diverges or nothing moves.
    """
    missed, total, count = 0.0, 0.0, 0
    for part in rows:
        model = _simulate(part, gains, turns=type == "arm")
        with np.errstate(over="ignore", invalid="ignore"):  # with wrong gains it may diverge
            error = part.velocity - model
            missed += float(error @ error)
        total += float(part.velocity[1:] @ part.velocity[1:])
        count += len(part) - 1
    if not count or not math.isfinite(missed) or not total:
        return SimulationScore(-math.inf, math.inf)
    rmse = math.sqrt(missed / count)
    return SimulationScore(1.0 - rmse / math.sqrt(total / count), rmse)


def _simulate(part: Rows, gains: Mapping[str, float], *, turns: bool) -> Array:
    """Velocities of a test, simulated from its first sample by exact steps of v' = (V - kV·v)/kA.

    Plain floats: one step needs the last.

    Args:
        part: the rows of the test.
        gains: the gains.
        turns: whether the weight depends on the angle.
    """
    periods = np.diff(part.time)
    rate = -gains["kV"] / gains["kA"]
    with np.errstate(over="ignore", invalid="ignore"):
        decay = np.exp(rate * periods)
        gain = np.expm1(rate * periods) / -gains["kV"] if gains["kV"] else periods / gains["kA"]
    steps = zip(decay.tolist(), gain.tolist(), periods.tolist(), part.voltage.tolist())  # noqa: B905 - nothing follows the last voltage
    ks, kg, offset = gains["kS"], gains.get("kG", 0.0), gains.get("offset_rad", 0.0)
    x, v, weight = float(part.position[0]), float(part.velocity[0]), kg
    model = [v]
    for keep, push, dt, volts in steps:
        friction = ks if v > 0.0 else -ks if v < 0.0 else 0.0
        if turns:
            angle = x + 0.5 * dt * v + offset
            weight = kg * math.cos(angle) if math.isfinite(angle) else math.nan
        after = keep * v + push * (volts - friction - weight)
        x += 0.5 * dt * (v + after)
        v = after
        model.append(v)
    return np.array(model)
