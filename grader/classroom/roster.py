"""Who is in a class: a column of a CSV file, or Canvas's own export."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from grader.classroom.submission_names import Identities
from sim.support.student_table import read_student_table

GROUP, LATE = "group", "late"  # columns that say who worked together, and who was late
COLUMNS = ("sis login id", "student", "login", "email", "sis user id", "id", "name")


@dataclass(frozen=True)
class Roster:
    """The students of a class.

    Args:
        header: of the roster.
        rows: student -> their row, by the header; empty where there is no roster.
    """

    header: tuple[str, ...] = ()
    rows: Mapping[str, Mapping[str, str]] = field(default_factory=dict)

    @property
    def partners(self) -> dict[str, tuple[str, ...]]:
        """Student -> the others of the same group, by the column ``group``."""
        groups: dict[str, list[str]] = {}
        for student, text in self._read_column(GROUP).items():
            groups.setdefault(text.casefold(), []).append(student)
        return {
            student: tuple(other for other in those if other != student)
            for those in groups.values()
            for student in those
        }

    @property
    def late(self) -> dict[str, str]:
        """Student -> the entry in the column ``late``, if it is not empty."""
        return self._read_column(LATE)

    def _read_column(self, column: str) -> dict[str, str]:
        """Student -> text of a column, where there is one."""
        heads = [head for head in self.header if head.strip().casefold() == column]
        texts = {
            student: row.get(head, "").strip()
            for student, row in self.rows.items()
            for head in heads
        }
        return {student: text for student, text in texts.items() if text}

    @property
    def identities(self) -> Identities | None:
        """The students, and the names each of them may be called by; None without a roster."""
        return Identities(self.rows) if self.rows else None


def read_class_roster(path: Path) -> Roster:
    """Read a roster.

    Canvas's export has a column ``Student`` with the full name and a better one, ``SIS Login ID``,
    which is what a submission is called: there, that one counts.

    Raises:
        BadRequest: it cannot be read, has no such column, nobody, or somebody twice.
    """
    table = read_student_table(
        path, what="the roster", advice="Give the path of a CSV file in UTF-8."
    )
    advice = 'Write "student" above the column with the names of the students.'
    column = table.find_column(*COLUMNS, advice=advice, usual="student")
    return Roster(table.header, table.index_rows(column))
