"""The bench beside MuJoCo: the same mechanisms and effects, moved by other people's physics.

MuJoCo moves inertia, weight, friction, springs, stops and joints in steps of a millisecond, and
softly where the bench is exact; what a controller and a sensor do is the effects' own in both.
"""

import json
import subprocess
import sys
from dataclasses import replace
from importlib import import_module

import numpy as np
import pytest

from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.io import read
from sim.physics.battery import Battery
from sim.physics.effects import EFFECTS

pytest.importorskip("mujoco", reason="MuJoCo is not installed (extra `physics`)")

pytestmark = pytest.mark.slow

ROUTINE = Routine(ramp=0.5, step=5.0)
CLOSE = 0.003  # [share of a run's top speed] of steps of a millisecond, and what rubs softly
SOFT = {"backlash": 0.006, "compliance": 0.004}  # teeth that give; a joint that is damped a little


@pytest.fixture
def moved(root, monkeypatch):
    """The runs of a mechanism without a battery or a sensor around it, by name of who moves it."""
    monkeypatch.syspath_prepend(root / "tests" / "benchmarks")
    physics = {
        "mujoco": import_module("reconcile_mujoco").moved,
        "bench": import_module("reconcile_recording").on_the_bench,
    }

    def simulated(mechanism, who):
        sensor = replace(mechanism.sensor, velocity_noise=0.0, jitter=0.0, resolution=1e-9)
        plain = {"battery": Battery(resistance=0.0), "stator": 1e4, "supply": 1e4}
        bare = replace(mechanism, sensor=sensor, **plain)
        chance = np.random.default_rng(0)
        return physics[who](bare, ROUTINE, rng=chance, period=0.02, wobble=0.0)

    return simulated


def off(runs, others):
    """[share of a run's top speed] by which velocities differ, in the run where they do most."""
    return max(
        np.sqrt(np.mean((one.velocity[:n] - other.velocity[:n]) ** 2))
        / np.abs(other.velocity).max()
        for one, other in zip(runs, others, strict=True)
        for n in (min(len(one), len(other)),)
    )


@pytest.mark.parametrize("name", MECHANISMS)
def test_a_complete_mechanism_moves_as_mujoco_moves_it(moved, name):
    theirs, ours = (moved(MECHANISMS[name], who) for who in ("mujoco", "bench"))

    assert [len(run) for run in theirs] == pytest.approx([len(run) for run in ours], abs=1)
    assert off(theirs, ours) < CLOSE


@pytest.mark.parametrize("effect", EFFECTS)
def test_an_effect_moves_a_mechanism_as_in_mujoco(moved, effect):
    plain = next(
        one
        for one in map(MECHANISMS.get, ("turret", "drivetrain"))
        if not EFFECTS[effect].reason_against(one.scale)
    )

    theirs, ours = (moved(plain.hide(effect), who) for who in ("mujoco", "bench"))

    assert off(theirs, ours) < SOFT.get(effect, CLOSE)
    assert off(theirs, moved(plain, "bench")) > off(theirs, ours)


def test_the_benchmarks_cases_are_made_by_mujoco_on_request(root, tmp_path):
    script = root / "tests" / "benchmarks" / "reconcile_cases.py"
    told = ["--seed", "7", "--cases", "1", "--shuffled", "1", "--physics", "mujoco"]
    where = ["--out", str(tmp_path / "cases"), "--key", str(tmp_path / "key.json")]

    command = [sys.executable, str(script), *told, *where]
    run = subprocess.run(command, capture_output=True, encoding="utf-8", check=False)

    assert run.returncode == 0, run.stderr
    key = json.loads((tmp_path / "key.json").read_text(encoding="utf-8"))
    assert len(key) == 11
    for name in key:
        for file in ("train.csv", "validation.csv", "test.csv"):
            log = read(tmp_path / "cases" / name / file)
            assert all(np.ptp(one.velocity) > 0.0 for one in log.runs)
