"""Pages: how they are filled in, and how they are written, whole or not at all."""

import os
from contextlib import suppress
from functools import cache
from pathlib import Path
from uuid import uuid4

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from sim.errors import BadRequest

PAGES = (".html", ".htm")
FOLDER = Path(__file__).parent


@cache
def templates(folder: Path | None = None) -> Environment:
    """The templates of this folder; what they are filled with is escaped.

    Args:
        folder: another one with more of them.
    """
    return Environment(
        loader=FileSystemLoader([folder or FOLDER, FOLDER], encoding="utf-8"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )


def page_at(path: str | os.PathLike[str]) -> Path:
    """Where a page goes.

    Raises:
        BadRequest: its name does not end as a page's.
    """
    target = Path(path)
    if target.suffix.lower() not in PAGES:
        raise BadRequest(
            f"no page ends in {target.suffix or 'nothing'!r}",
            where=str(target),
            advice="End its name in .html.",
        )
    return target


def write_whole(text: str, target: Path) -> None:
    """Write a file, whole or not at all.

    Raises:
        BadRequest: it cannot be written.
    """
    part = target.with_name(f".{uuid4().hex}.part")
    try:
        part.write_text(text, encoding="utf-8", newline="\n")
        part.replace(target)
    except OSError as error:
        raise BadRequest(
            f"cannot be written ({error.strerror or error})",
            where=str(target),
            advice="Choose a folder that exists and that you may write to.",
        ) from None
    finally:
        with suppress(OSError):  # nothing is left to remove when all went well
            part.unlink()
