"""JSON of the tools of 2019 to 2023: every form of row, and every repair said aloud."""

import json
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import sim
from sim.doubt import Doubt
from sim.errors import BadRequest, BadSample, MissingSignal, Refusal, UnreadableFile
from sim.log import Array, Log

RUNS = {
    "slow-forward": "quasistatic-forward",
    "slow-backward": "quasistatic-reverse",
    "fast-forward": "dynamic-forward",
    "fast-backward": "dynamic-reverse",
}
COUNT = 40
PERIOD = 0.02


def motion(key: str, *, side: float = 1.0) -> tuple[Array, Array, Array, Array]:
    """Time, voltage, position, velocity of one run: a wheel that follows 2 V per unit/s at once."""
    start = 100.0 - 20.0 * list(RUNS).index(key)  # the last key in the file was recorded first
    way = 1.0 if key.endswith("forward") else -1.0
    steps = np.arange(COUNT)
    voltage = way * (0.1 * steps if key.startswith("slow") else np.where(steps > 0, 6.0, 0.0))
    velocity = side * 0.5 * voltage
    return start + PERIOD * steps, voltage, np.cumsum(velocity) * PERIOD, velocity


def document(width: int, **more: Any) -> dict[str, Any]:
    """A file as a tool wrote it, with rows of this width."""
    rows = {}
    for key in RUNS:
        time, u, x, v = motion(key)
        right = motion(key, side=1.1)
        other, still = np.full(COUNT, 12.5), np.zeros(COUNT)
        rows[key] = {
            4: [time, u, x, v],
            6: [time, other, u / 12, u, x, v],
            9: [time, u, u, x, right[2], v, right[3], still, still],
            10: [time, other, u / 12, u, u, x, right[2], v, right[3], still],
        }[width]
    return {key: np.transpose(columns).tolist() for key, columns in rows.items()} | more


def sysid(width: int, mechanism: str, **more: Any) -> dict[str, Any]:
    """A file of SysId, 2021 to 2023."""
    words = {"test": mechanism, "units": "Meters", "unitsPerRotation": 0.5, "sysid": True}
    return document(width) | words | more


def scaled(made: dict[str, Any], key: str, *columns: int, by: float = -1.0) -> None:
    """Multiply columns of a run."""
    for row in made[key]:
        for column in columns:
            row[column] *= by


def read_json(folder: Path, made: object, **asked: Any) -> Log:
    path = folder / "sysid_data.json"
    path.write_text(made if isinstance(made, str) else json.dumps(made), encoding="utf-8")
    return sim.read(path, **asked)


def only_doubt(log: Log) -> Doubt:
    (doubt,) = log.doubts
    return doubt


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
        (run,) = log.of(name)
        assert run.time.tolist() == time.tolist()
        assert run.voltage.tolist() == voltage.tolist()
        assert run.position.tolist() == (position * 0.5).tolist()
        assert run.velocity.tolist() == (velocity * 0.5).tolist()
        assert run.bus_voltage is None


@pytest.mark.parametrize(
    ("units", "per_rotation", "si"),
    [
        ("Meters", 0.5, 0.5),
        ("Feet", 2.0, 2.0 * 0.3048),
        ("Radians", 2.0 * np.pi, 2.0 * np.pi),
        ("Degrees", 360.0, 2.0 * np.pi),
        ("Rotations", 1.0, 2.0 * np.pi),
    ],
)
def test_rotations_become_the_units_of_the_file_and_these_si(
    tmp_path: Path, units: str, per_rotation: float, si: float
) -> None:
    log = read_json(tmp_path, sysid(4, "Simple", units=units, unitsPerRotation=per_rotation))

    (run,) = log.of("dynamic-forward")
    assert log.units == units.lower()
    assert run.velocity[-1] == pytest.approx(3.0 * si, rel=1e-15)


def test_rows_of_six_have_the_battery_and_no_word_about_units(tmp_path: Path) -> None:
    log = read_json(tmp_path, document(6))

    assert (log.type, log.mechanism, log.units) == ("", "", "meters")
    assert only_doubt(log).code == "units-unknown"
    assert "taken as meters" in only_doubt(log).message
    assert "--units" in only_doubt(log).message
    (run,) = log.of("dynamic-forward")
    assert run.voltage[-1] == 6.0
    assert run.velocity[-1] == 3.0
    assert run.bus_voltage is not None
    assert run.bus_voltage.tolist() == [12.5] * COUNT


@pytest.mark.parametrize(
    ("asked", "units"),
    [
        pytest.param({"units": "feet"}, "feet", id="as said"),
        pytest.param({"type": "arm"}, "radians", id="an arm's default"),
    ],
)
def test_units_a_file_leaves_open_are_settled_by_asking(
    tmp_path: Path, asked: dict[str, str], units: str
) -> None:
    log = read_json(tmp_path, document(6), **asked)

    assert log.units == units
    assert [doubt.code for doubt in log.doubts] == ([] if "units" in asked else ["units-unknown"])


def test_units_one_says_go_before_those_of_the_file_with_a_doubt(tmp_path: Path) -> None:
    log = read_json(tmp_path, sysid(4, "Simple"), units="feet")

    assert log.units == "feet"
    assert log.of("dynamic-forward")[0].velocity[-1] == pytest.approx(3.0 * 0.5 * 0.3048)
    assert only_doubt(log).code == "contradicting-units"
    assert "Meters" in only_doubt(log).message
    assert read_json(tmp_path, sysid(4, "Simple"), units="meters").doubts == ()


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
        (run,) = log.of(name)
        assert run.time.tolist() == time.tolist()
        assert run.voltage.tolist() == voltage.tolist()
        np.testing.assert_allclose(run.position, share * 0.5 * position, rtol=1e-14)
        np.testing.assert_allclose(run.velocity, share * 0.5 * velocity, rtol=1e-14)
        assert (run.bus_voltage is None) == (width == 9)


def test_a_file_of_2020_that_says_nothing_is_a_drivetrain_by_its_two_sides(tmp_path: Path) -> None:
    log = read_json(tmp_path, document(10) | {"track-width": document(10)["slow-forward"]})

    assert log.type == "simple"
    assert len(log.runs) == 4
    assert only_doubt(log).code == "units-unknown"


@pytest.mark.parametrize("words", [{"test": "Elevator", "units": "Feet"}, {"units": "Feet"}])
def test_a_row_of_ten_whose_right_side_is_unused_is_one_mechanism(
    tmp_path: Path, words: dict[str, str]
) -> None:
    made = document(10, **words)
    for key in RUNS:
        scaled(made, key, 4, 6, 8, by=0.0)

    log = read_json(tmp_path, made)

    assert log.type == words.get("test", "").lower()
    assert log.of("dynamic-forward")[0].voltage[-1] == 6.0
    assert log.doubts == ()


def test_the_nine_columns_of_2019_are_told_from_those_of_sysid_by_the_battery(
    tmp_path: Path,
) -> None:
    made = {key: [row[:9] for row in rows] for key, rows in document(10).items()}

    (run,) = read_json(tmp_path, made, motor="left").of("dynamic-forward")
    assert run.voltage[-1] == 6.0
    assert run.bus_voltage is not None
    assert run.bus_voltage[-1] == 12.5

    (run,) = read_json(tmp_path, document(9), motor="left").of("dynamic-forward")
    assert run.voltage[-1] == 6.0
    assert run.bus_voltage is None


def test_an_angular_drivetrain_is_half_the_difference_of_its_sides(tmp_path: Path) -> None:
    made = sysid(9, "Drivetrain (Angular)")
    for key in RUNS:
        scaled(made, key, 1, 3, 5)  # turning left, the left side runs backward

    log = read_json(tmp_path, made)

    (run,) = log.of("quasistatic-reverse")
    _, voltage, _, velocity = motion("slow-backward")
    assert run.voltage.tolist() == voltage.tolist()
    np.testing.assert_allclose(run.velocity, 1.05 * 0.5 * velocity, rtol=1e-14)
    assert (log.type, log.mechanism) == ("simple", "Drivetrain (Angular)")
    assert only_doubt(log).code == "turning-drivetrain"
    assert "half the track width" in only_doubt(log).message


REPAIRS = [
    pytest.param(
        {"slow-backward": [3, 4], "fast-backward": [3, 4]},
        {"unsigned-voltage": ["left", "right"]},
        id="no voltage has a sign",
    ),
    pytest.param(
        {"slow-backward": [4], "fast-backward": [4]},
        {"unsigned-voltage": ["right"]},
        id="the right voltage has no sign",
    ),
    pytest.param(
        {key: [4] for key in RUNS},
        {"inverted-voltage": ["right"]},
        id="the right voltage is inverted",
    ),
    pytest.param(
        {"fast-forward": [3]},
        {"inverted-voltage": ["left"]},
        id="the left voltage is inverted in one run",
    ),
    pytest.param(
        {key: [6, 8] for key in RUNS},
        {"inverted-encoder": ["right"]},
        id="the right encoder is inverted",
    ),
    pytest.param(
        {key: [4, 6, 8] for key in RUNS},
        {"mirrored-side": ["right"]},
        id="the right side is mirrored",
    ),
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


def test_a_doubt_about_one_side_does_not_follow_the_other(tmp_path: Path) -> None:
    made = sysid(10, "Drivetrain")
    for key in RUNS:
        scaled(made, key, 4)

    assert read_json(tmp_path, made, motor="left").doubts == ()
    assert only_doubt(read_json(tmp_path, made, motor="right")).code == "inverted-voltage"


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


@pytest.mark.parametrize(
    "keys",
    [
        pytest.param(list(RUNS), id="in all runs"),
        pytest.param(["slow-forward"], id="in a forward run"),
    ],
)
def test_other_signs_of_one_mechanism_are_left_to_later_checks(
    tmp_path: Path, keys: list[str]
) -> None:
    made = sysid(4, "Arm")
    for key in keys:
        scaled(made, key, 1)

    log = read_json(tmp_path, made)

    assert log.doubts == ()
    for key, test in RUNS.items():
        sign = -1.0 if key in keys else 1.0
        assert np.array_equal(log.of(test)[0].voltage, sign * motion(key)[1])


def test_both_sides_against_the_tests_name_stay_as_recorded(tmp_path: Path) -> None:
    made = sysid(9, "Drivetrain")
    made["fast-forward"], made["fast-backward"] = made["fast-backward"], made["fast-forward"]

    log = read_json(tmp_path, made)

    assert log.doubts == ()
    assert log.of("dynamic-forward")[0].velocity[-1] < 0


def test_a_side_that_does_not_move_is_refused_unless_the_other_is_chosen(tmp_path: Path) -> None:
    made = sysid(9, "Drivetrain")
    for key in RUNS:
        scaled(made, key, 4, 6, by=0.0)

    with pytest.raises(MissingSignal, match="right encoder .*stands still.* --motor left"):
        read_json(tmp_path, made)
    assert read_json(tmp_path, made, motor="left").of("dynamic-forward")[0].velocity[-1] == 1.5


def test_sides_that_move_differently_are_doubted(tmp_path: Path) -> None:
    made = sysid(9, "Drivetrain")
    scaled(made, "fast-forward", 6, by=1.5)

    doubt = only_doubt(read_json(tmp_path, made))

    assert doubt.code == "sides-differ"
    assert "dynamic-forward" in doubt.message
    assert "--motor left and --motor right" in doubt.message


def test_signs_that_come_and_go_are_doubted(tmp_path: Path) -> None:
    made = sysid(9, "Drivetrain")
    for row in made["fast-forward"][::2]:
        row[5] *= -1

    log = read_json(tmp_path, made, motor="left")

    assert only_doubt(log).code == "unclear-sign"
    assert "left, dynamic-forward" in only_doubt(log).message


def test_an_empty_run_and_an_unknown_one_are_doubted(tmp_path: Path) -> None:
    made = sysid(4, "Simple") | {"slow-forward": [], "fast_forward": [[1, 2, 3, 4]]}

    log = read_json(tmp_path, made)

    assert len(log.runs) == 3
    assert {doubt.code: "fast_forward" in doubt.message for doubt in log.doubts} == {
        "empty-run": False,
        "unknown-run": True,
    }


def test_a_gyro_that_gave_no_number_does_not_matter(tmp_path: Path) -> None:
    made = sysid(9, "Drivetrain")
    for row in made["slow-forward"]:
        row[7] = row[8] = None

    assert len(read_json(tmp_path, made).runs) == 4


def test_a_mechanism_no_tool_wrote_is_doubted(tmp_path: Path) -> None:
    log = read_json(tmp_path, sysid(4, "Catapult"))

    assert (log.type, log.mechanism) == ("", "Catapult")
    assert only_doubt(log).code == "unknown-mechanism"
    assert "--type" in only_doubt(log).message


def test_repeated_rows_are_dropped_with_a_doubt(tmp_path: Path) -> None:
    made = sysid(4, "Simple")
    made["fast-forward"].insert(5, made["fast-forward"][5])

    log = read_json(tmp_path, made)

    assert len(log.of("dynamic-forward")[0]) == COUNT
    assert only_doubt(log).code == "repeated-time"


def with_row(row: object, *, width: int = 4, test: str = "Simple") -> dict[str, Any]:
    """A sound file but for row 7 of one run."""
    made = sysid(width, test)
    made["fast-forward"][7] = row
    return made


TEXT = json.dumps(sysid(4, "Simple"), indent=1)
REFUSED = [
    pytest.param(
        TEXT[: len(TEXT) // 2],
        UnreadableFile,
        r"line \d+, column \d+: the file ends in the middle\. Copy it again",
        id="truncated",
    ),
    pytest.param(
        TEXT.replace("0.0,\n", "0.0\n", 1),
        UnreadableFile,
        r"line 5, column \d+: damaged JSON \(Expecting ',' delimiter\)\. Copy it again",
        id="a comma lost",
    ),
    pytest.param(
        '{"slow-forward": ' + "[" * 100_000,
        UnreadableFile,
        "not an object with a list of rows.*unchanged",
        id="nested without end",
    ),
    pytest.param(
        '{"slow-forward": [[1,2,3,4]], "slow-forward": [[1,2,3,4]]}',
        UnreadableFile,
        r"json: 'slow-forward' stands in it 2 times\. Keep one",
        id="a run twice",
    ),
    pytest.param(
        with_row([1, 2, 3]),
        UnreadableFile,
        r"fast-forward, row 7: \[1\.0, 2\.0, 3\.0\] is not a row of 4 numbers.*Remove",
        id="a row too short",
    ),
    pytest.param(
        with_row([1, 2, "3", 4]), UnreadableFile, "row 7: .*not a row of 4", id="a word in a row"
    ),
    pytest.param(
        with_row([1, 2, True, 4]), UnreadableFile, "row 7: .*not a row of 4", id="a truth in a row"
    ),
    pytest.param(with_row("slow"), UnreadableFile, "fast-forward: not a list", id="no row"),
    pytest.param(
        with_row([1, 2, 3, float("nan")]),
        BadSample,
        "dynamic-forward: velocity is nan in row 7. Remove that row",
        id="nan",
    ),
    pytest.param(
        with_row([1, None, 3, 4]), BadSample, "voltage is nan in row 7.*record", id="null"
    ),
    pytest.param(
        with_row([1, 2, float("inf"), 4]), BadSample, "position is inf in row 7", id="infinite"
    ),
    pytest.param(
        '{"fast-forward": [[1, 2, ' + "3" * 5000 + ", 4]]}",
        BadSample,
        "position is inf in row 0",
        id="a number too long",
    ),
    pytest.param(
        with_row([1, 2, 3, 4, 1e30, 6, 7, 8, 9], width=9, test="Drivetrain"),
        BadSample,
        "right position is 1e\\+30 in row 7",
        id="absurd, on the right",
    ),
    pytest.param(
        sysid(4, "Simple") | {"fast-forward": [[t, 1, 0, 0] for t in (5, 6, 1, 2)]},
        BadSample,
        r"json, dynamic-forward: time does not increase",
        id="time goes back",
    ),
    pytest.param(
        sysid(4, "Simple") | {"slow-forward": None},
        UnreadableFile,
        "slow-forward: not a list of rows",
        id="null for a run",
    ),
    pytest.param(
        {"slow-forward": [[1, 2, 3, 4, 5]]},
        UnreadableFile,
        "rows have 5 numbers.*4, 6, 9, 10",
        id="a width no tool wrote",
    ),
    pytest.param(
        sysid(4, "Simple") | {"slow-forward": document(9)["slow-forward"]},
        UnreadableFile,
        "9 numbers in quasistatic-forward, 4 numbers in .*not two joined",
        id="two widths",
    ),
    pytest.param({key: [] for key in RUNS}, UnreadableFile, "all its runs are empty", id="empty"),
    pytest.param(
        {"test": "Arm", "units": "Meters"},
        UnreadableFile,
        "there is no run in it.*slow-forward, slow-backward",
        id="no run",
    ),
    pytest.param({"slow-forward": [[]]}, UnreadableFile, "0 numbers", id="an empty row"),
    pytest.param([1, 2], UnreadableFile, "not an object with a list of rows", id="a list"),
    pytest.param(
        sysid(9, "Arm"), UnreadableFile, "drivetrain, but its test is 'Arm'", id="a wrong test"
    ),
    pytest.param(sysid(4, "Arm", test=3), UnreadableFile, "test is not a name", id="no name"),
    pytest.param(
        sysid(4, "Arm", units="Furlongs"),
        UnreadableFile,
        "units are 'Furlongs'.*--units, one of: meters",
        id="unknown units",
    ),
    pytest.param(sysid(4, "Arm", units=[]), UnreadableFile, r"units are \[\]", id="no units"),
    *(
        pytest.param(
            sysid(4, "Arm", unitsPerRotation=per),
            UnreadableFile,
            "unitsPerRotation is .*a positive number",
            id=f"{per} units per rotation",
        )
        for per in (0, -1, "0.5", None, float("nan"), float("inf"))
    ),
]


@pytest.mark.parametrize(("made", "refusal", "said"), REFUSED)
def test_a_damaged_file_is_refused_with_the_place_and_advice(
    tmp_path: Path, made: object, refusal: type[Refusal], said: str
) -> None:
    with pytest.raises(refusal, match=said):
        read_json(tmp_path, made)


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"motor": "middle"}, "no motor 'middle'.* --motor from: left, right, combined"),
        ({"entries": {"voltage": "volts"}}, "columns .* have no names.*Leave out"),
    ],
)
def test_a_request_the_format_cannot_meet_is_refused(
    tmp_path: Path, asked: dict[str, Any], said: str
) -> None:
    with pytest.raises(BadRequest, match=said):
        read_json(tmp_path, sysid(9, "Drivetrain"), **asked)


def read_or_refusal(path: Path, data: bytes) -> Log | Refusal:
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

    outcome = read_or_refusal(path, json.dumps(made).encode())

    assert isinstance(outcome, Log) or (str(path) in str(outcome) and "\n" not in str(outcome))


@given(st.binary(max_size=8), st.integers(0, len(TEXT)), st.integers(0, 60))
def test_any_damage_is_read_or_refused_in_one_line(
    tmp_path_factory: pytest.TempPathFactory, junk: bytes, at: int, cut: int
) -> None:
    path = tmp_path_factory.getbasetemp() / "damaged.json"

    outcome = read_or_refusal(path, TEXT[:at].encode() + junk + TEXT[at + cut :].encode())

    assert isinstance(outcome, Log) or (str(path) in str(outcome) and "\n" not in str(outcome))


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


@pytest.mark.shared
@pytest.mark.parametrize("motor", ["left", "right", None])
@pytest.mark.parametrize("name", ["frc4646-2022-drivetrain", "frc501-2020-drivetrain"])
def test_both_sides_of_a_real_drivetrain_go_the_way_they_are_pushed(
    shared: Path, name: str, motor: str | None
) -> None:
    log = sim.read(shared / "data" / "real" / f"{name}.json", motor=motor)

    for run in log.runs:
        way = 1.0 if run.direction == "forward" else -1.0
        assert (way * run.voltage >= 0).all()
        assert (way * run.velocity >= 0).all()
        assert way * (run.position[-1] - run.position[0]) > 0.5
        assert (run.bus_voltage is not None) == ("2020" in name)
