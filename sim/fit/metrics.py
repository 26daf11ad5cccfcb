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
from itertools import pairwise

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
        decay, gain = _discretize(np.diff(part.time), gains)
        if type == "arm":
            model = _simulate_arm(part, decay, gain, gains)
        else:
            model = _simulate_without_gravity_angle(part, decay, gain, gains)
        with np.errstate(over="ignore", invalid="ignore"):  # with wrong gains it may diverge
            error = part.velocity - model
            missed += float(error @ error)
        total += float(part.velocity[1:] @ part.velocity[1:])
        count += len(part) - 1
    if not count or not math.isfinite(missed) or not total:
        return SimulationScore(-math.inf, math.inf)
    rmse = math.sqrt(missed / count)
    return SimulationScore(1.0 - rmse / math.sqrt(total / count), rmse)


def _discretize(period: Array, gains: Mapping[str, float]) -> tuple[list[float], list[float]]:
    """Exact step of v' = (V - kV·v)/kA: v⁺ = decay·v + gain·V."""
    rate = -gains["kV"] / gains["kA"]
    with np.errstate(over="ignore", invalid="ignore"):
        decay = np.exp(rate * period)
        gain = np.expm1(rate * period) / -gains["kV"] if gains["kV"] else period / gains["kA"]
    return decay.tolist(), gain.tolist()


def _simulate_without_gravity_angle(
    part: Rows, decay: list[float], gain: list[float], gains: Mapping[str, float]
) -> Array:
    """Velocities of a simple mechanism or an elevator. Plain floats: one step needs the last."""
    ks, kg = gains["kS"], gains.get("kG", 0.0)
    v = float(part.velocity[0])
    model = [v]
    for keep, push, volts in zip(decay, gain, part.voltage.tolist(), strict=False):
        friction = ks if v > 0.0 else -ks if v < 0.0 else 0.0
        v = keep * v + push * (volts - friction - kg)
        model.append(v)
    return np.array(model)


def _simulate_arm(
    part: Rows, decay: list[float], gain: list[float], gains: Mapping[str, float]
) -> Array:
    """The velocities of an arm simulated with the gains, from the first sample of a test."""
    ks, kg, offset = gains["kS"], gains["kG"], gains["offset_rad"]
    x, v = float(part.position[0]), float(part.velocity[0])
    model = [v]
    periods = (late - early for early, late in pairwise(part.time.tolist()))
    for keep, push, dt, volts in zip(decay, gain, periods, part.voltage.tolist(), strict=False):
        friction = ks if v > 0.0 else -ks if v < 0.0 else 0.0
        angle = x + 0.5 * dt * v + offset
        weight = kg * math.cos(angle) if math.isfinite(angle) else math.nan
        after = keep * v + push * (volts - friction - weight)
        x += 0.5 * dt * (v + after)
        v = after
        model.append(v)
    return np.array(model)
