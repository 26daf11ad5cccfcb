"""Java's values in Python: numbers, texts, arrays, exceptions and operators.

A whole number is ``int``, one with a fraction ``float``, boolean ``bool``, String and char ``str``,
null None; a boxed number is the number. No robot program counts on a number that wraps around at
its width, so none does here: what Java would compute then is unknown.
"""

import enum
import functools
import math
import operator
import tomllib
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from grader.robotcode.java.steps import STATE
from grader.robotcode.library.base import (
    JAVA,
    Fake,
    FakeType,
    Unknown,
    WrongArgument,
    add_named_classes,
    describe,
    fake,
)

_LANG = "java.lang"
NAMES = tomllib.loads(Path(__file__).with_name("names.toml").read_text("utf-8"))
CHARACTERS = 5_000  # of a text, that cost as much time as a step
LONGEST_TEXT = 1_000_000  # [characters] of one text
LARGEST = 1 << 63  # no whole number of Java's reaches it


class Array(list[Any]):
    """Java's array. Its equality in Java is its identity.

    Args:
        items: its elements.
        kind: type of an element, as ``int``, ``String`` or ``int[]``.
    """

    def __init__(self, items: Iterable[Any] = (), kind: str = "Object") -> None:
        super().__init__(items)
        self.kind = kind


_WHOLE, _REAL = ("int", "long", "short", "byte"), ("double", "float")
_DEFAULTS: dict[str, Any] = dict.fromkeys(_WHOLE, 0) | dict.fromkeys(_REAL, 0.0)
_DEFAULTS |= {"boolean": False, "char": "\0"}
PRIMITIVES = frozenset(_DEFAULTS)
_BOXES = {"int": "Integer", "char": "Character"}  # the others are the same with a capital
# Type of Python of every primitive kind and of its box.
TYPES = {kind: type(value) for kind, value in _DEFAULTS.items()}
KINDS: dict[type, str] = {int: "int", float: "double", bool: "boolean"}
BOXES = {_BOXES.get(kind, kind.title()): kind for kind in _DEFAULTS}  # Integer: int
TYPES |= {box: TYPES[kind] for box, kind in BOXES.items()}
BOX_NAMES = {int: "Integer", float: "Double", bool: "Boolean", str: "String"}
_NUMBERS = frozenset((int, float))
_NARROW = frozenset({"byte", "short", "char"})  # a cast to them may change a number


def default_value(kind: str) -> Any:
    """The initial value of a field or an array element of a type."""
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
    if cls in BOX_NAMES:
        return f"{_LANG}.{BOX_NAMES[cls]}"
    known = getattr(vars(cls).get("java"), "full_name", "")
    known = known or next((name for name, one in JAVA.items() if one is cls), "")
    package = vars(cls).get("java_package", "")
    return known or f"{package}.{vars(cls).get('java_name', cls.__name__)}".lstrip(".")


class JavaClass(Fake):
    """Base of the classes of Java's library. Java finds one by its package and its name."""

    def __init_subclass__(
        cls, package: str = "", name: str = "", others: str = "", *, partial: bool = False
    ) -> None:
        cls.java_package, cls.java_name = package, name or cls.__name__
        for place in package.split():
            cls.fake_complete = False
            fake(place, complete=not partial, others=others, name=name)(cls)


class Throwable(
    JavaClass,
    Exception,
    package=_LANG,
    others="setStackTrace initCause addSuppressed getSuppressed getStackTrace fillInStackTrace",
):
    """java.lang.Throwable: message and cause; no stack trace."""

    def __init__(self, message: object = None, cause: object = None, *_options: bool) -> None:
        if isinstance(message, BaseException) and cause is None:
            message, cause = to_string(message), message
        super().__init__(message)
        self._message = message if message is None else to_string(message)
        self._cause = cause

    getMessage = lambda self: self._message
    getLocalizedMessage = lambda self: self.getMessage()
    getCause = lambda self: self._cause
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


class NullPointerException(RuntimeException, package=_LANG):
    """null where an object is needed."""


class ArithmeticException(RuntimeException, package=_LANG):
    """A division of whole numbers by zero."""


class ClassCastException(RuntimeException, package=_LANG):
    """A cast to a class that the object does not have."""


class IndexOutOfBoundsException(RuntimeException, package=_LANG):
    """An index that is not there."""


class ArrayIndexOutOfBoundsException(IndexOutOfBoundsException, package=_LANG):
    """Java's exception for an array's index out of bounds."""


class StringIndexOutOfBoundsException(IndexOutOfBoundsException, package=_LANG):
    """Java's exception for a text's index out of bounds."""


class NoSuchElementException(RuntimeException, package="java.util"):
    """There is no such element."""


class StackOverflowError(JavaError, package=_LANG):
    """Calls that go too deep."""


class OutOfMemoryError(JavaError, package=_LANG):
    """More data than the memory holds."""


class ExceptionInInitializerError(JavaError, package=_LANG):
    """A static initializer failed."""


add_named_classes(NAMES["exceptions"])


def find_method(value: Any, name: str) -> Any:
    """A method that the class of an object or one of its bases has; None if it has none."""
    return getattr(value, name) if _defines_method(type(value), name) else None  # type: ignore[arg-type]


@functools.lru_cache(maxsize=4096)
def _defines_method(cls: type, name: str) -> bool:
    return any(name in vars(base) for base in cls.__mro__)


def make_unknown(text: str) -> Callable[..., Unknown]:
    """A method with an unknown result."""
    return lambda *_args: Unknown(text)


def find_unknown(*values: object) -> Unknown | None:
    """The first unknown value; None if all are known."""
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


def require_number(value: Any) -> Any:
    """A number, or an unknown value, such as a character's number.

    Raises:
        NullPointerException: it is null.
        WrongArgument: it is no number.
    """
    if value is None:
        raise NullPointerException("a number is needed here, and this is null")
    if isinstance(value, str) and len(value) == 1:
        return Unknown("the number of a character")
    if type(value) not in _NUMBERS:
        raise WrongArgument(f"{describe(value)} is not a number")
    return value


def _lift_operator(operate: Callable[[Any, Any], Any]) -> Callable[[Any, Any], Any]:
    """An operator of Java's for two numbers or two booleans."""

    def apply_to_java_values(a: Any, b: Any) -> Any:
        if type(a) not in _NUMBERS or type(b) not in _NUMBERS:
            unknown = find_unknown(a, b)
            if unknown is not None:
                return unknown
            if type(a) is bool and type(b) is bool:
                return operate(a, b)
            a, b = require_number(a), require_number(b)
        result = operate(a, b)
        wide = type(result) is int and not -LARGEST <= result < LARGEST
        return Unknown("a number beyond 64 bits") if wide else result

    return apply_to_java_values


def _lift_whole_operator(operate: Callable[[int, int], int]) -> Callable[[Any, Any], Any]:
    def apply_to_whole_numbers(a: Any, b: Any) -> Any:
        if type(a) is float or type(b) is float:
            raise WrongArgument(f"{a} and {b} are not both whole numbers")
        return operate(a, b)

    return _lift_operator(apply_to_whole_numbers)


def _divide(a: Any, b: Any) -> Any:
    if type(a) is int and type(b) is int:
        if b == 0:
            raise ArithmeticException("/ by zero")
        quotient = abs(a) // abs(b)
        return quotient if (a < 0) == (b < 0) else -quotient
    if b != 0:
        return a / b
    return math.nan if a == 0 or math.isnan(a) else math.copysign(math.inf, a) * math.copysign(1, b)


def _compute_remainder(a: Any, b: Any) -> Any:
    if type(a) is int and type(b) is int:
        return a - b * _divide(a, b)
    return math.nan if b == 0 or math.isinf(a) else math.fmod(a, b)


def check_range(value: Any) -> Any:
    """A sum of ints; unknown where it would wrap around in Java."""
    wraps = type(value) is int and not -(1 << 31) <= value < 1 << 31
    return Unknown("a number beyond 32 bits") if wraps else value


_add_numbers = _lift_operator(operator.add)
subtract = _lift_operator(operator.sub)
multiply = _lift_operator(operator.mul)
divide = _lift_operator(_divide)
remainder = _lift_operator(_compute_remainder)
bit_and = _lift_whole_operator(operator.and_)
bit_or = _lift_whole_operator(operator.or_)
bit_xor = _lift_whole_operator(operator.xor)
less = _lift_operator(operator.lt)
less_equal = _lift_operator(operator.le)
greater = _lift_operator(operator.gt)
greater_equal = _lift_operator(operator.ge)


def add(a: Any, b: Any) -> Any:
    """Java's ``a + b``, also of texts."""
    if (isinstance(a, str) or isinstance(b, str)) and find_unknown(a, b) is None:
        one, other = to_string(a), to_string(b)
        unknown = find_unknown(one, other)
        return bound_text(one + other) if unknown is None else unknown
    return _add_numbers(a, b)


def same(a: Any, b: Any) -> Any:
    """Java's ``==``: numbers by value, objects by identity, texts by their characters.

    Two texts made by ``new String`` would differ in Java; here they are the same.
    """
    unknown = find_unknown(a, b)
    if unknown is not None:
        return unknown
    if type(a) in _NUMBERS and type(b) in _NUMBERS:
        return a == b
    if type(a) in _NUMBERS or type(b) in _NUMBERS:  # boxed, or a character's number
        return Unknown("such a comparison") if isinstance(a, str) or isinstance(b, str) else False
    return a is b or (type(a) is type(b) and type(a) in (str, bool) and a == b)


def differ(a: Any, b: Any) -> Any:
    """Java's ``!=``."""
    equal = same(a, b)
    return equal if isinstance(equal, Unknown) else not equal


def cast(kind: str, value: Any) -> Any:
    """Java's ``(kind) value`` for a primitive kind; for another kind the value as it is."""
    if kind not in _DEFAULTS or type(value) in (bool, Unknown):
        return value
    if kind == "char" and isinstance(value, str):
        return value
    number = require_number(value)
    if kind in _NARROW or type(number) is Unknown:
        return Unknown(f"({kind})")
    if type(number) is int and kind in _WHOLE:
        return check_range(number) if kind == "int" else number
    if kind in _REAL:
        return float(number)
    edge = LARGEST if kind == "long" else 1 << 31
    return 0 if math.isnan(number) else int(max(-edge, min(edge - 1, number)))


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
    if wanted is float and type(value) is int:
        return float(value)
    if wanted is str and type(value) is int:
        return Unknown("the character of a number")
    if wanted is not bool and type(value) is not bool and type(value) not in _NUMBERS:
        return require_number(value)
    raise WrongArgument(f"{describe(value)} is no {kind}: it needs a cast")


def bound_text(text: str) -> str:
    """A text, unless it is too long for the memory."""
    STATE.tick(len(text) // CHARACTERS)
    if len(text) > LONGEST_TEXT:
        raise OutOfMemoryError("Java heap space")
    return text


_WORDS = {None: "null", True: "true", False: "false"}


def to_string(value: Any) -> Any:
    """Java's String.valueOf; the text of an unknown value is unknown."""
    if isinstance(value, str | Unknown):
        return value
    if value is None or type(value) is bool:
        return _WORDS[value]
    if type(value) in _NUMBERS:
        text = str(value)
        return text if text.strip("-.0123456789") == "" else Unknown("the text of such a number")
    STATE.tick()
    method = find_method(value, "toString")
    if method is not None:
        return method()
    if isinstance(value, enum.Enum):
        return value.name
    if type(value) in (list, tuple):
        return write_items(value)
    return Unknown(f"the text of a {type(value).__name__}")


def write_items(items: Iterable[Any], start: str = "[", end: str = "]") -> Any:
    """Items as Java writes a collection: ``[a, b]``. It is unknown where one of them is."""
    texts = [to_string(one) for one in items]
    unknown = find_unknown(*texts)
    return bound_text(start + ", ".join(texts) + end) if unknown is None else unknown


def equals(a: Any, b: Any) -> Any:
    """Java's Objects.equals."""
    unknown = find_unknown(a, b)
    if a is b or unknown is not None:
        return True if unknown is None else unknown
    if type(a) in BOX_NAMES:
        return type(a) is type(b) and a == b
    STATE.tick()
    method = None if a is None or b is None else find_method(a, "equals")
    if method is not None:
        return method(b)
    plain = type(a) in (list, tuple) and type(b) in (list, tuple) and len(a) == len(b)
    return plain and all(map(equals, a, b))


def hash_code(value: Any) -> int:
    """A hash for Python's dictionaries, by the program's own hashCode where it has one."""
    method = find_method(value, "hashCode")
    found = id(value) if method is None else method()
    return found if type(found) is int else 0


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


class JavaEnum(JavaClass, package=_LANG, name="Enum", others="hashCode getDeclaringClass"):
    """Base of a learner's enums. Each constant has ``_name`` and ``_ordinal``."""

    name = toString = __str__ = lambda self: self._name
    ordinal = lambda self: self._ordinal
    compareTo = lambda self, other: self._ordinal - other._ordinal
    equals = lambda self, other: self is other
