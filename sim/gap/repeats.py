"""Whether the residual repeats when a test is repeated.

    share = 2·Σ a·b/Σ(a² + b² - noise)     with the means a, b of short intervals at equal times

A residual that repeats is physics that the model lacks; one that does not is noise or a
disturbance.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from sim.core.log import Array
from sim.gap.residuals import Residuals

SAME = 0.05  # [share of the largest voltage] largest RMS difference of a repetition's voltage
INTERVALS, LEAST = 60, 5  # at most; samples of each, at least
MOSTLY, HARDLY = 0.7, 0.3  # [1] shares above which residuals repeat, and below which they do not
LOUD = 3.0  # [standard errors] by which residuals exceed noise, at least
AGAIN, PARTLY = "comes again", "comes again in part"
CHANGES, NOISE = "changes from run to run", "is only noise"


@dataclass(frozen=True)
class Repeat:
    """Two runs of the same test under the same voltage.

    Args:
        test: name of the test.
        runs: indices of the two runs.
        sure: [standard errors] by which the correlation of both velocity residuals is above 0.
        excess: [1] mean square of the residuals over that of noise alone.
        share: [1] share of the residuals, beyond noise, that is equal in both; may be below 0.
        verdict: ``comes again``, ``comes again in part``, ``changes from run to run`` or ``is no
            more than noise``.
    """

    test: str
    runs: tuple[int, int]
    sure: float
    excess: float
    share: float
    verdict: str


def compare_repeats(runs: Sequence[Residuals], *, noise: float) -> tuple[Repeat, ...]:
    """Compare the residuals of every pair of runs of the same test.

    Args:
        runs: residuals of any runs.
        noise: [unit/s] standard deviation of a velocity.
    """
    pairs = [
        pair for pair in combinations(range(len(runs)), 2) if _are_repeats(*(runs[i] for i in pair))
    ]
    return tuple(found for pair in pairs for found in _compare_pair(runs, pair, noise=noise))


def _are_repeats(one: Residuals, other: Residuals) -> bool:
    """Whether two runs are of the same test, with about the same voltage."""
    n = min(one.time.size, other.time.size)
    if one.test != other.test or n < 2 * LEAST:
        return False
    across = np.interp(one.run_time[:n], other.run_time, other.voltage)
    difference = math.sqrt(float(np.mean((one.voltage[:n] - across) ** 2)))
    return difference <= SAME * float(np.abs(one.voltage).max())


def _compare_pair(
    runs: Sequence[Residuals], pair: tuple[int, int], *, noise: float
) -> Iterator[Repeat]:
    """The comparison of two runs; nothing if they have too few common samples."""
    one, other = (runs[number] for number in pair)
    n = min(one.time.size, other.time.size)
    ends = np.linspace(
        0.0, min(one.run_time[n - 1], other.run_time[n - 1]), min(INTERVALS, n // LEAST) + 1
    )
    (a, count_a), (b, count_b) = (
        _average_over_intervals(run, ends, noise=noise) for run in (one, other)
    )
    both = (count_a >= LEAST - 1) & (count_b >= LEAST - 1)
    a, b, counts = a[both], b[both], np.minimum(count_a, count_b)[both]
    if a.size < LEAST:
        return
    size = math.sqrt(float(a @ a) * float(b @ b))
    correlation = float(a @ b) / size if size > 0.0 else 0.0
    rho = _compute_lag_one_correlation(a) * _compute_lag_one_correlation(b)
    sure = correlation * math.sqrt(a.size * (1.0 - rho) / (1.0 + rho))
    excess = float(np.mean(counts * (a**2 + b**2))) / 2.0
    share = float(np.mean(counts * a * b)) / max(excess - 1.0, 1e-9)
    if excess < 1.0 + LOUD * math.sqrt(1.0 / a.size):
        verdict = NOISE
    else:
        verdict = AGAIN if share >= MOSTLY else PARTLY if share > HARDLY else CHANGES
    yield Repeat(one.test, pair, sure, excess, share, verdict)


def _average_over_intervals(run: Residuals, ends: Array, *, noise: float) -> tuple[Array, Array]:
    """[noise] mean velocity residual in each interval, and its number of samples."""
    residual = run.error[:, 1] / noise
    there = ~np.isnan(residual) & (run.run_time < ends[-1])
    place = np.searchsorted(ends, run.run_time[there], side="right") - 1
    count = np.bincount(place, minlength=ends.size - 1).astype(np.float64)
    total = np.bincount(place, residual[there], minlength=ends.size - 1)
    return total / np.maximum(count, 1.0), count


def _compute_lag_one_correlation(values: Array) -> float:
    """[1] lag-one autocorrelation, clamped to 0 and 0.95."""
    square = float(values @ values)
    return min(max(float(values[1:] @ values[:-1]) / square, 0.0), 0.95) if square > 0.0 else 0.0
