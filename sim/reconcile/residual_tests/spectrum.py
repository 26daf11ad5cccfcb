"""Periodic residuals: the largest peak in the spectrum of the disturbance.

    power(f) = Σ |Σ w·exp(-2πi·f·t)|²/(n·mean(w²))        w how much of a push each innovation has

summed over the runs. Of noise the power of a run is exponential, that of several a gamma deviate.
What q takes for pushes at random is small in each innovation, and yet a line in their spectrum.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from sim.core.log import Array
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.reconcile.residual_tests.repeatability import estimate_disturbance
from sim.reconcile.thresholds import FEWEST_SAMPLES, SHORTEST_WINDOW

FEWEST_TURNS = 2.0  # that a run has to last: of fewer, friction of its own makes one
FASTEST = 0.5 / SHORTEST_WINDOW  # [Hz] faster is a joint that swings, or a wave along the way


@dataclass(frozen=True)
class SpectralPeak:
    """A periodic residual.

    Args:
        size: [1] -ln of the probability that noise has as large a peak at this frequency; how many
            frequencies were looked at is not counted in.
        rate: [Hz] the frequency.
    """

    size: float = 0.0
    rate: float = 0.0


def find_spectral_peak(problem: PredictionErrorProblem, point: Estimate) -> SpectralPeak:
    """Find the spectral peak that noise would be least likely to produce.

    Args:
        problem: the measurements.
        point: what is believed.
    """
    runs = list(_disturbances_by_run(problem, point))
    squares = sum(float(push @ push) for _, push in runs)
    if not squares > 0.0:
        return SpectralPeak()
    mean = squares / sum(push.size for _, push in runs)
    lasts = [float(np.ptp(time)) for time, _ in runs]
    longest = max(lasts)
    rates: Array = np.arange(FEWEST_TURNS / longest, FASTEST, 0.5 / longest)
    power, count = np.zeros(rates.size), np.zeros(rates.size)
    for (time, push), lasting in zip(runs, lasts, strict=True):
        slow = int(np.searchsorted(rates * lasting, FEWEST_TURNS))
        for place in range(slow, rates.size):  # all waves at once would need gigabytes
            wave = np.exp(-2j * np.pi * rates[place] * time)
            power[place] += abs(wave @ push) ** 2 / (push.size * mean)
        count[slow:] += 1.0
    sizes = (_surprisal(p, int(n)) for p, n in zip(power.tolist(), count.tolist(), strict=True))
    found = (SpectralPeak(size, rate) for size, rate in zip(sizes, rates.tolist(), strict=True))
    return max(found, key=lambda one: one.size, default=SpectralPeak())


def _disturbances_by_run(
    problem: PredictionErrorProblem, point: Estimate
) -> Iterator[tuple[Array, Array]]:
    """Of each run that is long enough: times, and pushes less their mean."""
    every, told = (
        estimate_disturbance(problem, point),
        np.asarray(~problem.ignored_readings.all(axis=1)),
    )
    for record, (first, last) in zip(
        problem.records, pairwise(problem.run_edges.tolist()), strict=True
    ):
        mine = told[first:last]
        push = every[first:last][mine]
        if push.size >= FEWEST_SAMPLES:
            yield record.measurements.time[mine], push - np.mean(push)


def _surprisal(power: float, count: int) -> float:
    """-log of the chance that so many exponential deviates sum up to as much (Erlang's tail)."""
    if not (power > 0.0 and count):
        return 0.0
    terms = [k * math.log(power) - math.lgamma(k + 1.0) for k in range(count)]
    most = max(terms)
    return power - most - math.log(sum(math.exp(one - most) for one in terms))
