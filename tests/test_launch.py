"""What a launch shows of slipping wheels, without a model: a speed that falls, or waits."""

from dataclasses import replace

import numpy as np
import pytest

from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.log import Log, Run
from sim.inspect.detect_faults import inspect
from sim.inspect.faults import FAULTS
from sim.inspect.launch import find_launch_event, find_step_start
from sim.inspect.log_features import LogFeatures

TIME = np.arange(0.0, 2.5, 0.005)
PLAIN = 3.0 * (1.0 - np.exp(-TIME / 0.15))


def run_of(speed, *, volts=6.0, noise=0.0):
    """A forward step whose speed is given; position and velocity are of it."""
    shaken = speed + noise * np.random.default_rng(2).standard_normal(speed.size)
    steps = np.concatenate(([0.0], 0.005 * np.cumsum(0.5 * (speed[1:] + speed[:-1]))))
    volts = np.broadcast_to(np.asarray(volts, dtype=float), TIME.shape)
    return Run("dynamic-forward", TIME, volts, steps, shaken)


def dented(depth, *, at=0.3, wide=0.05):
    return PLAIN * (1.0 - depth * np.exp(-0.5 * ((TIME - at) / wide) ** 2))


def waiting():
    """Up to 80 % at once, on from there after 0.4 s: the two speeds of wheels and robot."""
    wheels = 0.8 * 3.0 * (1.0 - np.exp(-TIME / 0.03))
    robot = 3.0 - 0.6 * np.exp(-np.maximum(TIME - 0.4, 0.0) / 0.1)
    return np.where(TIME < 0.4, wheels, robot)


def test_a_plain_rise_is_no_event():
    assert find_launch_event(run_of(PLAIN)) is None


@pytest.mark.parametrize("noise", [0.0, 0.3])
def test_a_speed_that_falls_and_recovers_is_an_event(noise):
    event = find_launch_event(run_of(dented(0.4), noise=noise))

    assert event.kind == "fall"
    assert event.size == pytest.approx(0.26, abs=0.04)  # 2.12 m/s, then 1.56 m/s
    assert TIME[event.end] == pytest.approx(0.3, abs=0.05)


def test_a_speed_that_waits_and_climbs_on_is_an_event():
    event = find_launch_event(run_of(waiting()))

    assert event.kind == "wait"
    assert event.size == pytest.approx(0.2, abs=0.03)
    assert 0.2 < TIME[event.end] < 0.45


NO_EVENTS = {
    "a small fall": lambda: run_of(dented(0.1)),
    "a fall that the voltage explains": lambda: run_of(
        dented(0.4), volts=6.0 - 3.0 * (np.abs(TIME - 0.27) < 0.08)
    ),
    "a fall as there are later, too": lambda: run_of(
        PLAIN * (1.0 - 0.3 * (np.sin(9.0 * TIME) ** 8))
    ),
    "slack that is taken up": lambda: run_of(
        PLAIN + 0.7 * np.exp(-0.5 * ((TIME - 0.01) / 0.004) ** 2)
    ),
    "a load that goes on to change": lambda: run_of(PLAIN * (0.8 + 0.12 * TIME)),
    "no launch to speak of": lambda: replace(
        Run("dynamic-forward", TIME[:150], np.full(150, 6.0), PLAIN[:150], PLAIN[:150])
    ),
    "standstill": lambda: run_of(np.zeros(TIME.size)),
}


@pytest.mark.parametrize("why", NO_EVENTS)
def test_ordinary_run_has_no_launch_event(why):
    assert find_launch_event(NO_EVENTS[why]()) is None


def test_a_step_begins_where_its_voltage_stays():
    volts = np.where(TIME < 1.0, 0.0, 6.0)
    volts[0] = 6.0  # what the test before left behind

    assert TIME[find_step_start(run_of(PLAIN, volts=volts))] == pytest.approx(1.0)


def test_wheels_slip_on_a_floor_and_nowhere_else():
    event = run_of(dented(0.4))

    def found(**about):
        return list(FAULTS["wheel-slip"].detect(LogFeatures(Log((event,), **about))))

    assert [one.fault for one in found(units="meters")] == ["wheel-slip"]
    assert "half the step, 3.0 V" in found(units="meters")[0].advice
    assert found(units="radians", mechanism="Drivetrain")
    assert not found(units="radians")
    assert not found(units="meters", type="elevator")


@pytest.mark.parametrize("seed", range(8))
def test_no_launch_of_the_bench_is_an_event(seed):
    rng = np.random.default_rng(seed)
    period = (0.02, 0.005)[seed % 2]
    log = simulate(MECHANISMS["drivetrain"].draw(rng), Routine(), rng=rng, period=period)

    assert [find_launch_event(run) for run in log.runs if run.kind == "dynamic"] == [None, None]
    assert inspect(log).is_clean
