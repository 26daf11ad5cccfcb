"""One file more in the catalogue, nothing else touched: the solver suspects it, and names it."""

import json
import os
import shutil
import subprocess
import sys

import pytest
from test_adding_an_effect import GOOD

TESTS = ["--ramp", "1.5", "--step", "4", "--timeout", "2.5", "--seed", "3"]


@pytest.fixture(scope="module")
def sysid(root, tmp_path_factory):
    """The command of a copy of the project in which bearings can churn, and what it prints."""
    folder = tmp_path_factory.mktemp("project")
    shutil.copytree(root / "sim", folder / "sim", ignore=shutil.ignore_patterns("__pycache__"))
    (folder / "sim" / "effects" / "churn.py").write_text(GOOD, encoding="utf-8")
    environment = {**os.environ, "PYTHONPATH": str(folder), "SYSID_CACHE": str(folder / "cache")}

    def ran(*arguments):
        return subprocess.run(
            [sys.executable, "-c", "from sim.cli import main; main()", *arguments],
            cwd=folder, env=environment, capture_output=True, encoding="utf-8", check=False,
            timeout=300,
        )  # fmt: skip

    return ran


def test_a_new_file_in_the_catalogue_is_a_suspect_and_is_named(sysid):
    made = sysid("simulate", "shooter", "--hide", "churn:2", *TESTS, "-o", "log.csv")
    found = sysid("reconcile", "log.csv", "--json")

    assert made.returncode == 0, made.stderr
    assert found.returncode in {0, 1}, found.stderr
    first, *_ = json.loads(found.stdout)["findings"]
    assert (first["effect"], first["kind"]) == ("churn", "effect")
    assert first["sentence"].startswith("Bearings that churn. What is missing rises fast")
    assert first["inspect"] == "Bearings."
    assert first["parameters"]["churn"]["value"] > 0.0
