"""Damaged CSV logs: refused by line and column, with advice."""

from pathlib import Path

import pytest
from test_csv import HEADER, PLAIN, read_text

from sim.core.errors import BadSample, MissingSignal, Refusal, UnreadableFile


def row(**cells: str) -> str:
    """One row of a sound file, cells replaced."""
    sound = {"test": "dynamic-forward", "time_s": "1", "voltage": "2", "position": "3"}
    return ",".join({**sound, "velocity": "4", **cells}.values())


DAMAGED = {
    "a word for a number": ([row(), row(velocity="abc")], BadSample, 3),
    "an empty cell, blank lines counted": (["", row(), "", row(position=" ")], BadSample, 5),
    "nan": ([row(voltage="nan")], BadSample, 2),
    "infinite": ([row(time_s="-inf")], BadSample, 2),
    "absurdly large": ([row(voltage="1e12")], BadSample, 2),
    "underscore": ([row(velocity="1_000")], BadSample, 2),
    "a row that is too short": ([row(), "dynamic-forward,1,2"], UnreadableFile, 3),
    "a row that is too long": ([row() + ",5"], UnreadableFile, 2),
    "an unknown test": ([row(test="dynamics")], UnreadableFile, 2),
    "open quote": (['"' + row()], UnreadableFile, 2),
}


@pytest.mark.parametrize(("rows", "refusal", "line"), DAMAGED.values(), ids=DAMAGED)
def test_damaged_row_is_named_by_its_line(
    tmp_path: Path, rows: list[str], refusal: type[Refusal], line: int
) -> None:
    with pytest.raises(refusal, match=rf"log\.csv, line {line}: "):
        read_text(tmp_path, "\n".join([HEADER, *rows]))


UNSOUND = {
    "no rows": (HEADER, UnreadableFile),
    "a column of another name": (PLAIN.replace("velocity", "speed"), MissingSignal),
    "a column twice": (PLAIN.replace("position", "velocity"), UnreadableFile),
    "bytes that are no text": (PLAIN.encode() + b"\xff", UnreadableFile),
    "a thousands sign": (PLAIN.replace(",", ";").replace("0.5;", "1.000,5;"), UnreadableFile),
    "two tests in one run": (
        f"run,{HEADER}\n1,{row()}\n1,{row(test='coast-forward', time_s='2')}\n", UnreadableFile
    ),
    "time back in one run": (
        f"run,{HEADER}\n1,{row()}\n1,{row(time_s='0.5')}\n", UnreadableFile
    ),
    "a current that stops": (f"{HEADER},current\n{row()},5\n{row(time_s='2')},\n", BadSample),
    "a current that is nan": (f"{HEADER},current\n{row()},nan\n", BadSample),
}  # fmt: skip


@pytest.mark.parametrize(("text", "refusal"), UNSOUND.values(), ids=UNSOUND)
def test_file_that_is_not_sound_is_refused(
    tmp_path: Path, text: str | bytes, refusal: type[Refusal]
) -> None:
    with pytest.raises(refusal, match=r"log\.csv"):
        read_text(tmp_path, text)
