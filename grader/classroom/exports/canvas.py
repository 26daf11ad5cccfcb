"""Canvas's gradebook, to be imported there: its own export as the roster, with one column added.

Canvas finds a student by ID, SIS User ID or SIS Login ID, and makes a new assignment of a column it
does not know: https://community.canvaslms.com, "How do I import grades in the Gradebook". The cell
of a student with work that was not graded is empty, and so is that of one who handed in nothing: a
0 would be a mark that nobody gave.
"""

from pathlib import Path

from grader.classroom.csv_file import escape_formula, write_csv_file
from grader.classroom.results import ClassResults, find_total, list_ungraded
from sim.support.printable import list_first

ROSTER = ("ID", "SIS User ID", "SIS Login ID")  # Canvas finds nobody by the name alone
IDENTITY = ("Student", "ID", "SIS User ID", "SIS Login ID", "Section")


def write(results: ClassResults, folder: Path) -> tuple[Path, ...]:
    """Write ``canvas.csv``.

    Raises:
        BadRequest: it cannot be written.
    """
    most = sum(results.max_scores.values())
    points = ["    Points Possible", *[""] * (len(IDENTITY) - 1), f"{most:g}"]
    rows = [[*IDENTITY, results.name], points]
    for one in results.students:
        cells = results.roster.get(one.student, {})
        row = {name.strip().casefold(): cell for name, cell in cells.items()}
        row.setdefault("student", one.student)
        who = [row.get(name.casefold(), "") for name in IDENTITY]
        total = find_total(one, results)
        rows.append([*map(escape_formula, who), "" if total is None else f"{total:g}"])
    return (write_csv_file(folder / "canvas.csv", rows),)


def warn(results: ClassResults) -> str:
    """One line about the students whose points are left out; empty if there are none."""
    names = [one.student for one in results.students if list_ungraded(one, results)]
    if not names:
        return ""
    return (
        "canvas.csv has no points for these students, because some of their work was not graded: "
        f"{list_first(names, separator='; ')}. Check their work, then run this again"
    )
