"""What a fit leaves: whether it repeats, and whether it has a rhythm."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from reconcile_made import based, recorded

from sim.core.log import Log
from sim.core.units import find_unit
from sim.physics.engine import State
from sim.physics.model import Model, Part
from sim.reconcile.candidates import score_estimate
from sim.reconcile.cross_validation import Gap
from sim.reconcile.local_minimum import minimize, minimize_fully
from sim.reconcile.residual_tests.repeatability import RepeatedResidual, find_repeated_residual
from sim.reconcile.residual_tests.spectrum import find_spectral_peak
from sim.reconcile.residual_tests.summary import ResidualSummary
from sim.reconcile.selection_round import SelectionRound
from sim.reconcile.thresholds import PERIODIC, REPEATED
from sim.reconcile.verdict import reach_verdict

GAINS = {"kS": 0.3, "kV": 0.5, "kA": 0.05}
NOISE = (1e-3, 1e-2)  # [m] and [m/s]
TESTS = ("quasistatic-forward", "quasistatic-reverse", "dynamic-forward", "dynamic-reverse")
SHAKES = 0.06  # [V] in every sample, which no log shows


def session(*parts, seed, tests=TESTS):
    """Two rounds of tests from zero, each run with a friction and shakes of its own."""
    rng = np.random.default_rng(seed)
    runs, clock = [], 0.0
    for test in (*tests, *tests):
        friction = GAINS["kS"] * (1.0 + 0.05 * rng.standard_normal())
        model = Model("simple", {**GAINS, "kS": friction}, parts)
        begun = {"state": State.cold_at(0.0), "began": clock}
        run = recorded(test, model, step=4.0, noise=NOISE, rng=rng, **begun)
        runs.append(replace(run, voltage=run.voltage + SHAKES * rng.standard_normal(len(run))))
        clock = float(run.time[-1]) + 2.0
    return Log(tuple(runs), units="meters", type="simple")


def found(log):
    """What runs miss alike of a model without effects, as it follows best."""
    problem, point = based(log, GAINS)
    return problem, find_repeated_residual(problem, minimize(problem, point))


@settings(max_examples=12, deadline=None)
@given(seed=st.integers(0, 10**6))
def test_friction_and_noise_that_differ_by_run_are_not_repeatable(seed):
    _, alike = found(session(seed=seed))

    assert alike.size < REPEATED


def test_wave_along_the_position_is_repeatable_by_position():
    wave = Part("cogging", {"cosine": 0.25, "sine": 0.0, "turns": 3.0})

    _, alike = found(session(wave, seed=2))

    assert alike.size > REPEATED
    assert alike.what == "position"


def test_local_force_is_found_at_its_position():
    log = session(seed=3)
    bumpy = [
        replace(run, velocity=run.velocity + 0.5 * np.exp(-(((run.position - 2.0) / 0.3) ** 2)))
        for run in log.runs
    ]

    problem, alike = found(replace(log, runs=tuple(bumpy)))

    assert alike.size > REPEATED
    assert (alike.what, alike.way) == ("position", 1)
    assert alike.high > 1.6
    assert alike.low < 2.4
    assert alike.high - alike.low < 0.1 * np.ptp(problem.measured[:, 0])


def test_friction_that_fades_with_speed_is_repeatable_by_velocity():
    _, alike = found(session(Part("stribeck", {"extra": 0.6, "slow": 0.6}), seed=4))

    assert alike.size > REPEATED
    assert alike.what == "speed"


@pytest.mark.parametrize("count", [1, 2])
def test_single_run_has_no_repeatable_residual(count):
    log = session(seed=5)
    one = replace(log, runs=log.runs[:count])  # one of them forward, one in reverse

    _, alike = found(one)

    assert alike == RepeatedResidual(what=alike.what)


SWING = 0.3  # [V]


def rhythm_session(*parts, seed, swings=0.0, size=SWING):
    """Two rounds of tests, each run shaken; and pushed to and fro so many times a second."""
    rng = np.random.default_rng(seed)
    runs, clock = [], 0.0
    for test in (*TESTS, *TESTS):
        model = Model("simple", GAINS, parts)
        run = recorded(test, model, step=4.0, noise=NOISE, rng=rng, state=State.cold_at(0.0))
        run = replace(run, time=clock + run.time)
        hidden = SHAKES * rng.standard_normal(len(run))
        hidden += size * np.sin(2.0 * np.pi * swings * run.time)
        runs.append(replace(run, voltage=run.voltage + hidden))  # the motor did not get it
        clock = float(run.time[-1]) + 2.0
    return Log(tuple(runs), units="meters", type="simple")


def find_peak(log):
    """The clearest rhythm in what the best model without effects leaves."""
    problem, point = based(log, GAINS)
    point = minimize_fully(problem, point)
    return problem, point, find_spectral_peak(problem, point)


@settings(max_examples=12, deadline=None)
@given(seed=st.integers(0, 10**6))
def test_random_forces_have_no_spectral_line(seed):
    _, _, rhythm = find_peak(rhythm_session(seed=seed))

    assert rhythm.size < 0.2 * PERIODIC


@settings(max_examples=12, deadline=None)
@given(seed=st.integers(0, 10**6), swings=st.floats(0.6, 4.5))
def test_oscillation_is_found_at_its_frequency_though_process_noise_could_explain_it(seed, swings):
    problem, point, rhythm = find_peak(rhythm_session(seed=seed, swings=swings))

    assert rhythm.size > PERIODIC
    assert rhythm.rate == pytest.approx(swings, abs=0.15)
    assert point.process_noise > problem.noise.velocity**2
    assert ResidualSummary.summarize(problem, point).is_periodic


def test_a_wave_along_the_position_is_reported_as_repeated_by_place():
    wave = Part("cogging", {"cosine": 0.25, "sine": 0.0, "turns": 3.0})

    left = ResidualSummary.summarize(*find_peak(rhythm_session(wave, seed=2))[:2])

    assert left.is_repeated
    assert "At the same places" in remains_of(left)[2]


def remains_of(left):
    """The verdict on a model that leaves that, and follows else."""
    problem, point = based(rhythm_session(seed=6), GAINS)
    gap = Gap(problem.noise.velocity, problem.noise.position)
    done = [SelectionRound.make_base(score_estimate(problem, point), gap)]
    return reach_verdict([], done, problem, residuals=left, unit=find_unit("meters"))
