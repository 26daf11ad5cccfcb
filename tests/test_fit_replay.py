"""Measured against simulated: what is left is the sensor's noise, and a wrong gain shows."""

from dataclasses import replace

import numpy as np
import pytest

from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.errors import BadRequest
from sim.fit import fit
from sim.fit.replay import replay_fit

GENTLE = Routine(ramp=0.5, step=3.5, timeout=6.0)
KINDS = ("drivetrain", "arm", "elevator")


@pytest.fixture(scope="module", params=KINDS)
def bench(request):
    """A log of the bench, and its fit."""
    log = simulate(MECHANISMS[request.param], GENTLE, rng=np.random.default_rng(3))
    return log, fit(log)


def rms(one):
    return float(np.sqrt(np.mean(one.velocity_error[one.moving] ** 2)))


def test_residual_of_the_replay_is_the_sensor_noise(bench):
    log, found = bench

    runs = replay_fit(found, log)

    assert [one.run.test for one in runs] == [run.test for run in log.runs]
    for one in runs:
        assert 0.7 < rms(one) / one.velocity_noise < 1.3
        inside = np.abs(one.velocity_error) < 1.96 * one.velocity_noise
        assert inside.mean() > 0.9


def test_the_lag_that_was_found_is_simulated_along():
    mechanism = MECHANISMS["drivetrain"]
    slow = replace(mechanism, sensor=replace(mechanism.sensor, filter=0.12))
    log = simulate(slow, GENTLE, rng=np.random.default_rng(5))
    found = fit(log)
    step = [run.test for run in log.runs].index("dynamic-forward")

    with_it = replay_fit(found, log)[step]
    without = replay_fit(replace(found, velocity_delay=0.0, position_delay=0.0), log)[step]

    assert found.velocity_delay == pytest.approx(0.06, abs=0.01)
    assert rms(with_it) < 1.3 * with_it.velocity_noise
    assert rms(without) > 3.0 * rms(with_it)


def test_log_with_reversed_sign_is_simulated_with_its_own_sign():
    log = simulate(MECHANISMS["drivetrain"], GENTLE, rng=np.random.default_rng(3))
    runs = tuple(replace(run, voltage=-run.voltage) for run in log.runs)
    turned = replace(log, runs=runs)

    one = replay_fit(fit(turned), turned)[0]

    assert rms(one) < 1.3 * one.velocity_noise


@pytest.mark.parametrize("gain", ["kV", "kA"])
def test_gains_that_move_nothing_are_refused(bench, gain):
    log, found = bench

    with pytest.raises(BadRequest, match="a gain is negative"):
        replay_fit(replace(found, gains={**found.gains, gain: -0.1}), log)


def test_runs_too_short_to_compare_are_left_out(bench):
    log, found = bench
    stub = log.runs[0]
    stub = replace(
        stub, **{name: getattr(stub, name)[:3] for name in ("time", "voltage", "position")},
        velocity=stub.velocity[:3], current=None, bus_voltage=None,
    )  # fmt: skip

    assert replay_fit(found, replace(log, runs=(stub,))) == ()
    assert len(replay_fit(found, replace(log, runs=(stub, *log.runs)))) == len(log.runs)
