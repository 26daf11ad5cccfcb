"""Tables of students: a roster, or marks, as spreadsheets and learning platforms write them.

Commas, semicolons or tabs may separate the cells, and Canvas's gradebook can be read as it is.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from sim.core.errors import BadRequest, refusals_at
from sim.support.csv_rows import split_rows
from sim.support.os_errors import refuse_os_errors
from sim.support.student_names import check_student_name, normalize_name

# Rows of Canvas's gradebook that are no students: of points, of posting, and of a tester.
NO_STUDENT = {"points possible", "manual posting", "student, test"}


@dataclass(frozen=True)
class StudentTable:
    """A table with a header, of which one column names students.

    Args:
        path: path of the file.
        header: names of the columns, as written.
        rows: place and cells of each row that is not empty, by the header.
    """

    path: Path
    header: tuple[str, ...]
    rows: tuple[tuple[str, Mapping[str, str]], ...]

    def find_column(self, *names: str, advice: str, usual: str = "") -> str:
        """The first of these columns that the table has, in any case, as written.

        Args:
            names: names of columns.
            advice: advice if the table has none of them.
            usual: the one that a message names; empty is the first.

        Raises:
            BadRequest: the table has none of them.
        """
        written = {head.strip().casefold(): head for head in self.header}
        for name in names:
            if name.casefold() in written:
                return written[name.casefold()]
        raise BadRequest(
            f"the first line names no column {usual or names[0]}",
            where=str(self.path),
            advice=advice,
        )

    def index_rows(self, column: str) -> dict[str, Mapping[str, str]]:
        """Student -> their row, in the order of the table; Canvas's other rows are left out.

        Args:
            column: the column with the names, as written.

        Raises:
            BadRequest: there is nobody, an invalid name, or one that occurs twice.
        """
        rows = [
            row
            for row in self.rows
            if NO_STUDENT.isdisjoint(cell.strip().casefold() for cell in row[1].values())
        ]
        if not rows:
            raise BadRequest(
                "there is no student in this table",
                where=str(self.path),
                advice="Write each student in a line of their own, below the first line.",
            )
        names = make_distinct_names((where, row.get(column, "")) for where, row in rows)
        return dict(zip(names, (row for _, row in rows), strict=True))


def read_student_table(path: Path, *, what: str, advice: str) -> StudentTable:
    """Read a table of students.

    Args:
        path: path of a CSV file in UTF-8.
        what: what it holds: ``the roster``.
        advice: advice if it cannot be read.

    Raises:
        BadRequest: it cannot be read, or a row has more cells than the first line.
    """
    with refuse_os_errors(f"{what} cannot be read", path, advice=advice):
        content = path.read_text(encoding="utf-8-sig")
    (_, header), *below = list(split_rows(content, where=str(path))) or [(1, [])]
    rows = []
    for line, cells in below:
        where = f"{path}, line {line}"
        if any(cell.strip() for cell in cells[len(header) :]):
            raise BadRequest(
                f"{len(cells)} cells, but the first line has {len(header)}",
                where=where,
                advice='Put quotes around a text with a comma: "Doe, Jane".',
            )
        if any(cell.strip() for cell in cells):
            rows.append((where, dict(zip(header, cells, strict=False))))
    return StudentTable(path, tuple(header), tuple(rows))


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
