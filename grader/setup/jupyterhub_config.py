"""JupyterHub for a class: lessons and exercises in a browser, with nothing to install for students.

`grade export jupyterhub` writes this file. Run `jupyterhub` in its folder, as root on Linux. The
folder around it has to hold roster.csv, and packages/ as `grade release --roster` made them.

    codes.csv        made beside this file: the code that each student logs in with
    ../handed-in/    the work of a student, copied there each time their server stops

Each student has a system user of their own, whose home nobody else can enter.
"""

import hashlib
import hmac
import os
import pwd
import secrets
import shutil
import subprocess
import sys
import tarfile
import tempfile
import zipfile
from pathlib import Path
from typing import Any

from jupyterhub.auth import LocalAuthenticator

import grader
from grader.classroom.csv_file import write_csv_file
from grader.classroom.roster import read_class_roster
from grader.setup.start import QUIET
from sim.core.errors import Refusal
from sim.physics.engine import load_engine
from sim.support.student_names import make_folder_name, normalize_name
from sim.support.student_table import read_student_table
from sim.support.work.cache import find_cache_folder

HERE = Path(__file__).resolve().parent
CLASS = HERE.parent
CODES = HERE / "codes.csv"
LETTERS = "ABCDEFGHJKLMNPQRSTUVWXYZ23456789"  # without those that look like others
LENGTH = 8  # of a code: a million million codes, too many to try
MEMORY = 4 * 2**30  # [bytes] of address space, of which about a tenth is used; for each process
PROCESSES = 500  # processes and threads that one student may have at once
IDLE = 3600  # [s] without work until a server stops
PATIENCE = 300  # [s] until a server has to answer; thirty may start at the same time
PACK = (  # a student's answers and data; what is larger than 20 MB is neither
    "find course/.course course/exercises -type f -size -20M -print0"
    " | tar --create --null --files-from -"
)


def refuse_unsafe_setup() -> None:
    """Stop with one sentence if students could not work, or could read forbidden files."""
    if sys.platform != "linux" or os.geteuid() != 0:
        sys.exit("Only root on Linux can give each student a system user: run jupyterhub as root.")
    if (Path(grader.__file__).parents[1] / "solutions").exists():
        sys.exit(
            "The course runs from a folder with the solutions, and students could read them. "
            "Install it without -e: python -m pip install '.[course,hub]'"
        )
    if can_unprivileged_user_run(["test", "-x", str(CLASS)]):
        sys.exit(
            f"Students could enter {CLASS}, which holds roster, packages and codes. Keep the class "
            f"in a folder of its own, and close it: chmod 700 '{CLASS}'"
        )
    if not can_unprivileged_user_run([sys.executable, "-c", "import jupyterlab, grader"]):
        sys.exit(
            f"Students cannot run {sys.executable} with the course. Install both where every user "
            "may read, for example in /opt."
        )


def can_unprivileged_user_run(command: list[str]) -> bool:
    """Whether a command succeeds for a user without any rights."""
    done = subprocess.run(  # noqa: S603 - our own arguments, no shell
        command, **run_as("nobody"), stderr=subprocess.DEVNULL, check=False
    )
    return done.returncode == 0


def run_as(user: str) -> dict[str, Any]:
    """Arguments of ``subprocess`` that run a command as this user, in their home."""
    account = pwd.getpwnam(user)
    home = account.pw_dir if Path(account.pw_dir).is_dir() else "/"
    return {"user": account.pw_uid, "group": account.pw_gid, "extra_groups": [], "cwd": home}


def name_account(student: str) -> str:
    """The system user of a student: no name that a user may not have, or that one of yours has."""
    return f"student-{hashlib.sha256(normalize_name(student).encode()).hexdigest()[:8]}"


def find_package(folder: str) -> Path:
    """The package of a student, by the name of their folder."""
    return CLASS / "packages" / "students" / f"{folder}.zip"


def load_codes(students: list[str]) -> dict[str, str]:
    """Normalized name -> code. A code is made once, and kept."""
    known: dict[str, str] = {}
    if CODES.exists():
        advice = "Remove it: new codes are made."
        kept = read_student_table(CODES, what="the file of codes", advice=advice)
        names, typed = (kept.find_column(one, advice=advice) for one in ("student", "code"))
        known = {
            normalize_name(name): row.get(typed, "") for name, row in kept.index_rows(names).items()
        }
    codes = {
        name: known.get(normalize_name(name))
        or "".join(secrets.choice(LETTERS) for _ in range(LENGTH))
        for name in students
    }
    write_csv_file(CODES, [("student", "code"), *codes.items()])
    return {normalize_name(name): code for name, code in codes.items()}


refuse_unsafe_setup()
load_engine()  # compiles it now, and not once more for each student
try:
    STUDENTS = list(read_class_roster(CLASS / "roster.csv").rows)
    STUDENT_CODES = load_codes(STUDENTS)
except Refusal as refusal:
    sys.exit(str(refusal))
FOLDERS = {name_account(one): make_folder_name(one) for one in STUDENTS}
if missing := [one for one in FOLDERS.values() if not find_package(one).is_file()]:
    sys.exit(f"There is no {find_package(missing[0])}. Make it with grade release --roster.")


class RosterAuthenticator(LocalAuthenticator):  # type: ignore[misc]  # JupyterHub has no type hints
    """Admits users with a student's code, and slows down repeated wrong codes."""

    async def authenticate(self, _handler: object, data: dict[str, str]) -> str | None:
        """The student's system user; None if name or code is wrong."""
        name = data["username"].strip().casefold()
        typed = data["password"].strip().upper()
        code = STUDENT_CODES.get(name, "")
        right = bool(code) and hmac.compare_digest(typed.encode(), code.encode())
        return name_account(name) if right else None

    def add_system_user(self, user: Any) -> None:  # noqa: ANN401 - the same
        """Make the student's system user, with course and compiled simulation in their home."""
        with tempfile.TemporaryDirectory() as home:
            for package in (CLASS / "packages/course.zip", find_package(FOLDERS[user.name])):
                with zipfile.ZipFile(package) as archive:
                    archive.extractall(home)  # noqa: S202 - our own package
            cache = Path(home, ".cache", "sysid-course")
            cache.mkdir(parents=True)
            for compiled in find_cache_folder().glob("*.kernel"):
                shutil.copy(compiled, cache)
            subprocess.run(  # noqa: S603 - our own arguments, no shell
                ["useradd", "--create-home", "--skel", home, "--key", "HOME_MODE=0700",  # noqa: S607 - the system's
                 "--shell", "/bin/bash", user.name],
                check=True,
            )  # fmt: skip


def collect_work(spawner: Any) -> None:  # noqa: ANN401 - the same
    """Copy a student's exercises to ../handed-in.

    They are read as the student, so that nothing comes with them that is not theirs.
    """
    target = CLASS / "handed-in" / FOLDERS[spawner.user.name]
    shutil.rmtree(target, ignore_errors=True)
    with (
        subprocess.Popen(  # noqa: S602 - our own text
            PACK,
            shell=True,
            **run_as(spawner.user.name),
            stdout=subprocess.PIPE,
        ) as packing,
        tarfile.open(fileobj=packing.stdout, mode="r|", errorlevel=0) as archive,
    ):
        archive.extractall(target, filter="data")


c = get_config()  # type: ignore[name-defined]  # noqa: F821 - JupyterHub defines it
c.JupyterHub.authenticator_class = RosterAuthenticator
c.Authenticator.allow_all = True  # of those whom it lets in
c.LocalAuthenticator.create_system_users = True
c.Spawner.cmd = ["prlimit", f"--as={MEMORY}", f"--nproc={PROCESSES}", "jupyterhub-singleuser"]
c.Spawner.args = [
    *QUIET,
    "--KernelManager.transport=ipc",  # every user could listen at a port
    "--ServerApp.terminado_settings={'shell_command': ['/bin/bash']}",  # which keeps PATH
    f"--ServerApp.shutdown_no_activity_timeout={IDLE}",
    f"--MappingKernelManager.cull_idle_timeout={IDLE}",
]
c.Spawner.environment = {
    "PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}",
    "OPENBLAS_NUM_THREADS": "1",  # the cores are there for all students
}
c.Spawner.notebook_dir = "~/course"
c.Spawner.default_url = "/lab/tree/lessons/00_guess_or_measure.ipynb"
c.Spawner.disable_user_config = True
c.Spawner.start_timeout = c.Spawner.http_timeout = PATIENCE
c.Spawner.post_stop_hook = collect_work
