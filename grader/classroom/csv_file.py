"""Tables for spreadsheets, which must not take a cell for a formula."""

import csv
import io
from collections.abc import Iterable
from pathlib import Path

from grader.classroom.atomic_files import write_private_file
from sim.support.printable import make_printable

FORMULA = ("=", "+", "-", "@", "\t", "\r")


def write_csv_file(path: Path, rows: Iterable[Iterable[str]], *, mark: str = "") -> Path:
    """Write a table for its owner alone; its path.

    Args:
        path: of the file.
        rows: the cells of each row.
        mark: what the file begins with; some spreadsheets know UTF-8 by U+FEFF alone.

    Raises:
        BadRequest: it cannot be written.
    """
    stream = io.StringIO(newline="")
    csv.writer(stream).writerows(rows)
    return write_private_file(path, mark + stream.getvalue())


def escape_formula(text: str) -> str:
    """The text of a cell, with an apostrophe in front if a spreadsheet would take it for a formula.

    Source: OWASP, "CSV Injection".
    """
    text = make_printable(text)
    return f"'{text}" if text.startswith(FORMULA) else text
