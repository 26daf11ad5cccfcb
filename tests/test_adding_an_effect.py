"""One file dropped into the catalogue, nothing else touched: listed, offered and tested."""

import json
import os
import shutil
import subprocess
import sys

import pytest

pytestmark = pytest.mark.slow

GOOD = '''
"""Rolling resistance that grows with speed, one way of saying that bearings churn.

    V = ... + churn·|v|^0.5·sgn(v)
"""

import math

import numpy as np

from sim.physics.effect import Effect, Parameter


def force(v, churn):
    """[V] against the motion."""
    return churn * math.copysign(math.sqrt(abs(v)), v) if v else 0.0


def ordinary_parameters(scale, size):
    """Half a volt at the speed of a step."""
    return {"churn": 0.5 * size / math.sqrt(scale.speed)}


def find_start_values(seen):
    """Its share in what is missing."""
    column = np.sign(seen.velocity) * np.sqrt(np.abs(seen.velocity))
    yield {"churn": max(float(seen.fit_columns(column)[0]), 0.01)}


EFFECT = Effect(
    name="churn",
    kind="term",
    summary="bearings that churn",
    formula="churn·|v|^0.5·sgn(v)",
    parameters=(Parameter("churn", "volts per root of speed", "V·(s/{u})^0.5", power=0.5),),
    fingerprint="What is missing rises fast and then slowly.",
    inspect="Bearings.",
    apart={"drag": "A faster run: drag grows faster than speed, churn more slowly."},
    example=ordinary_parameters,
    start_values=find_start_values,
    hooks={"force": force},
)
'''
WRONG = {
    "argument": ("def force(v, churn)", "def force(speed, churn)", "force asks for 'speed'"),
    "look-alike": ('apart={"drag"', 'apart={"friction"', "told apart from 'friction', which is no"),
    "sign": ("return churn *", "return -churn *", "test_an_effect_never_accelerates"),
}  # fmt: skip

CHEAP = "churn and (never_accelerates or contract_asks)"  # what needs no compiled engine
TESTS = ("--ramp", "1.5", "--step", "4", "--timeout", "2.5", "--seed", "3")


@pytest.fixture(scope="module")
def copy(root, tmp_path_factory):
    """The project's code with one more effect, and a cache of its own."""
    folder = tmp_path_factory.mktemp("project")
    shutil.copytree(root / "sim", folder / "sim", ignore=shutil.ignore_patterns("__pycache__"))
    (folder / "tests").mkdir()
    for name in ("conftest.py", "places.py", "small_course.py", "test_effects.py"):
        shutil.copy(root / "tests" / name, folder / "tests" / name)
    shutil.copy(root / "pyproject.toml", folder)
    (folder / "sim" / "physics" / "effects" / "churn.py").write_text(GOOD, encoding="utf-8")
    return folder


def run(copy, *command):
    """Run a module in the copy, which comes before what is installed.

    Compiled files are told apart by length and second; two versions of one file can share both,
    so none is written.
    """
    environment = {
        **os.environ, "PYTHONPATH": str(copy), "SYSID_CACHE": str(copy / "cache"),
        "PYTHONDONTWRITEBYTECODE": "1",
    }  # fmt: skip
    return subprocess.run(
        [sys.executable, *command], cwd=copy, env=environment, capture_output=True,
        encoding="utf-8", check=False, timeout=300,
    )  # fmt: skip


def sysid(copy, *arguments):
    return run(copy, "-c", "from sim.cli import main; main()", *arguments)


def contract(copy, only="churn"):
    return run(
        copy, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", "tests/test_effects.py",
        "-k", only,
    )  # fmt: skip


def test_new_effect_is_listed_can_be_hidden_and_keeps_the_contract(copy):
    listed = json.loads(sysid(copy, "effects", "--json").stdout)
    made = sysid(copy, "simulate", "drivetrain", "--hide", "churn:0.7", "-o", "log.csv")
    checked = contract(copy)

    assert "bearings that churn" in [row["summary"] for row in listed]
    assert made.returncode == 0, made.stderr
    assert checked.returncode == 0, checked.stdout
    assert "passed" in checked.stdout


def test_new_effect_is_a_candidate_and_is_named(copy):
    made = sysid(copy, "simulate", "shooter", "--hide", "churn:2", *TESTS, "-o", "churns.csv")
    found = sysid(copy, "reconcile", "churns.csv", "--json")

    assert made.returncode == 0, made.stderr
    assert found.returncode in {0, 1}, found.stderr
    first, *_ = json.loads(found.stdout)["findings"]
    assert (first["effect"], first["kind"]) == ("churn", "effect")
    assert first["sentence"].startswith("Bearings that churn. What is missing rises fast")
    assert first["inspect"] == "Bearings."
    assert first["parameters"]["churn"]["value"] > 0.0


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_effect_file_fails_with_a_sentence_that_says_why(copy, name):
    right, wrong, said = WRONG[name]
    file = copy / "sim" / "physics" / "effects" / "churn.py"
    assert right in GOOD
    file.write_text(GOOD.replace(right, wrong), encoding="utf-8")

    checked = contract(copy, CHEAP)

    file.write_text(GOOD, encoding="utf-8")
    assert checked.returncode != 0
    assert said in checked.stdout
