"""CSV logs: what columns mean, and what is damaged."""

from pathlib import Path

import numpy as np
import pytest

import sim
from sim.core.errors import BadRequest, BadSample, MissingSignal, Refusal, UnreadableFile
from sim.core.log import Log, Run
from sim.io import list_entries
from sim.io.entries import assemble_logs
from sim.io.entries.entry import Entry
from sim.io.format import ReadOptions

HEADER = "test,time_s,voltage,position,velocity"
PLAIN = f"""{HEADER}
quasistatic-forward,0.0,0.5,1.0,0.25
quasistatic-forward,0.02,0.75,1.5,0.5
dynamic-reverse,3.0,-7.0,2.0,-1.0
"""


def read_text(folder: Path, text: str | bytes, **asked: object) -> Log:
    path = folder / "log.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode("utf-8"))
    return sim.read(path, **asked)


SIGNALS = ("time", "voltage", "position", "velocity", "current", "bus_voltage")


def columns(log: Log) -> list[tuple[str, list[list[float]]]]:
    signals = ("time", "voltage", "position", "velocity")
    return [(run.test, [getattr(run, name).tolist() for name in signals]) for run in log.runs]


WORKED = [
    ("quasistatic-forward", [[0.0, 0.02], [0.5, 0.75], [1.0, 1.5], [0.25, 0.5]]),
    ("dynamic-reverse", [[3.0], [-7.0], [2.0], [-1.0]]),
]


@pytest.mark.parametrize(
    "text",
    [
        pytest.param(PLAIN, id="as documented"),
        pytest.param("\ufeff" + PLAIN, id="with a byte-order mark"),
        pytest.param(PLAIN.replace("\n", "\r\n"), id="with Windows line ends"),
        pytest.param(PLAIN.replace("\n", "\r"), id="with line ends of an old Mac"),
        pytest.param(PLAIN.replace("\n", "\n\n"), id="with blank lines"),
        pytest.param("\n \n" + PLAIN + ",,,,\n", id="with lines a spreadsheet left empty"),
        pytest.param(PLAIN.replace(",", " , "), id="with spaces around cells"),
        pytest.param(PLAIN.upper(), id="in capitals"),
        pytest.param(PLAIN.replace(",", "\t"), id="with tabs"),
        pytest.param(PLAIN.replace(",", ";"), id="with semicolons"),
        pytest.param(PLAIN.replace(",", ";").replace(".", ","), id="with decimal commas"),
        pytest.param(
            "\n".join(",".join(f'"{c}"' for c in row.split(",")) for row in PLAIN.split()),
            id="with every cell in quotation marks",
        ),
        pytest.param(
            "\n".join(",".join(reversed(row.split(","))) for row in PLAIN.split()),
            id="with the columns in another order",
        ),
        pytest.param(
            PLAIN.replace("quasistatic-forward", "slow-forward").replace(
                "dynamic-reverse", "fast-backward"
            ),
            id="with the names of the older tools",
        ),
        pytest.param(
            PLAIN.replace("quasistatic-forward", "Quasistatic Forward").replace(
                "dynamic-reverse", "dynamic_backward"
            ),
            id="with names as people write them",
        ),
        pytest.param(PLAIN.rstrip("\n"), id="without a last line end"),
    ],
)
def test_log_reads_the_same_in_every_spelling_of_its_csv(tmp_path: Path, text: str) -> None:
    log = read_text(tmp_path, text)

    assert columns(log) == WORKED
    assert log.doubts == ()


@pytest.mark.parametrize(
    ("rows", "lengths"),
    [
        pytest.param(["a 0", "a 1", "b 0", "b 1"], [2, 2], id="a new test"),
        pytest.param(["a 5", "a 6", "a 0", "a 1"], [2, 2], id="time goes back"),
        pytest.param(["a 0", "a 1", "b 2", "a 3"], [2, 1, 1], id="the first test again"),
        pytest.param(["a 0", "a 1", "a 2"], [3], id="none"),
    ],
)
def test_runs_are_split_at_time_jumps_and_test_changes_without_a_run_column(
    tmp_path: Path, rows: list[str], lengths: list[int]
) -> None:
    names = {"a": "coast-forward", "b": "triangle-reverse"}
    lines = [f"{names[row[0]]},{row[2]},0,0,0" for row in rows]

    log = read_text(tmp_path, "\n".join([HEADER, *lines]))

    assert [len(run) for run in log.runs] == lengths


def test_current_and_bus_voltage_are_read_where_a_run_has_them(tmp_path: Path) -> None:
    text = f"""{HEADER},bus_voltage,current
dynamic-forward,0,1,0,0,12.5,40
dynamic-forward,1,1,0,0,12.4,41
dynamic-reverse,0,1,0,0,12.3,
"""

    forward, reverse = read_text(tmp_path, text).runs

    assert forward.current is not None
    assert forward.current.tolist() == [40.0, 41.0]
    assert reverse.current is None
    assert reverse.bus_voltage is not None
    assert reverse.bus_voltage.tolist() == [12.3]


def test_an_unknown_column_is_named_and_left_out(tmp_path: Path) -> None:
    rows = PLAIN.strip().split("\n")
    text = "\n".join([rows[0] + ",acceleration", *(row + ",what?" for row in rows[1:])])

    log = read_text(tmp_path, text)

    assert columns(log) == WORKED
    (doubt,) = log.doubts
    assert doubt.code == "unknown-column"
    assert "'acceleration'" in doubt.message
    assert "bus_voltage" in doubt.message


def test_columns_of_other_names_are_read_when_options_name_them(tmp_path: Path) -> None:
    text = PLAIN.replace(HEADER, "State,time_s,Volts,Angle,velocity")
    names = {"state": "state", "voltage": "volts", "position": "ANGLE"}

    assert columns(read_text(tmp_path, text, entries=names)) == WORKED
    with pytest.raises(BadRequest) as refused:
        read_text(tmp_path, text, entries={"torque": "volts"})
    assert refused.value.advice


def sampled(test: str, n: int, *, rng: np.random.Generator, **more: bool) -> Run:
    signals = {name: rng.normal(size=n) * 10.0 for name in SIGNALS[1:4]}
    signals |= {name: rng.normal(size=n) for name, wanted in more.items() if wanted}
    return Run(test, np.cumsum(rng.uniform(1e-4, 0.1, n)), **signals)


def test_written_csv_is_read_back_bit_by_bit(tmp_path: Path) -> None:
    rng = np.random.default_rng(3)
    runs = (
        sampled("quasistatic-forward", 40, rng=rng, current=True),
        sampled("quasistatic-forward", 1, rng=rng),
        sampled("chirp-reverse", 30, rng=rng, current=True, bus_voltage=True),
    )

    sim.write(Log(runs), tmp_path / "log.csv")
    back = sim.read(tmp_path / "log.csv")

    assert back.doubts == ()
    assert [run.test for run in back.runs] == [run.test for run in runs]
    for ours, theirs in zip(runs, back.runs, strict=True):
        for name in SIGNALS:
            one, other = getattr(ours, name), getattr(theirs, name)
            assert (one is None) == (other is None)
            assert one is None or one.tobytes() == other.tobytes()


def test_motor_asked_of_a_file_with_one_makes_no_difference(tmp_path: Path) -> None:
    (doubt,) = read_text(tmp_path, PLAIN, motor="left").doubts

    assert doubt.code == "one-motor"


def test_whole_numbers_that_count_something_are_no_voltage():
    time = np.arange(0, 2_000_000, 20_000)
    entries = (
        Entry("state", "string", "", time, np.full(time.size, "dynamic-forward")),
        Entry("angle", "double", "", time, np.linspace(0.0, 3.0, time.size)),
        Entry("flags", "int64", "", time, np.where(time < 1_000_000, 32.0, 33.0)),
    )
    named = {"state": "state", "position": "angle", "voltage": "flags"}

    with pytest.raises(MissingSignal, match="'flags' cannot be a voltage: .* 32, 33"):
        assemble_logs(entries, options=ReadOptions(entries=named), where="log")


def test_columns_of_a_table_are_listed_as_entries(tmp_path):
    text = "Zeit;Spannung;Test\n0,02;1,5;dynamic-forward\n0,04;1,6;dynamic-forward\n"
    (tmp_path / "t.csv").write_text(text, encoding="utf-8")
    found = {one.name: one for one in list_entries(tmp_path / "t.csv")}

    assert list(found) == ["Zeit", "Spannung", "Test"]
    assert found["Spannung"].numbers().tolist() == [1.5, 1.6]
    assert found["Test"].type == "string"


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
def test_malformed_csv_is_refused(
    tmp_path: Path, text: str | bytes, refusal: type[Refusal]
) -> None:
    with pytest.raises(refusal, match=r"log\.csv"):
        read_text(tmp_path, text)
