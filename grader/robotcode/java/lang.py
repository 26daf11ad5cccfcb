"""java.lang without texts: Math, the boxes of numbers, System, Thread, Object and Class."""

import contextlib
import enum
import functools
import math
import re
import struct
from collections.abc import Callable
from fractions import Fraction
from sys import float_info
from typing import Any

from grader.robotcode.java import text
from grader.robotcode.java.collections import Random
from grader.robotcode.java.values import (
    FINISH,
    ArithmeticException,
    Array,
    ArrayIndexOutOfBoundsException,
    Byte,
    Float,
    IllegalArgumentException,
    JavaClass,
    Long,
    NullPointerException,
    NumberFormatException,
    Output,
    Short,
    add,
    cast,
    compare,
    equals,
    full_name,
    hash_code,
    identity_hash,
    is_text,
    make_statics,
    negate,
    promote,
    propagate,
    to_string,
    wrap,
)
from grader.robotcode.library.base import JAVA, FakeType
from grader.robotcode.library.world import WORLD

_LANG = "java.lang"
WHOLE_KINDS = frozenset({"", "int", "short", "byte", "char"})  # what a list takes for an index
MILLISECONDS, NANOSECONDS = 1e3, 1e9  # in a second
START = 1_767_225_600_000  # [ms] from 1970 to 2026, when every program starts
LONGEST_SLEEP = 10.0  # [s] after which a thread that sleeps again and again is stopped


class Exited(BaseException):
    """The program called System.exit."""


class _ThreadStopped(BaseException):
    """A thread that would never end."""


def _real(function: Callable[..., float]) -> Callable[..., float]:
    """A function of doubles that answers as Java does where Python raises an error."""

    @functools.wraps(function)
    def run(*args: Any) -> float:
        try:
            return float(function(*map(_to_double, args)))
        except ValueError:
            return math.nan
        except OverflowError:
            return math.inf

    run.__annotations__ = {"return": float}
    return run


def _to_double(value: Any) -> float:
    return float(promote(value, 0.0)[1])


def _log(function: Callable[[float], float], pole: float) -> Callable[[float], float]:
    return lambda x: -math.inf if x == pole else function(x)


def _round_with(change: Callable[[float], int]) -> Callable[[float], float]:
    """A rounding to a double, which keeps its sign and what is not finite."""
    return lambda x: math.copysign(change(x), x) if math.isfinite(x) else x


def _power(base: float, exponent: float) -> float:
    odd = math.isfinite(exponent) and exponent % 2 == 1
    if math.isnan(exponent) or (abs(base) == 1 and math.isinf(exponent)):
        return math.nan
    if base == 0 and exponent < 0:
        return math.copysign(math.inf, base) if odd else math.inf
    try:
        return math.pow(base, exponent)
    except OverflowError:
        return -math.inf if base < 0 and odd else math.inf


def _round(value: Any) -> Any:
    """Java's Math.round: half up, of a double to a long, else to an int."""
    kind, real = "long" if type(value) is float else "int", _to_double(value)
    if not math.isfinite(real):
        return cast(kind, real)
    whole = math.floor(real)
    return (
        cast(kind, float(whole))
        if abs(real) >= 2**52
        else _MAKE[kind](whole + (2 * (real - whole) >= 1))
    )


_MAKE = {"int": lambda value: max(-(2**31), min(2**31 - 1, value)), "long": Long}


def _choose(pick: Callable[..., Any]) -> Callable[[Any, Any], Any]:
    def run(a: Any, b: Any) -> Any:
        rank, a, b = promote(a, b)
        if a != a or b != b:  # noqa: PLR0124 - not a number
            return FINISH[rank](math.nan)
        return FINISH[rank](pick(a, b, key=lambda one: (one, math.copysign(1, one))))

    return run


def _exact(operate: Callable[..., int]) -> Callable[..., Any]:
    """Arithmetic on whole numbers that refuses to wrap around."""

    def run(a: Any, b: Any) -> Any:
        rank, a, b = promote(a, b)
        result = operate(a, b)
        if FINISH[rank](result) != result:
            raise ArithmeticException(f"{'long' if rank else 'integer'} overflow")
        return FINISH[rank](result)

    return run


def _floor(operate: Callable[[int, int], int]) -> Callable[[Any, Any], Any]:
    def run(a: Any, b: Any) -> Any:
        rank, a, b = promote(a, b)
        if b == 0:
            raise ArithmeticException("/ by zero")
        return FINISH[rank](operate(a, b))

    return run


def _to_int(value: int) -> int:
    if wrap(value) != value:
        raise ArithmeticException("integer overflow")
    return int(value)


_larger, _smaller = _choose(max), _choose(min)
_SAME = "sin cos tan asin acos atan cosh tanh atan2 sqrt exp expm1 ulp".split()  # noqa: SIM905
_REALS: dict[str, Callable[..., float]] = {
    **{name: getattr(math, name) for name in _SAME},
    "cbrt": lambda x: float(round(math.cbrt(x))) if round(math.cbrt(x)) ** 3 == x else math.cbrt(x),
    "hypot": lambda x, y: math.hypot(x, y),
    "fma": lambda x, y, z: float(Fraction(x) * Fraction(y) + Fraction(z)),
    "sinh": lambda x: math.copysign(_real(math.sinh)(abs(x)), x),
    "log": _log(math.log, 0),
    "log10": _log(math.log10, 0),
    "log1p": _log(math.log1p, -1),
    "pow": _power,
    "ceil": _round_with(math.ceil),
    "floor": _round_with(math.floor),
    "rint": _round_with(round),
    "toRadians": math.radians,
    "toDegrees": math.degrees,
    "IEEEremainder": math.remainder,
    "copySign": math.copysign,
    "signum": lambda x: math.copysign(1, x) if x else x,
    "nextUp": lambda x: math.nextafter(x, math.inf),
    "nextDown": lambda x: math.nextafter(x, -math.inf),
}
for _name in ("Math", "StrictMath"):
    make_statics(
        f"{_LANG}.{_name}",
        {
            **{name: _real(function) for name, function in _REALS.items()},
            "abs": lambda x: _larger(x, negate(x)) if x or isinstance(x, float) else x,
            "max": _larger,
            "min": _smaller,
            "clamp": lambda x, low, high: cast(
                "int" if type(low) is type(high) is int else "double",
                _larger(low, _smaller(high, x)),
            ),
            "round": _round,
            "floorMod": _floor(lambda a, b: a % b),
            "floorDiv": _floor(lambda a, b: a // b),
            "addExact": _exact(lambda a, b: a + b),
            "subtractExact": _exact(lambda a, b: a - b),
            "multiplyExact": _exact(lambda a, b: a * b),
            "negateExact": lambda a: _exact(lambda a, _: -a)(a, a),
            "incrementExact": lambda a: _exact(lambda a, b: a + b)(a, 1),
            "decrementExact": lambda a: _exact(lambda a, b: a - b)(a, 1),
            "toIntExact": _to_int,
            "random": lambda: WORLD.singletons.setdefault("Math.random", Random()).nextDouble(),
        },
        PI=math.pi,
        E=math.e,
    )

_REAL_TEXT = re.compile(r"[+-]?(NaN|Infinity|(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?[dDfF]?)")


def _parse_real(source: Any) -> float:
    if source is None:
        raise NullPointerException
    trimmed = source.strip()
    if not _REAL_TEXT.fullmatch(trimmed):
        raise NumberFormatException(f'For input string: "{source}"' if trimmed else "empty String")
    return float(trimmed if trimmed[-1] in "Ny" else trimmed.rstrip("dDfF"))


def _parse_whole(bits: int) -> Callable[..., int]:
    def run(source: Any, radix: int = 10) -> int:
        if source is None:
            raise NumberFormatException("Cannot parse null string")
        wrong = f'For input string: "{source}"' + (f" under radix {radix}" if radix != 10 else "")  # noqa: PLR2004
        try:
            value = (
                int(source, radix)
                if re.fullmatch(r"[+-]?\w+", source) and "_" not in source
                else None
            )
        except ValueError:
            value = None
        if value is None or wrap(value, bits) != value:
            raise NumberFormatException(wrong)
        return value

    return run


def _to_radix(value: int, radix: int = 10) -> str:
    digits, size, radix = "", abs(value), radix if radix in range(2, 37) else 10
    while size or not digits:
        size, digit = divmod(size, radix)
        digits = "0123456789abcdefghijklmnopqrstuvwxyz"[digit] + digits
    return "-" * (value < 0) + digits


def _unsigned(letter: str) -> Callable[[int], str]:
    return lambda value: f"{value & ((1 << getattr(type(value), 'bits', 32)) - 1):{letter}}"


_REAL_TESTS: dict[str, Callable[..., bool]] = {
    "isNaN": math.isnan,
    "isInfinite": math.isinf,
    "isFinite": math.isfinite,
}
_WHOLE_STATICS: dict[str, Callable[..., Any]] = {
    "toString": _to_radix,
    "toBinaryString": _unsigned("b"),
    "toHexString": _unsigned("x"),
    "toOctalString": _unsigned("o"),
    "bitCount": lambda value: _unsigned("b")(value).count("1"),
    "toUnsignedInt": lambda value: value & ((1 << type(value).bits) - 1),
    "toUnsignedString": lambda value: str(int(_unsigned("b")(value), 2)),
    "signum": lambda value: (value > 0) - (value < 0),
}
_REAL_STATICS: dict[str, Callable[..., Any]] = {
    **_REAL_TESTS,
    "doubleToLongBits": lambda value: Long(struct.unpack(">q", struct.pack(">d", value))[0]),
    "longBitsToDouble": lambda bits: struct.unpack(">d", struct.pack(">q", bits))[0],
    "intBitsToFloat": lambda bits: Float(struct.unpack(">f", struct.pack(">i", bits))[0]),
    "floatToIntBits": lambda value: struct.unpack(">i", struct.pack(">f", value))[0],
}
_EDGES = {
    "Double": (float, float_info.max, 5e-324),
    "Float": (Float, 3.4028234663852886e38, 1.401298464324817e-45),
}


def _make_box(kind: str, name: str, parse: Callable[..., Any], **constants: Any) -> type:
    """The class of a boxed number: its static methods, and a constructor."""
    real = parse is _parse_real

    def as_kind(method: Callable[..., Any]) -> Callable[..., Any]:
        return lambda *args: method(*(cast(kind, one) for one in args))

    def read(source: Any, *radix: int) -> Any:
        return cast(kind, parse(source, *radix) if is_text(source) or source is None else source)

    return make_statics(
        f"{_LANG}.{name}",
        {
            f"parse{kind.title()}": read,
            "valueOf": read,
            "compare": as_kind(compare),
            "hashCode": as_kind(hash_code),
            "max": as_kind(_larger),
            "min": as_kind(_smaller),
            "sum": as_kind(add),
            **(_REAL_STATICS | {"toString": as_kind(to_string)} if real else _WHOLE_STATICS),
        },
        __new__=lambda _cls, source: read(source),
        **constants,
    )


for _name, _made in {"int": int, "long": Long, "short": Short, "byte": Byte}.items():
    _bits = getattr(_made, "bits", 32)
    _edge = 1 << (_bits - 1)
    _limits = {"MIN_VALUE": _made(-_edge), "MAX_VALUE": _made(_edge - 1), "SIZE": _bits}
    _title = "Integer" if _made is int else _made.__name__
    _make_box(_name, _title, _parse_whole(_bits), **_limits)
for _title, (_made, _most, _least) in _EDGES.items():
    _limits = {"MAX_VALUE": _made(_most), "MIN_VALUE": _made(_least), "NaN": _made(math.nan)}
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
        "hashCode": hash_code,
        "logicalAnd": lambda a, b: a and b,
        "logicalOr": lambda a, b: a or b,
        "logicalXor": lambda a, b: a != b,
    },
    TRUE=True,
    FALSE=False,
)


class Class(JavaClass, package=_LANG):
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
    """The only Class of a class, or of the name of a type that is none, such as ``int``."""
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
    hashCode = lambda self: identity_hash(self)
    toString = lambda self: f"{full_name(type(self))}@{hash_code(self) & 0xFFFFFFFF:x}"
    getClass = lambda self: class_of(self)


_MARKERS = ("Comparable", "Cloneable", "AutoCloseable", "CharSequence", "Record", "Number", "Void")
for _name in _MARKERS:
    FakeType(_name, (JavaClass,), {}, package=_LANG)
FakeType("Serializable", (JavaClass,), {}, package="java.io")


class PrintStream(Output, package="java.io"):
    """System.out and System.err."""

    printf = format = lambda self, *args: self.print(text.format(args[0], args[1:]))


def _copy_array(source: Array, start: int, target: Array, place: int, count: int) -> None:
    for array, first, which in ((source, start, "source"), (target, place, "destination")):
        if count < 0 or first < 0 or first + count > len(array):
            raise ArrayIndexOutOfBoundsException(
                f"arraycopy: last {which} index {first + count} out of bounds for "
                f"{array.kind}[{len(array)}]"
            )
    target[place : place + count] = source[start : start + count]


def _exit(_status: int) -> None:
    raise Exited


System = make_statics(
    f"{_LANG}.System",
    {
        "currentTimeMillis": lambda: Long(START + int(WORLD.time * MILLISECONDS)),
        "nanoTime": lambda: Long(int(WORLD.time * NANOSECONDS)),
        "identityHashCode": identity_hash,
        "getProperty": lambda _key, other=None: other,
        "getenv": lambda _key=None: None,
        "lineSeparator": lambda: "\n",
        "arraycopy": _copy_array,
        "exit": _exit,
        "gc": lambda: None,
    },
    out=PrintStream(),
    err=PrintStream(silent=True),
)


class Thread(JavaClass, package=_LANG, others="join interrupt setDaemon setName setPriority getId"):
    """A thread: it runs once, whole, in the next loop, and its sleeping takes no time."""

    def __init__(self, target: Any = None, name: str = "Thread-0") -> None:
        self._target = None if is_text(target) else target
        self._name = target if is_text(target) else name
        self._slept = 0.0

    def run(self) -> None:
        """What it does: call what it was made with."""
        if self._target is not None:
            self._target()

    def start(self) -> None:
        """Let it run in the next loop."""
        WORLD.each_loop.append(self._run_once)

    def _run_once(self) -> None:
        WORLD.each_loop.remove(self._run_once)
        WORLD.singletons["thread"] = self
        with contextlib.suppress(_ThreadStopped):
            self.run()
        del WORLD.singletons["thread"]

    @staticmethod
    def sleep(millis: int, nanos: int = 0) -> None:
        """Wait: this keeps the robot's loop waiting, but not where another thread does it."""
        seconds, thread = millis / MILLISECONDS + nanos / NANOSECONDS, Thread.currentThread()
        if seconds < 0:
            raise IllegalArgumentException("timeout value is negative")
        thread._slept += seconds
        if thread is not WORLD.singletons.get("thread"):
            WORLD.blocked += seconds
            WORLD.time += seconds
        elif thread._slept > LONGEST_SLEEP:
            raise _ThreadStopped

    __call__ = lambda self: self.run()
    currentThread = staticmethod(lambda: WORLD.singletons.get("thread") or Thread(None, "main"))
    interrupted = staticmethod(lambda: False)
    getName = lambda self: self._name
    isAlive = lambda self: self._run_once in WORLD.each_loop
    isInterrupted = isDaemon = lambda self: False
