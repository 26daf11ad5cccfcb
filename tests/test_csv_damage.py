"""Damaged CSV logs: refused by line and column, with advice."""

from pathlib import Path

import pytest
from csv_text import HEADER, PLAIN, read_text
from hypothesis import given
from hypothesis import strategies as st

import sim
from sim.core.errors import BadSample, MissingSignal, Refusal, UnreadableFile
from sim.core.log import Log


def read_or_refusal(path: Path) -> Log | Refusal:
    try:
        return sim.read(path)
    except Refusal as refusal:
        return refusal


def row(**cells: str) -> str:
    """One row of a sound file, cells replaced."""
    sound = {"test": "dynamic-forward", "time_s": "1", "voltage": "2", "position": "3"}
    return ",".join({**sound, "velocity": "4", **cells}.values())


REFUSED = [
    pytest.param(
        [row(), row(velocity="abc")],
        BadSample,
        r"log\.csv, line 3: velocity is 'abc', not a number\. Write a number there",
        id="a word for a number",
    ),
    pytest.param(
        ["", row(), "", row(position=" ")],
        BadSample,
        r"line 5: position is empty\. Write a number",
        id="an empty cell, blank lines counted",
    ),
    pytest.param(
        [row(voltage="nan")], BadSample, r"line 2: voltage is nan\. Write a number", id="nan"
    ),
    pytest.param(
        [row(time_s="-inf")], BadSample, r"line 2: time_s is -inf\. Write a number", id="infinite"
    ),
    pytest.param(
        [row(voltage="1e12")], BadSample, r"line 2: voltage is 1e12\. Write", id="absurdly large"
    ),
    pytest.param(
        [row(velocity="1_000")], BadSample, r"velocity is '1_000', not a number", id="underscore"
    ),
    pytest.param(
        [row(), "dynamic-forward,1,2"],
        UnreadableFile,
        r"line 3: the row has 3 cells where the header has 5\. Complete the line",
        id="a row that is too short",
    ),
    pytest.param(
        [row() + ",5"],
        UnreadableFile,
        r"line 2: the row has 6 cells where the header has 5",
        id="a row that is too long",
    ),
    pytest.param(
        [row(test="dynamics")],
        UnreadableFile,
        r"line 2: test is 'dynamics', .* quasistatic\|dynamic\|coast.* -forward or -reverse\.",
        id="an unknown test",
    ),
    pytest.param([], UnreadableFile, r"there are no rows below the header\. Record", id="no rows"),
    pytest.param(
        ['"' + row()], UnreadableFile, r"line 2: damaged CSV .* quotation mark", id="open quote"
    ),
]


@pytest.mark.parametrize(("rows", "refusal", "said"), REFUSED)
def test_a_damaged_row_is_named_by_line_and_column(
    tmp_path: Path, rows: list[str], refusal: type[Refusal], said: str
) -> None:
    with pytest.raises(refusal, match=said):
        read_text(tmp_path, "\n".join([HEADER, *rows]))


@pytest.mark.parametrize(
    ("text", "refusal", "said"),
    [
        pytest.param(
            PLAIN.replace("velocity", "speed"),
            MissingSignal,
            r"no column velocity; .*speed.*Name the columns test,time_s.* --velocity",
            id="a column of another name",
        ),
        pytest.param(
            PLAIN.replace("position", "velocity"),
            UnreadableFile,
            "two columns are named velocity.*rename one",
            id="a column twice",
        ),
        pytest.param(
            PLAIN.encode() + b"\xff",
            UnreadableFile,
            f"byte {len(PLAIN)} is not UTF-8.*Save",
            id="bytes that are no text",
        ),
        pytest.param(
            PLAIN.replace(",", ";").replace("0.5;", "1.000,5;"),
            UnreadableFile,
            "both commas and points.*one decimal sign",
            id="a sign for thousands",
        ),
        pytest.param(
            f"run,{HEADER}\n1,{row()}\n1,{row(test='coast-forward', time_s='2')}\n",
            UnreadableFile,
            r"line 3: run '1' changes its test here.*value of its own",
            id="two tests in one run",
        ),
        pytest.param(
            f"run,{HEADER}\n1,{row()}\n1,{row(time_s='0.5')}\n",
            UnreadableFile,
            r"line 3: run '1' goes back in time here.*or leave the column out",
            id="time back in one run",
        ),
        pytest.param(
            f"{HEADER},current\n{row()},5\n{row(time_s='2')},\n",
            BadSample,
            r"line 3: current is empty, in a run that has it elsewhere.*whole run",
            id="a current that stops",
        ),
        pytest.param(
            f"{HEADER},current\n{row()},nan\n",
            BadSample,
            r"line 2: current is nan",
            id="a current that is nan",
        ),
    ],
)
def test_a_file_that_is_not_sound_is_refused_with_advice(
    tmp_path: Path, text: str | bytes, refusal: type[Refusal], said: str
) -> None:
    with pytest.raises(refusal, match=said):
        read_text(tmp_path, text)


@given(
    st.text('0123456789.,-+einf;\t\n\r" abc_#\u00e9\x00'),
    st.integers(0, len(PLAIN)),
    st.integers(0, 20),
)
def test_any_damage_is_read_or_refused_in_one_line(
    tmp_path_factory: pytest.TempPathFactory, junk: str, at: int, cut: int
) -> None:
    path = tmp_path_factory.getbasetemp() / "damaged.csv"
    path.write_bytes((PLAIN[:at] + junk + PLAIN[at + cut :]).encode("utf-8"))

    outcome = read_or_refusal(path)

    if isinstance(outcome, Refusal):
        assert str(path) in str(outcome)
        assert "\n" not in str(outcome)
    else:
        assert all(len(run) for run in outcome.runs)
