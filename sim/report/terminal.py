"""Text on a terminal: wrapped and colored where a person reads it."""

import sys
from textwrap import wrap

from rich.console import Console
from rich.text import Text

WIDEST = 120  # [columns] longer lines are hard to read
VERDICT_STYLES = {"Usable": "bold green", "Do not use": "bold red"}
WRONG, WARNING = "bold red", "yellow"


class WrappedPrinter:
    """Prints wrapped text; brackets in it are printed as they are, not read as markup.

    Args:
        console: where to print; standard output if None.
        widest: [columns] longest line; None takes ``WIDEST``, and does not wrap in a pipe.
    """

    def __init__(self, console: Console | None = None, *, widest: int | None = None) -> None:
        self.console = console or Console(highlight=False, file=sys.stdout)
        self.width = min(self.console.width, widest or WIDEST)
        if widest is None and not self.console.is_terminal:
            self.width = sys.maxsize

    def __call__(self, text: str, *, indent: int = 0, hang: int = 0, style: str = "") -> None:
        """Print a paragraph.

        Args:
            text: what to print.
            indent: [columns] before each line.
            hang: [columns] further before each line but the first.
            style: of the text, as rich names it.
        """
        blank = " " * indent
        lines = wrap(
            text.replace("± ", "±\u00a0"), self.width, initial_indent=blank,
            subsequent_indent=blank + " " * hang, break_on_hyphens=False, break_long_words=False,
        )  # fmt: skip
        for line in lines or [""]:
            self.console.print(Text(line.replace("\u00a0", " "), style=style), soft_wrap=True)
