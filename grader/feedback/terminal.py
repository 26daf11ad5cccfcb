"""Lines of text for a terminal: colored where one looks at it, plain where a program reads it."""

import os
import shutil
import sys
import textwrap
from collections.abc import Iterable
from dataclasses import dataclass

from sim.support import command_line
from sim.support.printable import make_printable

WIDEST = 80  # [columns] longer lines are harder to read
NARROWEST = 40  # [columns] below this, words would stand alone


@dataclass(frozen=True)
class StyledText:
    """A piece of a line in one style, as rich names it: ``bold green``."""

    text: str
    style: str = ""


Line = tuple[StyledText, ...]


def style_line(text: str = "", style: str = "") -> Line:
    """A line in one style."""
    return (StyledText(text, style),)


def wrap_text(text: str, *, lead: str, style: str = "", spare: int = 0) -> list[Line]:
    """Break a text into lines that fit the terminal, after a lead of its own.

    Args:
        text: what to say; a line break in it stays.
        lead: what the first line starts with; the others are indented as far.
        style: of the text.
        spare: columns to keep free at the end.
    """
    room = find_width() - len(lead) - spare
    rows = [
        row
        for paragraph in text.splitlines() or [""]
        for row in textwrap.wrap(paragraph, room, break_long_words=False) or [""]
    ]
    leads = [lead] + [" " * len(lead)] * (len(rows) - 1)
    return [
        (StyledText(head), StyledText(row, style)) for head, row in zip(leads, rows, strict=True)
    ]


def find_width() -> int:
    """The largest width of a line."""
    return max(NARROWEST, min(WIDEST, shutil.get_terminal_size((WIDEST, 24)).columns))


def print_lines(lines: Iterable[Line]) -> None:
    """Print lines to standard output."""
    if not sys.stdout.isatty() or "NO_COLOR" in os.environ:
        for spans in lines:
            text = make_printable("".join(span.text for span in spans))
            print(text.rstrip())  # noqa: T201 - a command prints
        sys.stdout.flush()  # a server's lines are read while it goes on
        return
    from rich.console import Console  # noqa: PLC0415 - a pipe needs no colors, and starts sooner
    from rich.text import Text  # noqa: PLC0415 - the same

    console = Console(highlight=False, soft_wrap=True)
    for spans in lines:
        console.print(Text.assemble(*((make_printable(span.text), span.style) for span in spans)))


def print_error(said: str) -> None:
    """Print one line to standard error."""
    command_line.print_error(said, name="grade")
