"""Java's texts, as far as robot programs need them; the result of any other method is unknown."""

import functools
import re
from collections.abc import Callable
from types import NoneType
from typing import Any

from grader.robotcode.java.steps import STATE
from grader.robotcode.java.values import (
    CHARACTERS,
    LONGEST_TEXT,
    IllegalArgumentException,
    StringIndexOutOfBoundsException,
    compare,
    find_unknown,
    make_statics,
    make_unknown,
    propagate,
    spread,
    to_string,
)
from grader.robotcode.library.base import Unknown

_PLAIN = re.compile(r"%(-?\d{0,3})(\.\d{1,2})?([sdfn%])")
_TAKES: dict[str, type] = {"s": str, "d": int, "f": float}


class IllegalFormatException(IllegalArgumentException, package="java.util"):
    """A format that does not fit its arguments."""


def format(pattern: Any, args: Any) -> Any:
    """A text with arguments filled in, as java.util.Formatter does it for plain ``%s %d %f``."""
    waiting = spread(args)
    if not isinstance(pattern, str) or "%" in _PLAIN.sub("", pattern):
        return Unknown("format()")  # a locale comes first, or a rare letter is in it
    filled = []
    for _, _, letter in _PLAIN.findall(pattern):
        if letter in "n%":
            continue
        if letter == "s":
            waiting[:1] = map(to_string, waiting[:1])
        value = waiting.pop(0) if waiting else Ellipsis
        if value is Ellipsis or type(value) not in (_TAKES[letter], Unknown, NoneType):
            raise IllegalFormatException(f"Format specifier '%{letter}'")
        filled.append(Unknown("null") if value is None else value)
    unknown = find_unknown(*filled)
    return pattern.replace("%n", "\n") % tuple(filled) if unknown is None else unknown


def _replace_text(text: str, old: Any, new: Any) -> Any:
    long = text.count(old) * len(new) > LONGEST_TEXT
    return Unknown("replace()") if long else text.replace(old, new)


def _take_substring(text: str, begin: int, end: int | None = None) -> str:
    stop = len(text) if end is None else end
    if not 0 <= begin <= stop <= len(text):
        raise StringIndexOutOfBoundsException(f"begin {begin}, end {stop}, length {len(text)}")
    return text[begin:stop]


_UNKNOWN = (
    "replaceAll replaceFirst matches chars lines codePointAt intern subSequence contentEquals "
    "compareToIgnoreCase strip stripLeading stripTrailing regionMatches codePoints indent "
    "getBytes translateEscapes stripIndent transform describeConstable copyValueOf split repeat "
    "lastIndexOf toCharArray join hashCode isBlank getClass"
)
STRING_METHODS: dict[str, Callable[..., Any]] = {
    **{name: make_unknown(f"{name}()") for name in _UNKNOWN.split()},
    "length": len,
    "isEmpty": lambda text: not text,
    "charAt": lambda text, index: _take_substring(text, index, index + 1),
    "substring": _take_substring,
    "indexOf": lambda text, part: text.find(part),
    "contains": lambda text, part: part in text,
    "startsWith": lambda text, start: text.startswith(start),
    "endsWith": lambda text, end: text.endswith(end),
    "equals": lambda text, other: text == other,
    "equalsIgnoreCase": lambda text, other: other is not None and text.lower() == other.lower(),
    "compareTo": compare,
    "toUpperCase": lambda text, *_locale: text.upper(),
    "toLowerCase": lambda text, *_locale: text.lower(),
    "trim": lambda text: text.strip(),
    "replace": _replace_text,
    "concat": lambda text, other: text + other,
    "format": lambda _text, pattern, *args: format(pattern, args),
    "formatted": lambda text, *args: format(text, args),
    "valueOf": lambda _text, value: to_string(value),
    "toString": lambda text: text,
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
    {"valueOf": to_string},
    partial=True,
    format=staticmethod(lambda pattern, *args: format(pattern, args)),
    __new__=lambda _cls, text="": text,
)
