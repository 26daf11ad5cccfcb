"""What the benchmark learns of how likely a finding is right."""

import importlib.util
import json
import sys
from pathlib import Path

import numpy as np
import pytest

from sim.reconcile.probability import FEATURES, Evidence, compute_probability

BENCHMARKS = Path(__file__).resolve().parent / "benchmarks"
ROWS = 4000


@pytest.fixture(scope="module")
def learning():
    pytest.importorskip("sklearn", reason="only the learning needs scikit-learn")
    spec = importlib.util.spec_from_file_location(
        "learn_probability", BENCHMARKS / "learn_probability.py"
    )
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


def drawn(weights, *, seed):
    """Rows whose truth follows a logistic model of given weights."""
    rng = np.random.default_rng(seed)
    table = rng.normal(size=(ROWS, len(FEATURES)))
    odds = weights["intercept"] + table @ [weights[name] for name in FEATURES]
    right = rng.random(ROWS) < 1.0 / (1.0 + np.exp(-odds))
    return [(tuple(row), bool(one)) for row, one in zip(table, right, strict=True)]


def test_the_weights_that_made_the_rows_are_found_again(learning):
    weights = {"intercept": 0.5, **{name: (-1.0) ** n for n, name in enumerate(FEATURES)}}

    found = learning.fit_coefficients(drawn(weights, seed=1))

    assert found == pytest.approx(weights, abs=0.2)


def test_what_is_predicted_is_what_the_product_says(learning):
    rows = drawn({"intercept": 0.0, **dict.fromkeys(FEATURES, 0.3)}, seed=2)[:20]
    stored = json.loads(learning.FILE.read_text(encoding="utf-8"))["coefficients"]

    told = learning.predict(rows, stored)

    assert told == pytest.approx([compute_probability(Evidence(*row)) for row, _ in rows])


def test_a_maker_whose_findings_are_more_often_wrong_is_seen(learning):
    weights = {"intercept": 2.0, **dict.fromkeys(FEATURES, 0.5)}
    rows = drawn(weights, seed=3)
    told = learning.predict(rows, weights)

    as_told = learning.describe_calibration(told, rows)
    liars = learning.describe_calibration(told, [(row, False) for row, _ in rows])

    error = lambda said: float(said.rpartition(" ")[2])  # noqa: E731 - a word of a sentence
    assert error(as_told) < 0.03
    assert error(liars) > 0.5


def test_rows_take_asymmetric_friction_and_a_constant_load_for_one(learning, tmp_path):
    evidence = dict.fromkeys(FEATURES, 0.0)
    judged = [
        {"effect": "constant-load", "ambiguous_with": [], "evidence": evidence},
        {"effect": "drag", "ambiguous_with": ["stribeck"], "evidence": evidence},
    ]
    line = {"case": "1", "truth": {"effects": ["asymmetric-friction"]}, "judged": judged}
    path = tmp_path / "rows.jsonl"
    path.write_text(f"{json.dumps(line)}\n" + json.dumps({**line, "judged": []}), encoding="utf-8")

    assert [right for _, right in learning.read_rows(path)] == [True, False]
