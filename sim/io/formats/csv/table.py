"""The cells of a CSV file by column, with their line numbers for error messages."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from sim.core.advice import Action
from sim.core.doubt import Doubt
from sim.core.errors import BadRequest, BadSample, MissingSignal, UnreadableFile
from sim.core.log import LARGEST, Array
from sim.core.vocabulary import DIRECTIONS, KINDS
from sim.io.entries.names import find_test_name
from sim.support.csv_rows import check_width, detect_delimiter, split_rows

NEEDED = ("test", "time_s", "voltage", "position", "velocity")
EXTRA = ("current", "bus_voltage")  # optional; empty in runs without them
STATED = ("type", "units")  # optional; the same in every row
SIGNALS = ("run", *NEEDED, *EXTRA)
KNOWN = (*SIGNALS, *STATED)
WORDS = ("run", "test", *STATED)  # columns of texts; the others hold numbers

_ENTRY = {"state": "test", "time": "time_s"}  # name of a signal -> its column, if they differ


@dataclass(frozen=True)
class CsvTable:
    """The cells of a CSV file, column by column.

    Args:
        where: the file.
        cells: name of a column -> its cells, one for every row.
        lines: number of the line on which each row ends, from 1.
        decimal_comma: whether the decimal sign is a comma.
        doubts: warnings about the header.
    """

    where: str
    cells: Mapping[str, tuple[str, ...]]
    lines: list[int]
    decimal_comma: bool = False
    doubts: tuple[Doubt, ...] = ()

    def describe_row(self, row: int) -> str:
        """The place of a row, for messages."""
        return f"{self.where}, line {self.lines[row]}"

    def group_by_test(self) -> tuple[list[str], NDArray[np.intp]]:
        """The tests in the file, and for each row the index of its test (rows,).

        Raises:
            UnreadableFile: a cell does not name a test; the message lists the tests.
        """
        found: list[str] = []
        code_of: dict[str, int] = {}
        for row, cell in enumerate(self.cells["test"]):
            if cell not in code_of:
                test = find_test_name(cell, fillers=())
                if not test:
                    raise UnreadableFile(
                        f"test is {cell[:40]!r}, which is not the name of a test",
                        where=self.describe_row(row),
                        advice=f"Tests are {'|'.join(KINDS)}, then -{' or -'.join(DIRECTIONS)}.",
                    )
                if test not in found:
                    found.append(test)
                code_of[cell] = found.index(test)
        return found, np.array([code_of[cell] for cell in self.cells["test"]], dtype=np.intp)

    def parse_column(self, name: str, *, gaps: bool = False) -> Array:
        """The finite numbers of a column (rows,); with ``gaps``, an empty cell becomes nan.

        Raises:
            BadSample: a cell is not a finite number; the message names its line.
        """
        cells = self._normalize_cells(name, gaps=gaps)
        try:
            values = np.array([float(cell) for cell in cells])
        except ValueError:
            values = np.full(len(cells), np.nan)
            odd = np.array([not is_number(cell) for cell in cells])
        else:
            odd = ~(np.abs(values) < LARGEST)
            if "_" in "".join(cells):  # only Python accepts 1_000 as a number
                odd |= ["_" in cell for cell in cells]
        if gaps:
            odd &= [cell != "" and not cell.isspace() for cell in self.cells[name]]
        if odd.any():
            row = int(np.argmax(odd))
            cell, numeric = self.cells[name][row].strip(), is_number(cells[row])
            raise BadSample(
                f"{name} {_describe_cell(cell, numeric=numeric)}",
                where=self.describe_row(row),
                advice="Write a number there, or remove the line.",
            )
        return values

    def find_stated(self, name: str) -> str | None:
        """The word that a constant column holds for the whole log; None if the column is missing.

        Raises:
            UnreadableFile: its cells differ.
        """
        words = list(dict.fromkeys(cell.strip() for cell in self.cells.get(name, ())))
        if len(words) > 1:
            raise UnreadableFile(
                f"the column {name} says both {words[0][:40]!r} and {words[1][:40]!r}",
                where=self.where,
                advice="A file holds one mechanism: write the same in every row.",
            )
        return words[0] or None if words else None

    def _normalize_cells(self, name: str, *, gaps: bool) -> Sequence[str]:
        """The cells of a column with decimal points; with ``gaps``, ``nan`` for empty cells."""
        cells: Sequence[str] = self.cells[name]
        if self.decimal_comma:
            cells = [cell.replace(",", ".") for cell in cells]
        return [cell.strip() or "nan" for cell in cells] if gaps else cells


def read_header(text: str) -> list[str]:
    """The lower-case names in the first line that is not blank."""
    first = re.split(r"[\r\n]", text.lstrip(), maxsplit=1)[0]
    return [cell.strip(' "').lower() for cell in re.split(r"[,;\t]", first)]


def open_table(path: Path, *, entries: Mapping[str, str]) -> CsvTable:
    """Read the cells of a CSV file.

    Args:
        path: the file.
        entries: signal -> name of its column in this file, if it is not ours.

    Raises:
        UnreadableFile: not UTF-8, no rows, rows of unequal length, two columns of one name, or
            decimal commas and points.
        MissingSignal: a column is missing.
        BadRequest: ``entries`` names an unknown signal.
    """
    where = str(path)
    text = read_text(path)
    (_, first), *rows = list(split_rows(text, where=where)) or [(1, [""])]
    for line, row in rows:
        check_width(row, first, where=f"{where}, line {line}")
    place, doubts = _find_columns([cell.strip() for cell in first], entries=entries, where=where)
    if not rows:
        raise UnreadableFile(
            "there are no rows below the header", where=where, advice="Record a test first."
        )
    columns = list(zip(*(row for _, row in rows), strict=True))
    cells = {name: columns[index] for name, index in place.items()}
    lines = [line for line, _ in rows]
    comma = detect_delimiter(text) != "," and _uses_decimal_comma(cells, where=where)
    return CsvTable(where, cells, lines, comma, doubts)


def read_text(path: Path) -> str:
    """The text of a file.

    Raises:
        UnreadableFile: it is not UTF-8.
    """
    try:
        return path.read_bytes().decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise UnreadableFile(
            f"byte {error.start} is not UTF-8 text",
            where=str(path),
            advice="Save the file as CSV in UTF-8.",
        ) from None


def _find_columns(
    written: list[str], *, entries: Mapping[str, str], where: str
) -> tuple[dict[str, int], tuple[Doubt, ...]]:
    """Our name of each column -> its index, and a doubt about unknown columns."""
    header = [title.lower() for title in written]
    named = {_ENTRY.get(name, name): title.strip().lower() for name, title in entries.items()}
    for name in named:
        if name not in SIGNALS:
            raise BadRequest(
                f"{name!r} is not a signal", advice=f"Choose one of: {', '.join(SIGNALS)}."
            )
    titles = {name: named.get(name, name) for name in KNOWN}
    for title in titles.values():
        if header.count(title) > 1:
            raise UnreadableFile(
                f"two columns are named {title}", where=where, advice="Remove or rename one."
            )
    place = {name: header.index(title) for name, title in titles.items() if title in header}
    missing = [titles[name] for name in NEEDED if name not in place]
    ignored = [name for name in written if name and name.lower() not in titles.values()]
    # One of position and velocity suffices, unless it may be there under another name.
    suffices = not ignored and missing in ([titles["position"]], [titles["velocity"]])
    if missing and not suffices:
        raise MissingSignal(
            f"no column {' or '.join(missing)}; the first line is {','.join(written)[:80]!r}",
            where=where,
            advice=Action("columns", ",".join(NEEDED)),
        )
    doubt = Doubt(
        "unknown-column",
        f"{where}: nothing here reads the columns {', '.join(map(repr, ignored))}; they were left "
        f"out. Known are {', '.join(KNOWN)}.",
    )
    return place, (doubt,) if ignored else ()


def _uses_decimal_comma(cells: Mapping[str, tuple[str, ...]], *, where: str) -> bool:
    """Whether the decimal sign is a comma.

    Raises:
        UnreadableFile: there are both commas and points.
    """
    signs = {
        sign
        for name, column in cells.items()
        if name not in WORDS
        for sign in ",."
        if any(sign in cell for cell in column)
    }
    if len(signs) > 1:
        raise UnreadableFile(
            "its numbers have both commas and points",
            where=where,
            advice="Save it with one decimal sign, and without one for thousands.",
        )
    return "," in signs


def is_number(cell: str) -> bool:
    """Whether the cell is a number, finite or not."""
    try:
        float(cell)
    except ValueError:
        return False
    return "_" not in cell


def _describe_cell(cell: str, *, numeric: bool) -> str:
    """The error of a cell that should hold a number, for a message."""
    if not cell:
        return "is empty"
    return f"is {cell[:40]}" if numeric else f"is {cell[:40]!r}, not a number"
