"""Who is in a class: a column of a CSV file, or Canvas's own export."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from grader.classroom.submission_names import Identities
from sim.bench.dataset.roster import make_distinct_names, read_roster
from sim.core.errors import BadRequest

COLUMNS = ("student", "sis login id", "login", "email", "sis user id", "id", "name")


@dataclass(frozen=True)
class Roster:
    """The students of a class.

    Args:
        header: of the roster.
        rows: student -> their row, by the header.
    """

    header: tuple[str, ...]
    rows: Mapping[str, Mapping[str, str]]

    @property
    def identities(self) -> Identities:
        """The students, and the names each of them may be called by."""
        return Identities(self.rows)


def read_class_roster(path: Path) -> Roster:
    """Read a roster.

    Canvas's export has a column ``Student`` with the full name and a better one, ``SIS Login ID``,
    which is what a submission is called: there, that one counts.

    Raises:
        BadRequest: it cannot be read, has no such column, nobody, or somebody twice.
    """
    roster = read_roster(path, advice="Give the path of a CSV file in UTF-8.")
    columns = COLUMNS[1:] if roster.find_column(["sis login id"]) is not None else COLUMNS
    place = roster.find_column(columns)
    if place is None:
        raise BadRequest(
            "the first line names no column for the students",
            where=str(path),
            advice='Write "student" above the column with the names of the students.',
        )
    if not roster.rows:
        raise BadRequest(
            "there is no student on this roster",
            where=str(path),
            advice="Write each student in a line of their own, below the first line.",
        )
    cells = [
        (f"{path}, line {number}", row[place].strip() if place < len(row) else "")
        for number, row in roster.rows
    ]
    names = make_distinct_names(cells)
    rows = {
        name: dict(zip(roster.header, row, strict=False))
        for name, (_, row) in zip(names, roster.rows, strict=True)
    }
    return Roster(roster.header, rows)
