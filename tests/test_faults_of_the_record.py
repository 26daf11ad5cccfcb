"""Faults of the record: each is struck at random and found again, and clean logs stay clean.

What each is, its module says. What all faults have in common is tested in ``test_faults.py``.
"""

from dataclasses import replace

import numpy as np
import pytest
from handmade import each

from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.inspect.contaminate import contaminate
from sim.inspect.faults import FAULTS
from sim.inspect.log_features import LogFeatures

LESSON = Routine(ramp=0.5, step=3.5)
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
SEEDS = 8  # logs; the share of many is in the table of test_faults.py


def drawn(seed, *, period=0.02):
    """A clean log of some mechanism."""
    rng = np.random.default_rng(seed)
    name = tuple(MECHANISMS)[seed % len(MECHANISMS)]
    built = MECHANISMS[name].draw(rng)
    return simulate(built, LESSON, rng=rng, period=period)


def struck(name, log, seed, *, severity=1.0):
    """The log with one fault, somewhere it may strike."""
    rng = np.random.default_rng(seed + 1000)
    return contaminate(log, name, severity=severity, rng=rng)


def found(name, log):
    return list(FAULTS[name].detect(LogFeatures(log)))


def missed(name, spoilt):
    """The damaged parts that the detective did not find."""
    damages = found(name, spoilt.log)
    return [part for part in spoilt.where if not any(d.where.overlap(part) >= 0.5 for d in damages)]


@pytest.mark.parametrize(("severity", "least"), [(0.3, 6), (3.0, 8)])
@pytest.mark.parametrize("name", MINE)
def test_a_fault_is_found_where_it_struck(name, severity, least):
    logs = [drawn(seed) for seed in range(SEEDS)]

    spoilt = [struck(name, log, seed, severity=severity) for seed, log in enumerate(logs)]

    assert all(one.where for one in spoilt)
    assert sum(not missed(name, one) for one in spoilt) >= least


def names(log):
    return {damage.fault for name in MINE for damage in found(name, log)}


def recorded(name, seed=1, *, period=0.02):
    rng = np.random.default_rng(seed)
    return simulate(MECHANISMS[name].draw(rng), LESSON, rng=rng, period=period)


def coarse(run, step):
    """A velocity in steps, which repeats itself because it is coarse."""
    return replace(run, velocity=np.round(run.velocity / step) * step)


def test_a_coarse_velocity_is_not_a_stale_one():
    log = each(recorded("drivetrain"), lambda run: coarse(run, 0.1))

    assert np.mean(np.diff(log.runs[0].velocity) == 0.0) > 0.5
    assert names(log) == set()


def test_motion_against_the_voltage_by_weight_is_no_sign_error():
    # an elevator that 0.5 V cannot lift: it sinks, in the forward test as in the reverse one
    log = recorded("elevator")
    forward, reverse = (
        log.list_runs_of_test("dynamic-forward")[0],
        log.list_runs_of_test("dynamic-reverse")[0],
    )
    sinks = replace(reverse, test="dynamic-forward", velocity=reverse.velocity * 0.2)
    sinks = replace(
        sinks,
        voltage=np.full(len(sinks), 0.5),
        position=reverse.position[0] + (reverse.position - reverse.position[0]) * 0.2,
    )

    log = replace(log, runs=tuple(sinks if run is forward else run for run in log.runs))

    assert found("sign-flip", log) == []


def test_a_turning_flywheel_whose_log_says_meters_is_a_wrong_unit():
    found_once = found("unit-error", replace(recorded("shooter"), units="meters"))

    assert found_once
    assert "nothing on an FRC robot" in found_once[0].evidence
    assert found("unit-error", recorded("shooter")) == []
