"""Cogging: a force that is periodic in the position.

    V = ... + cosine·cos(turns·x) + sine·sin(turns·x)

Causes are magnets that pass iron, a sprocket that is not round, and a bent shaft.
"""

import math
from collections.abc import Iterator, Mapping

import numpy as np

from sim.physics.effect import Effect, Parameter, Scale
from sim.physics.voltage_residual import VoltageResidual

MIN_PERIODS, MAX_PERIODS, FINER = 4.0, 80.0, 0.25  # [periods along the travel] and step
MAX_SAMPLES = 1500  # samples of which a spectrum is computed
PEAKS = 3  # peaks of the spectrum that become start values


def force(x: float, cosine: float, sine: float, turns: float) -> float:
    """[V] force toward negative positions."""
    return cosine * math.cos(turns * x) + sine * math.sin(turns * x)


def stored_energy(x: float, cosine: float, sine: float, turns: float) -> float:
    """[V·unit] energy of the cogging force at a position."""
    return (cosine * math.sin(turns * x) - sine * math.cos(turns * x)) / turns


def ordinary_parameters(scale: Scale, size: float) -> Mapping[str, float]:
    """Parameters of a given size; size 1 is 0.2 V, with twelve periods along the travel."""
    turns = 2.0 * math.pi * 12.0 / scale.reach
    return {"cosine": 0.16 * size, "sine": 0.12 * size, "turns": turns}


def shortest_time(values: Mapping[str, float], gains: Mapping[str, float]) -> float:
    """[s] one period over 2π at the speed of 6 V; time steps must resolve it."""
    return gains["kV"] / (6.0 * max(values["turns"], 1e-9))


def shortest_length(values: Mapping[str, float]) -> float:
    """[unit] length scale, one period over 2π; steps must resolve it."""
    return 1.0 / max(values["turns"], 1e-9)


def find_start_values(residual: VoltageResidual) -> Iterator[Mapping[str, float]]:
    """Start values: the highest peaks in the spectrum of the voltage residual over position.

    Fewer than four periods along the travel do not show that a force is periodic: a bump, or a
    brake along a part of the travel, gives one or two.
    """
    length = float(np.ptp(residual.position)) if residual.position.size else 0.0
    if length <= 0.0:
        return
    tried = 2.0 * math.pi * np.arange(MIN_PERIODS, MAX_PERIODS, FINER) / length
    some = slice(None, None, max(residual.position.size // MAX_SAMPLES, 1))
    few = residual.select_samples(some)
    turned = np.exp(1j * (tried[1] - tried[0]) * few.position)  # from one wave to the next
    waves = np.repeat(turned[:, None], tried.size, axis=1)
    waves[:, 0] = np.exp(1j * tried[0] * few.position)
    waves = np.multiply.accumulate(waves, axis=1)
    cosine, sine = few.fit_column_sets(waves.real, waves.imag)
    left = np.hypot(cosine, sine)
    for _ in range(PEAKS):
        best = int(np.argmax(left))
        yield {
            "cosine": float(cosine[best]),
            "sine": float(sine[best]),
            "turns": float(tried[best]),
        }
        left[max(best - 3, 0) : best + 4] = 0.0


EFFECT = Effect(
    name="cogging",
    kind="term",
    summary="a force that repeats with the position (magnets, a sprocket that is not round)",
    formula="cosine·cos(turns·x) + sine·sin(turns·x)",
    parameters=(
        # teeth and magnets cause as much in any mechanism
        Parameter("cosine", "its cosine part", "V", least=-12.0, most=12.0, everyday=0.06),
        Parameter("sine", "its sine part", "V", least=-12.0, most=12.0, everyday=0.06),
        Parameter(
            "turns", "angle of the wave per position", "rad/{u}", power=1, least=1e-6, neutral=1.0
        ),
    ),
    fingerprint=(
        "The missing voltage comes and goes with the position, at the same places in every run."
    ),
    inspect=(
        "Check whether a sprocket or pulley is not round, whether a shaft is bent, and whether a "
        "wheel has a flat spot. The magnets of the motor can be the cause, too."
    ),
    apart={
        "compliance": (
            "Run at another speed. Cogging stays at the same positions, a vibration keeps its "
            "frequency."
        ),
        "gravity-cosine": (
            "Use the full travel. The force of gravity repeats only once per turn of the arm."
        ),
    },
    example=ordinary_parameters,
    start_values=find_start_values,
    hooks={"force": force},
    symmetric=False,
    stored_energy=stored_energy,
    shortest_time=shortest_time,
    shortest_length=shortest_length,
)
