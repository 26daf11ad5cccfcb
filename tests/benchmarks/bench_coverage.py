"""Do error bars hold? How often the stated 95 % interval contains the truth, gain by gain.

    python tests/benchmarks/bench_coverage.py [--logs 200] [--fewer 50] [MECHANISM ...]

Each log is of a mechanism of its own, drawn as ``draw`` draws it, under four tests. Then the same
with three times the noise, and logged every 5 ms, on ``--fewer`` logs. The share inside is printed
with the bounds that 95 of 100 such counts respect (Clopper and Pearson): a true share of 95 %
leaves 90 to 98 % of 200 logs in about one count of a hundred, and of fewer logs much more often.
"""

import argparse
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
from scipy.stats import beta

from sim.bench.mechanism import Mechanism
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.errors import NotIdentifiable
from sim.fit import Fit, fit

ROUTINE = Routine(ramp=0.5, step=3.5)
NORMAL = 1.959964  # standard errors to each side that hold 95 of 100
SURE = 0.95  # of the bounds
LOW, HIGH = 0.90, 0.98  # shares that are aimed at
KINDS = {"ordinary": (1.0, 0.02), "noise x3": (3.0, 0.02), "5 ms": (1.0, 0.005)}
"""Name -> times the mechanism's own noise, and period [s]."""


def one_fit(name: str, *, seed: int, noise: float, period: float) -> tuple[Mechanism, Fit]:
    """A mechanism drawn, and the fit of its log."""
    chance = np.random.default_rng([seed, int(noise), round(1e4 * period)])
    built = MECHANISMS[name].draw(chance)
    sensor = replace(built.sensor, velocity_noise=noise * built.sensor.velocity_noise)
    built = replace(built, sensor=sensor)
    return built, fit(simulate(built, ROUTINE, rng=chance, period=period), type=built.type)


def deviations(name: str, *, logs: int, noise: float, period: float) -> tuple[list[dict], Counter]:
    """Of each log: gain -> how many standard errors it is off; and how often what was doubted."""
    off, said = [], Counter()
    for seed in range(logs):
        try:
            built, found = one_fit(name, seed=seed, noise=noise, period=period)
        except NotIdentifiable:
            said["refused"] += 1
            continue
        truth = {gain: built.gains.get(gain, 0.0) for gain in found.gains}  # an arm drawn is level
        off.append({g: (found.gains[g] - truth[g]) / found.errors[g] for g in truth})
        said.update(doubt.code for doubt in found.doubts)
    return off, said


def bounds(inside: int, count: int) -> tuple[float, float]:
    """Least and greatest share that such a count leaves credible."""
    rest = 0.5 * (1.0 - SURE)
    least = beta.ppf(rest, inside, count - inside + 1) if inside else 0.0
    most = beta.ppf(1.0 - rest, inside + 1, count - inside) if inside < count else 1.0
    return float(least), float(most)


def lines(name: str, kind: str, *, logs: int) -> Iterator[str]:
    """One line for each gain, one for what was said of the logs."""
    noise, period = KINDS[kind]
    off, said = deviations(name, logs=logs, noise=noise, period=period)
    for gain in off[0] if off else ():
        deviation = np.array([one[gain] for one in off])
        inside = int(np.count_nonzero(np.abs(deviation) < NORMAL))
        least, most = bounds(inside, deviation.size)
        share = inside / deviation.size
        aside = "" if LOW <= share <= HIGH else "   outside of 90 to 98"
        yield (
            f"{name:12} {kind:10} {gain:10} {inside:4} of {deviation.size:4} {100 * share:6.1f} % "
            f"({100 * least:5.1f} to {100 * most:5.1f})   spread {deviation.std():5.2f}   "
            f"middle {np.median(deviation):+5.2f}{aside}"
        )
    if said:
        told = ", ".join(f"{code} {times}" for code, times in said.most_common())
        yield f"{name:12} {kind:10} said of {logs} logs: {told}"


def main(arguments: Sequence[str] | None = None) -> None:
    """Print every line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0].replace("%", "%%"))
    parser.add_argument("mechanism", nargs="*", default=[], help="all if none is named")
    parser.add_argument("--logs", type=int, default=200, help="of each mechanism")
    parser.add_argument("--fewer", type=int, default=50, help="with more noise, and every 5 ms")
    given = parser.parse_args(arguments)
    for kind in KINDS:
        for name in given.mechanism or MECHANISMS:
            logs = given.logs if kind == "ordinary" else given.fewer
            for line in lines(name, kind, logs=logs):
                print(line, flush=True)


if __name__ == "__main__":
    main()
