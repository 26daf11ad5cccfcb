"""Cogging: a force that comes back every so often along the way.

    V = ... + cosine·cos(turns·x) + sine·sin(turns·x)

Magnets that pass iron, a sprocket out of round, a bent shaft, a belt that skips a tooth's worth.
"""

import math
from collections.abc import Iterator, Mapping

import numpy as np

from sim.physics.effect import Effect, Parameter, Scale
from sim.physics.voltage_residual import VoltageResidual

EVERYDAY = 0.06  # [V]

FEWEST, MOST, FINER = 4.0, 80.0, 0.25  # [1] times that it comes back within what a log covers
ENOUGH = 1500  # samples that show a spectrum
SHOWN = 3  # peaks of the spectrum that are worth a start


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


def find_start_values(seen: VoltageResidual) -> Iterator[Mapping[str, float]]:
    """Start values: the strongest lines in the voltage residual's spectrum over position.

    What comes back less than four times is not seen to come back: a bump, or a brake along a part
    of the way, has one wave or two.
    """
    length = float(np.ptp(seen.position)) if seen.position.size else 0.0
    if length <= 0.0:
        return
    tried = 2.0 * math.pi * np.arange(FEWEST, MOST, FINER) / length
    some = slice(None, None, max(seen.position.size // ENOUGH, 1))
    few = seen.select_samples(some)
    turned = np.exp(1j * (tried[1] - tried[0]) * few.position)  # by which each wave is ahead
    waves = np.repeat(turned[:, None], tried.size, axis=1)
    waves[:, 0] = np.exp(1j * tried[0] * few.position)
    waves = np.multiply.accumulate(waves, axis=1)
    cosine, sine = few.fit_column_sets(waves.real, waves.imag)
    left = np.hypot(cosine, sine)
    for _ in range(SHOWN):
        best = int(np.argmax(left))
        yield {
            "cosine": float(cosine[best]),
            "sine": float(sine[best]),
            "turns": float(tried[best]),
        }
        left[max(best - 3, 0) : best + 4] = 0.0


def is_ordinary(values: Mapping[str, float], _: Mapping[str, float]) -> bool:
    """Whether any robot has as much: the ripple that teeth and magnets leave in any mechanism."""
    return math.hypot(values["cosine"], values["sine"]) <= EVERYDAY


EFFECT = Effect(
    name="cogging",
    kind="term",
    summary="a force that repeats with the position (magnets, a sprocket that is not round)",
    formula="cosine·cos(turns·x) + sine·sin(turns·x)",
    parameters=(
        Parameter("cosine", "its cosine part", "V", least=-12.0, most=12.0),
        Parameter("sine", "its sine part", "V", least=-12.0, most=12.0),
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
    is_ordinary=is_ordinary,
)
