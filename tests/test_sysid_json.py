"""The JSON of SysId until 2023: sound, of two sides, and damaged."""

import json
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from old_tools import RUNS, document, motion, only_doubt, read_json, scaled, sysid

import sim
from sim.core.errors import BadSample, Refusal, UnreadableFile
from sim.core.log import Log


@pytest.mark.parametrize(
    ("test", "type_"),
    [
        ("Simple", "simple"),
        ("Simple Motor", "simple"),
        ("Elevator", "elevator"),
        ("Arm", "arm"),
    ],
)
def test_rows_of_four_are_one_mechanism(tmp_path: Path, test: str, type_: str) -> None:
    log = read_json(tmp_path, sysid(4, test))

    assert (log.type, log.mechanism, log.units) == (type_, test, "meters")
    assert log.doubts == ()
    # In the order they were recorded, which is not that of the file.
    assert [run.test for run in log.runs] == list(RUNS.values())[::-1]
    for key, name in RUNS.items():
        time, voltage, position, velocity = motion(key)
        (run,) = log.list_runs_of_test(name)
        assert run.time.tolist() == time.tolist()
        assert run.voltage.tolist() == voltage.tolist()
        assert run.position.tolist() == (position * 0.5).tolist()
        assert run.velocity.tolist() == (velocity * 0.5).tolist()
        assert run.bus_voltage is None


@pytest.mark.parametrize(
    ("asked", "units"),
    [
        pytest.param({"units": "feet"}, "feet", id="as said"),
        pytest.param({"type": "arm"}, "radians", id="an arm's default"),
    ],
)
def test_units_that_a_file_leaves_open_come_from_an_option(
    tmp_path: Path, asked: dict[str, str], units: str
) -> None:
    log = read_json(tmp_path, document(6), **asked)

    assert log.units == units
    assert [doubt.code for doubt in log.doubts] == ([] if "units" in asked else ["units-unknown"])


@pytest.mark.parametrize("motor", [None, "left", "right", "combined"])
@pytest.mark.parametrize("width", [9, 10])
def test_a_drivetrain_is_the_mean_of_its_sides_or_the_one_asked_for(
    tmp_path: Path, width: int, motor: str | None
) -> None:
    log = read_json(tmp_path, sysid(width, "Drivetrain"), motor=motor)

    assert (log.type, log.mechanism) == ("simple", "Drivetrain")
    assert log.doubts == ()
    assert len(log.runs) == 4
    share = {"left": 1.0, "right": 1.1}.get(motor or "", 1.05)
    for key, name in RUNS.items():
        time, voltage, position, velocity = motion(key)
        (run,) = log.list_runs_of_test(name)
        assert run.time.tolist() == time.tolist()
        assert run.voltage.tolist() == voltage.tolist()
        np.testing.assert_allclose(run.position, share * 0.5 * position, rtol=1e-14)
        np.testing.assert_allclose(run.velocity, share * 0.5 * velocity, rtol=1e-14)
        assert (run.bus_voltage is None) == (width == 9)


def test_a_row_of_ten_of_an_elevator_is_one_mechanism(tmp_path: Path) -> None:
    made = document(10, test="Elevator", units="Feet")
    for key in RUNS:
        scaled(made, key, 4, 6, 8, by=0.0)

    log = read_json(tmp_path, made)

    assert log.type == "elevator"
    assert log.list_runs_of_test("dynamic-forward")[0].voltage[-1] == 6.0
    assert log.doubts == ()


def test_the_nine_columns_of_2019_are_distinguished_from_sysids_by_the_battery(
    tmp_path: Path,
) -> None:
    made = {key: [row[:9] for row in rows] for key, rows in document(10).items()}

    (run,) = read_json(tmp_path, made, motor="left").list_runs_of_test("dynamic-forward")
    assert run.voltage[-1] == 6.0
    assert run.bus_voltage is not None
    assert run.bus_voltage[-1] == 12.5

    (run,) = read_json(tmp_path, document(9), motor="left").list_runs_of_test("dynamic-forward")
    assert run.voltage[-1] == 6.0
    assert run.bus_voltage is None


def test_empty_and_unknown_runs_are_left_out(tmp_path: Path) -> None:
    made = sysid(4, "Simple") | {"slow-forward": [], "fast_forward": [[1, 2, 3, 4]]}

    assert len(read_json(tmp_path, made).runs) == 3


class Real(NamedTuple):
    """What can be checked of a real log by hand."""

    name: str
    type: str
    units: str
    span: float  # [s] of the four tests together
    reach: float  # [m or rad] from the lowest position to the highest
    highest: float  # [V] the largest voltage


REAL = [
    Real("sciborgs-2023-elbow-arm", "arm", "radians", 19.9, 5.3, 2.6),
    Real("sciborgs-2023-wrist-arm", "arm", "radians", 22.5, 4.9, 1.8),
    Real("sciborgs-2023-elevator", "elevator", "meters", 33.5, 0.45, 3.4),
    Real("frc4646-2022-drivetrain", "simple", "meters", 21.8, 4.1, 7.0),
    Real("frc501-2020-drivetrain", "simple", "meters", 25.9, 6.3, 6.2),
]


@pytest.mark.shared
@pytest.mark.parametrize("real", REAL, ids=lambda real: real.name)
def test_a_real_log_reads_whole(shared: Path, real: Real) -> None:
    log = sim.read(shared / "data" / "real" / f"{real.name}.json")

    assert (log.type, log.units) == (real.type, real.units)
    assert sorted(run.test for run in log.runs) == sorted(RUNS.values())
    assert sum(np.ptp(run.time) for run in log.runs) == pytest.approx(real.span, abs=0.1)
    positions = np.concatenate([run.position for run in log.runs])
    assert np.ptp(positions) == pytest.approx(real.reach, rel=0.03)
    voltages = np.concatenate([run.voltage for run in log.runs])
    assert np.abs(voltages).max() == pytest.approx(real.highest, rel=0.03)
    assert [doubt.code for doubt in log.doubts] == ["units-unknown"] * ("2020" in real.name)


def with_row(row: object, *, width: int = 4, test: str = "Simple") -> dict[str, Any]:
    """A sound file but for row 7 of one run."""
    made = sysid(width, test)
    made["fast-forward"][7] = row
    return made


TEXT = json.dumps(sysid(4, "Simple"), indent=1)
DRIVE_ROW = [1, 2, 3, 4, 1e30, 6, 7, 8, 9]
BROKEN = {
    "truncated": TEXT[: len(TEXT) // 2],
    "a comma lost": TEXT.replace("0.0,\n", "0.0\n", 1),
    "nested without end": '{"slow-forward": ' + "[" * 100_000,
    "no row": with_row("slow"),
    "null for a run": sysid(4, "Simple") | {"slow-forward": None},
    "a width no tool wrote": {"slow-forward": [[1, 2, 3, 4, 5]]},
    "two widths": sysid(4, "Simple") | {"slow-forward": document(9)["slow-forward"]},
    "empty": {key: [] for key in RUNS},
    "no run": {"test": "Arm", "units": "Meters"},
    "an empty row": {"slow-forward": [[]]},
    "a list": [1, 2],
    "a wrong test": sysid(9, "Arm"),
    "no name": sysid(4, "Arm", test=3),
    "unknown units": sysid(4, "Arm", units="Furlongs"),
    "no units": sysid(4, "Arm", units=[]),
    **{
        f"{per} units per rotation": sysid(4, "Arm", unitsPerRotation=per)
        for per in (0, -1, "0.5", None, float("nan"), float("inf"))
    },
    "a row too short": with_row([1, 2, 3]),
    "a word in a row": with_row([1, 2, "3", 4]),
    "a truth in a row": with_row([1, 2, True, 4]),
}
PLACED = ("a row too short", "a word in a row", "a truth in a row", "nan", "null", "infinite")
BAD_SAMPLES = {
    "nan": with_row([1, 2, 3, float("nan")]),
    "null": with_row([1, None, 3, 4]),
    "infinite": with_row([1, 2, float("inf"), 4]),
    "absurd, on the right": with_row(DRIVE_ROW, width=9, test="Drivetrain"),
    "a number too long": '{"fast-forward": [[1, 2, ' + "3" * 5000 + ", 4]]}",
    "time goes back": sysid(4, "Simple") | {"fast-forward": [[t, 1, 0, 0] for t in (5, 6, 1, 2)]},
}


@pytest.mark.parametrize("name", [*BROKEN, *BAD_SAMPLES])
def test_damaged_file_is_refused_with_its_place(tmp_path: Path, name: str) -> None:
    made = (BROKEN | BAD_SAMPLES)[name]
    with pytest.raises(UnreadableFile if name in BROKEN else BadSample) as refused:
        read_json(tmp_path, made)

    said = str(refused.value)
    assert "sysid_data.json" in said
    assert "\n" not in said
    if name in PLACED:
        assert "row 7" in said


def read_or_refuse(path: Path, data: bytes) -> Log | Refusal:
    path.write_bytes(data)
    try:
        return sim.read(path)
    except Refusal as refusal:
        return refusal


VALUES = st.recursive(
    st.none()
    | st.booleans()
    | st.floats()
    | st.integers(-(10**400), 10**400)
    | st.text(max_size=3)
    | st.sampled_from(["Meters", "Arm", "Drivetrain"]),
    lambda inner: st.lists(inner, max_size=10) | st.dictionaries(st.text(max_size=2), inner),
    max_leaves=30,
)
NUMBERS = st.floats() | st.integers(-5, 5) | st.none()
ROWS = st.sampled_from([1, 4, 6, 9, 10]).flatmap(
    lambda width: st.lists(st.lists(NUMBERS, min_size=width, max_size=width), max_size=4)
)
KEYS = st.sampled_from([*RUNS, "track-width", "test", "units", "unitsPerRotation", "sysid"])


@given(st.dictionaries(KEYS, ROWS | VALUES, min_size=1))
def test_any_object_is_read_or_refused_in_one_line(
    tmp_path_factory: pytest.TempPathFactory, made: dict[str, object]
) -> None:
    path = tmp_path_factory.getbasetemp() / "any.json"

    outcome = read_or_refuse(path, json.dumps(made).encode())

    assert isinstance(outcome, Log) or (str(path) in str(outcome) and "\n" not in str(outcome))


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


def test_moving_side_is_read_when_the_other_stands_still(tmp_path: Path) -> None:
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
