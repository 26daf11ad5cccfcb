"""Files of an export, written whole or not at all."""

from pathlib import Path

from sim.errors import BadRequest
from sim.report.written import write_whole


def written(path: Path, text: str) -> Path:
    """Write a file, and the folder it stands in, and give back its path.

    Raises:
        BadRequest: it cannot be written.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise BadRequest(
            f"cannot be made: {error.strerror}",
            where=str(path.parent),
            advice="Name another folder with -o.",
        ) from None
    write_whole(text, path)
    return path
