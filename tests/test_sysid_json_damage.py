"""Damaged JSON of 2019 to 2023: refused with the place and with advice, whatever is wrong."""

import json
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from old_tools import RUNS, document, read_json, sysid

import sim
from sim.core.errors import BadSample, Refusal, UnreadableFile
from sim.core.log import Log


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
