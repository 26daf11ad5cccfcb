"""``grade serve``."""

import asyncio
import os
import socket
from pathlib import Path

import click

from grader.terminal import print_error, print_lines, style_line
from sim.core.errors import BadRequest
from sim.support.command_line import COULD_NOT, DONE

PATH = click.Path(path_type=Path)
EVERYWHERE = "0.0.0.0"  # noqa: S104 - a class's browsers are on other machines; codes keep the door


@click.command()
@click.argument("folder", type=PATH)
@click.option("--roster", type=PATH, required=True, help="CSV file with a column student.")
@click.option(
    "--packages",
    type=PATH,
    help="Folder that grade release made: each student gets their package.",
)
@click.option("--host", default=EVERYWHERE, show_default=True, help="Address to listen on.")
@click.option("--port", default=8000, show_default=True, help="Port of the login page.")
@click.option(
    "--unprotected", is_flag=True, help="Serve even if students can read each other's files."
)
def serve(
    folder: Path, roster: Path, packages: Path | None, host: str, port: int, *, unprotected: bool
) -> int:
    """Serve the course to browsers on this network.

    Chromebooks need nothing installed. FOLDER contains the work of each student, and codes.csv with
    their login codes. Everything runs on this machine; two students take about 1 GB of memory. If
    root runs it on Linux or macOS, each student has a separate system user.
    """
    from grader.classroom.roster import read_class_roster  # noqa: PLC0415 - --help must not wait for it
    from grader.course import find_course  # noqa: PLC0415 - the same
    from grader.release import make_common_package  # noqa: PLC0415 - the same
    from grader.serve.jupyter_servers import JupyterServers  # noqa: PLC0415 - the same
    from grader.serve.login_page import ServedClass, serve_forever  # noqa: PLC0415 - the same
    from grader.serve.student_folders import load_login_codes, prepare_student_folder  # noqa: PLC0415 - the same
    from grader.variant import make_folder_name  # noqa: PLC0415 - the same
    from sim.bench.dataset.secret import VARIABLE  # noqa: PLC0415 - the same

    os.environ.pop(VARIABLE, None)  # neither this process nor a student's needs the secret
    folder = folder.resolve()
    separate = _decide_separation(folder, packages, unprotected=unprotected)
    course = find_course(Path.cwd())
    students = tuple(read_class_roster(roster).rows)
    shared = make_common_package(course)
    lessons = sorted((course / "lessons").glob("*.ipynb"))
    first = lessons[0].relative_to(course).as_posix() if lessons else "exercises"

    def at_home(student: str) -> Path:
        own = packages / "students" / f"{make_folder_name(student)}.zip" if packages else None
        if own is not None and not own.is_file():
            raise BadRequest(
                f"there is no package for {student}",
                where=str(own),
                advice="Make it with grade release --roster.",
            )
        given = [shared, *([own.read_bytes()] if own else [])]
        return prepare_student_folder(folder, student, packages=given)

    served = ServedClass(
        load_login_codes(folder, students), at_home, JupyterServers(host, separate=separate), first
    )

    def ready(taken: int) -> None:
        address = _find_own_address() if host == EVERYWHERE else host
        print_lines([
            style_line(f"Login page: http://{address}:{taken}", "bold"),
            style_line(f"Names and codes of {len(students)} students: {folder / 'codes.csv'}"),
            style_line("Everybody on this network can open it. Ctrl-C ends it; all work is kept."),
        ])  # fmt: skip

    try:
        asyncio.run(serve_forever(served, port=port, ready=ready))
    except KeyboardInterrupt:
        return DONE
    except OSError as error:
        print_error(f"port {port} cannot be used ({error.strerror}). Name another with --port.")
        return COULD_NOT
    return DONE


COMMAND = serve


def _decide_separation(folder: Path, packages: Path | None, *, unprotected: bool) -> bool:
    """Whether each student gets a system user of their own; else say what that means.

    Raises:
        BadRequest: personal packages would lie open, or Python does for nobody but root.
    """
    from grader.serve.student_folders import can_separate, prepare_separation  # noqa: PLC0415 - as above

    if can_separate() and not unprotected:
        prepare_separation(folder)
        return True
    if packages and not unprotected:
        raise BadRequest(
            "students could read and change each other's files, so no packages are served",
            advice="Serve as root on Linux or macOS, or add --unprotected.",
        )
    print_lines(
        [
            style_line(
                "Students can read and change each other's files: do not grade this work.", "bold"
            )
        ]
    )
    return False


def _find_own_address() -> str:
    """The address other machines reach this one by; nothing is sent to find it."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as one:
        try:
            one.connect(("192.0.2.1", 9))  # a documentation address: only the route is looked up
        except OSError:
            return "127.0.0.1"
        return str(one.getsockname()[0])
