"""What the benchmark learns of how likely a finding is right."""

import importlib.util
import json
import sys
from pathlib import Path

import numpy as np
import pytest

from sim.reconcile.probability import FEATURES

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
