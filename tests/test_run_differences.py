"""Runs that differ, by the age of their frames or by friction: gains are found all the same."""

import math
from dataclasses import replace

import numpy as np
import pytest

from sim.bench.mechanisms import MECHANISMS
from sim.bench.recorder import RECORDERS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.log import Run
from sim.estimation.measurements import measure_runs
from sim.estimation.model_structure import ModelStructure
from sim.fit import fit
from sim.fit.run_differences import fit_run_differences
from sim.fit.search import fit_tracking, make_fit_problem
from sim.physics.engine import NO_CORRECTION, RunBatch, filter_runs
from sim.physics.model import Model, Part

GAINS = {"kS": 0.2, "kV": 2.0, "kA": 0.3}


def recorded(name, recorder, *, seed):
    device = RECORDERS[recorder]
    chance = np.random.default_rng([seed, 77])
    return simulate(device.record(MECHANISMS[name]), Routine(), rng=chance, period=device.period)


def simple_problem(log):
    problem = make_fit_problem(log, measure_runs(log, friction=None))
    truth = MECHANISMS["drivetrain"].gains
    return problem, fit_tracking(problem, ModelStructure("simple"), truth)


@pytest.mark.parametrize("late", [0.004, 0.03])
def test_a_run_with_a_lag_of_its_own_moves_as_a_model_with_a_delay(late):
    time = np.arange(0.0, 2.0, 0.02)
    still, count = np.zeros(1), time.size
    batch = RunBatch(
        edges=np.array([0.0, count]), time=time, voltage=3.0 * np.sin(4.0 * time),
        voltage_slide=np.zeros(count), measured=np.full((count, 2), np.nan), position=still,
        velocity=still, low=still - math.inf, high=still + math.inf, clocks=still,
        memory_groups=still,
    )  # fmt: skip

    def moved(model, lag):
        return filter_runs(
            model, batch, kalman_gain=NO_CORRECTION, position_offset=still, backlash_phase=still,
            friction_offset=still, lag_offset=np.array([lag]),
        )  # fmt: skip

    plain = Model("simple", GAINS)
    delayed = plain + Part("delay", {"lag": late})

    assert moved(plain, late) == pytest.approx(moved(delayed, 0.0), abs=1e-12)
    assert np.abs(moved(plain, late) - moved(plain, 0.0)).max() > 1e-3


@pytest.mark.parametrize("name", ["drivetrain", "swerve"])
def test_runs_that_are_late_by_different_frames_do_not_shift_static_friction(name):
    found = fit(recorded(name, "talonfx", seed=200))

    assert found.gains["kS"] == pytest.approx(MECHANISMS[name].gains["kS"], rel=0.003)
    assert found.gains["kA"] == pytest.approx(MECHANISMS[name].gains["kA"], rel=0.005)


def test_the_runs_differ_by_the_age_of_their_frames():
    log = recorded("drivetrain", "talonfx", seed=200)
    problem, point = simple_problem(log)

    extended, found = fit_run_differences(problem, point, every=problem, period=0.02)

    lags = found.values["delay.lag"] + found.nuisance.lag_offset
    assert extended.lag_sd == pytest.approx(0.02 / math.sqrt(12.0))
    assert np.all((lags > -0.002) & (lags < 0.022))
    assert np.ptp(lags) > 0.005  # the frames of this seed are 4 to 14 ms old


def test_a_frame_that_is_read_twice_is_not_compared():
    log = recorded("drivetrain", "roborio", seed=1)
    run = log.runs[2]
    seen = {"position": run.position.copy(), "velocity": run.velocity.copy()}
    for readings in seen.values():
        readings[101] = readings[100]
    repeated = replace(log, runs=(Run(run.test, run.time, run.voltage, **seen),))

    (measured,) = measure_runs(repeated, friction=None)

    assert np.flatnonzero(np.isnan(measured.measured).all(axis=1)).tolist() == [100, 101]


def frictions_by_run(name, shares, *, seed):
    """A log whose runs have frictions of their own, as shares of that of the mechanism."""
    mechanism = MECHANISMS[name]
    logs = [
        simulate(
            replace(mechanism, friction=mechanism.friction * share),
            Routine(),
            rng=np.random.default_rng([seed, number]),
        )
        for number, share in enumerate(shares)
    ]
    return replace(logs[0], runs=tuple(log.runs[number] for number, log in enumerate(logs)))


@pytest.mark.parametrize(("name", "seed"), [("drivetrain", 9), ("turret", 3), ("elevator", 5)])
def test_friction_that_differs_by_run_is_not_taken_for_lag(name, seed):
    shares = 1.0 + 0.04 * np.random.default_rng(seed).standard_normal(4)
    found = fit(frictions_by_run(name, shares, seed=seed), type=MECHANISMS[name].type)
    truth = MECHANISMS[name].friction

    assert abs(found.gains["kS"] - truth * shares.mean()) < 2.0 * found.errors["kS"]
    assert found.errors["kS"] > 0.008 * truth  # 4 % of four runs, of which the sample tells some
