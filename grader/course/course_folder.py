"""Unpack the course that came with the installation: ``grade start FOLDER``.

A wheel holds lessons and exercises in the folder ``sysid_course`` beside ``grader`` and ``sim``. In
a clone they lie at the top. Both are checked as a class's package is: nobody gets changed starters.
"""

from pathlib import Path

from grader.course.package_files import FOLDERS, select_package_files
from sim.core.errors import BadRequest
from sim.support.atomic_file import write_atomically
from sim.support.os_errors import refuse_os_errors

INSTALLATION = Path(__file__).resolve().parents[2]
IN_WHEEL = "sysid_course"


def unpack_course(target: Path) -> bool:
    """Write lessons and exercises into a folder, unless a course is there already.

    Args:
        target: the folder; it is made if it is not there.

    Returns:
        Whether it was written.

    Raises:
        BadRequest: the folder holds something else, or cannot be written; or the installation
            brought no course.
    """
    if is_course_folder(target):
        return False
    if target.exists() and (not target.is_dir() or any(target.iterdir())):
        raise BadRequest(
            "this place already holds something else",
            where=str(target),
            advice="Name a folder that is empty or new: grade start my-course",
        )
    files = select_package_files(find_course_source()).files
    advice = "Choose a folder that you may write to, on a disk with 10 MB of room."
    with refuse_os_errors("the course cannot be written", target, advice=advice):
        for name, content in files.items():
            if name.partition("/")[0] not in {"grader", "sim"}:  # those that run are installed
                path = target / name
                path.parent.mkdir(parents=True, exist_ok=True)
                write_atomically(path, content)
    return True


def is_course_folder(folder: Path) -> bool:
    """Whether a folder holds lessons and exercises."""
    return all((folder / name).is_dir() for name in FOLDERS)


def find_course_source() -> Path:
    """Where the installation keeps the course.

    Raises:
        BadRequest: it has none.
    """
    for folder in (INSTALLATION / IN_WHEEL, INSTALLATION):
        if is_course_folder(folder):
            return folder
    raise BadRequest(
        "this installation contains no lessons or exercises",
        where=str(INSTALLATION),
        advice="Install it again, from its wheel or its repository: python -m pip install "
        "--force-reinstall FILE-OR-FOLDER",
    )
