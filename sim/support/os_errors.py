"""Turn the errors of the operating system about a file into refusals of one line."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from sim.core.errors import BadRequest


@contextmanager
def refuse_os_errors(what: str, path: Path, *, advice: str) -> Iterator[None]:
    """A context that turns an OSError, or a text that is not UTF-8, into a BadRequest.

    Args:
        what: what cannot be done: ``the key cannot be written``.
        path: path of the file.
        advice: what to do next.

    Raises:
        BadRequest: the system refused; the message has its reason.
    """
    try:
        yield
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror or error if isinstance(error, OSError) else "it is not UTF-8"
        raise BadRequest(f"{what} ({reason})", where=str(path), advice=advice) from None
