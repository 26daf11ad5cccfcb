"""A table for a spreadsheet: a row for each student, a column for each exercise."""

import csv
import io
from pathlib import Path

from grader.classroom.atomic_files import write_private_file
from grader.classroom.csv_cells import escape_formula
from grader.classroom.results import ClassResults, collect_scores, find_status

SUMMARY = "gradebook.csv: a row for each student, for a spreadsheet"


def write(results: ClassResults, folder: Path) -> tuple[Path, ...]:
    """Write ``gradebook.csv``.

    Raises:
        BadRequest: it cannot be written.
    """
    stream = io.StringIO(newline="")
    table = csv.writer(stream)
    most = results.max_scores
    table.writerow(["student", *results.exercises, "total", "of", "not graded"])
    for one in results.students:
        points = collect_scores(one)
        unread = [name for name, how in find_status(one).items() if how == "ungradable"]
        unread += ["unused files"] if one.student in results.remarks else []
        row = [points.get(name, 0.0) for name in results.exercises]
        totals = (f"{sum(points.values()):g}", f"{sum(most.values()):g}", " ".join(unread))
        table.writerow([escape_formula(one.student), *(f"{value:g}" for value in row), *totals])
    return (write_private_file(folder / "gradebook.csv", "\ufeff" + stream.getvalue()),)
