"""java.lang without texts: Math, the boxes of numbers, System, Thread, Object and Class."""

import enum
import functools
import math
import re
from collections.abc import Callable
from sys import float_info
from typing import Any

from grader.robotcode.java.values import (
    FINISH,
    ArithmeticException,
    Array,
    ArrayIndexOutOfBoundsException,
    Byte,
    Float,
    JavaClass,
    Long,
    NullPointerException,
    NumberFormatException,
    Short,
    add,
    cast,
    compare,
    equals,
    full_name,
    hash_code,
    is_text,
    make_statics,
    negate,
    promote,
    propagate,
    to_string,
)
from grader.robotcode.library import timing
from grader.robotcode.library.base import JAVA, FakeType
from grader.robotcode.library.world import WORLD

_LANG = "java.lang"
WHOLE_KINDS = frozenset({"", "int", "short", "byte", "char"})  # what a list takes for an index
MILLISECONDS, NANOSECONDS = 1e3, 1e9  # in a second
START = 1_767_225_600_000  # [ms] from 1970 to 2026, when every program starts


class Exited(BaseException):
    """The program called System.exit."""


def _real(function: Callable[..., float]) -> Callable[..., float]:
    """A function of doubles that answers as Java does where Python raises an error."""

    @functools.wraps(function)
    def run(*args: Any) -> float:
        try:
            return float(function(*(float(promote(one, 0.0)[1]) for one in args)))
        except ValueError:
            return math.nan
        except OverflowError:
            return math.inf

    run.__annotations__ = {"return": float}
    return run


def _log(function: Callable[[float], float]) -> Callable[[float], float]:
    return lambda x: -math.inf if x == 0 else function(x)


def _round_with(change: Callable[[float], int]) -> Callable[[float], float]:
    """A rounding to a double, which keeps its sign and what is not finite."""
    return lambda x: math.copysign(change(x), x) if math.isfinite(x) else x


def _round(value: Any) -> Any:
    """Java's Math.round: half up, of a double to a long, else to an int."""
    kind, real = "long" if type(value) is float else "int", float(promote(value, 0.0)[1])
    return cast(kind, math.floor(real + 0.5) if abs(real) < 2**52 else real)


def _choose(pick: Callable[..., Any]) -> Callable[[Any, Any], Any]:
    def run(a: Any, b: Any) -> Any:
        rank, a, b = promote(a, b)
        if a != a or b != b:  # noqa: PLR0124 - not a number
            return FINISH[rank](math.nan)
        return FINISH[rank](pick(a, b, key=lambda one: (one, math.copysign(1, one))))

    return run


def _floor(operate: Callable[[int, int], int]) -> Callable[[Any, Any], Any]:
    def run(a: Any, b: Any) -> Any:
        rank, a, b = promote(a, b)
        if b == 0:
            raise ArithmeticException("/ by zero")
        return FINISH[rank](operate(a, b))

    return run


_larger, _smaller = _choose(max), _choose(min)
_SAME = "sin cos tan asin acos atan sinh cosh tanh atan2 sqrt cbrt exp expm1 log1p ulp pow"
_REALS: dict[str, Callable[..., float]] = {
    **{name: getattr(math, name) for name in _SAME.split()},
    "hypot": lambda x, y: math.hypot(x, y),
    "log": _log(math.log),
    "log10": _log(math.log10),
    "ceil": _round_with(math.ceil),
    "floor": _round_with(math.floor),
    "rint": _round_with(round),
    "toRadians": math.radians,
    "toDegrees": math.degrees,
    "copySign": math.copysign,
    "signum": lambda x: math.copysign(1, x) if x else x,
}
make_statics(
    f"{_LANG}.Math",
    {
        **{name: _real(function) for name, function in _REALS.items()},
        "abs": lambda x: _larger(x, negate(x)) if x or isinstance(x, float) else x,
        "max": _larger,
        "min": _smaller,
        "clamp": lambda x, low, high: cast(
            "int" if type(low) is type(high) is int else "double", _larger(low, _smaller(high, x))
        ),
        "round": _round,
        "floorMod": _floor(lambda a, b: a % b),
        "floorDiv": _floor(lambda a, b: a // b),
    },
    others="random addExact subtractExact multiplyExact negateExact incrementExact decrementExact "
    "toIntExact IEEEremainder nextUp nextDown fma getExponent scalb absExact ceilDiv ceilMod",
    PI=math.pi,
    E=math.e,
)
JAVA[f"{_LANG}.StrictMath"] = JAVA[f"{_LANG}.Math"]

_REAL_TEXT = re.compile(r"[+-]?(NaN|Infinity|(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?[dDfF]?)")


def _parse_real(source: Any) -> float:
    if source is None:
        raise NullPointerException
    trimmed = source.strip()
    if not _REAL_TEXT.fullmatch(trimmed):
        raise NumberFormatException(f'For input string: "{source}"' if trimmed else "empty String")
    return float(trimmed if trimmed[-1] in "Ny" else trimmed.rstrip("dDfF"))


def _parse_whole(source: Any) -> int:
    if source is None:
        raise NumberFormatException("Cannot parse null string")
    if not re.fullmatch(r"[+-]?\d{1,19}", source):
        raise NumberFormatException(f'For input string: "{source}"')
    return int(source)


_REAL_TESTS: dict[str, Callable[..., bool]] = {
    "isNaN": math.isnan,
    "isInfinite": math.isinf,
    "isFinite": math.isfinite,
}


def _make_box(kind: str, name: str, parse: Callable[..., Any], **constants: Any) -> type:
    """The class of a boxed number: its static methods, and a constructor."""

    def as_kind(method: Callable[..., Any]) -> Callable[..., Any]:
        return lambda *args: method(*(cast(kind, one) for one in args))

    def read(source: Any) -> Any:
        number = parse(source) if is_text(source) or source is None else source
        if parse is _parse_whole and cast(kind, number) != number:
            raise NumberFormatException(f'For input string: "{source}"')
        return cast(kind, number)

    return make_statics(
        f"{_LANG}.{name}",
        {
            f"parse{kind.title()}": read,
            "valueOf": read,
            "compare": as_kind(compare),
            "max": as_kind(_larger),
            "min": as_kind(_smaller),
            "sum": as_kind(add),
            "toString": as_kind(to_string),
            **(_REAL_TESTS if parse is _parse_real else {}),
        },
        partial=True,
        __new__=lambda _cls, source: read(source),
        **constants,
    )


for _name, _made in {"int": int, "long": Long, "short": Short, "byte": Byte}.items():
    _edge = 1 << (getattr(_made, "bits", 32) - 1)
    _limits = {"MIN_VALUE": _made(-_edge), "MAX_VALUE": _made(_edge - 1)}
    _make_box(_name, "Integer" if _made is int else _made.__name__, _parse_whole, **_limits)
for _title, _made, _most in (
    ("Double", float, float_info.max),
    ("Float", Float, 3.4028234663852886e38),
):
    _limits = {"MAX_VALUE": _made(_most), "NaN": _made(math.nan)}
    _limits |= {"POSITIVE_INFINITY": _made(math.inf), "NEGATIVE_INFINITY": _made(-math.inf)}
    _make_box(_title.lower(), _title, _parse_real, **_limits)


def _parse_boolean(source: Any) -> bool:
    return source if isinstance(source, bool) else source is not None and source.lower() == "true"


make_statics(
    f"{_LANG}.Boolean",
    {
        "parseBoolean": _parse_boolean,
        "valueOf": _parse_boolean,
        "toString": to_string,
        "compare": compare,
    },
    partial=True,
    TRUE=True,
    FALSE=False,
)


class Class(JavaClass, package=_LANG, partial=True):
    """What ``getClass()`` and ``X.class`` give: a class and its names."""

    def __init__(self, name: str, cls: Any = None) -> None:
        self._name, self._cls = name, cls

    of = staticmethod(lambda cls: class_named(full_name(cls), cls))
    getName = getTypeName = getCanonicalName = lambda self: self._name
    getSimpleName = lambda self: re.split(r"[.$]", self._name)[-1]
    getEnumConstants = lambda self: Array(
        self._cls if isinstance(self._cls, enum.EnumType) else self._cls.java.list_constants(),
        "Enum",
    )
    isInstance = lambda self, value: isinstance(value, self._cls)
    toString = lambda self: f"class {self._name}"


_CLASSES: dict[Any, Class] = {}


def class_named(name: str, cls: Any = None) -> Class:
    """Java's Class object of a class, or of a type like ``int``; each type has only one."""
    full = full_name(cls) if isinstance(cls, type) else name
    key = JAVA.get(full, cls if isinstance(cls, type) else name)
    return _CLASSES.setdefault(key, Class(full, cls))


def class_of(value: Any) -> Class:
    """Java's ``value.getClass()``."""
    return Class.of(type(value))


BOXED_METHODS: dict[str, Callable[..., Any]] = {
    **{
        f"{kind}Value": functools.partial(cast, kind)
        for kind in ("int", "long", "double", "float", "short", "byte")
    },
    **{name: test for name, test in _REAL_TESTS.items() if name != "isFinite"},
    "booleanValue": lambda value: value,
    "charValue": lambda value: value,
    "equals": equals,
    "compareTo": compare,
    "toString": to_string,
    "hashCode": hash_code,
    "getClass": class_of,
}
BOXED_METHODS = {name: propagate(method) for name, method in BOXED_METHODS.items()}


class Object(JavaClass, package=_LANG, others="notify notifyAll wait finalize"):
    """Base of everything, and what ``new Object()`` makes."""

    equals = lambda self, other: self is other
    hashCode = lambda self: id(self) & 0x7FFFFFFF
    toString = lambda self: f"{full_name(type(self))}@{hash_code(self) & 0xFFFFFFFF:x}"
    getClass = lambda self: class_of(self)


_MARKERS = ("Comparable", "Cloneable", "AutoCloseable", "CharSequence", "Record", "Number", "Void")
for _name in _MARKERS:
    FakeType(_name, (JavaClass,), {}, package=_LANG)
FakeType("Serializable", (JavaClass,), {}, package="java.io")


class PrintStream(JavaClass, package="java.io", partial=True):
    """System.out and System.err: nobody reads what a robot prints."""

    print = println = printf = format = lambda self, *_args: None


def _copy_array(source: Array, start: int, target: Array, place: int, count: int) -> None:
    for array, first in ((source, start), (target, place)):
        if count < 0 or first < 0 or first + count > len(array):
            raise ArrayIndexOutOfBoundsException(f"arraycopy: last index {first + count}")
    target[place : place + count] = source[start : start + count]


def _exit(_status: int) -> None:
    raise Exited


make_statics(
    f"{_LANG}.System",
    {
        "currentTimeMillis": lambda: Long(START + int(WORLD.time * MILLISECONDS)),
        "nanoTime": lambda: Long(int(WORLD.time * NANOSECONDS)),
        "getProperty": lambda _key, other=None: other,
        "getenv": lambda _key=None: None,
        "lineSeparator": lambda: "\n",
        "arraycopy": _copy_array,
        "exit": _exit,
        "gc": lambda: None,
    },
    partial=True,
    out=PrintStream(),
    err=PrintStream(),
)


class Thread(JavaClass, package=_LANG, partial=True):
    """A thread, which never runs here; where the robot's own sleeps, its loop has to wait."""

    sleep = staticmethod(lambda millis, *_nanos: timing.wait(millis / MILLISECONDS))
