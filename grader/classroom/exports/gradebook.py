"""A table for a spreadsheet: a row for each student, a column for each exercise.

A cell is empty where no answer was graded; ``not graded`` says where something was handed in.
"""

import csv
import io
from pathlib import Path

from grader.classroom.atomic_files import write_private_file
from grader.classroom.csv_cells import escape_formula
from grader.classroom.results import ClassResults, collect_scores, find_total, list_ungraded

SUMMARY = "gradebook.csv: a row for each student, for a spreadsheet"


def write(results: ClassResults, folder: Path) -> tuple[Path, ...]:
    """Write ``gradebook.csv``.

    Raises:
        BadRequest: it cannot be written.
    """
    stream = io.StringIO(newline="")
    table = csv.writer(stream)
    table.writerow(["student", *results.exercises, "total", "of", "late", "not graded"])
    for one in results.students:
        points = collect_scores(one)
        total = find_total(one, results)
        cells = [*(points.get(name) for name in results.exercises), total]
        row = ["" if value is None else f"{value:g}" for value in cells]
        unread = " ".join(list_ungraded(one, results))
        late = escape_formula(results.late.get(one.student, ""))
        most = f"{sum(results.max_scores.values()):g}"
        table.writerow([escape_formula(one.student), *row, most, late, unread])
    return (write_private_file(folder / "gradebook.csv", "\ufeff" + stream.getvalue()),)
