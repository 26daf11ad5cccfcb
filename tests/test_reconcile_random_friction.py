"""Friction that is each run's own: found beside what all runs have, and no finding."""

import math

import numpy as np
import pytest
from reconcile_made import rubbing

from sim.estimation.likelihood import PredictionErrorProblem
from sim.estimation.model_structure import ModelStructure
from sim.estimation.optimize import compute_standard_errors, make_joint_jacobian, make_prior_rows
from sim.estimation.random_friction import compute_laplace_correction, get_friction_sd
from sim.estimation.run_nuisance import RunNuisance
from sim.estimation.run_records import make_run_records
from sim.physics.engine import NO_CORRECTION, RunBatch, filter_runs
from sim.physics.model import Model, Part
from sim.reconcile.cross_validation import (
    compute_open_loop_errors,
    compute_rms_gap,
    find_parabola_minima,
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


def followed(model, time, volts, *, rubs):
    count = len(rubs)
    nothing, still = np.full((count * time.size, 2), np.nan), np.zeros(count)
    course = RunBatch(
        edges=np.arange(count + 1.0) * time.size, time=np.tile(time, count),
        voltage=np.tile(volts, count),
        voltage_slide=np.zeros(count * time.size), measured=nothing, position=still, velocity=still,
        low=still - math.inf, high=still + math.inf, clocks=still, memory_groups=still,
    )  # fmt: skip
    return filter_runs(
        model,
        course,
        kalman_gain=NO_CORRECTION,
        position_offset=still,
        backlash_phase=still,
        friction_offset=np.array(rubs),
        lag_offset=still,
    )


@pytest.mark.parametrize("rubs", [0.1, -0.1, -0.6])
def test_a_run_with_more_friction_moves_as_a_model_with_more(rubs):
    time = np.arange(0.0, 2.0, 0.02)
    volts = 3.0 * np.sin(4.0 * time)
    model = Model("simple", {**GAINS, "kS": max(GAINS["kS"] + rubs, 0.0)})

    tracks = followed(Model("simple", GAINS), time, volts, rubs=[0.0, rubs])

    assert tracks[time.size :] == pytest.approx(followed(model, time, volts, rubs=[0.0]), abs=1e-12)
    assert np.ptp(tracks[: time.size, 0]) != pytest.approx(np.ptp(tracks[time.size :, 0]), rel=1e-3)


def test_each_runs_friction_is_found_and_is_no_other_gain():
    problem = session(SHARES)

    found = minimize(problem, begun(problem))

    assert found.values == pytest.approx(GAINS, rel=0.03)
    frictions = (found.values["kS"] + found.nuisance.friction_offset) / GAINS["kS"]
    assert frictions == pytest.approx(SHARES, abs=0.01)
    assert float(np.mean(found.nuisance.friction_offset)) == pytest.approx(
        0.0, abs=1e-3
    )  # kS is their mean


def test_what_pushes_at_random_is_not_made_of_friction():
    """A search that had one friction for all runs would have to explain it by pushes."""
    problem = session(SHARES)

    found = minimize(problem, begun(problem))

    assert found.process_noise < 0.05 * problem.noise.velocity**2


def test_its_slope_is_of_the_size_by_which_friction_varies():
    """A run about to move begins a sample sooner with hardly less friction."""
    problem = session(SHARES)
    found = minimize(problem, begun(problem))
    nudged = [
        problem.evaluate(found.structure, {**found.values, "kS": share * found.values["kS"]},
                   found.nuisance, found.process_noise)
        for share in (0.999, 0.9995, 1.0005, 1.001)
    ]  # fmt: skip

    prices = [
        compute_laplace_correction(
            get_friction_sd(one.values), problem.compute_friction_jacobian(one)
        )
        for one in (found, *nudged)
    ]

    assert np.ptp(prices) < 8.0  # of 53: a run begins to move at a sample, or at the next
    assert prices[0] > 0.0


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


def test_what_a_point_adjusts_to_is_what_the_priors_allow():
    problem = session(SHARES)
    point = begun(problem)
    kept = make_joint_jacobian(problem, point)
    white = problem.whiten(point, point.innovations)

    rows, prior = make_prior_rows(problem, point)
    table, rest = np.vstack([problem.compute_jacobian(point), rows]), np.append(white, prior)
    by, *_ = np.linalg.lstsq(table, rest, rcond=None)
    left = rest - table @ by

    assert kept.compute_residual_square(white) + float(prior @ prior) == pytest.approx(
        float(left @ left), rel=1e-6
    )
    along, size = kept.compute_residual_products(white, white)
    assert 0.0 < size <= float(white @ white)
    assert along == pytest.approx(size - kept.basis.T @ white @ kept.prior, rel=1e-6)


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


def test_a_gap_of_a_friction_that_is_beyond_all_bounds_stays_wide():
    problem = session((1.4, 1.4, 1.4, 1.4))
    point = begun(problem)

    assert (
        compute_rms_gap(
            compute_open_loop_errors(problem, point, point.nuisance, own_friction=True)
        ).velocity
        > 3.0 * NOISE[1]
    )


def test_a_search_beside_an_effect_finds_both():
    wave = {"cosine": 0.12, "sine": 0.05, "turns": 3.0}
    problem = session(SHARES, Part("cogging", wave))
    values = {f"cogging.{name}": value for name, value in wave.items()}

    found = minimize_fully(problem, begun(problem, "cogging", **values))

    assert found.values["cogging.cosine"] == pytest.approx(wave["cosine"], abs=0.01)
    frictions = (found.values["kS"] + found.nuisance.friction_offset) / GAINS["kS"]
    assert frictions == pytest.approx(SHARES, abs=0.015)
    assert get_friction_sd(found.values) == pytest.approx(0.02, rel=0.05)


@pytest.mark.parametrize(
    ("values", "at"),
    [
        ((3.0, 1.0, 3.0), 0.0),
        ((4.0, 1.0, 2.0), 0.25),
        ((1.0, 1.0, 1.0), 0.0),  # nowhere
        ((1.7e308, 1.6e308, 1.7e308), 0.0),  # a model that runs away, but for a little
        ((math.inf, 1.0, 2.0), 0.0),
        ((math.inf, math.inf, math.inf), 0.0),
    ],
)
def test_the_likeliest_friction_is_where_a_parabola_is_lowest(values, at):
    less, here, more = np.array(values)[:, None]

    assert find_parabola_minima(less, here, more) == pytest.approx([at])
