"""Friction that is each run's own: found beside what all runs have, and no finding."""

import numpy as np
import pytest
from reconcile_made import rubbing

from sim.estimation.likelihood import PredictionErrorProblem
from sim.estimation.model_structure import ModelStructure
from sim.estimation.random_friction import get_friction_sd
from sim.estimation.run_nuisance import RunNuisance
from sim.estimation.run_records import make_run_records
from sim.estimation.run_variation import compute_standard_errors
from sim.physics.model import Part
from sim.reconcile.cross_validation import (
    compute_open_loop_errors,
    compute_rms_gap,
)
from sim.reconcile.local_minimum import minimize, minimize_fully

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


def test_each_runs_friction_is_found_and_is_no_other_gain():
    problem = session(SHARES)

    found = minimize(problem, begun(problem))

    assert found.values == pytest.approx(GAINS, rel=0.03)
    frictions = (found.values["kS"] + found.nuisance.friction_offset) / GAINS["kS"]
    assert frictions == pytest.approx(SHARES, abs=0.01)
    assert float(np.mean(found.nuisance.friction_offset)) == pytest.approx(
        0.0, abs=1e-3
    )  # kS is their mean


def test_a_standard_error_knows_of_frictions_that_differ():
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
def test_a_gap_is_that_of_each_runs_own_friction_between_those_that_are_tried(share):
    problem = session((share,) * 4)
    point = begun(problem)

    plain = compute_rms_gap(compute_open_loop_errors(problem, point, point.nuisance)).velocity
    eased = compute_rms_gap(
        compute_open_loop_errors(problem, point, point.nuisance, own_friction=True)
    ).velocity

    assert eased == pytest.approx(NOISE[1], rel=0.05)
    assert plain > 1.02 * eased


def test_a_search_beside_an_effect_finds_both():
    wave = {"cosine": 0.12, "sine": 0.05, "turns": 3.0}
    problem = session(SHARES, Part("cogging", wave))
    values = {f"cogging.{name}": value for name, value in wave.items()}

    found = minimize_fully(problem, begun(problem, "cogging", **values))

    assert found.values["cogging.cosine"] == pytest.approx(wave["cosine"], abs=0.01)
    frictions = (found.values["kS"] + found.nuisance.friction_offset) / GAINS["kS"]
    assert frictions == pytest.approx(SHARES, abs=0.015)
    assert get_friction_sd(found.values) == pytest.approx(0.02, rel=0.05)
