"""Text to display: safe if it comes from strangers, short if it is a list."""

import unicodedata
from collections.abc import Sequence

KEPT = "\n\t"
DIRECTIONS = frozenset("\u061c\u200e\u200f\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069")
INSTEAD = "\ufffd"  # the sign for a sign that cannot be shown


def make_printable(text: str) -> str:
    """The text with control and bidirectional characters replaced by visible ones.

    Control characters (C0 and C1, but for line break and tab) can recolor, move and rename a
    terminal; the signs that set a direction of writing can make a line read as another one; half of
    a pair (a surrogate) cannot be written at all. Source: Unicode Standard Annex 9 and Technical
    Report 36.

    Args:
        text: what a learner, a file or its name holds.
    """
    if text.isprintable():
        return text
    return "".join(INSTEAD if _commands(sign) else sign for sign in text)


def list_first(names: Sequence[str], *, most: int, separator: str = ", ") -> str:
    """Text with the first of many names, and how many more there are."""
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return separator.join(names[:most]) + more


def _commands(sign: str) -> bool:
    if sign in KEPT:
        return False
    return sign in DIRECTIONS or unicodedata.category(sign) in {"Cc", "Cs"}
