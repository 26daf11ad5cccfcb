"""CSV: one row per sample, with the header ``test,time_s,voltage,position,velocity``.

The columns may be in any order. ``run``, ``current``, ``bus_voltage``, ``type`` and ``units`` (of
the positions and velocities) are optional, and of ``position`` and ``velocity`` one suffices.
Without ``run``, a new run begins where the test changes or time goes back. Files from European
spreadsheets (``;`` between the cells, decimal commas) are read, too, and so are those of other
programs (``entries``).
"""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from sim.core.errors import BadSample, UnreadableFile
from sim.core.log import Array, Log, Run
from sim.core.units import find_unit
from sim.core.vocabulary import TYPES
from sim.io.entries import assemble_logs
from sim.io.entries.entry import Entry, find_missing_motion
from sim.io.format import (
    HEAD,
    ReadOptions,
    make_run,
    refuse_pick,
    warn_of_missing_signal,
    warn_of_motor_choice,
)
from sim.io.formats.csv.entries import is_export, read_columns, read_entries
from sim.io.formats.csv.table import EXTRA, KNOWN, NEEDED, STATED, CsvTable, open_table, read_header

SUFFIXES = (".csv",)
MIN_COLUMNS = 3  # so many known names of columns in its first line make a file a log


def recognizes(head: bytes) -> bool:
    """Whether the first line has enough of our columns, or is that of a log viewer's export."""
    text = head.decode("utf-8-sig", errors="replace")
    names = read_header(text)
    return is_export(names) or len(set(names) & set(KNOWN)) >= MIN_COLUMNS


def entries(path: Path) -> list[Entry]:
    """All entries of a log viewer's export, or the columns of a table.

    Raises:
        UnreadableFile: not UTF-8, rows of unequal length, or no rows.
        BadSample: a time is not a number.
    """
    return read_entries(path) if _is_export_file(path) else read_columns(path)


def _is_export_file(path: Path) -> bool:
    """Whether a log viewer exported the file."""
    with path.open(encoding="utf-8-sig", errors="replace") as stream:
        return is_export(read_header(stream.read(HEAD)))


def read(path: Path, options: ReadOptions) -> dict[str, Log]:
    """Read a CSV log; only a log viewer's export can have several motors.

    Args:
        path: the file.
        options: the user's choices: units, type, and columns of other names (``entries``).

    Raises:
        UnreadableFile: not UTF-8, no rows, rows of unequal length, or an unknown test.
        MissingSignal: a column is missing.
        BadSample: a cell is not a finite number; the message names line and column.
        BadRequest: a signal is unknown, or a mechanism was picked that the file does not have.
    """
    if _is_export_file(path):
        return assemble_logs(read_entries(path), options=options, where=str(path))[0]
    refuse_pick(options.pick, where=str(path))
    table = open_table(path, entries=options.entries)
    tests, codes = table.group_by_test()
    options = _take_stated(table, options)
    present = [name for name in NEEDED[2:] if name in table.cells]
    signals = {"time": table.parse_column("time_s")}
    signals |= {name: table.parse_column(name) for name in present}
    signals |= {name: table.parse_column(name, gaps=True) for name in EXTRA if name in table.cells}
    si = find_unit(options.units_or_default).si
    runs: list[Run] = []
    doubts = [*table.doubts, *warn_of_motor_choice(options.motor, where=table.where)]
    doubts += warn_of_missing_signal(find_missing_motion(present), options, where=table.where)
    for number, rows in enumerate(_split_runs(table, codes, signals["time"])):
        mine = {
            name: values[rows]
            for name, values in signals.items()
            if name not in EXTRA or _has_signal(table, name, values[rows], rows)
        }
        where = f"{table.where}, run {number}"
        run, warnings = make_run(tests[codes[rows[0]]], mine, si=si, where=where)
        runs.append(run)
        doubts.extend(warnings)
    log = Log(
        tuple(runs),
        units=options.units_or_default,
        type=options.type or "",
        source=table.where,
        doubts=tuple(doubts),
        computed=find_missing_motion(present) or "",
    )
    return {"": log}


def _take_stated(table: CsvTable, options: ReadOptions) -> ReadOptions:
    """The options, with the type and the units that the file states and the user does not."""
    units, type_ = table.find_stated("units"), table.find_stated("type")
    if type_ not in {None, *TYPES}:
        raise UnreadableFile(
            f"type is {type_!r}", where=table.where, advice=f"Types are {', '.join(TYPES)}."
        )
    return replace(
        options,
        units=options.units or (find_unit(units).name if units else None),
        type=options.type or type_,
    )


def write(log: Log, path: Path) -> None:
    """Write a log, with every number in the shortest form that reads back the same.

    The column ``run`` is written only if a test occurs twice, and ``type`` and ``units`` only if
    the log is not of a simple mechanism in meters.

    Args:
        log: the log to write; positions are written in its ``units``.
        path: the file.
    """
    numbered = len({run.test for run in log.runs}) < len(log.runs)
    extra = [name for name in EXTRA if any(getattr(run, name) is not None for run in log.runs)]
    with path.open("w", encoding="utf-8", newline="") as stream:
        stated = [] if _is_usual(log) else list(STATED)
        header = [*(["run"] if numbered else []), *NEEDED, *extra, *stated]
        stream.write(",".join(header) + "\n")
        end = f",{log.type or 'simple'},{log.units}\n" if stated else "\n"
        for number, run in enumerate(log.runs):
            prefix = f"{number},{run.test}," if numbered else f"{run.test},"
            for row in _format_rows(run, extra=extra, si=find_unit(log.units).si):
                stream.write(f"{prefix}{row}{end}")


def _is_usual(log: Log) -> bool:
    """Whether a reader takes a file that states no type and no units for this log."""
    return log.type in {"", "simple"} and log.units == ReadOptions().units_or_default


def _format_rows(run: Run, *, extra: list[str], si: float) -> Iterator[str]:
    """The numbers of a run as text, row by row."""
    signals: list[Array | None] = [run.time, run.voltage, run.position / si, run.velocity / si]
    signals += [getattr(run, name) for name in extra]
    cells = [[""] * len(run) if one is None else map(repr, one.tolist()) for one in signals]
    return map(",".join, zip(*cells, strict=True))


def _has_signal(table: CsvTable, name: str, values: Array, rows: NDArray[np.intp]) -> bool:
    """Whether a run has a signal.

    Raises:
        BadSample: only a part of the run has it.
    """
    empty = np.isnan(values)
    if empty.any() and not empty.all():
        raise BadSample(
            f"{name} is empty, in a run that has it elsewhere",
            where=table.describe_row(int(rows[np.argmax(empty)])),
            advice="Fill the column for the whole run, or empty it.",
        )
    return not empty.all()


def _split_runs(
    table: CsvTable, codes: NDArray[np.intp], time: Array
) -> Iterator[NDArray[np.intp]]:
    """The row indices of each run, in the order in which the runs begin.

    Raises:
        UnreadableFile: within a run, the test changes or time goes back.
    """
    if "run" not in table.cells:
        fresh = (np.diff(codes) != 0) | (np.diff(time) < 0)
        yield from np.split(np.arange(time.size), np.flatnonzero(fresh) + 1)
        return
    number_of: dict[str, int] = {}
    numbers = np.array(
        [number_of.setdefault(cell.strip(), len(number_of)) for cell in table.cells["run"]]
    )
    order = np.argsort(numbers, kind="stable")
    labels = list(number_of)
    for rows in np.split(order, np.flatnonzero(np.diff(numbers[order])) + 1):
        for wrong, what in (
            (np.diff(codes[rows]) != 0, "changes its test"),
            (np.diff(time[rows]) < 0, "goes back in time"),
        ):
            if wrong.any():
                raise UnreadableFile(
                    f"run {labels[numbers[rows[0]]][:40]!r} {what} here",
                    where=table.describe_row(int(rows[np.argmax(wrong) + 1])),
                    advice="Give every run a value of its own in the column run, or leave the "
                    "column out.",
                )
        yield rows
