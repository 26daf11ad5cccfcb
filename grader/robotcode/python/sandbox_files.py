"""The files of a learner that a run may read: a copy of the program only."""

from collections.abc import Iterator
from itertools import islice
from pathlib import Path

SUFFIXES = {".py", ".json"}  # code, and what robot programs keep numbers in
LARGEST = 1_000_000  # [bytes] of one file
MOST = 200  # files


def copy_program(path: Path, given: Path) -> Path:
    """Copy a program: the file, the code beside it and in the folder above, and in folders beside.

    Args:
        path: the file that holds the subsystem.
        given: where the copy goes; it is made.

    Returns:
        The copy of ``path``.
    """
    file = path.resolve()
    above = file.parent.parent
    (given / above.name / file.parent.name).mkdir(parents=True)
    for found in list_program_files(file):
        copy = given / above.name / found.relative_to(above)
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.write_bytes(found.read_bytes())
    copied = given / above.name / file.parent.name / path.name
    copied.write_bytes(file.read_bytes())
    return copied


def list_program_files(path: Path) -> Iterator[Path]:
    """The files that a run may read of the program in ``path``, ``MOST`` at most."""
    return islice(_list_program_files(path.resolve()), MOST)


def _list_program_files(file: Path) -> Iterator[Path]:
    """The files of the program. Only a folder with ``robot.py`` is one of a robot as a whole."""
    beside, above = file.parent, file.parent.parent
    for folder in (beside, above):
        yield from _list_code_files(folder)
    for folder in (beside, above) if (above / "robot.py").is_file() else (beside,):
        for below in _list_folder(folder):
            if below != beside and below.is_dir() and not below.is_symlink():
                yield from _list_code_files(below)


def _list_code_files(folder: Path) -> Iterator[Path]:
    """The code files of a folder, without links: they may lead to other people's files."""
    for found in _list_folder(folder):
        if (
            found.suffix in SUFFIXES
            and not found.is_symlink()
            and found.is_file()
            and found.stat().st_size <= LARGEST
        ):
            yield found


def _list_folder(folder: Path) -> list[Path]:
    try:
        return sorted(folder.iterdir())
    except OSError:  # not ours to look into
        return []
