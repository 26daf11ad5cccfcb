"""Who handed in, as Gradescope says it: run inside the autograder, prints the student's name."""

import json
import sys
from pathlib import Path

import click

from sim.core.errors import BadRequest
from sim.support.command_line import run_command
from sim.support.student_names import check_student_name

KEYS = ("email", "name", "sid")


def find_submitter(metadata: Path, *, by: str, roster: Path | None) -> str:
    """The student's name, on whom their numbers depend.

    Args:
        metadata: Gradescope's ``submission_metadata.json``.
        by: which of ``KEYS`` tells students apart.
        roster: CSV file of the class; the student is the row that holds what ``by`` says.
            None takes what ``by`` says for the name.

    Raises:
        BadRequest: the file cannot be read, says nothing there, or nobody on the roster fits.
    """
    try:
        users = json.loads(metadata.read_text(encoding="utf-8"))["users"]
        found = str(users[0].get(by) or "").strip()
    except (OSError, ValueError, TypeError, LookupError, AttributeError):
        raise BadRequest(
            "it does not say who handed in",
            where=str(metadata),
            advice="Run this as Gradescope does.",
        ) from None
    if not found:
        raise BadRequest(
            f"the student has no {by}",
            where=str(metadata),
            advice="Export the autograder again with another --student-from.",
        )
    return check_student_name(found) if roster is None else _find_on_roster(found, roster)


def _find_on_roster(found: str, roster: Path) -> str:
    from grader.classroom.roster import read_class_roster  # noqa: PLC0415 - only where there is a roster

    for student, row in read_class_roster(roster).rows.items():
        if found.casefold() in {cell.strip().casefold() for cell in row.values()}:
            return student
    raise BadRequest(
        f"the roster does not contain {found!r}",
        where=roster.name,
        advice="Add the student, and export the autograder again.",
    )


@click.command()
@click.argument("metadata", type=click.Path(path_type=Path))
@click.option("--by", type=click.Choice(KEYS), required=True)
@click.option("--roster", type=click.Path(path_type=Path))
def main(metadata: Path, by: str, roster: Path | None) -> None:
    """Print the student's name; exit code 2 and one line on standard error where there is none."""
    name = find_submitter(metadata, by=by, roster=roster)
    sys.stdout.reconfigure(encoding="utf-8")  # type: ignore[union-attr]  # a text stream, always
    sys.stdout.write(f"{name}\n")


if __name__ == "__main__":
    sys.exit(run_command(main, name="autograder"))
