"""``grade class``: its options."""

from pathlib import Path
from typing import Any

import click

from grader import cli
from grader.cli.course_here import ONLY, PATH

EXPORTS = sorted(
    path.stem for path in (Path(cli.__file__).parents[1] / "classroom/exports").glob("[!_]*.py")
)


@click.command("class")
@click.argument("folder", type=PATH)
@click.option("-o", "--output", type=PATH, help="Folder for results.  [default: FOLDER-graded]")
@click.option("--secret", type=PATH, help="File of the class's secret, made by grade release.")
@click.option("--roster", type=PATH, help="CSV file with a column student; or Canvas's export.")
@click.option("--self-study", is_flag=True, help="Students worked on the numbers of self-study, "
              "without packages of grade release.")  # fmt: skip
@click.option("--packages", type=PATH, help="Folder that grade release wrote, to recognize logs "
              "that were made for another student.")  # fmt: skip
@click.option("--overrides", type=PATH, help="CSV file of marks that you set by hand: student, "
              "check, points, why.")  # fmt: skip
@click.option("--student", metavar="NAME", help="FOLDER is what this one student handed in.")
@ONLY
@click.option("--export", "wanted", multiple=True, metavar="FORMAT",
              help=f"{', '.join(EXPORTS)}; may be repeated.")  # fmt: skip
@click.option("--name", help="Name of the class, for the overview.  [default: the folder's]")
@click.option(
    "--processes",
    type=click.IntRange(min=1),
    help="Number of processes that grade.  [default: one more than cores]",
)
@click.option("--cluster", metavar="ADDRESS", help="Grade on a Dask cluster: tcp://host:8786.")
@click.option(
    "--run/--no-run",
    default=None,
    help="Run students' code (robot code, fit.py).  [default: if this machine can isolate it]",
)
@click.option("--in", "engine", type=click.Choice(["docker", "podman"]),
              help="Grade in a container that has no network access.")  # fmt: skip
@click.option("--image", default="sysid-course", show_default=True, help="Image of that container.")
@click.option("--again", is_flag=True, help="Grade everything again.")
def class_(**options: Any) -> Any:  # noqa: ANN401 - passed on
    """Grade what a class handed in.

    FOLDER contains a folder or zip file for each student. In it, each answer is in a folder with
    the name of its exercise (exercise4/answers.toml). Downloads of Canvas, Moodle, Google Classroom
    and GitHub Classroom can be graded as they are. The command writes index.html (overview), a page
    for each student, gradebook.csv and the files of --export. If it was stopped, run it again.

    Exit codes: 0 all answers were graded, 1 some could not be graded, 2 could not do it.
    """
    return cli.class_run.grade_folder(**options)
