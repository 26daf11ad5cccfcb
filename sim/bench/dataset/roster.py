"""The students of a dataset: a list in the spec, or a column of a CSV file."""

from collections.abc import Iterable
from pathlib import Path

from sim.bench.dataset.roster_file import read_roster
from sim.bench.dataset.student import check_student_name, normalize_name
from sim.bench.dataset.table import TomlTable
from sim.core.errors import BadRequest, Refusal

COLUMN = "student"  # [header of a CSV file] unless the spec names another
EXAMPLE = "roster.csv"


def read_students(table: TomlTable, *, folder: Path) -> tuple[str, ...]:
    """The students, in their own order; empty if the spec has none.

    Args:
        table: the spec's top.
        folder: where the spec lies.

    Raises:
        BadRequest: no such file or column, a name that is none, or one that occurs twice.
    """
    given = table.content.get("students")
    if given is None:
        return ()
    if isinstance(given, list):
        texts = table.read_texts("students", example="ann")
        return distinct_names((f"{table.where}, students", text) for text in texts)
    if isinstance(given, dict):
        found = TomlTable(given, where=f"{table.where}, students", known=("file", "column"))
        file = found.read_text("file", example=EXAMPLE)
        column = found.read_text("column", example=COLUMN) if "column" in found else COLUMN
    else:
        file, column = table.read_text("students", example=EXAMPLE), COLUMN
    return distinct_names(_cells(folder / file, column=column))


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


def distinct_names(found: Iterable[tuple[str, str]]) -> tuple[str, ...]:
    """Names as they are shown, each of another person.

    Args:
        found: place and text of each name.

    Raises:
        BadRequest: a name that is none, or one that occurs twice.
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
