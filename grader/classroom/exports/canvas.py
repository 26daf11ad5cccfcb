"""Canvas's gradebook, to be imported there: its own export as the roster, with one column added.

Canvas finds a student by ID, SIS User ID or SIS Login ID, and makes a new assignment of a column it
does not know: https://community.canvaslms.com, "How do I import grades in the Gradebook".
"""

import csv
import io
from pathlib import Path

from grader.classroom.cells import safe
from grader.classroom.results import Results, scores
from grader.classroom.written import written

SUMMARY = "canvas.csv: to be imported into Canvas; give its own export as --roster"
IDENTITY = ("Student", "ID", "SIS User ID", "SIS Login ID", "Section")


def write(results: Results, folder: Path) -> tuple[Path, ...]:
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
        row = results.roster.get(one.student, {})
        alone = {"Student": one.student, "SIS Login ID": one.student}
        who = [(row or alone).get(name, "") for name in IDENTITY]
        table.writerow([*map(safe, who), f"{sum(scores(one).values()):g}"])
    return (written(folder / "canvas.csv", stream.getvalue()),)
