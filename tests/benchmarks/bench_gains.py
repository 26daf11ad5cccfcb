"""Two methods against the truth: every mechanism, three noise levels, 20 and 5 ms, everyday dirt.

    python tests/benchmarks/bench_gains.py [seeds]

Dirt is what nobody has to name: a little Stribeck friction, sag, delay and cogging, drawn anew for
each log. A cell is a mechanism at a noise and a period; its figure is the median error over seeds.
"""

import sys
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
PERIODS = (0.02, 0.005)  # [s]
DIRT = {"stribeck": 0.15, "battery-sag": 0.1, "delay": 0.08, "cogging": 0.1}  # [1] sizes at most
METHODS = ("sysid", "output-error")
GAINS = ("kS", "kV", "kA")


def main() -> None:
    """Print every cell, then the ratios that matter."""
    seeds = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    cells: dict[tuple[str, float, float], dict[str, dict[str, float]]] = {}
    print(f"{'cell':32} {'kS [V]':>17} {'kV [%]':>17} {'kA [%]':>17}   refused   (recipe, ours)")
    for name in MECHANISMS:
        for noise in NOISES:
            for period in PERIODS:
                cell, refused = one_cell(name, noise=noise, period=period, seeds=seeds)
                cells[name, noise, period] = cell
                shown = "".join(
                    f"{cell['sysid'][g] * u:9.3g}{cell['output-error'][g] * u:9.3g}"
                    for g, u in zip(GAINS, (1.0, 100.0, 100.0), strict=True)
                )
                print(f"{name:12} noise x{noise:<4g} {1e3 * period:3.0f} ms {shown}   {refused}")
    for gain in GAINS:
        theirs = median(cell["sysid"][gain] for cell in cells.values())
        ours = median(cell["output-error"][gain] for cell in cells.values())
        worse = {
            key: (cell["sysid"][gain], cell["output-error"][gain])
            for key, cell in cells.items()
            if cell["output-error"][gain] > cell["sysid"][gain] + 0.01
        }
        share = ours / theirs
        print(
            f"{gain}: median over cells {theirs:.3g} (recipe) {ours:.3g} (ours), {share:.2f} of it"
        )
        print(f"    above it by more than 0.01 in {worse or 'no cell'}")
        worst = max(cells, key=lambda key: cells[key]["output-error"][gain])
        closest = max(cells, key=lambda key: _share(cells[key], gain))
        print(f"    worst cell {worst}: {cells[worst]['output-error'][gain]:.3g}")
        print(f"    closest to the recipe {closest}: {_share(cells[closest], gain):.2f} of it")


def _share(cell: dict[str, dict[str, float]], gain: str) -> float:
    """Our error over the recipe's."""
    return cell["output-error"][gain] / max(cell["sysid"][gain], 1e-12)


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


if __name__ == "__main__":
    main()
