"""Entries of a CSV export of DataLogTool or AdvantageScope, in either layout.

Timestamp,Name,Value        a list: a row for each value (AdvantageScope calls it Key)
Timestamp,<entry>,…         a table: a column for each entry, with empty cells without a value
"""

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import numpy as np

from sim.core.errors import BadSample, UnreadableFile
from sim.io.entries.entry import STRING, Entry, ValuesEntry
from sim.io.formats.csv.table import split_rows

TIME = "timestamp"
LISTED = ({"name", "value"}, {"key", "value"})  # the other columns of a list
EMPTY = ("", "null")  # cells without a value
SECOND = 1e6  # [µs]

_Sample = tuple[float, str]  # time [µs] and cell


def is_export(names: Sequence[str]) -> bool:
    """Whether the lower-case column names are those of an AdvantageScope or DataLogTool export."""
    return len(names) > 1 and names[0] == TIME and "time_s" not in names


def read_entries(path: Path) -> list[Entry]:
    """The entries of an export.

    Args:
        path: the file.

    Raises:
        UnreadableFile: not UTF-8, rows of unequal length, or no rows.
        BadSample: a time is not a number.
    """
    where = str(path)
    _, rows = split_rows(path)
    _, header = next(rows)
    titles = [title.strip() for title in header]
    listed = {title.lower() for title in titles[1:]} in LISTED
    found: dict[str, list[_Sample]] = {} if listed else {title: [] for title in titles[1:]}
    for line, row in rows:
        if len(row) != len(titles):
            raise UnreadableFile(
                f"the row has {len(row)} cells where the header has {len(titles)}",
                where=f"{where}, line {line}",
                advice="Complete the line, or export the log again.",
            )
        time = _parse_time(row[0], where=f"{where}, line {line}") * SECOND
        for name, cell in [(row[1], row[2])] if listed else zip(titles[1:], row[1:], strict=True):
            if cell.strip() not in EMPTY:
                found.setdefault(name, []).append((time, cell.strip()))
    if not any(found.values()):
        raise UnreadableFile(
            "there are no rows below the header", where=where, advice="Record a test first."
        )
    return list(_make_entries(found.items()))


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
        cells = tuple(sample[1] for sample in samples)
        try:
            yield ValuesEntry(name, "double", "", time, np.array(cells, dtype=np.float64))
        except ValueError:
            yield ValuesEntry(name, STRING, "", time, cells)
