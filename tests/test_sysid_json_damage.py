"""Damaged JSON of 2019 to 2023: refused with the place and with advice, whatever is wrong."""

import json
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from old_tools import RUNS, document, read_json, sysid

import sim
from sim.core.errors import BadRequest, BadSample, Refusal, UnreadableFile
from sim.core.log import Log


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
        r"json: 'slow-forward' appears in it 2 times\. Keep one",
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
        ({"motor": "middle"}, "no motor 'middle'.* --motor: left, right, combined"),
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
