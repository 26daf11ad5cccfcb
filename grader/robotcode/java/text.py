"""Java's texts: String, StringBuilder, Character and the formats of printf.

A character beyond U+FFFF counts as one here, and as two in Java. What takes a regular expression
is unknown, but for split with a plain separator.
"""

import functools
import re
from collections.abc import Callable
from decimal import ROUND_HALF_UP, Decimal, localcontext
from typing import Any

from grader.robotcode.java.steps import STATE
from grader.robotcode.java.values import (
    BOX_NAMES,
    CHARACTERS,
    LONGEST_TEXT,
    Array,
    Char,
    IllegalArgumentException,
    JavaClass,
    OutOfMemoryError,
    StringIndexOutOfBoundsException,
    bound_text,
    compare,
    decimal_text,
    find_unknown,
    hash_code,
    join_texts,
    make_statics,
    propagate,
    spread,
    to_string,
    write_items,
)
from grader.robotcode.library.base import JAVA, Unknown

WIDEST = 1_000  # [characters] of one value in a format
_DIGITS = 400  # what the largest double with its fraction needs
_SPECIFIER = re.compile(r"%([-+0,]*)(\d{0,3})(?:\.(\d{1,2}))?([a-zA-Z%])|%")
_CONVERSIONS = {"s": object, "b": object, "d": int, "x": int, "f": float, "e": float}


class IllegalFormatException(IllegalArgumentException, package="java.util"):
    """A format that does not fit its arguments."""


def format(pattern: Any, args: Any) -> Any:
    """A text with arguments filled in, as java.util.Formatter does it."""
    if not isinstance(pattern, str):
        return Unknown("format()")  # a locale comes first
    waiting = spread(args)
    unknown = find_unknown(*waiting)
    if unknown is not None:
        return unknown

    def fill_in(match: re.Match[str]) -> str:
        flags, width, precision, letter = match.groups()
        if letter in {"n", "%"}:
            return "\n" if letter == "n" else "%"
        kind = (letter or "").lower()
        if kind not in _CONVERSIONS and kind not in {"c", "g", "o", "h"}:
            raise IllegalFormatException(f"Conversion = '{letter or '%'}'")
        if not waiting:
            raise IllegalFormatException(f"Format specifier '{match[0]}'")
        value = waiting.pop(0)
        whole = isinstance(value, bool) and kind in {"d", "x"}
        if value is not None and (whole or not isinstance(value, _CONVERSIONS.get(kind, object))):
            name = BOX_NAMES.get(type(value), "java.lang.Object")
            raise IllegalFormatException(f"{letter} != {name}")
        text = _write(value, kind, flags, precision)
        if "0" in flags:
            sign = text[0] * (text[0] in "+-")
            text = sign + text[len(sign) :].rjust(int(width) - len(sign), "0")
        text = text.ljust(int(width or 0)) if "-" in flags else text.rjust(int(width or 0))
        return text.upper() if letter.isupper() else text

    return bound_text(_SPECIFIER.sub(fill_in, pattern))


def _write(value: Any, kind: str, flags: str, precision: str | None) -> str:
    """One argument of a format, as long as it is."""
    if value is None or kind not in {"d", "f", "e", "x"} or value in (float("inf"), -float("inf")):
        text = to_string(value if kind != "b" or isinstance(value, bool) else value is not None)
        return text[: int(precision)] if precision else text
    if kind == "x":
        return f"{value & ((1 << getattr(type(value), 'bits', 32)) - 1):x}"
    if kind == "d" or value != value:  # noqa: PLR0124 - not a number
        text = to_string(value)
    else:
        text = _round(value, kind, int(precision or 6) if precision != "0" else 0)
    if "," in flags:
        before, point, after = text.partition(".")
        text = f"{int(before):,}{point}{after}"
    return f"+{text}" if "+" in flags and value >= 0 else text


def _round(value: float, kind: str, digits: int) -> str:
    """A number with that many digits, rounded half up from the digits that Java writes."""
    number = Decimal(decimal_text(value))
    with localcontext() as context:
        context.prec, context.rounding = 3 * _DIGITS, ROUND_HALF_UP
        if kind == "f":
            return f"{number.quantize(Decimal(1).scaleb(-digits)):f}"
        context.prec = digits + 1
        number = +number
        mantissa = f"{number.scaleb(-number.adjusted()):.{digits}f}"
        return f"{mantissa}e{number.adjusted() if number else 0:+03d}"


def _split(text: str, pattern: str, limit: int = 0) -> Any:
    plain = re.sub(r"\\(\W)", r"\1", pattern)
    if not plain or (plain == pattern and re.search(r"[][.$|()*+?^{}\\]", pattern)):
        return Unknown("split()")
    parts = text.split(plain, limit - 1 if limit > 0 else -1)
    while limit == 0 and len(parts) > 1 and not parts[-1]:
        parts.pop()
    return Array(parts, "String")


def _replace(text: str, old: str, new: str) -> str:
    if text.count(old) * len(new) > LONGEST_TEXT:
        raise OutOfMemoryError("Java heap space")
    return text.replace(old, new)


def _find_unit(text: str, index: int) -> Char:
    if not 0 <= index < len(text):
        raise StringIndexOutOfBoundsException(f"String index out of range: {index}")
    return Char(text[index])


def _cut(text: str, begin: int, end: int | None = None) -> str:
    stop = len(text) if end is None else end
    if not 0 <= begin <= stop <= len(text):
        raise StringIndexOutOfBoundsException(f"begin {begin}, end {stop}, length {len(text)}")
    return text[begin:stop]


def _text_of(unit: str | int) -> str:
    """What indexOf looks for: a text, a character or a character's number."""
    return chr(unit) if isinstance(unit, int) else unit + ""


def _repeat(text: str, times: int) -> str:
    if times < 0:
        raise IllegalArgumentException(f"count is negative: {times}")
    if len(text) * times > LONGEST_TEXT:
        raise OutOfMemoryError("Java heap space")
    return text * times


def _join(separator: str, *parts: Any) -> str:
    several = len(parts) == 1 and not isinstance(parts[0], str) and parts[0] is not None
    texts = map(to_string, parts[0] if several else parts)
    return join_texts(separator, texts)


def _value_of(value: object = "") -> Any:
    """String.valueOf, also of a char[]."""
    if type(value) is Array and value.kind == "char":
        return "".join(value)
    return to_string(value)


def _unknown(name: str) -> Callable[..., Any]:
    return lambda *_args: Unknown(f"{name}()")


_UNKNOWN = (
    "replaceAll replaceFirst matches chars lines codePointAt intern subSequence contentEquals "
    "compareToIgnoreCase stripLeading stripTrailing regionMatches codePoints indent copyValueOf "
    "getBytes translateEscapes stripIndent transform describeConstable"
)
STRING_METHODS: dict[str, Callable[..., Any]] = {
    **{name: _unknown(name) for name in _UNKNOWN.split()},
    "length": len,
    "isEmpty": lambda text: not text,
    "isBlank": lambda text: not text.strip(),
    "charAt": _find_unit,
    "substring": _cut,
    "indexOf": lambda text, part, start=0: text.find(_text_of(part), max(start, 0)),
    "lastIndexOf": lambda text, part: text.rfind(_text_of(part)),
    "contains": lambda text, part: to_string(part) in text,
    "startsWith": lambda text, start: text.startswith(start),
    "endsWith": lambda text, end: text.endswith(end),
    "equals": lambda text, other: type(other) is str and text == other,
    "equalsIgnoreCase": lambda text, other: other is not None and text.lower() == other.lower(),
    "compareTo": compare,
    "toUpperCase": lambda text, *_locale: text.upper(),
    "toLowerCase": lambda text, *_locale: text.lower(),
    "trim": lambda text: text.strip("".join(map(chr, range(33)))),
    "strip": lambda text: text.strip(),
    "replace": lambda text, old, new: _replace(text, to_string(old), to_string(new)),
    "split": _split,
    "concat": lambda text, other: bound_text(text + other),
    "repeat": _repeat,
    "toCharArray": lambda text: Array(map(Char, text), "char"),
    "format": lambda _text, pattern, *args: format(pattern, args),
    "join": lambda _text, separator, *parts: _join(separator, *parts),
    "valueOf": lambda _text, value: _value_of(value),
    "formatted": lambda text, *args: format(text, args),
    "toString": lambda text: text,
    "hashCode": hash_code,
    "getClass": lambda text: JAVA["java.lang.Class"].of(type(text)),
}


def _count_time(method: Callable[..., Any]) -> Callable[..., Any]:
    """The method of a text, in which a long text counts as several steps of the program."""

    @functools.wraps(method)
    def run(text: str, *args: Any) -> Any:
        STATE.tick(len(text) // CHARACTERS)
        return method(text, *args)

    return propagate(run)


STRING_METHODS = {name: _count_time(one) for name, one in STRING_METHODS.items()}
make_statics(
    "java.lang.String",
    {"valueOf": _value_of, "join": _join},
    partial=True,
    format=staticmethod(lambda pattern, *args: format(pattern, args)),
    __new__=lambda _cls, *args: _value_of(*args),
)


class StringBuilder(JavaClass, package="java.lang", partial=True):
    """A text that can be changed."""

    def __init__(self, start: object = "") -> None:
        self._text = "" if type(start) is int else to_string(start)

    def _put(self, start: int, end: int, text: object) -> Any:
        if not 0 <= start <= end or start > len(self._text):
            raise StringIndexOutOfBoundsException(f"offset {start}, length {len(self._text)}")
        written = text if isinstance(text, str) else write_items([_value_of(text)], "", "")
        self._text = bound_text(self._text[:start] + written + self._text[end:])
        return self

    append = lambda self, value: self._put(len(self._text), len(self._text), value)
    insert = lambda self, index, value: self._put(index, index, value)
    delete = lambda self, start, end: self._put(start, end, "")
    deleteCharAt = lambda self, index: self._put(index, index + 1, "")
    setCharAt = lambda self, index, unit: self._put(index, index + 1, unit)
    setLength = lambda self, length: self._put(length, max(length, len(self._text)), "") and None
    reverse = lambda self: self._put(0, len(self._text), self._text[::-1])
    toString = lambda self: self._text
    charAt = lambda self, index: _find_unit(self._text, index)
    length = lambda self: len(self._text)
    isEmpty = lambda self: not self._text


JAVA["java.lang.StringBuffer"] = StringBuilder


def _test_unit(test: Callable[[str], bool]) -> Callable[[str | int], bool]:
    return lambda unit: test(_text_of(unit))


make_statics(
    "java.lang.Character",
    {
        "isDigit": _test_unit(str.isdecimal),
        "isLetter": _test_unit(str.isalpha),
        "isLetterOrDigit": _test_unit(str.isalnum),
        "isUpperCase": _test_unit(str.isupper),
        "isWhitespace": _test_unit(str.isspace),
        "toUpperCase": lambda unit: Char(unit.upper()),
        "toLowerCase": lambda unit: Char(unit.lower()),
        "valueOf": lambda unit: unit,
        "toString": _text_of,
        "compare": compare,
    },
    partial=True,
)
