"""Where in its free play a run began: no log says so, and how it went on does."""

import numpy as np
import pytest
from reconcile_made import recorded

from sim.core.log import Log
from sim.estimation.likelihood import PredictionErrorProblem
from sim.estimation.model_structure import ModelStructure
from sim.estimation.run_nuisance import RunNuisance
from sim.estimation.run_records import make_run_records
from sim.physics.engine import State
from sim.physics.model import Model, Part
from sim.reconcile import reconcile
from sim.reconcile.backlash_phase import estimate_backlash_phase

GAINS = {"kS": 0.2, "kV": 2.4, "kA": 0.3}
SLACK, SHARE = 0.05, 0.2
JOINT = {"slack": SLACK, "share": SHARE, "damping": 0.3, "motor_friction": SHARE}
PLAY = Part("backlash", JOINT)
NOISE = (1e-4, 2e-3)  # [m] and [m/s]
BEGAN = {
    "quasistatic-forward": (-1.0, -1.0),
    "quasistatic-reverse": (1.0, 0.0),
    "dynamic-forward": (-1.0, 1.0),
    "dynamic-reverse": (0.5, -0.5),
}
"""Test -> where in the play its run began, in the log and in its validation."""
PLAYS = ModelStructure("simple") + "backlash"
OWN = {f"backlash.{name}": value for name, value in JOINT.items()}
VALUES = {**GAINS, **OWN}


def session(which, *, step, seed):
    """Four tests whose runs begin where ``BEGAN`` says."""
    return begun_at([places[which] for places in BEGAN.values()], step=step, seed=seed)


def begun_at(places, *, step, seed):
    """Four tests whose runs begin at places of their play."""
    rng = np.random.default_rng(seed)
    model = Model("simple", GAINS, (PLAY,))
    runs, clock = [], 0.0
    for test, place in zip(BEGAN, places, strict=True):
        load = -0.5 * SLACK * place
        begun = {"state": State(np.array([0.0, 0.0, load, 0.0, 0.0])), "began": clock, "still": 3}
        runs.append(recorded(test, model, step=step, noise=NOISE, rng=rng, **begun))
        clock = float(runs[-1].time[-1]) + 2.0
    return Log(tuple(runs), units="meters", type="simple")


@pytest.fixture(scope="module")
def problem():
    return PredictionErrorProblem.from_records(make_run_records(session(0, step=4.0, seed=1)))


def at(problem, structure=PLAYS, nuisance=None):
    begun = nuisance or RunNuisance.at_first_samples(len(problem.records))
    values = {name: VALUES[name] for name in structure.names}
    return problem.evaluate(structure, values, begun, problem.noise.velocity**2)


def test_each_run_is_begun_where_it_went_on_from(problem):
    blind = at(problem)

    seen = estimate_backlash_phase(problem, blind)

    assert seen.cost < blind.cost - 100.0
    assert seen.nuisance.backlash_phase == pytest.approx(
        [one for one, _ in BEGAN.values()], abs=0.2
    )


def test_play_is_named_wherever_its_runs_began_and_the_gap_closes():
    story = reconcile(
        session(0, step=4.0, seed=1),
        validation=session(1, step=3.0, seed=2),
        held_out=session(1, step=3.5, seed=3),
        type="simple",
    )

    (found,) = (one for one in story.findings if one.size == "major")
    assert found.effect == "backlash"
    assert found.parameters["slack"].value == pytest.approx(SLACK, rel=0.1)
    assert story.gap_after < 1.3 * story.noise_floor
