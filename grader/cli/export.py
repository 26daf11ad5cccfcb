"""``grade export``: what other people's systems need to grade with this course."""

from pathlib import Path

import click

from grader.classroom.atomic_files import write_private_file
from grader.classroom.autograder import AutograderContents, make_workflow, pack_gradescope
from grader.classroom.roster import read_class_roster
from grader.cli.course_here import ONLY, PATH, choose_exercises, find_course_here
from grader.cli.release import choose_files, refuse_secret_inside
from grader.exercise.exercise import Exercise
from grader.feedback.terminal import print_error, print_lines, style_line
from sim.support.command_line import DONE
from sim.support.secret import find_secret


@click.group()
def export() -> None:
    """Make an autograder for Gradescope or GitHub Classroom, or a configuration of JupyterHub."""


@export.command()
@click.option("-o", "--output", type=PATH, required=True, help="The zip file: autograder.zip.")
@ONLY
@click.option(
    "--student-from",
    type=click.Choice(["email", "name", "sid"]),
    default="email",
    show_default=True,
    help="Which field of Gradescope identifies a student.",
)
@click.option(
    "--roster",
    type=PATH,
    help="CSV file with all students. The row with this field is the student.",
)
@click.option("--secret", type=PATH, help="File of the class's secret. The zip file contains it.")
def gradescope(
    output: Path, only: tuple[str, ...], student_from: str, roster: Path | None, secret: Path | None
) -> int:
    """Make an autograder for Gradescope: a zip file that you upload there.

    It contains the course without solutions. Make one for each assignment: Gradescope puts all
    uploaded files into one folder, and each exercise has its own answers.toml.
    """
    course = find_course_here()
    asked = choose_exercises(only, course)
    if secret is not None:
        refuse_secret_inside(secret, {"course folder": course})
    kept = find_secret(secret, make=False) if secret else None
    if roster is not None:
        read_class_roster(roster)  # what is wrong with it is said here, and not on Gradescope
    files = choose_files(course, kept, with_keys=True)
    value = kept.value if kept else None
    listed = roster.read_bytes() if roster else None
    names = tuple(one.name for one in asked)
    write_private_file(
        output,
        pack_gradescope(AutograderContents(files, names, student_from, listed, value)),
    )
    _print_upload_notes(asked, output, with_secret=value is not None)
    return DONE


def _print_upload_notes(asked: tuple[Exercise, ...], output: Path, *, with_secret: bool) -> None:
    if with_secret:
        print_error(
            f"{output} contains your class's secret. Code of students runs in Gradescope's "
            "container. If the code cannot be isolated there (the autograder's output says so), "
            "it can read the secret and compute the numbers of all students. Upload this file "
            "nowhere else"
        )
    elif any(one.is_personal for one in asked):
        print_error(
            "without --secret, numbers depend only on the student's name. If you made packages "
            "with a roster, students have other numbers, and right answers would be marked wrong"
        )
    if len(asked) > 1:
        print_error(
            f"{len(asked)} exercises in one autograder: students have to hand in a zip file with "
            "a folder for each. For single files, make one for each exercise: --exercise 9"
        )
    print_lines([style_line(f"{output}: upload it to Gradescope, under Configure Autograder")])


@export.command()
@click.option("-o", "--output", type=PATH, required=True, help=".github/workflows/grade.yml")
@ONLY
def github(output: Path, only: tuple[str, ...]) -> int:
    """Make a workflow for GitHub Classroom: it grades each push, and shows the points.

    Put it into the repository that students start from, next to the unpacked course.zip. The
    numbers of a student depend only on their GitHub name: grade start --student GITHUB-NAME.
    """
    asked = choose_exercises(only, find_course_here())
    write_private_file(output, make_workflow([one.name for one in asked]).encode())
    print_lines([style_line(f"{output}: for the repository that students start from")])
    return DONE


@export.command()
@click.option("-o", "--output", type=PATH, required=True, help="../hub/jupyterhub_config.py")
def jupyterhub(output: Path) -> int:
    """Write a configuration of JupyterHub: students need nothing but a browser.

    The folder around that of the file has to hold roster.csv and packages. Run jupyterhub next to
    the file, as root on Linux.
    """
    write_private_file(
        output, (Path(__file__).parents[1] / "setup" / "jupyterhub_config.py").read_bytes()
    )
    print_lines([style_line(f"{output}: run jupyterhub in this folder, as root")])
    return DONE
