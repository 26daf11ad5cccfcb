"""Read a CSV roster as spreadsheets, Canvas and Gradescope write it."""

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from sim.core.errors import BadRequest

NO_STUDENT = "points possible"  # what Canvas writes in the second row of its gradebook


@dataclass(frozen=True)
class Roster:
    """A table of people.

    Args:
        path: where it was read.
        header: names of the columns, as written.
        rows: number of the line, and its cells; empty lines, and Canvas's points, are left out.
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
        path: of a CSV file in UTF-8.
        advice: what to do if it cannot be read.

    Raises:
        BadRequest: it cannot be read.
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
    rows = ((table.line_num, tuple(row)) for row in table)
    return Roster(path, header, tuple(row for row in rows if _names_somebody(row[1])))


def _names_somebody(row: Sequence[str]) -> bool:
    canvas = any(cell.strip().casefold() == NO_STUDENT for cell in row)
    return any(cell.strip() for cell in row) and not canvas


def _delimiter(text: str) -> str:
    """What stands between the cells; a spreadsheet of half of Europe writes a semicolon."""
    first = text.partition("\n")[0]
    return max(",;\t", key=first.count)
