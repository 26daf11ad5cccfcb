"""``grade release``."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import click

from grader.classroom.atomic_files import write_private_file
from grader.classroom.bundle import pack_course
from grader.classroom.release import StudentPackage, make_student_package, pack_course_folder
from grader.classroom.roster import read_class_roster
from grader.classroom.secret import identify_secret
from grader.cli.course_here import PATH, find_course_here
from grader.course.package_files import select_package_files
from grader.feedback.terminal import print_error, print_lines, style_line
from sim.core.errors import BadRequest
from sim.support.command_line import DONE
from sim.support.printable import list_first
from sim.support.secret import Secret, find_secret
from sim.support.student_names import make_folder_name
from sim.support.work.executor import count_available_cores, run_jobs
from sim.support.work.progress_bar import progress_bar

NAMED = 8  # files left out that are named
WORTH = 3  # [students] that a further process has to save, to be worth its start


@click.command()
@click.option("-o", "--output", type=PATH, required=True, help="Folder for the packages.")
@click.option(
    "--roster",
    type=PATH,
    help="CSV file with a column student. Each student gets numbers of their own.",
)
@click.option(
    "--secret", type=PATH, help="File of the class's secret. The command makes it if there is none."
)
@click.option("--name", default="our class", show_default=True, help="Name of the class.")
@click.option(
    "--processes", type=click.IntRange(min=1), help="Number of processes.  [default: every core]"
)
def release(
    output: Path, roster: Path | None, secret: Path | None, name: str, processes: int | None
) -> int:
    """Make the students' package.

    It is the course without solutions and secret. With a roster, each student also gets numbers and
    logs of their own, and no answer keys. Only the owner of the secret can make these numbers
    again, and grade them: grade class FOLDER --secret FILE.
    """
    if roster and not secret:
        raise BadRequest(
            "to give each student own numbers, a secret is needed",
            advice="Name a file for it outside the packages: --secret class.secret",
        )

    course = find_course_here()
    if secret:
        refuse_secret_inside(secret, {"folder of the packages": output, "course folder": course})
    kept = find_secret(secret, make=roster is not None)
    students = tuple(read_class_roster(roster).rows) if roster else ()
    everybody = pack_course_folder(choose_files(course, kept, with_keys=not students))
    if kept and kept.new:
        kept.save()
        print_error(f"{kept.new}: a new secret. Keep this file, and show it to nobody.")
    write_private_file(output / "course.zip", everybody)
    value, packed = kept.value if kept else b"", pack_course(course)
    packages = [StudentPackage(student, value, name, packed) for student in students]
    _write_packages(packages, output / "students", processes or count_available_cores())
    _tell_made(output, len(everybody), len(students), kept)
    return DONE


def refuse_secret_inside(secret: Path, folders: Mapping[str, Path]) -> None:
    """Refuse a secret that lies where students' files are taken from or written to.

    Args:
        secret: its file; a link counts as well as the place it leads to.
        folders: what a folder is called -> the folder.

    Raises:
        BadRequest: it lies in one of them.
    """
    places = (secret.resolve(), secret.parent.resolve() / secret.name)
    for name, folder in folders.items():
        if any(place.is_relative_to(folder.resolve()) for place in places):
            raise BadRequest(
                f"the secret is in the {name}, and everybody would get it",
                where=str(secret),
                advice=f"Keep it outside: --secret {Path('..') / secret.name}",
            )


def choose_files(course: Path, secret: Secret | None, *, with_keys: bool) -> dict[str, bytes]:
    """The files of a course that students get; prints which files of its folder they do not get.

    Args:
        course: the course folder.
        secret: of the class, which is in none of them.
        with_keys: also the exercises' answer keys.
    """
    chosen = select_package_files(course, with_keys=with_keys)
    chosen.refuse_secret(secret.value if secret else b"")
    if chosen.left_out:
        print_error(
            f"left out, as no part of the course: {list_first(chosen.left_out, most=NAMED)}"
        )
    return chosen.files


def _write_packages(packages: Sequence[StudentPackage], folder: Path, processes: int) -> None:
    with progress_bar("students", len(packages)) as (step, _):
        for student, content in run_jobs(
            make_student_package, packages, processes=processes, worth=WORTH
        ):
            write_private_file(folder / f"{make_folder_name(student)}.zip", content)
            step()


def _tell_made(output: Path, size: int, students: int, secret: Secret | None) -> None:
    """Print the size [bytes] of the common package, and the number of student packages."""
    lines = [f"{output / 'course.zip'}: for everybody, {size / 1e6:.1f} MB"]
    if students:
        lines.append(
            f"{output / 'students'}: a zip file for each of {students} students, to unpack into "
            "the same folder"
        )
    if secret:
        mark = identify_secret(secret.value)
        lines.append(f"Made with the secret {mark}; grade class shows the same characters.")
    print_lines([style_line(one) for one in lines])
