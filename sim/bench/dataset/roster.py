"""The students of a dataset: a list in the spec, or a column of a CSV file.

CSV files of spreadsheets, Canvas and Gradescope can be read.
"""

import csv
import io
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from sim.bench.dataset.student import check_student_name, normalize_name
from sim.bench.dataset.table import TomlTable
from sim.core.errors import BadRequest, Refusal

COLUMN = "student"  # header of the column, unless the spec names another
EXAMPLE = "roster.csv"
NO_STUDENT = {"points possible", "student, test"}  # rows of Canvas's gradebook: points, a tester


@dataclass(frozen=True)
class Roster:
    """A table of students.

    Args:
        path: path of the file.
        header: names of the columns, as written.
        rows: line number and cells of each row; empty lines, and rows of Canvas without a student,
            are left out.
    """

    path: Path
    header: tuple[str, ...]
    rows: tuple[tuple[int, tuple[str, ...]], ...]

    def find_column(self, columns: Sequence[str]) -> int | None:
        """Index of the first of these columns that the table has, in any case; else None."""
        plain = [name.strip().casefold() for name in self.header]
        found = (name.casefold() for name in columns if name.casefold() in plain)
        name = next(found, None)
        return None if name is None else plain.index(name)


def read_roster(path: Path, *, advice: str) -> Roster:
    """Read a roster.

    Args:
        path: path of a CSV file in UTF-8.
        advice: advice if it cannot be read.

    Raises:
        BadRequest: it cannot be read, or a row has more cells than the first line.
    """
    try:
        text = path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        why = error.strerror if isinstance(error, OSError) else "it is not UTF-8"
        raise BadRequest(
            f"the roster cannot be read ({why})", where=str(path), advice=advice
        ) from None
    table = csv.reader(io.StringIO(text, newline=""), delimiter=_delimiter(text))
    header = tuple(next(table, []))
    every = ((table.line_num, tuple(row)) for row in table)
    rows = tuple(row for row in every if _has_student(row[1]))
    for number, row in rows:
        if any(cell.strip() for cell in row[len(header) :]):
            raise BadRequest(
                f"{len(row)} cells, but the first line has {len(header)}",
                where=f"{path}, line {number}",
                advice='Put quotes around a text with a comma: "Doe, Jane".',
            )
    return Roster(path, header, rows)


def _has_student(row: Sequence[str]) -> bool:
    """Whether a row is not empty, and not one of Canvas's rows without a student."""
    canvas = any(cell.strip().casefold() in NO_STUDENT for cell in row)
    return any(cell.strip() for cell in row) and not canvas


def _delimiter(text: str) -> str:
    """The delimiter of the cells; spreadsheets in some languages write a semicolon."""
    first = text.partition("\n")[0]
    return max(",;\t", key=first.count)


def read_students(table: TomlTable, *, folder: Path) -> tuple[str, ...]:
    """The names of the students, in the order of the spec or file; empty if the spec has none.

    Args:
        table: top table of the spec.
        folder: folder of the spec.

    Raises:
        BadRequest: no such file or column, an invalid name, or one that occurs twice.
    """
    given = table.content.get("students")
    if given is None:
        return ()
    if isinstance(given, list):
        texts = table.read_texts("students", example="ann")
        return make_distinct_names((f"{table.where}, students", text) for text in texts)
    if isinstance(given, dict):
        found = TomlTable(given, where=f"{table.where}, students", known=("file", "column"))
        file = found.read_text("file", example=EXAMPLE)
        column = found.read_text("column", example=COLUMN) if "column" in found else COLUMN
    else:
        file, column = table.read_text("students", example=EXAMPLE), COLUMN
    return make_distinct_names(_cells(folder / file, column=column))


def _cells(path: Path, *, column: str) -> Iterable[tuple[str, str]]:
    """Place and text of every cell of a column."""
    advice = "Give the path of a CSV file in UTF-8, seen from the spec's folder."
    roster = read_roster(path, advice=advice)
    place = roster.find_column([column])
    if place is None:
        raise BadRequest(
            f"no column {column!r} in its first line",
            where=str(path),
            advice=f'Name one that is there: students = {{ file = "{path.name}", column = "…" }}',
        )
    for number, row in roster.rows:
        yield f"{path}, line {number}", row[place] if place < len(row) else ""


def make_distinct_names(found: Iterable[tuple[str, str]]) -> tuple[str, ...]:
    """The names as they are displayed, checked to be different.

    Args:
        found: place and text of each name.

    Raises:
        BadRequest: an invalid name, or one that occurs twice.
    """
    names: dict[str, str] = {}
    for where, text in found:
        try:
            name = check_student_name(text)
        except Refusal as refusal:
            raise BadRequest(refusal.what, where=where, advice=refusal.advice) from None
        if normalize_name(name) in names:
            raise BadRequest(
                f"{name!r} and {names[normalize_name(name)]!r} are the same student",
                where=where,
                advice="List each student only once. Two students need names that differ in more "
                "than upper and lower case.",
            )
        names[normalize_name(name)] = name
    return tuple(names.values())
