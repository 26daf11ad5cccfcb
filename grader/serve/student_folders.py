"""A home for each student: a copy of the course that is theirs and stays from day to day."""

import csv
import hmac
import io
import os
import secrets
import shutil
import subprocess
import sys
import tempfile
import threading
import zipfile
from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path

from grader.course import update_progress
from grader.variant import make_folder_name, normalize_name
from sim.bench.dataset.roster import read_roster
from sim.core.errors import BadRequest
from sim.report.page_file import write_page_file

CODES = "codes.csv"
LETTERS = "ABCDEFGHJKLMNPQRSTUVWXYZ23456789"  # without those that look like others
LENGTH = 6  # a thousand million codes, and a wrong one costs a second
FIRST, END = 64000, 64999  # user ids of students, and the one that only checks; no system uses them
_ASSIGNING = threading.Lock()  # two students who come at once must not get one user id
CHECK = "import os, sys, jupyterlab, numpy; os.stat(sys.argv[1])"


def load_login_codes(folder: Path, students: Iterable[str]) -> dict[str, str]:
    """Student -> the code they come in with; made once, kept in ``codes.csv``.

    Raises:
        BadRequest: the file cannot be read or written.
    """
    path = folder / CODES
    known: dict[str, str] = {}
    if path.exists():
        roster = read_roster(path, advice="Remove it: new codes are made.")
        known = {normalize_name(row[0]): row[1] for _, row in roster.rows if len(row) > 1}
    found = {name: known.get(normalize_name(name)) or _make_code() for name in students}
    if {normalize_name(name): code for name, code in found.items()} != known:
        stream = io.StringIO(newline="")
        csv.writer(stream).writerows([("student", "code"), *found.items()])
        folder.mkdir(parents=True, exist_ok=True)
        write_page_file(stream.getvalue(), path, private=True)
    if path.exists():
        path.chmod(0o600)  # one that was made before
    return found


def can_separate() -> bool:
    """Whether this process may run each student's server as a system user of its own."""
    return os.name == "posix" and os.geteuid() == 0


def prepare_separation(folder: Path) -> None:
    """Let students' user ids pass through the folder of homes, but not list it.

    Raises:
        BadRequest: another user can reach neither Python nor the folder.
    """
    folder.mkdir(parents=True, exist_ok=True)
    folder.chmod(0o711)
    try:
        done = subprocess.run(  # noqa: S603 - our own arguments, no shell
            [sys.executable, "-c", CHECK, str(folder)],
            user=END, group=END, extra_groups=[], cwd="/",
            env={**os.environ, "HOME": "/"},
            stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8", errors="replace",
            check=False,
        )  # fmt: skip
        said = (done.stderr.strip().splitlines() or [""])[-1]
        failed = done.returncode != 0
    except OSError as error:
        failed, said = True, str(error)
    if failed:
        raise BadRequest(
            f"students' own system users cannot run Python or reach their homes ({said[:200]})",
            where=f"{sys.executable}, {folder}",
            advice="Install Python and the course where every user may read (not in /root or a "
            "private home), or serve with --unprotected: students can then read each other.",
        )


def assign_account(place: Path) -> int:
    """The user id that owns this home; the next free one where it has none yet.

    Raises:
        BadRequest: no user id is left, or the home cannot be given to it.
    """
    with _ASSIGNING:
        if FIRST <= (own := place.lstat().st_uid) < END:
            return own
        used = {one.lstat().st_uid for one in place.parent.iterdir()}
        free = next(
            (uid for uid in range(FIRST, END) if uid not in used and not _is_known_account(uid)),
            None,
        )
        if free is None:
            raise BadRequest("no user id is left", where=str(place.parent), advice="Tidy homes.")
        try:
            _change_owner(place, free)
        except OSError as error:
            raise BadRequest(
                f"a home cannot be given to its student: {error.strerror}",
                where=str(place),
                advice="Name a folder on a local disk.",
            ) from None
        return free


def _change_owner(place: Path, uid: int) -> None:
    """Everything in it first, the folder last: an interrupted change is repeated."""
    for parent, folders, files in os.walk(place):
        for name in (*folders, *files):
            os.chown(Path(parent, name), uid, uid, follow_symlinks=False)
    place.chmod(0o700)
    os.chown(place, uid, uid, follow_symlinks=False)


def _is_known_account(uid: int) -> bool:
    import pwd  # noqa: PLC0415 - not on Windows

    try:
        pwd.getpwuid(uid)
    except KeyError:
        return False
    return True


def _make_code() -> str:
    return "".join(secrets.choice(LETTERS) for _ in range(LENGTH))


def is_code_right(given: str, code: str) -> bool:
    """Compare a typed code in constant time, ignoring case."""
    plain = given.strip().upper().encode("utf-8", "replace")
    return hmac.compare_digest(plain, code.encode())


def prepare_student_folder(folder: Path, student: str, *, packages: Iterable[bytes]) -> Path:
    """A student's course folder; unpacked where it is not there yet, else left as it is.

    Args:
        folder: of all homes.
        student: whose.
        packages: zip files with a folder ``course``, the later over the earlier.

    Raises:
        BadRequest: it cannot be written.
    """
    place = folder / make_folder_name(student)
    course = place / "course"
    if course.is_dir():
        return course
    try:
        place.mkdir(parents=True, exist_ok=True)
        new = Path(tempfile.mkdtemp(dir=folder, prefix=".new-"))  # where no student can write
        try:
            for package in packages:
                with zipfile.ZipFile(io.BytesIO(package)) as archive:
                    archive.extractall(new)
            if said := update_progress(new / "course", lambda now: replace(now, student=student)):
                raise BadRequest(said, where=str(course), advice="Allow writing there.")
            if FIRST <= (own := place.lstat().st_uid) < END:  # who removed their course
                _change_owner(new, own)
            (new / "course").rename(course)
        finally:
            shutil.rmtree(new, ignore_errors=True)
    except OSError as error:
        raise BadRequest(
            f"a home cannot be made: {error.strerror}",
            where=str(place),
            advice="Make room there, or name another folder.",
        ) from None
    return course


def find_student(students: Mapping[str, str], name: str) -> str | None:
    """The student on the roster whom a typed name means; None if there is none."""
    wanted = name.strip().casefold()
    return next((one for one in students if one.casefold() == wanted), None)
