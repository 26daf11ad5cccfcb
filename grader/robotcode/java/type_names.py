"""Types at run time: the type of a value, instance checks, and arrays of a type."""

import difflib
import enum
from collections.abc import Iterable, Sequence
from typing import Any

from grader.robotcode.java import values
from grader.robotcode.java.steps import ELEMENTS, STATE
from grader.robotcode.java.values import (
    Array,
    ArrayIndexOutOfBoundsException,
    JavaEnum,
    NullPointerException,
    OutOfMemoryError,
)
from grader.robotcode.library.base import Unknown, WrongArgument

INTERFACES: dict[str, Any] = {  # what values that are no objects here are instances of
    "Object": object, "Number": (int, float), "CharSequence": str, "Comparable": (int, float, str),
    "Iterable": Iterable,
}  # fmt: skip
MOST_ELEMENTS = 100_000
NEARLY = 0.7  # how much of two names has to agree for a "did you mean", from 0 to 1


def type_name(cls: type) -> str:
    """A class as Java calls it: ``String``, ``Double``, ``TalonFX``."""
    return values.BOX_NAMES.get(cls, cls.__name__)


def is_instance(value: Any, kind: str) -> bool:
    """Whether a value is one of a type that is no class here: ``Integer``, ``Comparable``."""
    if value is None:
        return False
    if kind in INTERFACES:
        return isinstance(value, INTERFACES[kind]) and (kind == "Object" or type(value) is not bool)
    return type(value) is values.TYPES.get(kind) or type_name(type(value)) == kind


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
        OutOfMemoryError: of more elements than any robot program has.
    """
    inner = kind.removesuffix("[]")
    size = sizes[0]
    if isinstance(size, Unknown):
        return size
    if not 0 <= size <= MOST_ELEMENTS:
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
    unknown = values.find_unknown(array, index)
    return _check_index(array, index)[index] if unknown is None else unknown


def array_set(array: Any, index: Any, value: Any) -> None:
    """Set an element.

    Raises:
        ArrayIndexOutOfBoundsException: there is none of this index.
    """
    if values.find_unknown(array, index) is None:
        _check_index(array, index)[index] = values.convert(array.kind, value)


def _check_index(array: Any, index: Any) -> Any:
    """The array, if it has an element of this index."""
    if array is None:
        raise NullPointerException("the array is null")
    if not isinstance(index, int):
        raise WrongArgument(f"an index is a whole number, and not {index}")
    if not 0 <= index < len(array):
        raise ArrayIndexOutOfBoundsException(f"Index {index} out of bounds for length {len(array)}")
    return array
