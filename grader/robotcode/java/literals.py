"""Java's literals as values: numbers, characters and strings."""

import re
from typing import Any

ESCAPES = {"n": "\n", "t": "\t", "b": "\b", "r": "\r", "f": "\f", "s": " "}


def read_number(text: str) -> tuple[Any, str] | None:
    """A number and its type; None if it does not fit."""
    plain = text.replace("_", "").lower()
    whole = plain.lstrip("-").startswith(("0x", "0b"))
    if not whole and (set(plain) & set(".e") or plain[-1] in "fd"):
        return float(plain.rstrip("fd")), "float" if plain.endswith("f") else "double"
    long = plain.endswith("l")
    number, half = int(plain.rstrip("l"), 0 if whole else 10), 1 << (63 if long else 31)
    if whole and half <= number < 2 * half:
        number -= 2 * half
    return (number, "long" if long else "int") if -half <= number < half else None


def read_string(text: str) -> str | None:
    """The text of ``"..."`` or of ``'x'``; None of a text block, and of a sign by its number."""
    if text.startswith('"""') or re.search(r"\\[u0-7]", text):
        return None
    return re.sub(r"\\(.)", lambda match: ESCAPES.get(match[1], match[1]), text[1:-1])
