"""Types while a program runs: what a value is, whether it is one of a type, arrays of a type."""

import difflib
import enum
from collections.abc import Iterable, Sequence
from typing import Any

from grader.robotcode.java import values
from grader.robotcode.java.steps import ELEMENTS, STATE
from grader.robotcode.java.values import (
    Array,
    ArrayIndexOutOfBoundsException,
    ArrayStoreException,
    Char,
    JavaEnum,
    NegativeArraySizeException,
    NullPointerException,
    OutOfMemoryError,
)
from grader.robotcode.library.base import Unknown, WrongArgument

KINDS = {**values.KINDS, str: "String", type(None): "null"}
NAMES = {kind: box for box, kind in values.BOXES.items()}
INTERFACES: dict[str, Any] = {  # what values that are no objects here are instances of
    "Object": object, "Number": (int, float), "CharSequence": str, "Comparable": (int, float, str),
    "Iterable": Iterable,
}  # fmt: skip
MOST_ELEMENTS = 100_000
NEARLY = 0.7  # how much of two names has to agree for a "did you mean", from 0 to 1


def kind_of(value: Any) -> str:
    """The type of a value by its simple name."""
    cls = type(value)
    if isinstance(value, Array):
        return f"{value.kind}[]"
    return KINDS.get(cls) or type_name(cls)


def type_name(cls: type) -> str:
    """A class as Java calls it: ``String``, ``Double``, ``TalonFX``."""
    kind = KINDS.get(cls, cls.__name__)
    return NAMES.get(kind, kind)


def class_name(value: Any) -> str:
    """The class of a value by its full name."""
    kind = kind_of(value)
    if kind in NAMES or kind == "String":
        return f"java.lang.{NAMES.get(kind, kind)}"
    java = getattr(type(value), "java", None)
    return java.full_name if java is not None else values.full_name(type(value))


def is_instance(value: Any, kind: str) -> bool:
    """Whether a value is one of a type that is no class here: ``Integer``, ``Comparable``."""
    if value is None:
        return False
    if kind in INTERFACES:
        known = INTERFACES[kind]
        if isinstance(value, bool) and kind == "Number":
            return False
        return isinstance(value, known) or (
            kind == "Comparable" and values.find_method(value, "compareTo") is not None
        )
    return NAMES.get(kind_of(value), kind_of(value)) == kind


def enum_name(value: Any) -> str | None:
    """The name of an enum's constant; None of anything else."""
    if isinstance(value, JavaEnum):
        return value._name
    return value.name if isinstance(value, enum.Enum) else None


def did_you_mean(name: str, known: Sequence[str]) -> str:
    """The end of a sentence that offers the name most like a misspelled one; often empty."""
    near = difflib.get_close_matches(name, sorted(set(known) - {name}), 1, NEARLY)
    return f". Did you mean {near[0]}?" if near else ""


def make_array(kind: str, sizes: Sequence[Any]) -> Any:
    """A new array, of arrays if there is more than one size.

    Raises:
        NegativeArraySizeException: of fewer than no elements.
        OutOfMemoryError: of more than any robot program has.
    """
    inner = kind.removesuffix("[]")
    size = sizes[0]
    if isinstance(size, Unknown):
        return size
    if size < 0:
        raise NegativeArraySizeException(str(size))
    if size > MOST_ELEMENTS:
        raise OutOfMemoryError("Java heap space")
    STATE.tick(size // ELEMENTS)
    if len(sizes) > 1:
        return Array([make_array(inner, sizes[1:]) for _ in range(size)], inner)
    return Array([values.default_value(inner)] * size, inner)


def array_get(array: Any, index: Any) -> Any:
    """The element of an array at an index.

    Raises:
        ArrayIndexOutOfBoundsException: there is none of this index.
    """
    if isinstance(array, Unknown) or isinstance(index, Unknown):
        return array if isinstance(array, Unknown) else index
    _check_index(array, index)
    return list.__getitem__(array, index if not isinstance(index, Char) else ord(index))


def array_set(array: Any, index: Any, value: Any) -> None:
    """Set an element.

    Raises:
        ArrayIndexOutOfBoundsException: there is none of this index.
    """
    if isinstance(array, Unknown) or isinstance(index, Unknown):
        return
    _check_index(array, index)
    place = index if not isinstance(index, Char) else ord(index)
    try:
        list.__setitem__(array, place, values.convert(array.kind, value))
    except WrongArgument:
        raise ArrayStoreException(class_name(value)) from None


def _check_index(array: Any, index: Any) -> None:
    if array is None:
        raise NullPointerException("the array is null")
    place = ord(index) if isinstance(index, Char) else index
    if not isinstance(place, int):
        raise WrongArgument(f"an index is a whole number, and not {place}")
    if not 0 <= place < len(array):
        raise ArrayIndexOutOfBoundsException(f"Index {place} out of bounds for length {len(array)}")
