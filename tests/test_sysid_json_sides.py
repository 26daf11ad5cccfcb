"""Sides and signs in JSON of 2019 to 2023: every repair is right, and said aloud."""

from pathlib import Path

import numpy as np
import pytest
from old_tools import RUNS, document, motion, only_doubt, read_json, scaled, sysid


def test_an_angular_drivetrain_is_half_the_difference_of_its_sides(tmp_path: Path) -> None:
    made = sysid(9, "Drivetrain (Angular)")
    for key in RUNS:
        scaled(made, key, 1, 3, 5)  # turning left, the left side runs backward

    log = read_json(tmp_path, made)

    (run,) = log.list_runs_of_test("quasistatic-reverse")
    _, voltage, _, velocity = motion("slow-backward")
    assert run.voltage.tolist() == voltage.tolist()
    np.testing.assert_allclose(run.velocity, 1.05 * 0.5 * velocity, rtol=1e-14)
    assert (log.type, log.mechanism) == ("simple", "Drivetrain (Angular)")
    assert only_doubt(log).code == "turning-drivetrain"
    assert "half the track width" in only_doubt(log).message


REPAIRS = [
    ({"slow-backward": [3, 4], "fast-backward": [3, 4]}, {"unsigned-voltage": ["left", "right"]}),
    ({"slow-backward": [4], "fast-backward": [4]}, {"unsigned-voltage": ["right"]}),
    ({key: [4] for key in RUNS}, {"inverted-voltage": ["right"]}),
    ({"fast-forward": [3]}, {"inverted-voltage": ["left"]}),
    ({key: [6, 8] for key in RUNS}, {"inverted-encoder": ["right"]}),
    ({key: [4, 6, 8] for key in RUNS}, {"mirrored-side": ["right"]}),
]


@pytest.mark.parametrize(("spoiled", "said"), REPAIRS)
def test_a_side_with_wrong_signs_is_turned_and_every_run_of_it_named(
    tmp_path: Path, spoiled: dict[str, list[int]], said: dict[str, list[str]]
) -> None:
    sound = document(10, units="Meters")
    made = document(10, units="Meters")
    for key, columns in spoiled.items():
        scaled(made, key, *columns)

    log = read_json(tmp_path, made)

    for run, right in zip(log.runs, read_json(tmp_path, sound).runs, strict=True):
        for name in ("voltage", "position", "velocity"):
            assert np.array_equal(getattr(run, name), getattr(right, name))
    assert [doubt.code for doubt in log.doubts] == [code for code in said for _ in said[code]]
    for doubt, side in zip(log.doubts, next(iter(said.values())), strict=True):
        assert f", {side}, " in doubt.message
        for key, test in RUNS.items():
            assert (test in doubt.message) == (key in spoiled)


def test_a_voltage_without_a_sign_gets_one_in_a_mechanism_of_one_side(tmp_path: Path) -> None:
    made = sysid(4, "Elevator")
    scaled(made, "slow-backward", 1)
    scaled(made, "fast-backward", 1)

    log = read_json(tmp_path, made)

    sound = read_json(tmp_path, sysid(4, "Elevator"))
    for run, right in zip(log.runs, sound.runs, strict=True):
        assert np.array_equal(run.voltage, right.voltage)
    assert only_doubt(log).code == "unsigned-voltage"
    assert "quasistatic-reverse" in only_doubt(log).message
    assert "forward" not in only_doubt(log).message


def test_both_sides_against_the_tests_name_stay_as_recorded(tmp_path: Path) -> None:
    made = sysid(9, "Drivetrain")
    made["fast-forward"], made["fast-backward"] = made["fast-backward"], made["fast-forward"]

    log = read_json(tmp_path, made)

    assert log.doubts == ()
    assert log.list_runs_of_test("dynamic-forward")[0].velocity[-1] < 0


def test_living_side_is_read_where_the_other_does_not_move(tmp_path: Path) -> None:
    made = sysid(9, "Drivetrain")
    for key in RUNS:
        scaled(made, key, 4, 6, by=0.0)

    log = read_json(tmp_path, made)

    doubt = only_doubt(log)
    assert doubt.code == "dead-side"
    assert "the right encoder" in doubt.message
    assert log.list_runs_of_test("dynamic-forward")[0].velocity[-1] == 1.5


def test_sides_that_move_differently_are_doubted(tmp_path: Path) -> None:
    made = sysid(9, "Drivetrain")
    scaled(made, "fast-forward", 6, by=1.5)

    doubt = only_doubt(read_json(tmp_path, made))

    assert doubt.code == "sides-differ"
    assert "dynamic-forward" in doubt.message
    assert "Fit each side alone" in doubt.message
