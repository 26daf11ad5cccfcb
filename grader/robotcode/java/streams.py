"""Java's streams and functional interfaces, as far as robot code uses them."""

from collections.abc import Iterable, Iterator
from typing import Any

from grader.robotcode.java.collections import ArrayList, HashSet, Optional, counted
from grader.robotcode.java.values import (
    NAMES,
    Array,
    JavaClass,
    add,
    convert,
    make_statics,
    spread,
)
from grader.robotcode.library.base import Unknown, add_named_classes

_STREAMS = "java.util.stream"


class Stream(JavaClass, package=_STREAMS, partial=True):
    """A stream of objects, which gives each of them once."""

    _kind = "Object"

    def __init__(self, items: Iterable[Any]) -> None:
        self._items: Any = counted(convert(self._kind, one) for one in items)

    def __iter__(self) -> Iterator[Any]:
        return self._items

    @staticmethod
    def over(items: Any) -> Any:
        """A stream of a collection or an array, of the kind that fits."""
        return _KINDS.get(getattr(items, "kind", ""), Stream)(items)

    of = classmethod(lambda cls, *items: cls(spread(items, primitive=cls is not Stream)))
    map = lambda self, change: type(self)(map(change, self))
    mapToObj = lambda self, change: Stream(map(change, self))
    mapToInt = lambda self, change: IntStream(map(change, self))
    mapToDouble = lambda self, change: DoubleStream(map(change, self))
    filter = lambda self, test: type(self)(filter(test, self))
    collect = lambda self, collector: (
        collector if isinstance(collector, Unknown) else collector(self)
    )
    forEach = lambda self, action: [action(item) for item in self] and None
    toList = lambda self: ArrayList(list(self))
    toArray = lambda self, make=None: Array(self, make(0).kind if make else self._kind)
    count = lambda self: len(list(self))
    findFirst = findAny = lambda self: Optional(next(iter(self), None))
    anyMatch = lambda self, test: any(test(item) for item in self)
    allMatch = lambda self, test: all(test(item) for item in self)
    noneMatch = lambda self, test: not self.anyMatch(test)


class IntStream(Stream, package=_STREAMS, partial=True):
    """A stream of ints."""

    _kind: str = "int"

    def sum(self) -> Any:
        """The sum of the elements."""
        total = convert(self._kind, 0)
        for one in self:
            total = add(total, one)
        return total

    def average(self) -> Any:
        """The mean of the elements."""
        items = list(self)
        return Optional(DoubleStream(items).sum() / len(items) if items else None)

    range = classmethod(lambda cls, start, end: cls(range(start, end)))


class DoubleStream(IntStream, package=_STREAMS, partial=True):
    """A stream of doubles."""

    _kind = "double"


_KINDS = {"int": IntStream, "double": DoubleStream}
make_statics(
    "java.util.stream.Collectors",
    {
        "toList": lambda: lambda items: ArrayList(list(items)),
        "toSet": lambda: lambda items: HashSet(list(items)),
    },
    partial=True,
)


class Functional(JavaClass):
    """Base of the functional interfaces: an object of a learner's that implements one is called."""

    def __call__(self, *args: Any) -> Any:
        """Call its only method."""
        names = (one.__name__ for one in type(self).__mro__)
        called = next(name for name in names if name in FUNCTIONAL_INTERFACES)
        return getattr(self, FUNCTIONAL_INTERFACES[called])(*args)


DEFAULT_METHODS = frozenset({  # of functional interfaces; what they make is unknown
    "compose", "negate", "and", "or", "reversed", "thenComparing",
    "thenComparingDouble", "thenComparingInt",
})  # fmt: skip
FUNCTIONAL_INTERFACES: dict[str, str] = {}
for _row in NAMES["functional"]:
    add_named_classes([_row], Functional)
    FUNCTIONAL_INTERFACES |= dict.fromkeys(_row["names"].split(), _row["method"])


def shape_of(name: str) -> tuple[int, bool]:
    """How many values a functional interface takes, and whether it gives one."""
    none = name.endswith("Supplier") or name in {"Runnable", "Callable"}
    two = name in {"Comparator", "BinaryOperator"} or name.startswith(("Bi", "Obj", "ToDoubleBi"))
    gives = not name.endswith(("Consumer", "Runnable"))
    return 0 if none else 2 if two or "Binary" in name else 1, gives


FUNCTIONAL = frozenset(FUNCTIONAL_INTERFACES.values())
GIVEN = {"AsDouble": "double", "AsLong": "long", "AsInt": "int"}  # by how a method's name ends
