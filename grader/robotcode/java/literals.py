"""Java's literals as values: numbers, characters, strings and text blocks."""

import re
import textwrap
from typing import Any

from grader.robotcode.java.values import Char, Float, Long

ESCAPES = {
    "n": "\n", "t": "\t", "b": "\b", "r": "\r", "f": "\f", "s": " ",
    "0": "\0", "\\": "\\", "'": "'", '"': '"', "\n": "",
}  # fmt: skip
BITS = 32
OCTAL, DECIMAL = 8, 10
RADIXES = {"0x": 16, "0b": 2}
_ESCAPE = re.compile(r"\\(u+[0-9a-fA-F]{4}|[0-3]?[0-7]{1,2}|.|\n)", re.DOTALL)


def read_number(text: str) -> tuple[Any, str] | None:
    """A number and its type; None if it does not fit."""
    plain = text.replace("_", "").lower()
    radix = RADIXES.get(plain.lstrip("-")[:2], DECIMAL)
    try:
        if radix == DECIMAL and (set(plain) & set(".e") or plain[-1] in "fd"):
            real = float(plain.rstrip("fd"))
            return (Float(real), "float") if plain.endswith("f") else (real, "double")
        if "p" in plain:
            return float.fromhex(plain.rstrip("fd")), "double"
        long = plain.endswith("l")
        plain = plain.rstrip("l")
        octal = radix == DECIMAL and len(plain) > 1 and plain.startswith("0")
        number = int(plain, OCTAL if octal else 0 if radix != DECIMAL else DECIMAL)
    except ValueError:
        return None
    half = 1 << ((2 * BITS if long else BITS) - 1)
    if (radix != DECIMAL or octal) and half <= number < 2 * half:
        number -= 2 * half
    if not -half <= number < half:
        return None
    return (Long(number), "long") if long else (number, "int")


def _escape(match: re.Match[str]) -> str:
    sign = match[1]
    if len(sign) > 4:  # noqa: PLR2004 - u and its digits
        return chr(int(sign[-4:], 16))
    if sign.isdigit():
        return chr(int(sign, 8))
    return ESCAPES.get(sign, sign)


def read_character(text: str) -> Char:
    """The character of ``'x'``."""
    return Char(_ESCAPE.sub(_escape, text[1:-1]))


def read_string(text: str) -> str:
    """The text of ``"..."`` or of a text block, whose common indentation goes."""
    if not text.startswith('"""'):
        return _ESCAPE.sub(_escape, text[1:-1])
    body = text[3:-3].partition("\n")[2]
    last = body.rpartition("\n")[2]
    end = "" if last.strip() else "|"  # the closing quotes count as a line
    body = textwrap.dedent(body + end).removesuffix("|") if end else textwrap.dedent(body)
    lines = [line.rstrip(" \t") for line in body.split("\n")]
    return _ESCAPE.sub(_escape, "\n".join(lines))
