"""A log ten times as long takes ten times the memory to fit, and no more."""

import tracemalloc

import numpy as np
import pytest

from sim.bench.simulate import move_gains_only
from sim.core.log import FOUR_TESTS, Log, Run
from sim.core.vocabulary import METHODS
from sim.fit import fit

GAINS = {"kS": 0.25, "kV": 2.0, "kA": 0.3}
SHORT, LONG = 1_500, 15_000  # [samples] of all tests together; the longer is fitted in threads
ABOUT = 1.25  # [1] a table of all samples against all would make it ten


def log(samples):
    """The four tests over 4 s each, a quarter of the samples in each."""
    runs, time = [], np.linspace(0.0, 4.0, samples // 4)
    for index, test in enumerate(FOUR_TESTS):
        sign = 1.0 if test.endswith("forward") else -1.0
        volts = sign * (2.0 * time if test.startswith("quasi") else np.full(time.size, 7.0))
        position, velocity = move_gains_only(GAINS, time=time, voltage=volts)
        chance = np.random.default_rng(index)
        noisy = velocity + 0.02 * chance.standard_normal(time.size) * (velocity != 0.0)
        seen = np.round(position, 4)
        runs.append(Run(test, 10.0 * index + time, volts, seen, noisy))
    return Log(tuple(runs))


def most(work):
    """Bytes held at most while a function works, what it began with left out."""
    tracemalloc.start()
    try:
        work()
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize("method", METHODS)
def test_memory_a_sample_does_not_grow_with_the_log(method):
    short, long = log(SHORT), log(LONG)
    fit(short, method=method)  # what is loaded and compiled once is no matter

    each = [most(lambda one=one: fit(one, method=method)) / size
            for one, size in ((short, SHORT), (long, LONG))]  # fmt: skip

    assert each[1] < ABOUT * each[0]
