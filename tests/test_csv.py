"""CSV logs: what is read, what is refused and where, and that nothing is lost on the way."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import sim
from sim.errors import BadRequest, BadSample, MissingSignal, Refusal, UnreadableFile
from sim.log import Log, Run

HEADER = "test,time_s,voltage,position,velocity"
SIGNALS = ("time", "voltage", "position", "velocity", "current", "bus_voltage")
PLAIN = f"""{HEADER}
quasistatic-forward,0.0,0.5,1.0,0.25
quasistatic-forward,0.02,0.75,1.5,0.5
dynamic-reverse,3.0,-7.0,2.0,-1.0
"""


def read_text(folder: Path, text: str | bytes, **asked: object) -> Log:
    path = folder / "log.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode("utf-8"))
    return sim.read(path, **asked)


def read_or_refusal(path: Path) -> Log | Refusal:
    try:
        return sim.read(path)
    except Refusal as refusal:
        return refusal


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
def test_one_log_reads_the_same_in_every_dress(tmp_path: Path, text: str) -> None:
    log = read_text(tmp_path, text)

    assert columns(log) == WORKED
    assert log.doubts == ()


def test_the_file_says_no_units_and_no_type(tmp_path: Path) -> None:
    log = read_text(tmp_path, PLAIN)

    assert (log.units, log.type, log.mechanism) == ("meters", "", "")


@pytest.mark.parametrize(
    ("asked", "units", "first"),
    [
        pytest.param({"units": "feet"}, "feet", 0.3048, id="feet"),
        pytest.param({"type": "arm"}, "radians", 1.0, id="an arm is in radians"),
        pytest.param({"type": "arm", "units": "degrees"}, "degrees", np.pi / 180, id="degrees"),
        pytest.param({"type": "elevator"}, "meters", 1.0, id="an elevator in meters"),
    ],
)
def test_positions_become_si_by_the_units_one_says(
    tmp_path: Path, asked: dict[str, str], units: str, first: float
) -> None:
    log = read_text(tmp_path, PLAIN, **asked)

    assert log.units == units
    assert log.type == asked.get("type", "")
    assert log.runs[0].position[0] == first
    assert log.runs[0].velocity[0] == first * 0.25
    assert log.runs[0].voltage[0] == 0.5


@pytest.mark.parametrize(
    ("rows", "lengths"),
    [
        pytest.param(["a 0", "a 1", "b 0", "b 1"], [2, 2], id="a new test"),
        pytest.param(["a 5", "a 6", "a 0", "a 1"], [2, 2], id="time goes back"),
        pytest.param(["a 0", "a 1", "b 2", "a 3"], [2, 1, 1], id="the first test again"),
        pytest.param(["a 0", "a 1", "a 2"], [3], id="none"),
    ],
)
def test_without_a_run_column_a_run_begins_at(
    tmp_path: Path, rows: list[str], lengths: list[int]
) -> None:
    names = {"a": "coast-forward", "b": "triangle-reverse"}
    lines = [f"{names[row[0]]},{row[2]},0,0,0" for row in rows]

    log = read_text(tmp_path, "\n".join([HEADER, *lines]))

    assert [len(run) for run in log.runs] == lengths


def test_a_run_column_tells_runs_apart_and_gathers_their_rows(tmp_path: Path) -> None:
    text = f"""run,{HEADER}
first,dynamic-forward,0,1,0,0
2nd,dynamic-forward,0,2,0,0
first,dynamic-forward,1,3,0,0
2nd,dynamic-forward,1,4,0,0
"""

    log = read_text(tmp_path, text)

    assert [run.voltage.tolist() for run in log.runs] == [[1.0, 3.0], [2.0, 4.0]]


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


def test_columns_of_other_names_are_read_when_one_says_which(tmp_path: Path) -> None:
    text = PLAIN.replace(HEADER, "State,time_s,Volts,Angle,velocity")
    names = {"state": "state", "voltage": "volts", "position": "ANGLE"}

    assert columns(read_text(tmp_path, text, entries=names)) == WORKED
    with pytest.raises(BadRequest, match="Choose among: run, test"):
        read_text(tmp_path, text, entries={"torque": "volts"})


def test_repeated_times_are_dropped_with_a_doubt(tmp_path: Path) -> None:
    text = f"{HEADER}\n" + "dynamic-forward,0,1,0,0\n" * 3 + "dynamic-forward,1,1,0,0\n"

    log = read_text(tmp_path, text)

    assert [len(run) for run in log.runs] == [2]
    assert [doubt.code for doubt in log.doubts] == ["repeated-time"]


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
    pytest.param([], UnreadableFile, r"a header without rows\. Record", id="no rows"),
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


def sampled(test: str, n: int, *, rng: np.random.Generator, **more: bool) -> Run:
    signals = {name: rng.normal(size=n) * 10.0 for name in SIGNALS[1:4]}
    signals |= {name: rng.normal(size=n) for name, wanted in more.items() if wanted}
    return Run(test, np.cumsum(rng.uniform(1e-4, 0.1, n)), **signals)


def test_what_is_written_reads_back_as_the_same_bits(tmp_path: Path) -> None:
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


@pytest.mark.parametrize(
    ("tests", "header"),
    [
        pytest.param(["dynamic-forward", "dynamic-reverse"], HEADER, id="each test once"),
        pytest.param(["dynamic-forward"] * 2, f"run,{HEADER}", id="a test twice"),
    ],
)
def test_the_run_column_is_written_where_it_is_needed(
    tmp_path: Path, tests: list[str], header: str
) -> None:
    runs = [Run(test, [0.0, 0.1], [1.0, 2.0], [0.0, 0.5], [0.0, 1.5]) for test in tests]

    sim.write(Log(tuple(runs)), tmp_path / "log.csv")
    lines = (tmp_path / "log.csv").read_bytes().split(b"\n")

    assert lines[0].decode() == header
    assert lines[2].endswith(b"dynamic-forward,0.1,2.0,0.5,1.5")
    assert [len(run) for run in sim.read(tmp_path / "log.csv").runs] == [2, 2]


def test_positions_are_written_in_the_unit_of_the_log(tmp_path: Path) -> None:
    run = Run("dynamic-forward", [0.0], [1.0], [3.048], [0.3048])

    sim.write(Log((run,), units="feet"), tmp_path / "log.csv")

    assert (tmp_path / "log.csv").read_text("utf-8").endswith(",0.0,1.0,10.0,1.0\n")


@pytest.mark.parametrize(
    ("runs", "said"),
    [
        pytest.param((), "has no runs", id="no runs"),
        pytest.param((Run("dynamic-forward", [], [], [], []),), "has no samples", id="empty run"),
    ],
)
def test_what_rows_cannot_hold_is_not_written(
    tmp_path: Path, runs: tuple[Run, ...], said: str
) -> None:
    with pytest.raises(BadRequest, match=f"{said}.*a row of CSV is one"):
        sim.write(Log(runs), tmp_path / "log.csv")

    assert list(tmp_path.iterdir()) == []


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


@pytest.mark.shared
def test_the_reference_logs_read_whole(shared: Path) -> None:
    paths = sorted((shared / "data" / "sysid-answers").glob("*.csv"))
    paths += sorted((shared / "data" / "hidden-effects").glob("00*/*.csv"))
    assert len(paths) > 30

    for path in paths:
        log = sim.read(path)
        rows = path.read_text("utf-8").strip().count("\n")
        assert sum(len(run) for run in log.runs) == rows
        assert log.doubts == ()
