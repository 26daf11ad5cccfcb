"""A push that goes to and fro in time is told from noise, and from a habit of places."""

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
from sim.reconcile.local_minimum import minimize_fully
from sim.reconcile.residual_tests.spectrum import (
    find_spectral_peak,
)
from sim.reconcile.residual_tests.summary import ResidualSummary
from sim.reconcile.selection_round import SelectionRound
from sim.reconcile.thresholds import PERIODIC
from sim.reconcile.verdict import reach_verdict

GAINS = {"kS": 0.3, "kV": 0.5, "kA": 0.05}
NOISE = (1e-3, 1e-2)  # [m] and [m/s]
TESTS = ("quasistatic-forward", "quasistatic-reverse", "dynamic-forward", "dynamic-reverse")
SHAKES = 0.06  # [V] in every sample, which no log shows
SWING = 0.3  # [V]


def session(*parts, seed, swings=0.0, size=SWING):
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


def found(log):
    """The clearest rhythm in what the best model without effects leaves."""
    problem, point = based(log, GAINS)
    point = minimize_fully(problem, point)
    return problem, point, find_spectral_peak(problem, point)


@settings(max_examples=12, deadline=None)
@given(seed=st.integers(0, 10**6))
def test_shakes_have_no_rhythm(seed):
    _, _, rhythm = found(session(seed=seed))

    assert rhythm.size < 0.2 * PERIODIC


@settings(max_examples=12, deadline=None)
@given(seed=st.integers(0, 10**6), swings=st.floats(0.6, 4.5))
def test_a_swing_is_found_at_its_rate_though_it_passes_for_pushes_at_random(seed, swings):
    problem, point, rhythm = found(session(seed=seed, swings=swings))

    assert rhythm.size > PERIODIC
    assert rhythm.rate == pytest.approx(swings, abs=0.15)
    assert point.process_noise > problem.noise.velocity**2
    assert ResidualSummary.summarize(problem, point).is_periodic


def test_a_wave_along_the_way_is_told_as_a_habit_of_places():
    wave = Part("cogging", {"cosine": 0.25, "sine": 0.0, "turns": 3.0})

    left = ResidualSummary.summarize(*found(session(wave, seed=2))[:2])

    assert left.is_repeated
    assert "At the same places" in remains_of(left)[2]


def remains_of(left):
    """The verdict on a model that leaves that, and follows else."""
    problem, point = based(session(seed=6), GAINS)
    gap = Gap(problem.noise.velocity, problem.noise.position)
    done = [SelectionRound.make_base(score_estimate(problem, point), gap)]
    return reach_verdict([], done, problem, residuals=left, unit=find_unit("meters"))
