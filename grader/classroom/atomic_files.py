"""Files of a class, written whole or not at all, for their owner alone."""

from pathlib import Path

from sim.support.atomic_file import make_private_folder, write_atomically
from sim.support.os_errors import refuse_os_errors


def write_private_file(path: Path, content: str | bytes) -> Path:
    """Write a file for its owner alone, and the folder it stands in; its path.

    Raises:
        BadRequest: it cannot be written.
    """
    advice = "Make room there, or name another folder with -o. Then run the same command again."
    with refuse_os_errors("cannot be written", path, advice=advice):
        make_private_folder(path.parent)
        write_atomically(path, content, private=True)
    return path
