"""The gap of runs that were not fitted, and the likelihood where signals differ in samples."""

import math
from dataclasses import replace

import numpy as np
import pytest
from reconcile_made import based, rubbing

from sim.estimation.run_variation import (
    compute_run_variation_covariance,
    compute_standard_errors,
)
from sim.reconcile.cross_validation import (
    Fold,
    compute_open_loop_errors,
    compute_rms_gap,
    make_folds,
    select_usable_folds,
)
from sim.reconcile.local_minimum import minimize

GAINS = {"kS": 0.5, "kV": 0.5, "kA": 0.05}
NOISE = (1e-3, 1e-2)  # [m] and [m/s]


@pytest.fixture(scope="module")
def fitted():
    log = rubbing(GAINS, (1.0, 1.0, 1.0, 1.0), noise=NOISE, step=4.0, seed=0)
    problem, point = based(log, GAINS)
    return problem, minimize(problem, point)


def excluded(problem, *runs):
    records = [one.exclude() if n in runs else one for n, one in enumerate(problem.records)]
    return replace(problem, records=tuple(records))


def test_which_samples_are_compared_does_not_depend_on_the_model(fitted):
    problem, point = fitted
    stuck = problem.evaluate(
        point.structure, {**point.values, "kS": 50.0}, point.nuisance, point.process_noise
    )

    moving, still = (compute_open_loop_errors(problem, one, one.nuisance) for one in (point, stuck))

    assert len(moving) == len(still) == np.count_nonzero(problem.informative | problem.moving)


def test_a_fold_without_samples_is_not_used_and_a_gap_of_nothing_is_no_gap(fitted):
    problem, _ = fitted
    damaged = excluded(problem, 2)
    folds = make_folds([0] * 4)

    assert [one.predicted for one in select_usable_folds(damaged, folds)] == [(0,), (1,), (3,)]
    assert select_usable_folds(excluded(problem, 0, 1, 2), folds) == ()
    assert select_usable_folds(damaged, [Fold((2,), (0, 1))]) == ()
    gap = compute_rms_gap(np.empty((0, 2)))
    assert math.isnan(gap.velocity)
    assert math.isnan(gap.position)


def test_standard_errors_are_those_of_the_covariance_and_say_what_is_not_known(fitted):
    problem, point = fitted
    structure = point.structure + "deadband"
    values = {**point.values, "deadband.band": 0.01}  # below every voltage at which it moves
    beside = problem.evaluate(structure, values, point.nuisance, point.process_noise)

    errors = compute_standard_errors(problem, point)
    unknown = compute_standard_errors(problem, beside)

    variance = np.diag(compute_run_variation_covariance(problem, point))
    assert list(errors.values()) == pytest.approx(np.sqrt(variance).tolist())
    assert unknown["deadband.band"] == math.inf
    assert unknown["kV"] == pytest.approx(errors["kV"], rel=0.05)
