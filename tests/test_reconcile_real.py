"""Logs of real robots: what is known to be missing is named, what is known to be broken is told.

What they hold is known from their teams' code and from looking at them: an arm whose zero is 59
degrees off horizontal and that lost its motor's voltage every 0.22 s, an elevator with the same
trouble, and a drivetrain whose velocity comes some 140 ms late.
"""

import json
import math

import pytest

from sim.cli import sysid
from sim.support.command_line import run_command

pytestmark = [pytest.mark.slow, pytest.mark.shared]
LOGS = {
    "elbow": ("sciborgs-2023-elbow-arm.json", "simple"),
    "elevator": ("sciborgs-2023-elevator.json", "elevator"),
    "drivetrain": ("frc4646-2022-drivetrain.json", "simple"),
}


@pytest.fixture(scope="module")
def found(shared):
    """What `sysid reconcile --json` says of a log, asked once."""
    known = {}

    def ask(name, capsys):
        if name not in known:
            file, type_ = LOGS[name]
            path = shared / "data" / "real" / file
            capsys.readouterr()
            code = run_command(
                sysid, name="sysid",
                arguments=["reconcile", str(path), "--type", type_, "--json"],
            )  # fmt: skip
            known[name] = (code, json.loads(capsys.readouterr().out))
        return known[name]

    return ask


def effects(story, size="major"):
    return [
        one["effect"]
        for one in story["findings"]
        if one["size"] == size and one["kind"] == "effect"
    ]


def faults(story):
    return [one["effect"] for one in story["findings"] if one["kind"] == "fault"]


def test_gravity_of_an_arm_that_passes_for_simple_is_named_with_its_angle(found, capsys):
    _, story = found("elbow", capsys)
    (gravity,) = [one for one in story["findings"] if one["effect"] == "gravity-cosine"]
    level, upright = (gravity["parameters"][one]["value"] for one in ("level", "upright"))

    assert effects(story)[0] == "gravity-cosine"
    assert story["gap_after"] < 0.5 * story["gap_before"]
    assert abs(math.degrees(math.atan2(upright, level))) == pytest.approx(59.0, abs=12.0)


def test_the_lag_of_a_velocity_is_named(found, capsys):
    _, story = found("drivetrain", capsys)
    (lag,) = [one for one in story["findings"] if one["effect"] == "velocity-filter"]

    assert effects(story)[0] == "velocity-filter"
    # a mean over a window comes half of it late
    assert 0.5 * lag["parameters"]["window"]["value"] == pytest.approx(0.14, abs=0.01)
    assert story["gap_after"] < 0.2 * story["gap_before"]


@pytest.mark.parametrize("name", ["elbow", "elevator"])
def test_a_voltage_that_drops_out_is_damage_and_no_physics(found, capsys, name):
    _, story = found(name, capsys)

    assert "voltage-dropout" in faults(story)
    (dropout,) = [one for one in story["findings"] if one["effect"] == "voltage-dropout"]
    assert "the motor really lost it" in dropout["sentence"]


def test_no_effect_is_named_for_the_real_elevator(found, capsys):
    _, story = found("elevator", capsys)

    assert effects(story) == []


def test_a_log_without_a_voltage_is_refused(shared, capsys):
    path = shared / "data" / "real" / "sciborgs-2024-pivot-no-voltage.wpilog"

    assert run_command(sysid, name="sysid", arguments=["reconcile", str(path)]) == 2
    assert "no voltage entry" in capsys.readouterr().err
