"""Gains of logs that were made without the simulation: how near, and whether errors hold.

    python tests/benchmarks/bench_elsewhere.py [SEEDS] [FIRST SEED]

Two sets, which ``made_elsewhere.py`` describes: 144 logs a seed of six mechanisms under ideal
physics, with a recorder's dirt and with everyday dirt, and 64 a seed of light drivetrains whose
velocity is averaged over a window and whose voltage acts late.
"""

import sys
import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor

import numpy as np
from made_elsewhere import KINDS, Truth, error_logs, lag_logs

from sim.core.errors import Refusal
from sim.core.log import Log
from sim.fit import fit

GAINS = ("kS", "kV", "kA", "kG")
OFF = 0.1  # [share of kA] error from which a fit counts as wrong


def fitted(
    case: tuple[str, str, Truth, Log],
) -> tuple[str, str, dict[str, tuple[float, ...]], set[str], float]:
    """Mechanism, kind, gain -> (deviation over its error, relative deviation of both methods)."""
    name, kind, truth, log = case
    began = time.process_time()
    try:
        found = fit(log, type=truth.type)
    except Refusal:
        return name, kind, {}, {"refused"}, time.process_time() - began
    took = time.process_time() - began
    try:
        recipe = fit(log, type=truth.type, method="sysid").gains
    except Refusal:
        recipe = {}
    rows = {}
    for gain in GAINS:
        if gain in truth.gains:
            true, value = truth.gains[gain], found.gains[gain]
            rows[gain] = (
                (value - true) / found.errors[gain],
                value / true - 1.0,
                found.errors[gain] / true,
                recipe.get(gain, np.nan) / true - 1.0,
            )
    return name, kind, rows, {doubt.code for doubt in found.doubts}, took


def named_lag_logs(seeds: int, first: int) -> Iterator[tuple[str, str, Truth, Log]]:
    """The lag logs in the form of the others."""
    for name, truth, log in lag_logs(seeds=seeds, first=first):
        yield name, "lag", truth, log


def main(seeds: int, first: int) -> None:
    """Print both tables."""
    with ProcessPoolExecutor() as pool:
        found = list(pool.map(fitted, error_logs(seeds=seeds, first=first), chunksize=8))
        print(
            f"{len(found)} logs, {sum('refused' in codes for *_, codes, _ in found)} refused, "
            f"{np.mean([took for *_, took in found]):.3f} s of processor time each"
        )
        print("kind     gain  within 2 errors   median error: ours    stated  SysId's recipe")
        for kind in KINDS:
            for gain in GAINS:
                rows = np.array(
                    [one[2][gain] for one in found if one[1] == kind and gain in one[2]]
                )
                _, error, stated, recipe = np.nanmedian(np.abs(rows), axis=0)
                held = np.mean(np.abs(rows[:, 0]) < 2.0)
                print(f"{kind:8} {gain:4} {held:12.3f} {error:24.4%} {stated:9.4%} {recipe:12.2%}")
        lags = list(pool.map(fitted, named_lag_logs(seeds, first), chunksize=8))
    wrong = [one for one in lags if not one[2] or abs(one[2]["kA"][1]) > OFF]
    silent = [one[0] for one in wrong if one[2] and "model-strays" not in one[3]]
    print(
        f"{len(lags)} logs with window and lag: kA off by more than {OFF:.0%} in {len(wrong)}, "
        f"{len(silent)} of them without a warning: {silent}"
    )


if __name__ == "__main__":
    main(*(int(word) for word in (sys.argv[1:] + ["3", "0"][len(sys.argv) - 1 :])[:2]))
