"""Periodic residuals: the largest peak in the spectrum of the disturbance.

    power(f) = Σ |Σ w·exp(-2πi·f·t)|²/(n·mean(w²))        w disturbance estimated at each sample

summed over the runs. The power of noise is an exponential deviate in each run, so the sum is a
gamma deviate. A weak periodic force is small in each innovation, but a clear line in the spectrum.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from sim.core.log import Array
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.reconcile.residual_tests.repeatability import estimate_disturbance
from sim.reconcile.thresholds import FEWEST_SAMPLES, SHORTEST_WINDOW

FEWEST_TURNS = 2.0  # periods that a run has to last: friction can look like one slow period
FASTEST = 0.5 / SHORTEST_WINDOW  # [Hz] above: vibration of a joint, or a force along the position


@dataclass(frozen=True)
class SpectralPeak:
    """A periodic residual.

    Args:
        size: [1] -ln of the probability that noise has as large a peak at this frequency, not
            corrected for the number of frequencies.
        rate: [Hz] the frequency.
    """

    size: float = 0.0
    rate: float = 0.0


def find_spectral_peak(problem: PredictionErrorProblem, point: Estimate) -> SpectralPeak:
    """Find the spectral peak that noise would be least likely to produce.

    Args:
        problem: the measurements.
        point: the estimate whose residuals are tested.
    """
    runs = list(_list_disturbances(problem, point))
    squares = sum(float(values @ values) for _, values in runs)
    if not squares > 0.0:
        return SpectralPeak()
    mean = squares / sum(values.size for _, values in runs)
    durations = [float(np.ptp(time)) for time, _ in runs]
    longest = max(durations)
    rates: Array = np.arange(FEWEST_TURNS / longest, FASTEST, 0.5 / longest)
    power, count = np.zeros(rates.size), np.zeros(rates.size)
    for (time, values), duration in zip(runs, durations, strict=True):
        slowest = int(np.searchsorted(rates * duration, FEWEST_TURNS))
        for place in range(slowest, rates.size):  # all waves at once would need gigabytes
            wave = np.exp(-2j * np.pi * rates[place] * time)
            power[place] += abs(wave @ values) ** 2 / (values.size * mean)
        count[slowest:] += 1.0
    each = zip(power.tolist(), count.tolist(), rates.tolist(), strict=True)
    found = (SpectralPeak(_compute_surprisal(p, int(n)), rate) for p, n, rate in each)
    return max(found, key=lambda one: one.size, default=SpectralPeak())


def _list_disturbances(
    problem: PredictionErrorProblem, point: Estimate
) -> Iterator[tuple[Array, Array]]:
    """Per run that is long enough: [s] times, and disturbances minus their mean."""
    disturbance = estimate_disturbance(problem, point)
    used = np.asarray(~problem.ignored_readings.all(axis=1))
    for record, rows in zip(problem.records, problem.run_slices, strict=True):
        values = disturbance[rows][used[rows]]
        if values.size >= FEWEST_SAMPLES:
            yield record.measurements.time[used[rows]], values - np.mean(values)


def _compute_surprisal(power: float, count: int) -> float:
    """-ln of the probability that ``count`` exponential deviates sum to more (Erlang tail)."""
    if not (power > 0.0 and count):
        return 0.0
    terms = [k * math.log(power) - math.lgamma(k + 1.0) for k in range(count)]
    most = max(terms)
    return power - most - math.log(sum(math.exp(one - most) for one in terms))
