"""Files of an export, written whole or not at all."""

from pathlib import Path

from sim.core.errors import BadRequest
from sim.report.page_file import write_page_file
from sim.support.atomic_file import make_private_folder


def write_private_file(path: Path, text: str) -> Path:
    """Write a file for its owner alone, and the folder it stands in; its path.

    Raises:
        BadRequest: it cannot be written.
    """
    try:
        make_private_folder(path.parent)
    except OSError as error:
        raise BadRequest(
            f"cannot be made: {error.strerror}",
            where=str(path.parent),
            advice="Name another folder with -o.",
        ) from None
    write_page_file(text, path, private=True)
    return path
