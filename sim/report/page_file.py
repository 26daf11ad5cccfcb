"""Fill in page templates and write the file atomically."""

import os
from functools import cache
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from sim.core.errors import BadRequest
from sim.support.atomic_file import write_atomically
from sim.support.os_errors import refuse_os_errors
from sim.support.printable import make_printable

PAGES = (".html", ".htm")
ELSEWHERE = "Choose a folder that exists and that you may write to."
FOLDER = Path(__file__).parent


@cache
def load_templates(folder: Path | None = None) -> Environment:
    """The page templates of this folder, with automatic escaping.

    Args:
        folder: a further folder with templates, which is searched first.
    """
    return Environment(
        loader=FileSystemLoader([folder or FOLDER, FOLDER], encoding="utf-8"),
        autoescape=True,
        undefined=StrictUndefined,
        finalize=_escape_control_characters,
        trim_blocks=True,
        lstrip_blocks=True,
    )


def _escape_control_characters(value: object) -> object:
    """A value with control characters made visible; HTML marked as safe stays as it is."""
    return make_printable(value) if type(value) is str else value


def choose_page_path(path: str | os.PathLike[str]) -> Path:
    """The path that a page is written to.

    Raises:
        BadRequest: the name does not end in .html or .htm.
    """
    target = Path(path)
    if target.suffix.lower() not in PAGES:
        raise BadRequest(
            f"a page cannot end in {target.suffix or 'nothing'!r}",
            where=str(target),
            advice="End its name in .html.",
        )
    return target


def write_page_file(text: str, target: Path, *, private: bool = False) -> None:
    """Write a file; if that fails, an existing file stays as it was.

    Args:
        text: its content.
        target: the file.
        private: whether only its owner may read it.

    Raises:
        BadRequest: the file cannot be written.
    """
    with refuse_os_errors("cannot be written", target, advice=ELSEWHERE):
        write_atomically(target, text, private=private)
