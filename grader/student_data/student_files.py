"""The files that a learner gets, written unless an unchanged copy exists."""

import hashlib
import json
import os
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from grader.student_data.class_package import ClassPackage, read_class_package
from grader.student_data.draw_cache import find_cache_path, write_cached_data
from sim.core.errors import BadRequest
from sim.support.os_errors import refuse_os_errors
from sim.support.student_names import make_folder_name
from sim.support.work.cache import read_cached

if TYPE_CHECKING:
    from sim.core.log import Log

Made = str | bytes | Callable[[Path], None]


def format_log(log: "Log") -> Made:
    """A log as a file, in the format that the file's name asks for."""

    def write_to(path: Path) -> None:
        from sim.io import write  # noqa: PLC0415 - not where the file is there already

        write(log, path)

    return write_to


def write_student_files(
    files: Mapping[str, Made],
    *,
    exercise: Path,
    student: str,
    say: Callable[[str], None],
) -> None:
    """Write a learner's own files into ``data/<student>`` of an exercise.

    Files that are there as they were made stay untouched; others are made anew, and it is said.
    What a class issued is never made here: only its instructor can draw it.

    Args:
        files: name -> its text, its bytes, or what writes it to a path.
        exercise: the exercise's folder.
        student: for whom.
        say: shows a line.

    Raises:
        BadRequest: they cannot be written, or a class issued them and they are gone.
    """
    folder = exercise / "data" / make_folder_name(student)
    of_class = read_class_package(exercise.parents[1])
    if of_class and of_class.is_for(student):
        _are_files_whole(files, folder, of_class)
        return
    place = (folder / next(iter(files), "")).relative_to(exercise.parents[1]).as_posix()
    there = any((folder / name).is_file() for name in files)
    known = find_cache_path(exercise, student, "files")
    if known is not None and read_cached(known) == _digest_files(folder, files):
        return
    advice = "Free some space on this disk, or give yourself permission to write into this folder."
    with refuse_os_errors("your files cannot be written", folder, advice=advice):
        folder.mkdir(parents=True, exist_ok=True)
        news = [_write_made_file(made, folder / name) for name, made in files.items()]
        if known is not None:
            write_cached_data(known, _digest_files(folder, files))
    number = exercise.name.removeprefix("exercise")
    if any(news) and there:
        say(f"Your files were changed, so they are made again: {place}")
    elif any(news):
        say(f"Your own files for exercise {number}: {place}")


def _are_files_whole(files: Mapping[str, Made], folder: Path, of_class: ClassPackage) -> None:
    for name in files:
        if not (folder / name).is_file():
            raise BadRequest(
                f"{name} is missing, and only {of_class.name} can make it",
                where=str(folder),
                advice="Unpack your class's zip file once more.",
            )


def _digest_files(folder: Path, names: Iterable[str]) -> bytes:
    """What tells whether any of these files was changed."""
    found = {}
    for name in names:
        content = read_cached(folder / name)
        found[name] = "" if content is None else hashlib.sha256(content).hexdigest()
    return json.dumps(found, sort_keys=True).encode()


def _write_made_file(made: Made, path: Path) -> bool:
    """Write one file; whether it is new, or was not as it was made."""
    part = path.with_name(f"{os.getpid()}.part{path.suffix}")
    try:
        if callable(made):
            made(part)
        else:
            part.write_bytes(made.encode() if isinstance(made, str) else made)
        if path.is_file() and path.read_bytes() == part.read_bytes():
            return False
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)  # it is there where nothing was to be replaced, or it failed
    return True
