"""Faults of the record: each is struck at random and found again, and clean logs stay clean.

The table at the end of a fault's own paragraph in its module says what is meant; here is whether it
holds. What all faults have in common is tested in ``test_faults.py``.
"""

import numpy as np
import pytest

from sim.clues import Clues
from sim.contaminate import contaminate
from sim.faults import FAULTS
from sim.mechanisms import MECHANISMS
from sim.routine import Routine
from sim.simulate import simulate

MINE = (
    "command-logged",
    "mislabelled-test",
    "missing-test",
    "noisy-standstill",
    "sign-flip",
    "stale-samples",
    "stuck-sensor",
    "unit-error",
    "voltage-dropout",
)
SEEDS = 8  # logs; the share of a hundred is in the table of test_faults.py


def drawn(seed, *, period=0.02):
    """A clean log of some mechanism."""
    rng = np.random.default_rng(seed)
    name = tuple(MECHANISMS)[seed % len(MECHANISMS)]
    built = MECHANISMS[name].draw(rng)
    return simulate(built, Routine(ramp=0.5, step=3.5), rng=rng, period=period)


def struck(name, log, seed, *, severity=1.0):
    """The log with one fault, somewhere it may strike."""
    rng = np.random.default_rng(seed + 1000)
    return contaminate(log, name, severity=severity, rng=rng)


def found(name, log):
    return list(FAULTS[name].detect(Clues(log)))


def missed(name, spoilt):
    """The damaged parts that the detective did not find."""
    damages = found(name, spoilt.log)
    return [part for part in spoilt.where if not any(d.where.overlap(part) >= 0.5 for d in damages)]


@pytest.mark.parametrize(("severity", "least"), [(0.3, 6), (1.0, 8), (3.0, 8)])
@pytest.mark.parametrize("name", MINE)
def test_a_fault_is_found_where_it_struck(name, severity, least):
    logs = [drawn(seed) for seed in range(SEEDS)]

    spoilt = [struck(name, log, seed, severity=severity) for seed, log in enumerate(logs)]

    assert all(one.where for one in spoilt)
    assert sum(not missed(name, one) for one in spoilt) >= least


@pytest.mark.parametrize("period", [0.02, 0.005])
@pytest.mark.parametrize("seed", range(2 * len(MECHANISMS)))
def test_a_clean_log_comes_out_clean(seed, period):
    log = drawn(seed, period=period)

    assert [damage for name in MINE for damage in found(name, log)] == []
