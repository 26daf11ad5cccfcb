"""The delay of velocity against position is found whatever the scale, and none is made up."""

from dataclasses import replace

import numpy as np
import pytest

from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.physics.velocity_lag import estimate_velocity_lag

GENTLE = Routine(ramp=0.5, step=3.5)


def bench(name="drivetrain", *, period=0.005, seed=1):
    rng = np.random.default_rng(seed)
    return simulate(MECHANISMS[name].draw(rng), GENTLE, rng=rng, period=period)


def each(log, change):
    return replace(log, runs=tuple(change(run) for run in log.runs))


def late(run, *, by):
    return replace(run, velocity=np.interp(run.time - by, run.time, run.velocity))


def averaged(run, *, window):
    """The velocity as a controller averages it: the way gone in a window, over the window."""
    past = np.interp(run.time - window, run.time, run.position)
    return replace(run, velocity=(run.position - past) / window)


def held(run, n):
    """A new frame of the sensor only every ``n`` samples."""
    latest = np.arange(len(run)) // n * n
    return replace(run, position=run.position[latest], velocity=run.velocity[latest])


@pytest.mark.parametrize("lag", [0.0, 0.03, 0.112, 0.2])
@pytest.mark.parametrize("period", [0.02, 0.005])
@pytest.mark.parametrize("name", MECHANISMS)
def test_a_planted_delay_is_found_to_five_milliseconds(name, period, lag):
    log = each(bench(name, period=period), lambda run: late(run, by=lag))

    assert estimate_velocity_lag(log.runs).lag == pytest.approx(lag, abs=0.005)


def test_an_average_is_a_delay_of_half_its_window():
    log = each(bench(), lambda run: averaged(run, window=0.1))

    assert estimate_velocity_lag(log.runs).lag == pytest.approx(0.05, abs=0.005)


def test_frames_that_repeat_do_not_bend_the_delay():
    log = each(bench(), lambda run: held(late(run, by=0.06), 4))

    assert estimate_velocity_lag(log.runs).lag == pytest.approx(0.06, abs=0.006)


def test_runs_that_disagree_have_a_large_error():
    log = bench()
    spread = replace(log, runs=tuple(late(run, by=0.03 * i) for i, run in enumerate(log.runs)))

    assert estimate_velocity_lag(log.runs).error < 0.003
    assert estimate_velocity_lag(spread.runs).error > 0.01
    assert np.isnan(estimate_velocity_lag(log.runs[:1]).error)
