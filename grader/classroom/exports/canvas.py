"""Canvas's gradebook, to be imported there: its own export as the roster, with one column added.

Canvas finds a student by ID, SIS User ID or SIS Login ID, and makes a new assignment of a column it
does not know: https://community.canvaslms.com, "How do I import grades in the Gradebook".
"""

import csv
import io
from pathlib import Path

from grader.classroom.atomic_files import write_private_file
from grader.classroom.csv_cells import escape_formula
from grader.classroom.results import ClassResults, collect_scores

SUMMARY = "canvas.csv: to be imported into Canvas; give its own export as --roster"
ROSTER = ("ID", "SIS User ID", "SIS Login ID")  # Canvas finds nobody by the name alone
IDENTITY = ("Student", "ID", "SIS User ID", "SIS Login ID", "Section")


def write(results: ClassResults, folder: Path) -> tuple[Path, ...]:
    """Write ``canvas.csv``.

    Raises:
        BadRequest: it cannot be written.
    """
    stream = io.StringIO(newline="")
    table = csv.writer(stream)
    most = sum(results.max_scores.values())
    table.writerow([*IDENTITY, results.name])
    table.writerow(["    Points Possible", *[""] * (len(IDENTITY) - 1), f"{most:g}"])
    for one in results.students:
        cells = results.roster.get(one.student, {})
        row = {name.strip().casefold(): cell for name, cell in cells.items()}
        row.setdefault("student", one.student)
        who = [row.get(name.casefold(), "") for name in IDENTITY]
        table.writerow([*map(escape_formula, who), f"{sum(collect_scores(one).values()):g}"])
    return (write_private_file(folder / "canvas.csv", stream.getvalue()),)
