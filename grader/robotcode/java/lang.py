"""java.lang without texts: Math, the boxes of numbers, System, Thread and Object."""

import functools
import math
from collections.abc import Callable
from sys import float_info
from typing import Any

from grader.robotcode.java.values import (
    NAMES,
    ArithmeticException,
    JavaClass,
    cast,
    compare,
    equals,
    make_statics,
    make_unknown,
    propagate,
    require_number,
    to_string,
)
from grader.robotcode.library import timing
from grader.robotcode.library.base import JAVA, Unknown, add_named_classes
from grader.robotcode.library.world import WORLD

_LANG = "java.lang"
MILLISECONDS, NANOSECONDS = 1e3, 1e9  # in a second
START = 1_767_225_600_000  # [ms] from 1970 to 2026, when every program starts


class Exited(BaseException):
    """The program called System.exit."""


def _limit_to_reals(function: Callable[..., float]) -> Callable[..., Any]:
    """A function of doubles that answers as Java does where Python raises an error."""

    @functools.wraps(function)
    def run(*args: Any) -> Any:
        try:
            return float(function(*(float(require_number(one)) for one in args)))
        except ValueError:
            return math.nan
        except OverflowError:
            return math.inf

    return run


def _round_with(change: Callable[[float], int]) -> Callable[[float], float]:
    """A rounding to a double, which keeps signs, infinities and nan."""
    return lambda x: math.copysign(change(x), x) if math.isfinite(x) else x


def _make_min_or_max(pick: Callable[..., Any]) -> Callable[[Any, Any], Any]:
    def run(a: Any, b: Any) -> Any:
        found = pick(require_number(a), require_number(b))
        return found if type(a) is type(b) else float(found)

    return run


def _round_down(operate: Callable[[int, int], int]) -> Callable[[Any, Any], Any]:
    def run(a: Any, b: Any) -> Any:
        if b == 0:
            raise ArithmeticException("/ by zero")
        return operate(a, b)

    return run


_larger, _smaller = _make_min_or_max(max), _make_min_or_max(min)
_SAME = "sin cos tan asin acos atan sinh cosh tanh atan2 sqrt cbrt exp log10 pow"
_REALS: dict[str, Callable[..., float]] = {
    **{name: getattr(math, name) for name in _SAME.split()},
    "hypot": lambda x, y: math.hypot(x, y),
    "log": lambda x: math.log(x),
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
        **{name: _limit_to_reals(function) for name, function in _REALS.items()},
        "abs": lambda x: abs(require_number(x)),
        "max": _larger,
        "min": _smaller,
        "clamp": lambda x, low, high: _larger(low, _smaller(high, x)),
        "round": lambda x: cast("long", math.floor(x + 0.5) if math.isfinite(x) else x),
        "floorMod": _round_down(lambda a, b: a % b),
        "floorDiv": _round_down(lambda a, b: a // b),
    },
    others="random addExact subtractExact multiplyExact negateExact incrementExact decrementExact "
    "toIntExact IEEEremainder nextUp nextDown fma getExponent scalb absExact ceilDiv ceilMod ulp "
    "expm1 log1p",
    PI=math.pi,
    E=math.e,
)
JAVA[f"{_LANG}.StrictMath"] = JAVA[f"{_LANG}.Math"]
_REAL_TESTS: dict[str, Callable[..., bool]] = {
    "isNaN": math.isnan,
    "isInfinite": math.isinf,
    "isFinite": math.isfinite,
}


def _make_box(kind: str, name: str, **constants: Any) -> None:
    """The class of a boxed number: its static methods, and a constructor."""

    def value_of(source: Any) -> Any:
        return Unknown(f"{name}.valueOf()") if isinstance(source, str) else cast(kind, source)

    make_statics(
        f"{_LANG}.{name}",
        {
            "valueOf": value_of,
            "compare": compare,
            "max": _larger,
            "min": _smaller,
            "toString": to_string,
            **(_REAL_TESTS if kind in {"double", "float"} else {}),
        },
        partial=True,
        __new__=lambda _cls, source: value_of(source),
        **constants,
    )


for _name, _bits in {"int": 32, "long": 64, "short": 16, "byte": 8}.items():
    _limits = {"MIN_VALUE": -(1 << (_bits - 1)), "MAX_VALUE": (1 << (_bits - 1)) - 1}
    _make_box(_name, "Integer" if _name == "int" else _name.title(), **_limits)
for _name in ("Double", "Float"):
    _edges = {"MAX_VALUE": float_info.max, "NaN": math.nan}
    _edges |= {"POSITIVE_INFINITY": math.inf, "NEGATIVE_INFINITY": -math.inf}
    _make_box(_name.lower(), _name, **_edges)
make_statics(
    f"{_LANG}.Boolean",
    {"toString": to_string, "compare": compare},
    partial=True,
    TRUE=True,
    FALSE=False,
)


BOXED_METHODS: dict[str, Callable[..., Any]] = {
    **{
        f"{kind}Value": functools.partial(cast, kind)
        for kind in ("int", "long", "double", "float", "short", "byte")
    },
    **{name: test for name, test in _REAL_TESTS.items() if name != "isFinite"},
    "booleanValue": lambda value: value,
    "equals": equals,
    "compareTo": compare,
    "toString": to_string,
    "hashCode": make_unknown("hashCode()"),
    "getClass": make_unknown("getClass()"),
}
BOXED_METHODS = {name: propagate(method) for name, method in BOXED_METHODS.items()}


class Object(JavaClass, package=_LANG, others="notify notifyAll wait finalize toString getClass"):
    """Base of everything, and what ``new Object()`` makes."""

    equals = lambda self, other: self is other
    hashCode = lambda self: id(self)


add_named_classes(NAMES["markers"], JavaClass)


class PrintStream(JavaClass, package="java.io", partial=True):
    """System.out and System.err, whose output is dropped."""

    print = println = printf = format = lambda self, *_args: None


def _exit_program(_status: int) -> None:
    raise Exited


make_statics(
    f"{_LANG}.System",
    {
        "currentTimeMillis": lambda: START + int(WORLD.time * MILLISECONDS),
        "nanoTime": lambda: int(WORLD.time * NANOSECONDS),
        "exit": _exit_program,
        "arraycopy": lambda _source, _from, to, *_how: to.__setitem__(
            slice(None), [Unknown("a copied element")] * len(to)
        ),
    },
    partial=True,
    out=PrintStream(),
    err=PrintStream(),
)


class Thread(JavaClass, package=_LANG, partial=True):
    """A thread, which never runs here; where the robot's own sleeps, its loop has to wait."""

    sleep = staticmethod(lambda millis, *_nanos: timing.wait(millis / MILLISECONDS))
