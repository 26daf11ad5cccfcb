"""The students of a dataset: a list in the spec, or a column of a CSV file.

CSV files of spreadsheets, Canvas and Gradescope can be read.
"""

import csv
import io
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from sim.bench.dataset.student import check_student_name, normalize_name
from sim.bench.dataset.table import key, read_table, refusals_at, text, texts
from sim.core.errors import BadRequest
from sim.support.os_errors import refuse_os_errors

COLUMN = "student"  # header of the column, unless the spec names another
EXAMPLE = "roster.csv"
NO_STUDENT = {"points possible", "student, test"}  # rows of Canvas's gradebook: points, a tester


@dataclass(frozen=True, kw_only=True)
class RosterFile:
    """The file of a roster, as a spec names it.

    Args:
        file: its path, seen from the spec's folder.
        column: header of the column with the names.
    """

    file: str = key(text(EXAMPLE))
    column: str = key(text(COLUMN), COLUMN)


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
    with refuse_os_errors("the roster cannot be read", path, advice=advice):
        content = path.read_text(encoding="utf-8-sig")
    first = content.partition("\n")[0]  # spreadsheets in some languages write a semicolon
    delimiter = max(",;\t", key=first.count)
    table = csv.reader(io.StringIO(content, newline=""), delimiter=delimiter)
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


def names_or_file(key: str, value: object) -> object:
    """Read the spec's students: names, the path of a file, or a table with its path."""
    if isinstance(value, list):
        return texts("ann")(key, value)
    return value if isinstance(value, dict) else text(EXAMPLE)(key, value)


def read_students(given: object, *, where: str, folder: Path) -> tuple[str, ...]:
    """The names of the students, in the order of the spec or file; empty if the spec has none.

    Args:
        given: what ``names_or_file`` read.
        where: path of the spec.
        folder: folder of the spec.

    Raises:
        BadRequest: no such file or column, an invalid name, or one that occurs twice.
    """
    place = f"{where}, students"
    if isinstance(given, tuple):
        return make_distinct_names((place, name) for name in given)
    with refusals_at(place):
        found = read_table(RosterFile, given if isinstance(given, dict) else {"file": given})
    path = folder / found.file
    advice = "Give the path of a CSV file in UTF-8, seen from the spec's folder."
    roster = read_roster(path, advice=advice)
    column = roster.find_column([found.column])
    if column is None:
        raise BadRequest(
            f"no column {found.column!r} in its first line",
            where=str(path),
            advice=f'Name one that is there: students = {{ file = "{path.name}", column = "…" }}',
        )
    return make_distinct_names(
        (f"{path}, line {number}", row[column] if column < len(row) else "")
        for number, row in roster.rows
    )


def make_distinct_names(found: Iterable[tuple[str, str]]) -> tuple[str, ...]:
    """The names as they are displayed, checked to be different.

    Args:
        found: place and text of each name.

    Raises:
        BadRequest: an invalid name, or one that occurs twice.
    """
    names: dict[str, str] = {}
    for where, given in found:
        with refusals_at(where):
            name = check_student_name(given)
            if normalize_name(name) in names:
                raise BadRequest(
                    f"{name!r} and {names[normalize_name(name)]!r} are the same student",
                    advice="List each student only once. Two students need names that differ in "
                    "more than upper and lower case.",
                )
            names[normalize_name(name)] = name
    return tuple(names.values())
