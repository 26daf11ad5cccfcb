"""Two methods against the truth: a mechanism with everyday dirt, at a noise and a period.

Dirt is what nobody has to name: a little Stribeck friction, sag, delay and cogging, drawn anew for
each log. A cell is a mechanism at a noise and a period; its figure is the median error over seeds.
"""

from dataclasses import replace
from statistics import median

import numpy as np

from sim.bench.mechanism import Mechanism
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.errors import NotIdentifiable
from sim.core.log import Log
from sim.fit import fit

ROUTINE = Routine(ramp=0.5, step=3.5)
NOISES = (1.0, 3.0, 10.0)  # times the mechanism's own
DIRT = {"stribeck": 0.15, "battery-sag": 0.1, "delay": 0.08, "cogging": 0.1}  # [1] sizes at most
METHODS = ("sysid", "output-error")
GAINS = ("kS", "kV", "kA")


def one_cell(
    name: str, *, noise: float, period: float, seeds: int
) -> tuple[dict[str, dict[str, float]], dict[str, int]]:
    """Method -> gain -> median error (kS in volts, others as a share), and refusals."""
    errors: dict[str, dict[str, list[float]]] = {m: {g: [] for g in GAINS} for m in METHODS}
    refused = dict.fromkeys(METHODS, 0)
    for seed in range(seeds):
        built, log = one_log(name, noise=noise, period=period, seed=seed)
        for method in METHODS:
            try:
                found = fit(log, type=built.type, method=method)
            except NotIdentifiable:
                refused[method] += 1
                continue
            for gain in GAINS:
                off = abs(found.gains[gain] - built.gains[gain])
                errors[method][gain].append(off if gain == "kS" else off / built.gains[gain])
    return {
        method: {gain: median(some) if some else np.inf for gain, some in by_gain.items()}
        for method, by_gain in errors.items()
    }, refused


def one_log(name: str, *, noise: float, period: float, seed: int) -> tuple[Mechanism, Log]:
    """A mechanism drawn, dirty and noisy, and its log."""
    chance = np.random.default_rng([seed, int(noise), int(1e4 * period)])
    built = MECHANISMS[name].draw(chance)
    sensor = replace(built.sensor, velocity_noise=noise * built.sensor.velocity_noise)
    built = replace(built, sensor=sensor)
    for effect, most in DIRT.items():
        built = built.hide(effect, float(chance.uniform(0.2, 1.0)) * most)
    return built, simulate(built, ROUTINE, rng=chance, period=period)
