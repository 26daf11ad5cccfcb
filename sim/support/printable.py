"""Text to display: untrusted text without control characters, lists, and numbers."""

import math
import unicodedata
from collections.abc import Sequence

KEPT = "\n\t"
DIRECTIONS = frozenset("\u061c\u200e\u200f\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069")
REPLACEMENT = "\ufffd"  # the Unicode replacement character
SHOWN = 5  # names in one line


def make_printable(text: str) -> str:
    """The text with control and bidirectional characters replaced by visible ones.

    Control characters (C0 and C1, except line break and tab) can recolor, move and rename a
    terminal. Bidirectional characters can change the apparent order of a text. Lone surrogates
    cannot be encoded. Source: Unicode Standard Annex 9 and Technical
    Report 36.

    Args:
        text: text from a student, a file or a file name.
    """
    if text.isprintable():
        return text
    return "".join(REPLACEMENT if _is_control(character) else character for character in text)


def list_first(names: Sequence[str], *, most: int = SHOWN, separator: str = ", ") -> str:
    """Text with the first names of a list, and the number of the others.

    Args:
        names: the names.
        most: number of names to list.
        separator: text between two names.
    """
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return separator.join(names[:most]) + more


def _is_control(character: str) -> bool:
    if character in KEPT:
        return False
    return character in DIRECTIONS or unicodedata.category(character) in {"Cc", "Cs"}


def join_names(names: Sequence[str], *, word: str = "and") -> str:
    """The names as a list in a sentence: ``a, b and c``; ``nothing`` without any."""
    *first, last = names or ("nothing",)
    return f"{', '.join(first)} {word} {last}" if first else last


def finite_or_none(number: float | None) -> float | None:
    """The number; None where it is not finite, which JSON cannot say."""
    return number if number is not None and math.isfinite(number) else None


def write_minus_sign(number: str) -> str:
    """A number as text with a minus sign (−); a power of ten keeps its hyphen, to be copied."""
    return number if "e" in number else number.replace("-", "−")
