"""What the catalogue of misconceptions says is true of the simulated robot, number by number."""

from dataclasses import replace

import numpy as np
import pytest

from grader.checks.misconception import MISCONCEPTIONS
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.errors import Refusal
from sim.fit import fit
from sim.physics.effects import EFFECTS

ROBOT = MECHANISMS["drivetrain"]


def recorded(*, step=2.0, seed=0, period=0.02, **sensor):
    routine = Routine(ramp=0.5, step=step, timeout=8.0)
    robot = replace(ROBOT, sensor=replace(ROBOT.sensor, **sensor))
    return simulate(robot, routine, rng=np.random.default_rng(seed), period=period)


def share(log, gain="kA", **how):
    """A gain that SysId's recipe finds in a log, over the true one."""
    return fit(log, method="sysid", **how).gains[gain] / ROBOT.gains[gain]


def test_a_long_median_makes_ka_too_small_and_an_average_too_large(reads):
    said = MISCONCEPTIONS["M-FILTER-FREE"].says
    reads(said)
    assert "Some sensors average the velocity" in said

    log = recorded()
    found = [share(log, median=window) for window in (1, 5, 9, 15)]

    assert found[0] == pytest.approx(1.0, abs=0.05)
    assert found == sorted(found, reverse=True)
    assert found[-1] < 0.6
    assert share(recorded(filter=0.224)) > 1.1  # [s] of a NEO's own encoder


def test_a_smaller_step_shows_ka_as_well_only_above_the_noise(reads):
    reads(MISCONCEPTIONS["M-BIG-STEP"].says)

    means = {
        step: np.mean([share(recorded(step=step, seed=seed)) for seed in range(4)])
        for step in (2.0, 1.0, 0.6)
    }

    assert means[2.0] == pytest.approx(1.0, abs=0.04)
    assert 1.05 < means[1.0] < 1.3
    assert means[0.6] > 1.4


def test_without_the_slow_forward_run_the_gains_are_right_and_sysid_refuses(reads):
    log = recorded()
    kept = tuple(run for run in log.runs if run.test != "quasistatic-forward")
    three = replace(log, runs=kept)

    found = fit(three).gains

    for gain, truth in ROBOT.gains.items():
        assert found[gain] == pytest.approx(truth, rel=0.02)
    with pytest.raises(Refusal, match="needs all four"):
        fit(three, method="sysid")
    reads(MISCONCEPTIONS["M-REVERSE-WASTE"].says)


def test_more_rows_of_the_same_readings_make_ka_smaller(reads):
    reads(MISCONCEPTIONS["M-MORE-ROWS"].says)

    found = [share(recorded(period=period, frame=0.02)) for period in (0.02, 0.005, 0.002)]

    assert found[0] == pytest.approx(1.0, abs=0.1)
    assert found == sorted(found, reverse=True)
    assert found[-1] < 0.3


def share_of_column(log):
    """The coefficient of a column of accelerations in a fit of the voltage, over the true kA."""
    v = np.concatenate([run.velocity for run in log.runs])
    a = np.concatenate([np.gradient(run.velocity, run.time) for run in log.runs])
    u = np.concatenate([run.voltage for run in log.runs])
    found, *_ = np.linalg.lstsq(np.column_stack((np.sign(v), v, a)), u, rcond=None)
    return found[2] / ROBOT.gains["kA"]


def test_noise_in_a_column_of_accelerations_makes_ka_too_small(reads):
    reads(MISCONCEPTIONS["M-NOISE-AVERAGES"].says)

    means = [
        np.mean([share_of_column(recorded(velocity_noise=noise, seed=n)) for n in range(4)])
        for noise in (0.005, 0.02, 0.04)  # [m/s]
    ]

    assert means == sorted(means, reverse=True)
    assert means[0] < 1.0
    assert means[-1] < 0.3


def test_noise_makes_the_ka_of_sysids_regression_too_large():
    means = [
        np.mean([share(recorded(velocity_noise=noise, seed=seed)) for seed in range(4)])
        for noise in (0.005, 0.02, 0.04)  # [m/s]
    ]

    assert means[0] == pytest.approx(1.0, abs=0.03)
    assert means == sorted(means)
    assert means[-1] > 1.5


def test_a_heavier_robot_needs_more_ka_and_no_more_ks_by_itself(reads):
    reads(MISCONCEPTIONS["M-HEAVIER-MORE-KS"].says)

    light, heavy = (
        fit(simulate(replace(ROBOT, load=mass), Routine(), rng=np.random.default_rng(0))).gains
        for mass in (50.0, 70.0)
    )

    assert heavy["kS"] == pytest.approx(light["kS"], rel=0.02)
    assert heavy["kV"] == pytest.approx(light["kV"], rel=0.01)
    assert heavy["kA"] > 1.3 * light["kA"]


def test_drag_means_air_drag_and_no_grease_or_belt(reads):
    looks = EFFECTS["drag"].inspect

    assert looks.startswith("Check whether a part moves air")
    reads(looks)
