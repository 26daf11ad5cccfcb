"""Entries of a CSV file of another program, such as DataLogTool or AdvantageScope.

Timestamp,Name,Value        a list: a row for each value (AdvantageScope calls it Key)
Timestamp,<entry>,…         a table: a column for each entry, with empty cells without a value

The times may have another name (``t``, ``time_ms``) and stand in any column of a table.
"""

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import numpy as np

from sim.core.errors import BadSample, UnreadableFile
from sim.io.entries.entry import SECOND, STRING, Entry
from sim.io.entries.names import split_unit, split_words
from sim.io.entries.units import SECONDS
from sim.io.formats.csv.table import is_number, read_text
from sim.support.csv_rows import check_width, detect_delimiter, split_rows

TIMES = frozenset({"t", "time", "timestamp"})
SLOWEST = 0.5  # [s] between two rows; where it seems to be more, the times are not in seconds
LISTED = ({"name", "value"}, {"key", "value"})  # the other columns of a list
EMPTY = ("", "null")  # cells without a value
PAUSE = 1.0  # [s] put between two runs, where each begins at the same time
IDLE = "none"  # the state between them

_Sample = tuple[float, str]  # time [µs] and cell


def is_export(names: Sequence[str]) -> bool:
    """Whether the lower-case column names are those of entries with a time, and not our own."""
    return len(names) > 1 and "time_s" not in names and _find_time(names) is not None


def _find_time(names: Sequence[str]) -> int | None:
    """The index of the first column that holds times; None if none does."""
    for index, name in enumerate(names):
        words = _split_time(name)
        if TIMES & words and words <= TIMES | SECONDS.keys():
            return index
    return None


def _split_time(name: str) -> set[str]:
    """The words and the unit in the name of a column, lower case."""
    name, unit = split_unit(name)
    return {*split_words(name.lower()), *filter(None, [unit.lower()])}


def read_entries(path: Path) -> list[Entry]:
    """The entries of an export.

    Args:
        path: the file.

    Raises:
        UnreadableFile: not UTF-8, rows of unequal length, or no rows.
        BadSample: a time is not a number.
    """
    where = str(path)
    (_, header), *rows = split_rows(read_text(path), where=where)
    titles = [title.strip() for title in header]
    first = _find_time([title.lower() for title in titles]) or 0
    unit = titles.pop(first)
    listed = {title.lower() for title in titles} in LISTED
    found: dict[str, list[_Sample]] = {} if listed else {title: [] for title in titles}
    written, cells = [], []
    for line, row in rows:
        check_width(row, header, where=f"{where}, line {line}")
        written.append(_parse_time(row.pop(first), where=f"{where}, line {line}"))
        cells.append(row)
    times = np.array(written) * _find_unit(unit, written)
    begins = set() if listed else set((np.flatnonzero(np.diff(times) < 0.0) + 1).tolist())
    for begin in sorted(begins):  # each run has a clock of its own
        times[begin:] += times[begin - 1] - times[begin] + PAUSE * SECOND
    for number, row in enumerate(cells):
        for name, cell in [(row[0], row[1])] if listed else zip(titles, row, strict=True):
            samples = found.setdefault(name, [])
            if number in begins and samples and not is_number(samples[-1][1]):
                samples.append((times[number] - 0.5 * PAUSE * SECOND, IDLE))
            if cell.strip() not in EMPTY:
                samples.append((times[number], cell.strip()))
    if not any(found.values()):
        raise UnreadableFile(
            "there are no rows below the header", where=where, advice="Record a test first."
        )
    return list(_make_entries(found.items()))


def read_columns(path: Path) -> list[Entry]:
    """The columns of a table as entries; the time of each value is the number of its row.

    Raises:
        UnreadableFile: not UTF-8, or no header.
    """
    text = read_text(path)
    cells = [row for _, row in split_rows(text, where=str(path))]
    if detect_delimiter(text) != ",":
        cells = [[cell.replace(",", ".") for cell in row] for row in cells]
    columns = zip(*cells, strict=False)  # of rows of unequal length, what all have
    return list(
        _make_entries(
            (title.strip(), [(float(row), cell) for row, cell in enumerate(column)])
            for title, *column in columns
        )
    )


def _find_unit(name: str, times: Sequence[float]) -> float:
    """The unit of the times [µs]: by the name of their column, else by how far rows are apart."""
    named = next((SECOND * SECONDS[word] for word in _split_time(name) if word in SECONDS), None)
    steps = np.abs(np.diff(times))
    steps = steps[steps > 0.0]
    if named is not None or not steps.size:
        return named or SECOND
    step = float(np.median(steps))
    return next(
        unit for unit in (SECOND, 1e3, 1.0) if step * unit < SLOWEST * SECOND or unit == 1.0
    )


def _parse_time(cell: str, *, where: str) -> float:
    try:
        time = float(cell)
    except ValueError:
        time = np.nan
    if not np.isfinite(time):
        raise BadSample(
            f"the time is {cell[:40]!r}, not a number",
            where=where,
            advice="Correct the cell, or export the log again.",
        )
    return time


def _make_entries(found: Iterable[tuple[str, list[_Sample]]]) -> Iterator[Entry]:
    """Entries of numbers if every cell is a number, else of texts."""
    for name, samples in found:
        samples.sort(key=lambda sample: sample[0])
        time = np.array([sample[0] for sample in samples]).round().astype(np.int64)
        cells = np.array([sample[1] for sample in samples], dtype=np.object_)
        try:
            yield Entry(name, "double", "", time, cells.astype(np.float64))
        except ValueError:
            yield Entry(name, STRING, "", time, cells)
