"""Without Numba, which the bare install leaves out, everything works, and with the same digits."""

import json
import math

import pytest
from sysid_process import run_sysid

from sim.physics.engine import ieee_math

pytestmark = pytest.mark.slow

BLOCKED = """
import importlib.abc, importlib.util, sys

class Blocked(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path, target=None):
        if name.partition(".")[0] in {"numba", "llvmlite"}:
            raise ModuleNotFoundError(name)

found = importlib.util.find_spec
importlib.util.find_spec = lambda name: None if name in {"numba", "llvmlite"} else found(name)
sys.meta_path.insert(0, Blocked())
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with an ordinary log and one with an effect in it."""
    place = tmp_path_factory.mktemp("logs")
    run_sysid("simulate", "drivetrain", "--seed", "1", "-o", "drive.csv", folder=place)
    run_sysid("simulate", "arm", "--seed", "2", "--step", "5", "-o", "arm.wpilog", folder=place)
    return place


@pytest.mark.parametrize("log", ["drive.csv", "arm.wpilog"])
def test_a_fit_has_the_same_digits(folder, log):
    slow, quick = (
        run_sysid("fit", log, "--json", folder=folder, before=before) for before in (BLOCKED, "")
    )

    assert slow.stderr == ""
    assert json.loads(slow.stdout) == json.loads(quick.stdout)
    assert slow.returncode == quick.returncode


def test_broken_numba_is_not_used(monkeypatch):
    from sim.physics import engine  # noqa: PLC0415 - its private functions are replaced here

    def refuse(_effects, *, compiled=True):
        if compiled:
            raise ImportError("Numba needs NumPy 2.2 or less")
        return "plain"

    monkeypatch.setattr(engine, "compose_engine", refuse)
    monkeypatch.setattr(engine, "_load_plain_engine", lambda: "plain")

    assert engine._build_engine.__wrapped__() == "plain"


@pytest.mark.parametrize(
    ("name", "argument", "expected"),
    [
        ("cos", math.inf, math.nan),
        ("sin", -math.inf, math.nan),
        ("sqrt", -1.0, math.nan),
        ("exp", 1000.0, math.inf),
        ("expm1", 1000.0, math.inf),
        ("log1p", -1.0, -math.inf),
        ("log1p", -2.0, math.nan),
        ("ceil", math.nan, -(2.0**63)),
        ("ceil", 1.2, 2.0),
        ("cos", 0.0, 1.0),
    ],
)
def test_invalid_arithmetic_gives_the_results_of_compiled_code(name, argument, expected):
    found = getattr(ieee_math, name)(argument)

    assert found == expected or (math.isnan(found) and math.isnan(expected))
