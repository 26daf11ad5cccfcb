"""What rows tell of gains: the errors of repeated fits, and infinity where a column is lost."""

import math

import numpy as np
import pytest

from sim.core.errors import BadRequest
from sim.fit.information_matrix import compute_information
from sim.fit.sysid_rows import Rows


def rows(velocity, acceleration, position=None):
    """Rows of which only the motion matters here."""
    n = len(velocity)
    empty = np.zeros(n)
    return Rows(
        np.arange(n) * 0.02,
        np.full(n, 0.02),
        empty,
        empty if position is None else np.asarray(position, dtype=float),
        np.asarray(velocity, dtype=float),
        np.asarray(acceleration, dtype=float),
    )


BOTH = {
    "quasistatic-forward": rows([0.5, 1.0, 1.5], [0.4, 0.4, 0.4]),
    "quasistatic-reverse": rows([-0.5, -1.0, -1.5], [-0.4, -0.4, -0.4]),
    "dynamic-forward": rows([0.2, 0.6, 1.1], [8.0, 4.0, 2.0]),
}
UP = {test: part for test, part in BOTH.items() if test.endswith("forward")}


def test_errors_are_those_of_repeated_fits():
    rng = np.random.default_rng(1)
    v = np.concatenate([part.velocity for part in BOTH.values()])
    a = np.concatenate([part.acceleration for part in BOTH.values()])
    columns = np.column_stack([np.sign(v), v, a])
    volts = columns @ [0.2, 2.5, 0.2] + 0.05 * rng.standard_normal((4000, v.size))
    found = np.linalg.lstsq(columns, volts.T, rcond=None)[0]
    said = compute_information(BOTH, type="simple", noise=0.05).errors
    assert said == pytest.approx(
        dict(zip(("kS", "kV", "kA"), found.std(axis=1), strict=True)), rel=0.04
    )


def test_an_elevator_that_only_goes_up_tells_friction_from_weight_never():
    errors = compute_information(UP, type="elevator", noise=0.05).errors
    assert math.isinf(errors["kS"])
    assert math.isinf(errors["kG"])
    assert math.isfinite(errors["kV"])
    assert math.isfinite(errors["kA"])


@pytest.mark.parametrize(
    ("ask", "advice"),
    [
        (lambda: compute_information({}, type="simple", noise=0.1), "at least one test that moves"),
        (lambda: compute_information(UP, type="crane", noise=0.1), "Choose one of: simple"),
        (lambda: compute_information(UP, type="simple", noise=0.0), "must be above 0"),
    ],
    ids=["no rows", "no such type", "no noise"],
)
def test_what_cannot_be_told_is_refused_with_advice(ask, advice):
    with pytest.raises(BadRequest, match=advice):
        ask()
