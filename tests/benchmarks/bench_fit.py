"""Both methods in process: how long they take, and how much memory at most.

    python tests/benchmarks/bench_fit.py

Of method sysid preparation and regression, then SysId's simulation metrics; of method output-error
the whole fit. For comparison, SysId 2026.2.2's own core takes 2.6 ms for 4 x 500 samples and 4.7 s
for 4 x 25,000 (its sums of squares are quadratic), and 0.6 ms more for the metrics of the former.

Memory is what Python and NumPy allocate beyond the log, as tracemalloc sees it, on every system.
"""

import numpy as np
from timing import HEADER, line, peak, seconds

from sim.bench.simulate import move_gains_only
from sim.core.log import FOUR_TESTS, Log, Run
from sim.core.vocabulary import METHODS
from sim.fit import fit
from sim.fit.metrics import score_simulated_velocity
from sim.fit.regression import regress_acceleration
from sim.fit.sysid_rows import prepare_rows

GAINS = {"kS": 0.25, "kV": 2.0, "kA": 0.3}
TICK = 1e-4  # [m] of the encoder: none is without steps
LARGE = 10_000  # [samples a test] from which a few repetitions do


def log(samples: int) -> Log:
    """Four tests of ``samples`` samples over 10 s each, with noise."""
    rng = np.random.default_rng(1)
    runs = []
    for index, test in enumerate(FOUR_TESTS):
        time = np.linspace(0.0, 10.0, samples)
        sign = 1.0 if test.endswith("forward") else -1.0
        voltage = sign * (time if test.startswith("quasi") else np.full(samples, 7.0))
        position, velocity = move_gains_only(GAINS, time=time, voltage=voltage)
        noisy = velocity + rng.normal(0, 0.02, samples)
        seen = TICK * np.round(position / TICK)
        runs.append(Run(test, 20.0 * index + time, voltage, seen, noisy))
    return Log(tuple(runs))


def measure(recorded: Log, *, name: str, targets: tuple[float, float | None, float]) -> None:
    """Print the figures of one log."""
    raw = list(prepare_rows(recorded).raw.values())
    taken = seconds(lambda: regress_acceleration(prepare_rows(recorded).rows, type="simple"))
    print(line(f"{name}: preparation and regression", taken, target=targets[0]))
    taken = seconds(lambda: score_simulated_velocity(raw, GAINS, type="simple"))
    print(line(f"{name}: simulation metrics, all four tests", taken, target=targets[1]))
    repeats = 3 if len(recorded.runs[0]) > LARGE else 15
    taken = seconds(lambda: fit(recorded), repeats=repeats)
    print(line(f"{name}: output-error", taken, target=targets[2]), flush=True)


def memory(samples: int) -> None:
    """Print the most memory that each method takes for four tests of so many samples."""
    recorded = log(samples)
    for method in METHODS:
        most = peak(lambda method=method: fit(recorded, method=method))
        each = most / (4 * samples)
        name = f"4 x {samples:,}: memory, {method}"
        print(f"{name:56} {most / 1e6:9.1f} MB {each:7.0f} bytes a sample", flush=True)


def main() -> None:
    """Print the figures."""
    print(HEADER)
    measure(log(500), name="4 x 500", targets=(1.5e-3, 10e-3, 20e-3))
    measure(log(25_000), name="4 x 25,000", targets=(60e-3, None, 0.5))
    for samples in (2_500, 25_000, 100_000):
        memory(samples)


if __name__ == "__main__":
    main()
