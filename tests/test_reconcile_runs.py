"""What is each run's own: its record, its friction, where in its play it began."""

import math

import numpy as np
import pytest
from reconcile_made import recorded, rubbing

from sim.core.log import Log, Run
from sim.estimation.likelihood import PredictionErrorProblem
from sim.estimation.model_structure import ModelStructure
from sim.estimation.random_friction import get_friction_sd
from sim.estimation.run_nuisance import RunNuisance
from sim.estimation.run_records import make_run_records
from sim.estimation.run_variation import compute_standard_errors
from sim.physics.engine import State
from sim.physics.model import Model, Part
from sim.reconcile import reconcile
from sim.reconcile.backlash_phase import estimate_backlash_phase
from sim.reconcile.cross_validation import compute_open_loop_errors, compute_rms_gap
from sim.reconcile.local_minimum import minimize, minimize_fully

TIME = np.arange(0.0, 4.0, 0.02)
ROUGH = 6e-4  # [m]


def record(way, *, rough=ROUGH):
    noise = rough * np.random.default_rng(7).standard_normal(TIME.size)
    position = 0.16 + way + noise
    position[0] = 0.16
    run = Run("quasistatic-forward", TIME, TIME, position, np.gradient(way, TIME))
    (only,) = make_run_records(Log((run,), units="meters"))
    return only


def lifted(sunk):
    """(n,) [m] that sinks in the first second, waits, and is lifted by 6 m."""
    sinks = -sunk * np.clip(TIME, 0.0, 1.0)
    return sinks + np.where(TIME > 1.5, 6.0 * np.clip((TIME - 1.5) / 2.5, 0.0, 1.0) ** 2, 0.0)


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_mechanism_that_does_not_move_is_on_its_stop(way):
    found = record(way * lifted(0.0))

    assert (found.low if way > 0.0 else found.high) == 0.16
    assert math.isinf(found.high if way > 0.0 else found.low)


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_mechanism_that_sinks_a_little_has_its_stop_there(way):
    found = record(way * lifted(0.05))

    stop = found.low if way > 0.0 else found.high
    assert stop == pytest.approx(0.16 - way * 0.05, abs=5.0 * ROUGH)


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_mechanism_that_sinks_far_has_no_stop(way):
    found = record(way * lifted(0.3))

    assert math.isinf(found.low)
    assert math.isinf(found.high)


@pytest.mark.parametrize("way", [1.0, -1.0])
@pytest.mark.parametrize(("beyond", "stops"), [(0.02, False), (0.0, True)])
def test_position_that_the_mechanism_later_passes_is_no_stop(way, beyond, stops):
    there = 3.0 * np.sin(np.clip((TIME - 0.5) / 2.5, 0.0, 1.0) * np.pi)
    found = record(way * (there - beyond * np.clip(TIME - 3.0, 0.0, 1.0)))

    assert math.isfinite(found.low if way > 0.0 else found.high) == stops


GAINS = {"kS": 0.5, "kV": 0.5, "kA": 0.05}
NOISE = (1e-3, 1e-2)  # [m] and [m/s]
SHARES = (1.06, 0.95, 0.98, 1.04)  # [1] of the friction that each run has


def session(shares, *parts, step=4.0, seed=0):
    log = rubbing(GAINS, shares, *parts, noise=NOISE, step=step, seed=seed)
    return PredictionErrorProblem.from_records(make_run_records(log))


def begun(problem, *effects, **values):
    structure = ModelStructure("simple", effects)
    nuisance = RunNuisance.at_first_samples(len(problem.records))
    return problem.evaluate(structure, {**GAINS, **values}, nuisance, problem.noise.velocity**2)


def test_friction_of_each_run_is_found_and_does_not_bias_the_gains():
    problem = session(SHARES)

    found = minimize(problem, begun(problem))

    assert found.values == pytest.approx(GAINS, rel=0.03)
    frictions = (found.values["kS"] + found.nuisance.friction_offset) / GAINS["kS"]
    assert frictions == pytest.approx(SHARES, abs=0.01)
    assert float(np.mean(found.nuisance.friction_offset)) == pytest.approx(
        0.0, abs=1e-3
    )  # kS is their mean


def test_standard_errors_include_friction_that_differs_by_run():
    """Of kS, which four runs with a twenty-fifth more or less each do not tell to a thousandth."""
    truths, errors = [], []
    for seed in range(12):
        rng = np.random.default_rng(seed)
        problem = session(1.0 + 0.04 * rng.standard_normal(4), seed=seed)
        found = minimize(problem, begun(problem))
        truths.append(found.values["kS"] - GAINS["kS"])
        errors.append(compute_standard_errors(problem, found)["kS"])

    off = np.abs(truths) / np.array(errors)

    assert np.mean(off < 2.0) > 0.7
    assert np.mean(off < 0.05) < 0.3  # nor are they far too large
    assert np.median(errors) == pytest.approx(0.04 * GAINS["kS"] / 2.0, rel=0.3)


@pytest.mark.parametrize("share", [0.93, 0.97, 1.02, 1.055, 1.1])
def test_gap_uses_the_friction_of_each_run_between_tried_values(share):
    problem = session((share,) * 4)
    point = begun(problem)

    plain = compute_rms_gap(compute_open_loop_errors(problem, point, point.nuisance)).velocity
    eased = compute_rms_gap(
        compute_open_loop_errors(problem, point, point.nuisance, own_friction=True)
    ).velocity

    assert eased == pytest.approx(NOISE[1], rel=0.05)
    assert plain > 1.02 * eased


def test_search_finds_run_friction_together_with_an_effect():
    wave = {"cosine": 0.12, "sine": 0.05, "turns": 3.0}
    problem = session(SHARES, Part("cogging", wave))
    values = {f"cogging.{name}": value for name, value in wave.items()}

    found = minimize_fully(problem, begun(problem, "cogging", **values))

    assert found.values["cogging.cosine"] == pytest.approx(wave["cosine"], abs=0.01)
    frictions = (found.values["kS"] + found.nuisance.friction_offset) / GAINS["kS"]
    assert frictions == pytest.approx(SHARES, abs=0.015)
    assert get_friction_sd(found.values) == pytest.approx(0.02, rel=0.05)


PLAY_GAINS = {"kS": 0.2, "kV": 2.4, "kA": 0.3}
SLACK, SHARE = 0.05, 0.2
JOINT = {"slack": SLACK, "share": SHARE, "damping": 0.3, "motor_friction": SHARE}
PLAY = Part("backlash", JOINT)
PLAY_NOISE = (1e-4, 2e-3)  # [m] and [m/s]
BEGAN = {
    "quasistatic-forward": (-1.0, -1.0),
    "quasistatic-reverse": (1.0, 0.0),
    "dynamic-forward": (-1.0, 1.0),
    "dynamic-reverse": (0.5, -0.5),
}
"""Test -> where in the play its run began, in the log and in its validation."""
PLAYS = ModelStructure("simple") + "backlash"
OWN = {f"backlash.{name}": value for name, value in JOINT.items()}
VALUES = {**PLAY_GAINS, **OWN}


def play_session(which, *, step, seed):
    """Four tests whose runs begin where ``BEGAN`` says."""
    return begun_at([places[which] for places in BEGAN.values()], step=step, seed=seed)


def begun_at(places, *, step, seed):
    """Four tests whose runs begin at places of their play."""
    rng = np.random.default_rng(seed)
    model = Model("simple", PLAY_GAINS, (PLAY,))
    runs, clock = [], 0.0
    for test, place in zip(BEGAN, places, strict=True):
        load = -0.5 * SLACK * place
        begun = {"state": State(np.array([0.0, 0.0, load, 0.0, 0.0])), "began": clock, "still": 3}
        runs.append(recorded(test, model, step=step, noise=PLAY_NOISE, rng=rng, **begun))
        clock = float(runs[-1].time[-1]) + 2.0
    return Log(tuple(runs), units="meters", type="simple")


@pytest.fixture(scope="module")
def problem():
    return PredictionErrorProblem.from_records(make_run_records(play_session(0, step=4.0, seed=1)))


def at(problem, structure=PLAYS, nuisance=None):
    begun = nuisance or RunNuisance.at_first_samples(len(problem.records))
    values = {name: VALUES[name] for name in structure.names}
    return problem.evaluate(structure, values, begun, problem.noise.velocity**2)


def test_backlash_phase_of_each_run_is_estimated(problem):
    blind = at(problem)

    seen = estimate_backlash_phase(problem, blind)

    assert seen.cost < blind.cost - 100.0
    assert seen.nuisance.backlash_phase == pytest.approx(
        [one for one, _ in BEGAN.values()], abs=0.2
    )


def test_backlash_is_named_wherever_in_the_play_its_runs_began():
    story = reconcile(
        play_session(0, step=4.0, seed=1),
        validation=play_session(1, step=3.0, seed=2),
        held_out=play_session(1, step=3.5, seed=3),
        type="simple",
    )

    (found,) = (one for one in story.findings if one.size == "major")
    assert found.effect == "backlash"
    assert found.parameters["slack"].value == pytest.approx(SLACK, rel=0.1)
    assert story.gap_after < 1.3 * story.noise_floor
