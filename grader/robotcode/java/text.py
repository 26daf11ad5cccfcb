"""Java's texts: String, StringBuilder, Character and the formats of printf.

A character beyond U+FFFF counts as one here, and as two in Java.
"""

import functools
import re
from collections.abc import Callable
from decimal import ROUND_HALF_UP, Decimal, localcontext
from functools import partial
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
    NullPointerException,
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
from grader.robotcode.library.base import JAVA

LONGEST_SEARCHED = 2_000  # [characters] a regular expression may take long on more
LONGEST_NESTED = 20  # [characters] the same, with a repetition of a group that can vary
MOST_TRIES = 1e8  # places that a search may have to look at, with several repetitions
WIDEST = 1_000  # [characters] of one value in a format
_DIGITS = 400  # what the largest double with its fraction needs

_SPECIFIER = re.compile(
    r"%(?:(?:(\d+)\$)?([-#+ 0,(<]*)(\d+)?(?:\.(\d+))?([a-zA-Z%])|(.?))", re.DOTALL
)
_REPEAT = re.compile(r"[^\\][*+{]")
_NESTED = re.compile(r"[*+?|}].*\)[*+{]")


class IllegalFormatException(IllegalArgumentException, package="java.util"):
    """A format that does not fit its arguments."""


class UnknownFormatConversionException(IllegalFormatException, package="java.util"):
    """A letter that no conversion has."""


class MissingFormatArgumentException(IllegalFormatException, package="java.util"):
    """Fewer arguments than the format asks for."""


class IllegalFormatConversionException(IllegalFormatException, package="java.util"):
    """A conversion for another type."""


class MissingFormatWidthException(IllegalFormatException, package="java.util"):
    """A flag that needs a width."""


class IllegalFormatPrecisionException(IllegalFormatException, package="java.util"):
    """A precision where none is allowed."""


class PatternSyntaxException(IllegalArgumentException, package="java.util.regex"):
    """A text that is no regular expression."""


def format(pattern: Any, args: Any) -> Any:
    """A text with arguments filled in, as java.util.Formatter does it. A locale may come first."""
    args = list(args)
    if not isinstance(pattern, str) and args:
        pattern, args = args[0], args[1:]
    args = spread(args)
    unknown = find_unknown(pattern, *args)
    if unknown is not None:
        return unknown
    if pattern is None:
        raise NullPointerException
    used: list[int] = []  # indices of the arguments that stand in their order, or are pointed at
    last = [-1]

    def fill_in(match: re.Match[str]) -> str:
        index, flags, width, _, letter, wrong = match.groups()
        if wrong is not None:
            raise UnknownFormatConversionException(f"Conversion = '{wrong or '%'}'")
        if "-" in flags and not width:
            raise MissingFormatWidthException(match[0])
        if letter in "n%":
            return "\n" if letter == "n" else _pad("%", flags, width)
        if letter.lower() not in "bhscdoxefg" or letter in "DOF":
            raise UnknownFormatConversionException(f"Conversion = '{letter}'")
        if index is None and "<" not in flags:
            used.append(len(used))
        place = int(index) - 1 if index else last[0] if "<" in flags else used[-1]
        if not 0 <= place < len(args):
            raise MissingFormatArgumentException(f"Format specifier '{match[0]}'")
        last[0] = place
        filled = _convert(match, args[place])
        return filled.upper() if letter.isupper() else filled

    return bound_text(_SPECIFIER.sub(fill_in, pattern))


def _pad(text: str, flags: str, width: str | None) -> str:
    size = int(width or 0)
    if size > WIDEST:
        raise OutOfMemoryError("Java heap space")
    return text.ljust(size) if "-" in flags else text.rjust(size)


def _convert(match: re.Match[str], value: Any) -> str:
    """One argument as its specifier says."""
    _, flags, width, precision, letter, _ = match.groups()
    kind = letter.lower()
    whole = isinstance(value, int) and not isinstance(value, bool)
    fits = {"c": isinstance(value, Char) or type(value) is int, "s": True, "b": True, "h": True}
    fits |= dict.fromkeys("dox", whole) | dict.fromkeys("efg", isinstance(value, float))
    if precision and kind in "dox":
        raise IllegalFormatPrecisionException(precision)
    if value is not None and not fits[kind]:
        name = BOX_NAMES.get(type(value), "java.lang.Object")
        raise IllegalFormatConversionException(f"{letter} != {name}")
    if kind == "b":
        text = to_string(value if isinstance(value, bool) else value is not None)
    elif kind in "shc" or value is None:
        text = (
            f"{hash_code(value) & 0xFFFFFFFF:x}"
            if kind == "h" and value is not None
            else (chr(value) if kind == "c" and type(value) is int else to_string(value))
        )
    elif kind in "xo":
        bits = getattr(type(value), "bits", 32)
        text = f"{value & ((1 << bits) - 1):{kind}}".rjust(int(width or 0) * ("0" in flags), "0")
    else:
        return _pad(_write_number(value, kind, match), flags, width)
    return _pad(text[: int(precision)] if precision else text, flags, width)


def _write_number(value: Any, kind: str, match: re.Match[str]) -> str:
    _, flags, width, precision, _, _ = match.groups()
    finite = value == value and abs(value) != float("inf")  # noqa: PLR0124 - not a number
    text = to_string(abs(value)) if not finite or kind == "d" else _round(value, kind, precision)
    if "," in flags and finite:
        before, point, after = text.partition(".")
        text = f"{int(before):,}{point}{after}"
    negative = value < 0 or to_string(value).startswith("-")
    sign = "-" if negative else "+" if "+" in flags else " " if " " in flags else ""
    start, end = ("(", ")") if negative and "(" in flags else (sign, "")
    width = int(width or 0) - len(start + end) if "0" in flags and finite else 0
    return start + _pad(text, "", str(max(width, 0))).replace(" ", "0") + end


def _round(value: float, kind: str, precision: str | None) -> str:
    """Size of a number with that many digits, rounded half up from the digits Java writes."""
    digits = min(int(precision or 6) if precision != "0" else 0, _DIGITS)
    number = abs(Decimal(decimal_text(value)))
    with localcontext() as context:
        context.prec, context.rounding = 3 * _DIGITS, ROUND_HALF_UP
        if kind == "g":
            digits = max(digits, 1)
            kind = "f" if number == 0 or Decimal("1e-4") <= number < 10**digits else "e"
            digits -= number.adjusted() + 1 if kind == "f" and number else 1
        if kind == "f":
            return f"{number.quantize(Decimal(1).scaleb(-digits)):f}"
        context.prec = digits + 1
        number = +number
        mantissa = f"{number.scaleb(-number.adjusted()):.{digits}f}"
        return f"{mantissa}e{number.adjusted() if number else 0:+03d}"


def _compile(pattern: str, text: str) -> re.Pattern[str]:
    """A regular expression of Java's in Python's syntax.

    Raises:
        PatternSyntaxException: it is none.
        OutOfMemoryError: the text is too long to look through.
    """
    repeats = len(_REPEAT.findall(pattern))
    longest = LONGEST_NESTED if _NESTED.search(pattern) else MOST_TRIES ** (1 / max(repeats, 1))
    if len(text) > min(longest, LONGEST_SEARCHED):
        raise OutOfMemoryError("Java heap space")
    STATE.tick(len(text))
    quoted = re.sub(r"\\Q(.*?)(\\E|$)", lambda match: re.escape(match[1]), pattern, flags=re.DOTALL)
    quoted = re.sub(r"\(\?<(?=[a-zA-Z])", "(?P<", quoted).replace(r"\z", r"\Z")
    for name, members in _CLASSES.items():
        quoted = quoted.replace(rf"[\p{{{name}}}", f"[{members}")
        quoted = quoted.replace(rf"\p{{{name}}}", f"[{members}]")
    try:
        return re.compile(quoted)
    except re.error as error:
        raise PatternSyntaxException(f"{error} near index {error.pos}\n{pattern}") from None


_CLASSES = {"Alpha": "a-zA-Z", "L": "a-zA-Z", "Digit": "0-9", "Alnum": "a-zA-Z0-9"}
_CLASSES |= {"Upper": "A-Z", "Lu": "A-Z", "Lower": "a-z", "Ll": "a-z", "Space": r"\s"}
_CLASSES["Punct"] = r"!-/:-@\[-`{-~"


def _replace_all(text: str, old: str, new: str) -> str:
    if text.count(old) * len(new) > LONGEST_TEXT:
        raise OutOfMemoryError("Java heap space")
    return text.replace(old, new)


def _replace(text: str, pattern: str, template: str, most: int = 0) -> str:
    def fill_in(match: re.Match[str]) -> str:
        def take(part: re.Match[str]) -> str:
            return part[1] or match[part[3] or int(part[2])] or ""

        return re.sub(r"\\(.)|\$(\d)|\$\{(\w+)\}", take, template)

    if len(template) > WIDEST:
        raise OutOfMemoryError("Java heap space")
    return bound_text(_compile(pattern, text).sub(fill_in, text, count=most))


def _split(text: str, pattern: str, limit: int = 0) -> Array:
    parts: list[str] = []
    start = 0
    for match in _compile(pattern, text).finditer(text):
        if 0 < limit <= len(parts) + 1:
            break
        if match.end() > 0 and not (match.start() == match.end() == len(text)):
            parts.append(text[start : match.start()])
            start = match.end()
    parts.append(text[start:])
    while limit == 0 and len(parts) > 1 and not parts[-1]:
        parts.pop()
    return Array(parts if parts != [""] or not text else [], "String")


def _find_unit(text: str, index: int, wrong: str = "String index out of range: {}") -> Char:
    if not 0 <= index < len(text):
        raise StringIndexOutOfBoundsException(wrong.format(index, len(text)))
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


def _stream(name: str, items: Any) -> Any:
    return JAVA[f"java.util.stream.{name}"](items)


def _value_of(value: object = "", *bounds: int) -> Any:
    """String.valueOf, also of a char[] or a part of it."""
    if type(value) is Array and value.kind == "char":
        start, length = bounds or (0, len(value))
        return "".join(value[start : start + length])
    return to_string(value)


STRING_METHODS: dict[str, Callable[..., Any]] = {
    "length": len,
    "isEmpty": lambda text: not text,
    "isBlank": lambda text: not text.strip(),
    "charAt": _find_unit,
    "codePointAt": lambda text, index: ord(_find_unit(text, index)),
    "substring": _cut,
    "subSequence": _cut,
    "indexOf": lambda text, part, start=0: text.find(_text_of(part), max(start, 0)),
    "lastIndexOf": lambda text, part, end=LONGEST_TEXT: text.rfind(
        _text_of(part), 0, max(end + len(_text_of(part)), 0)
    ),
    "contains": lambda text, part: to_string(part) in text,
    "startsWith": lambda text, start, index=0: index >= 0 and text.startswith(start, index),
    "endsWith": lambda text, end: text.endswith(end),
    "equals": lambda text, other: type(other) is str and text == other,
    "contentEquals": lambda text, other: text == to_string(other),
    "equalsIgnoreCase": lambda text, other: other is not None and text.lower() == other.lower(),
    "compareTo": compare,
    "compareToIgnoreCase": lambda text, other: compare(text.lower(), other.lower()),
    "toUpperCase": lambda text, *_locale: text.upper(),
    "toLowerCase": lambda text, *_locale: text.lower(),
    "trim": lambda text: text.strip("".join(map(chr, range(33)))),
    "strip": lambda text: text.strip(),
    "stripLeading": lambda text: text.lstrip(),
    "stripTrailing": lambda text: text.rstrip(),
    "replace": lambda text, old, new: _replace_all(text, to_string(old), to_string(new)),
    "replaceAll": _replace,
    "replaceFirst": lambda text, pattern, new: _replace(text, pattern, new, 1),
    "matches": lambda text, pattern: _compile(pattern, text).fullmatch(text) is not None,
    "split": _split,
    "concat": lambda text, other: bound_text(text + other),
    "repeat": _repeat,
    "toCharArray": lambda text: Array(map(Char, text), "char"),
    "chars": lambda text: _stream("IntStream", map(ord, text)),
    "lines": lambda text: _stream("Stream", text.splitlines()),
    "format": lambda _text, pattern, *args: format(pattern, args),
    "join": lambda _text, separator, *parts: _join(separator, *parts),
    "valueOf": lambda _text, *value: _value_of(*value),
    "copyValueOf": lambda _text, *value: _value_of(*value),
    "formatted": lambda text, *args: format(text, args),
    "toString": lambda text: text,
    "intern": lambda text: text,
    "hashCode": hash_code,
    "getClass": lambda text: JAVA["java.lang.Class"].of(type(text)),
}


def _count_time(method: Callable[..., Any]) -> Callable[..., Any]:
    """The same; a long text costs steps."""

    @functools.wraps(method)
    def run(text: str, *args: Any) -> Any:
        STATE.tick(len(text) // CHARACTERS)
        return method(text, *args)

    return propagate(run)


STRING_METHODS = {name: _count_time(one) for name, one in STRING_METHODS.items()}


String = make_statics(
    "java.lang.String",
    {"valueOf": _value_of, "copyValueOf": _value_of, "join": _join},
    format=staticmethod(lambda pattern, *args: format(pattern, args)),
    CASE_INSENSITIVE_ORDER=partial(STRING_METHODS["compareToIgnoreCase"]),
    __new__=lambda _cls, *args: _value_of(*args),
)


class StringBuilder(JavaClass, package="java.lang", others="capacity ensureCapacity trimToSize"):
    """A text that can be changed."""

    def __init__(self, start: object = "") -> None:
        self._text = "" if type(start) is int else to_string(start)

    def _put(self, start: int, end: int, text: object) -> Any:
        if not 0 <= start <= end or start > len(self._text):
            place = f"offset {start}" if start == end else f"start {start}, end {end}"
            raise StringIndexOutOfBoundsException(f"{place}, length {len(self._text)}")
        written = text if isinstance(text, str) else write_items([_value_of(text)], "", "")
        self._text = bound_text(self._text[:start] + written + self._text[end:])
        return self

    def append(self, value: object, *bounds: int) -> Any:
        """Add a value, or a part of a text, at the end."""
        end = len(self._text)
        return self._put(end, end, _cut(to_string(value), *bounds) if bounds else value)

    def setLength(self, length: int) -> None:
        """Cut the text, or make it longer."""
        self._text = self._text[:length] + _repeat("\0", max(length - len(self._text), 0))

    charAt = lambda self, index: _find_unit(self._text, index, "index {}, length {}")
    insert = lambda self, index, value: self._put(index, index, value)
    replace = lambda self, start, end, text: self._put(start, end, text)
    delete = lambda self, start, end: self._put(start, end, "")
    deleteCharAt = lambda self, index: self._put(index, index + len(self.charAt(index)), "")
    setCharAt = lambda self, index, unit: self._put(index, index + len(self.charAt(index)), unit)
    reverse = lambda self: self._put(0, len(self._text), self._text[::-1])
    toString = lambda self: self._text


def _ask_text(name: str) -> Callable[..., Any]:
    return lambda self, *args: STRING_METHODS[name](self._text, *args)


for _name in ("length", "indexOf", "lastIndexOf", "substring", "isEmpty", "chars"):
    setattr(StringBuilder, _name, _ask_text(_name))
JAVA["java.lang.StringBuffer"] = StringBuilder


class StringJoiner(JavaClass, package="java.util", others="setEmptyValue merge"):
    """Texts with a separator between."""

    def __init__(self, separator: str, start: str = "", end: str = "") -> None:
        self._separator, self._start, self._end = separator, start, end
        self._parts: list[str] = []

    add = lambda self, part: (self, self._parts.append(to_string(part)))[0]
    toString = lambda self: bound_text(
        self._start + join_texts(self._separator, self._parts) + self._end
    )
    length = lambda self: len(self.toString())


def _test_unit(test: Callable[[str], bool]) -> Callable[[str | int], bool]:
    return lambda unit: test(_text_of(unit))


def _change_unit(change: Callable[[str], str]) -> Callable[[str | int], Any]:
    def run(unit: str | int) -> Any:
        changed = Char(change(_text_of(unit))[0])
        return ord(changed) if isinstance(unit, int) else changed

    return run


Character = make_statics(
    "java.lang.Character",
    {
        "isDigit": _test_unit(str.isdecimal),
        "isLetter": _test_unit(str.isalpha),
        "isAlphabetic": _test_unit(str.isalpha),
        "isLetterOrDigit": _test_unit(lambda unit: unit.isalpha() or unit.isdecimal()),
        "isUpperCase": _test_unit(str.isupper),
        "isLowerCase": _test_unit(str.islower),
        "isWhitespace": _test_unit(lambda unit: unit.isspace() and unit != "\xa0"),
        "toUpperCase": _change_unit(str.upper),
        "toLowerCase": _change_unit(str.lower),
        "getNumericValue": lambda unit: int(_text_of(unit), 36) if _text_of(unit).isalnum() else -1,
        "digit": lambda unit, radix: int(_text_of(unit), radix) if _text_of(unit).isalnum() else -1,
        "valueOf": lambda unit: unit,
        "toString": _text_of,
        "hashCode": ord,
        "compare": compare,
    },
    MIN_VALUE=Char("\0"),
    MAX_VALUE=Char("\uffff"),
)
