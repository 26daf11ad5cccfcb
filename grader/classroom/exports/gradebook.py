"""A table for a spreadsheet: a row for each student, a column for each exercise.

A cell is empty where no answer was graded; ``not graded`` says where something was handed in.
"""

from pathlib import Path

from grader.classroom.csv_file import escape_formula, write_csv_file
from grader.classroom.results import ClassResults, collect_scores, find_total, list_ungraded


def write(results: ClassResults, folder: Path) -> tuple[Path, ...]:
    """Write ``gradebook.csv``.

    Raises:
        BadRequest: it cannot be written.
    """
    rows = [["student", *results.exercises, "total", "of", "late", "not graded"]]
    for one in results.students:
        points = collect_scores(one)
        total = find_total(one, results)
        cells = [*(points.get(name) for name in results.exercises), total]
        row = ["" if value is None else f"{value:g}" for value in cells]
        unread = " ".join(list_ungraded(one, results))
        late = escape_formula(results.late.get(one.student, ""))
        most = f"{sum(results.max_scores.values()):g}"
        rows.append([escape_formula(one.student), *row, most, late, unread])
    return (write_csv_file(folder / "gradebook.csv", rows, mark="\ufeff"),)
