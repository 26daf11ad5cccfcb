"""Text to display: untrusted text without control characters, lists, and numbers."""

import math
import unicodedata
from collections.abc import Sequence

KEPT = "\n\t"
DIRECTIONS = frozenset("\u061c\u200e\u200f\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069")
REPLACEMENT = "\ufffd"  # the Unicode replacement character
SHOWN = 5  # names in one line
FINEST = 1e-4  # [1] relative error; carpet, battery and heat change a gain by more


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


def format_error(value: float, error: float) -> str:
    """A standard error as text: two digits, ``not known``, or that it is negligible."""
    if not math.isfinite(error):
        return "not known"
    if error < FINEST * abs(value):
        return f"< {FINEST:.2%} of it"
    return _write_rounded(error, _count_places(value, error))


def format_value(value: float, error: float) -> str:
    """A value as text, with as many decimals as its error has: 0.250 for an error of 0.013."""
    if not math.isfinite(error):
        return f"{value:.4g}"
    return _write_rounded(value, _count_places(value, error))


def format_with_error(value: float, error: float) -> str:
    """A value and its standard error: ``0.250 ± 0.013``."""
    return f"{format_value(value, error)} ± {format_error(value, error)}"


def _count_places(value: float, error: float) -> int:
    """Decimal places that show two digits of an error; negative for an error of 100 or more."""
    error = max(error, FINEST * abs(value))
    return 1 - math.floor(math.log10(error)) if error > 0.0 else 0


def _write_rounded(number: float, places: int) -> str:
    return f"{round(number, places):.{max(places, 0)}f}"
