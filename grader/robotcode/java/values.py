"""Java's values in Python: numbers of a width, characters, arrays, exceptions and operators.

int is ``int``, double ``float``, boolean ``bool``, String ``str`` and null None; the others have
classes of their own here. A boxed number is the number: two Integers are ``==`` if they are equal.
"""

import enum
import functools
import math
import operator
from collections.abc import Callable, Iterable
from ctypes import c_float
from decimal import Decimal
from types import NoneType
from typing import Any, Self

from grader.robotcode.java.steps import STATE
from grader.robotcode.library.base import (
    JAVA,
    Fake,
    FakeType,
    Unknown,
    WrongArgument,
    describe,
    fake,
)

_LANG = "java.lang"
MIN_INT, MAX_INT = -(2**31), 2**31 - 1
CHARACTERS = 5_000  # of a text, that cost as much time as a step
LONGEST_TEXT = 1_000_000  # [characters] of one text
PLAIN_FROM, PLAIN_BELOW = 1e-3, 1e7  # a double between them is written without an exponent


def wrap(value: int, bits: int = 32) -> int:
    """A whole number as that many bits hold it, in two's complement."""
    half = 1 << (bits - 1)
    return ((value + half) & ((1 << bits) - 1)) - half


class _SizedInteger(int):
    """A whole number that wraps around at its width."""

    bits = 0

    def __new__(cls, value: int = 0) -> Self:
        return super().__new__(cls, wrap(value, cls.bits))


class Long(_SizedInteger):
    """Java's long."""

    bits = 64


class Short(_SizedInteger):
    """Java's short."""

    bits = 16


class Byte(_SizedInteger):
    """Java's byte."""

    bits = 8


class Float(float):
    """Java's float: a double rounded to 24 binary digits."""

    def __new__(cls, value: float = 0.0) -> Self:
        """The nearest float."""
        return super().__new__(cls, c_float(value).value)


class Char(str):
    """Java's char: one UTF-16 unit. It never equals a text."""

    __slots__ = ()

    def __eq__(self, other: object) -> bool:
        return type(other) is Char and str.__eq__(self, other)

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __hash__(self) -> int:
        return hash((Char, ord(self)))


class Array(list[Any]):
    """Java's array. Its equality in Java is its identity.

    Args:
        items: its elements.
        kind: type of an element, as ``int``, ``String`` or ``int[]``.
    """

    def __init__(self, items: Iterable[Any] = (), kind: str = "Object") -> None:
        super().__init__(items)
        self.kind = kind

    @property
    def length(self) -> int:
        """Number of elements."""
        return len(self)

    def clone(self) -> "Array":
        """A copy with the same elements."""
        return Array(self, self.kind)


_DEFAULTS = {"int": 0, "long": Long(), "short": Short(), "byte": Byte(), "char": Char("\0")}
_DEFAULTS |= {"double": 0.0, "float": Float(), "boolean": False}
PRIMITIVES = frozenset(_DEFAULTS)
_BOXES = {"int": "Integer", "char": "Character"}  # the others are the same with a capital
# Type of Python of every primitive kind and of its box.
TYPES = {kind: type(value) for kind, value in _DEFAULTS.items()}
KINDS: dict[type, str] = {cls: kind for kind, cls in TYPES.items()}
BOXES = {_BOXES.get(kind, kind.title()): kind for kind in _DEFAULTS}  # Integer: int
TYPES |= {box: TYPES[kind] for box, kind in BOXES.items()}
BOX_NAMES = {TYPES[name]: f"java.lang.{name}" for name in BOXES}
BOX_NAMES[str] = "java.lang.String"
_ARRAY_CODES = {"int": "I", "long": "J", "boolean": "Z"}  # the others begin with their letter
_RANKS = {int: 0, Short: 0, Byte: 0, Char: 0, Long: 1, Float: 2, float: 3}
_PLAIN = frozenset((int, float))
_REAL_RANK = 2  # from here on a number has a fraction
FINISH: tuple[Callable[[Any], Any], ...] = (wrap, Long, Float, float)  # by rank
_MAKERS: dict[str, Callable[[Any], Any]] = {
    **TYPES,
    "int": wrap,
    "char": lambda code: Char(chr(code & 0xFFFF)),
}


def default_value(kind: str) -> Any:
    """What a field or an element of that type is before anything is stored in it."""
    return _DEFAULTS.get(kind)


def spread(args: Iterable[Any], *, primitive: bool = False) -> list[Any]:
    """The arguments of ``T...``: an array of objects stands for its elements.

    Args:
        args: what the method is called with.
        primitive: whether an array of primitives does so as well, as for ``int...``.
    """
    items = list(args)
    array = len(items) == 1 and type(items[0]) is Array
    array = array and (primitive or items[0].kind not in _DEFAULTS)
    return list(items[0]) if array else items


def full_name(cls: type) -> str:
    """Name of a class with its package, as Java writes it in an exception."""
    known = BOX_NAMES.get(cls) or getattr(vars(cls).get("java"), "full_name", "")
    known = known or next((name for name, one in JAVA.items() if one is cls), "")
    package = vars(cls).get("java_package", "")
    return known or f"{package}.{vars(cls).get('java_name', cls.__name__)}".lstrip(".")


class JavaClass(Fake):
    """Base of the classes of Java's library. Java finds one by its package and its name."""

    def __init_subclass__(
        cls, package: str = "", name: str = "", others: str = "", *, partial: bool = False
    ) -> None:
        for key, one in vars(cls).items():
            method = one.__func__ if isinstance(one, staticmethod | classmethod) else one
            if getattr(method, "__name__", "") == "<lambda>":
                method.__qualname__ = f"{cls.__name__}.{key}"
        cls.java_package, cls.java_name = package, name or cls.__name__
        for place in package.split():
            cls.fake_complete = False
            fake(place, complete=not partial, others=others, name=name)(cls)


class Throwable(JavaClass, Exception, package=_LANG, others="setStackTrace"):
    """java.lang.Throwable: message, cause and what was suppressed; no stack trace."""

    def __init__(self, message: object = None, cause: object = None, *_options: bool) -> None:
        if isinstance(message, BaseException) and cause is None:
            message, cause = to_string(message), message
        super().__init__(message)
        self._message = message if message is None else to_string(message)
        self._cause = cause
        self._suppressed: list[Any] = []

    getMessage = lambda self: self._message
    getLocalizedMessage = lambda self: self.getMessage()
    getCause = lambda self: self._cause
    initCause = lambda self, cause: (self, self.__dict__.update(_cause=cause))[0]
    addSuppressed = lambda self, error: self._suppressed.append(error)
    getSuppressed = lambda self: Array(self._suppressed, "Throwable")
    getStackTrace = lambda self: Array((), "StackTraceElement")
    fillInStackTrace = lambda self: self
    printStackTrace = lambda self, *_to: None

    def toString(self) -> str:
        """Class and message."""
        message, name = self.getLocalizedMessage(), full_name(type(self))
        return name if message is None else f"{name}: {to_string(message)}"

    __str__ = toString


class JavaException(Throwable, package=_LANG, name="Exception"):
    """java.lang.Exception."""


class JavaError(Throwable, package=_LANG, name="Error"):
    """java.lang.Error."""


class RuntimeException(JavaException, package=_LANG):
    """Java's exception that no method has to declare."""


class IllegalArgumentException(RuntimeException, package=_LANG):
    """An argument with a value that is not allowed."""


class IllegalStateException(RuntimeException, package=_LANG):
    """A call at the wrong time."""


class NullPointerException(RuntimeException, package=_LANG):
    """null where an object is needed."""


class ArithmeticException(RuntimeException, package=_LANG):
    """A division of whole numbers by zero."""


class ClassCastException(RuntimeException, package=_LANG):
    """A cast to a class that the object does not have."""


class ArrayStoreException(RuntimeException, package=_LANG):
    """An element of the wrong class for an array."""


class IndexOutOfBoundsException(RuntimeException, package=_LANG):
    """An index that is not there."""


class ArrayIndexOutOfBoundsException(IndexOutOfBoundsException, package=_LANG):
    """Java's exception for an array's index out of bounds."""


class StringIndexOutOfBoundsException(IndexOutOfBoundsException, package=_LANG):
    """Java's exception for a text's index out of bounds."""


class NegativeArraySizeException(RuntimeException, package=_LANG):
    """An array with less than no elements."""


class NumberFormatException(IllegalArgumentException, package=_LANG):
    """A text that is no number."""


class UnsupportedOperationException(RuntimeException, package=_LANG):
    """A change of what cannot be changed."""


class ConcurrentModificationException(RuntimeException, package="java.util"):
    """A collection changed while it is gone through."""


class NoSuchElementException(RuntimeException, package="java.util"):
    """There is no such element."""


class InterruptedException(JavaException, package=_LANG):
    """A thread was woken."""


class TimeoutException(JavaException, package="java.util.concurrent"):
    """Something took too long."""


class IOException(JavaException, package="java.io"):
    """Reading or writing failed."""


class StackOverflowError(JavaError, package=_LANG):
    """Calls that go too deep."""


class OutOfMemoryError(JavaError, package=_LANG):
    """More data than the memory holds."""


class AssertionError(JavaError, package=_LANG):
    """An assertion that does not hold."""


class ExceptionInInitializerError(JavaError, package=_LANG):
    """A static initializer failed."""


class NoClassDefFoundError(JavaError, package=_LANG):
    """A class whose static initializer has failed before."""


def find_method(value: Any, name: str) -> Any:
    """A method that the class of an object or one of its bases has; None if it has none."""
    return getattr(value, name) if _defines(type(value), name) else None  # type: ignore[arg-type]


@functools.lru_cache(maxsize=4096)
def _defines(cls: type, name: str) -> bool:
    return any(name in vars(base) for base in cls.__mro__)


def find_unknown(*values: object) -> Unknown | None:
    """The first of some values that nobody knows."""
    return next((one for one in values if type(one) is Unknown), None)


def propagate(function: Callable[..., Any]) -> Callable[..., Any]:
    """A function whose result is unknown if one of its arguments is."""

    @functools.wraps(function)
    def run(*args: object) -> Any:
        unknown = find_unknown(*args)
        return function(*args) if unknown is None else unknown

    return run


def make_statics(
    name: str, table: dict[str, Any], *, partial: bool = False, others: str = "", **constants: Any
) -> type:
    """A class of static methods that have no effect but their result.

    Args:
        name: of the class, with its package.
        table: the methods by their names.
        partial: whether it has other members, which nobody knows.
        others: the names of all those.
        constants: its other members.
    """
    package, _, simple = name.rpartition(".")
    methods = {key: staticmethod(propagate(one)) for key, one in table.items()}
    members = methods | constants
    return FakeType(simple, (JavaClass,), members, package=package, others=others, partial=partial)


def promote(a: Any, b: Any) -> tuple[int, Any, Any]:
    """Two numbers in the type that Java computes them in, and its rank: int, long, float, double.

    Raises:
        NullPointerException: one is null.
        WrongArgument: one is no number.
    """
    for one in (a, b):
        if one is None:
            raise NullPointerException("a number is needed here, and this is null")
        if type(one) not in _RANKS:
            raise WrongArgument(f"{describe(one)} is not a number")
    rank = max(_RANKS[type(a)], _RANKS[type(b)])
    a, b = (ord(one) if type(one) is Char else one for one in (a, b))
    return (rank, a, b) if rank < _REAL_RANK else (rank, FINISH[rank](a), FINISH[rank](b))


def _calculate(whole: Callable[..., Any], real: Callable[..., Any], a: Any, b: Any) -> Any:
    unknown = find_unknown(a, b)
    if unknown is not None:
        return unknown
    if type(a) is bool and type(b) is bool:
        return whole(a, b)
    rank, a, b = promote(a, b)
    result = (whole if rank < _REAL_RANK else real)(a, b)
    return result if type(result) is bool else FINISH[rank](result)


def _add_any(whole: Callable[..., Any], real: Callable[..., Any], a: Any, b: Any) -> Any:
    if find_unknown(a, b) is None and (is_text(a) or is_text(b)):
        return bound_text(to_string(a) + to_string(b))
    return _calculate(whole, real, a, b)


def _operator(
    whole: Callable[..., Any], real: Callable[..., Any], otherwise: Callable[..., Any] = _calculate
) -> Callable[[Any, Any], Any]:
    """An operator of Java's from those for two whole numbers and for two with fractions."""

    def operate(a: Any, b: Any) -> Any:
        kind = type(a)
        if kind is type(b):
            if kind is float:
                return real(a, b)
            if kind is int:
                result = whole(a, b)
                return result if MIN_INT <= result <= MAX_INT else wrap(result)
        elif kind in _PLAIN and type(b) in _PLAIN:
            return real(float(a), float(b))
        return otherwise(whole, real, a, b)

    return operate


def _divide_whole(a: int, b: int) -> int:
    if b == 0:
        raise ArithmeticException("/ by zero")
    quotient = abs(a) // abs(b)
    return quotient if (a < 0) == (b < 0) else -quotient


def _divide_real(a: float, b: float) -> float:
    if b != 0:
        return a / b
    return math.nan if a == 0 or math.isnan(a) else math.copysign(math.inf, a) * math.copysign(1, b)


def _remainder_whole(a: int, b: int) -> int:
    return a - b * _divide_whole(a, b)


def _remainder_real(a: float, b: float) -> float:
    return math.nan if b == 0 or math.isinf(a) else math.fmod(a, b)


def _refuse_fraction(a: float, b: float) -> float:
    raise WrongArgument(f"{to_string(a)} and {to_string(b)} are not both whole numbers")


add = _operator(operator.add, operator.add, _add_any)
subtract = _operator(operator.sub, operator.sub)
multiply = _operator(operator.mul, operator.mul)
divide = _operator(_divide_whole, _divide_real)
remainder = _operator(_remainder_whole, _remainder_real)
bit_and = _operator(operator.and_, _refuse_fraction)
bit_or = _operator(operator.or_, _refuse_fraction)
bit_xor = _operator(operator.xor, _refuse_fraction)
less = _operator(operator.lt, operator.lt)
less_equal = _operator(operator.le, operator.le)
greater = _operator(operator.gt, operator.gt)
greater_equal = _operator(operator.ge, operator.ge)


def negate(a: Any) -> Any:
    """Java's ``-a``."""
    return -a if type(a) is float else multiply(a, -1)


def complement(a: Any) -> Any:
    """Java's ``~a``."""
    return bit_xor(a, -1)


def _shift(operate: Callable[[int, int, int], int]) -> Callable[[Any, Any], Any]:
    def run(a: Any, distance: Any) -> Any:
        rank, whole, _ = promote(a, 0)
        bits = 64 if rank else 32
        return FINISH[rank](operate(whole, promote(distance, 0)[1] & (bits - 1), bits))

    return propagate(run)


shift_left = _shift(lambda a, distance, _: a << distance)
shift_right = _shift(lambda a, distance, _: a >> distance)
shift_unsigned = _shift(lambda a, distance, bits: (a & ((1 << bits) - 1)) >> distance)


def same(a: Any, b: Any) -> Any:
    """Java's ``==``: numbers by value, objects by identity, texts by their characters.

    Two texts made by ``new String`` would differ in Java; here they are the same.
    """
    unknown = find_unknown(a, b)
    if unknown is not None:
        return unknown
    if type(a) in _RANKS and type(b) in _RANKS:
        _, a, b = promote(a, b)
        return a == b
    return a is b or (type(a) is type(b) and type(a) in (str, bool) and a == b)


def differ(a: Any, b: Any) -> Any:
    """Java's ``!=``."""
    equal = same(a, b)
    return equal if isinstance(equal, Unknown) else not equal


def cast(kind: str, value: Any) -> Any:
    """Java's ``(kind) value`` for a primitive kind; for another kind the value as it is."""
    if kind not in _DEFAULTS or type(value) in (bool, Unknown):
        return value
    number = promote(value, 0)[1]
    if isinstance(number, float) and not kind.startswith(("double", "float")):
        edge = 1 << (63 if kind == "long" else 31)
        number = 0 if math.isnan(number) else int(max(-edge, min(edge - 1, number)))
    return _MAKERS[kind](number)


def convert(kind: str, value: Any) -> Any:
    """A value as a variable of that type holds it: widened or boxed, never made narrower.

    Raises:
        NullPointerException: null for a primitive.
        WrongArgument: Java would not compile it, as with a double for an int.
    """
    wanted = TYPES.get(kind)
    if wanted is None or type(value) is wanted or type(value) is Unknown:
        return value
    if value is None and kind[0].isupper():
        return None
    if type(value) is bool or wanted is bool or promote(value, 0)[0] > _RANKS[wanted]:
        raise WrongArgument(f"{describe(value)} is no {kind}: it needs a cast")
    return cast(KINDS[wanted], value)


def is_text(value: object) -> bool:
    """Whether a value is a String."""
    return isinstance(value, str) and type(value) is not Char


def bound_text(text: str) -> str:
    """A text, unless it is too long for the memory."""
    STATE.tick(len(text) // CHARACTERS)
    if len(text) > LONGEST_TEXT:
        raise OutOfMemoryError("Java heap space")
    return text


def decimal_text(value: float) -> str:
    """The shortest decimal number that reads back as that double or float."""
    if type(value) is not Float or not math.isfinite(value):
        return repr(float(value))
    texts = (f"{value:.{digits}g}" for digits in range(1, 10))
    return repr(float(next(text for text in texts if Float(float(text)) == value)))


def _write_real(value: float) -> str:
    if not math.isfinite(value):
        return "NaN" if math.isnan(value) else f"{'-' * (value < 0)}Infinity"
    text = decimal_text(value)
    if value == 0 or PLAIN_FROM <= abs(float(text)) < PLAIN_BELOW:
        return text
    shortest = f"{Decimal(text).normalize():E}"
    two_digits = shortest if "." in shortest else f"{value:.1E}"
    mantissa, _, exponent = two_digits.partition("E")
    return f"{mantissa}E{int(exponent)}"


_WRITERS: dict[type, Callable[[Any], Any]] = {
    **dict.fromkeys((int, Long, Short, Byte, Char), str),
    **dict.fromkeys((float, Float), _write_real),
    bool: lambda value: "true" if value else "false",
    NoneType: lambda _: "null",
    Unknown: lambda value: value,
}


def to_string(value: Any) -> Any:
    """Java's String.valueOf. Of what nobody knows, the text is unknown, too."""
    kind = type(value)
    if kind is str:
        return value
    if kind in _WRITERS:
        return _WRITERS[kind](value)
    STATE.tick()
    method = find_method(value, "toString")
    if method is not None:
        return method()
    if isinstance(value, enum.Enum):
        return value.name
    if kind in (list, tuple):
        return write_items(value)
    if kind is Array:
        element = value.kind
        named = f"L{element};" if element[0].isupper() else element[0].upper()
        return f"[{_ARRAY_CODES.get(element, named)}@{hash_code(value):x}"
    return f"{full_name(kind)}@{hash_code(value) & 0xFFFFFFFF:x}"


def join_texts(separator: str, texts: Iterable[str]) -> str:
    """Texts with a separator between, unless they are too long for the memory."""
    parts, length = [], 0
    for one in texts:
        length += len(one) + len(separator)
        if length > LONGEST_TEXT:
            raise OutOfMemoryError("Java heap space")
        parts.append(one)
    return separator.join(parts)


def write_items(items: Iterable[Any], start: str = "[", end: str = "]") -> str:
    """Items as Java writes a collection: ``[a, b]``. What is unknown in it is a question mark."""
    texts = ("?" if type(one) is Unknown else to_string(one) for one in items)
    return start + join_texts(", ", texts) + end


def equals(a: Any, b: Any) -> Any:
    """Java's Objects.equals."""
    unknown = find_unknown(a, b)
    if a is b or unknown is not None:
        return True if unknown is None else unknown
    if isinstance(a, float) and type(a) is type(b):
        return (a == b and math.copysign(1, a) == math.copysign(1, b)) or (a != a and b != b)  # noqa: PLR0124
    if type(a) in BOX_NAMES:
        return type(a) is type(b) and a == b
    STATE.tick()
    method = None if a is None or b is None else find_method(a, "equals")
    if method is not None:
        return method(b)
    plain = type(a) in (list, tuple) and type(b) in (list, tuple) and len(a) == len(b)
    return plain and all(map(equals, a, b))


def hash_items(hashes: Iterable[int], start: int = 0) -> int:
    """Java's hash of a sequence, from those of its elements."""
    return wrap(functools.reduce(lambda sofar, one: (31 * sofar + one) & 0xFFFFFFFF, hashes, start))


def hash_code(value: Any) -> int:
    """Java's hashCode, of a text and a whole number; for anything else some number of its own."""
    if isinstance(value, str):
        return hash_items(map(ord, value))
    if value is None or type(value) in BOX_NAMES:
        return wrap(hash(value))
    STATE.tick()
    method = find_method(value, "hashCode")
    return id(value) & MAX_INT if method is None else method()


def compare(a: Any, b: Any) -> Any:
    """Java's ``a.compareTo(b)``.

    Raises:
        ClassCastException: they have no order.
    """
    unknown = find_unknown(a, b)
    if unknown is not None:
        return unknown
    if a is None or b is None:
        raise NullPointerException
    if any(isinstance(a, one) and isinstance(b, one) for one in (float, int, str)):
        return (a > b) - (a < b)
    if isinstance(a, enum.Enum) and type(a) is type(b):
        return list(type(a)).index(a) - list(type(b)).index(b)
    method = find_method(a, "compareTo")
    if method is None:
        raise ClassCastException(
            f"class {full_name(type(a))} cannot be cast to class java.lang.Comparable"
        )
    return method(b)


class JavaEnum(JavaClass, package=_LANG, name="Enum"):
    """Base of a learner's enums. Each constant has ``_name`` and ``_ordinal``."""

    name = toString = __str__ = lambda self: self._name
    ordinal = lambda self: self._ordinal
    compareTo = lambda self, other: self._ordinal - other._ordinal
    equals = lambda self, other: self is other
    hashCode = lambda self: hash_code(self._name)
    getDeclaringClass = lambda self: JAVA["java.lang.Class"].of(
        type(self) if type(self).java.form == "enum" else type(self).__mro__[1]
    )
