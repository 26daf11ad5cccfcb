"""Java's streams and functional interfaces, as far as robot code uses them.

A collector is a function from the elements to the result.
"""

from collections.abc import Callable, Iterable, Iterator
from functools import reduce
from itertools import chain, islice
from typing import Any

from grader.robotcode.java.collections import (
    ArrayList,
    HashSet,
    Optional,
    OptionalDouble,
    OptionalInt,
    counted,
    sort,
)
from grader.robotcode.java.values import (
    Array,
    JavaClass,
    Long,
    add,
    compare,
    convert,
    join_texts,
    make_statics,
    spread,
    to_string,
)
from grader.robotcode.library.base import FakeType, Unknown

_STREAMS = "java.util.stream"


def _repeat(make: Callable[[], Any]) -> Iterator[Any]:
    while True:
        yield make()


def _iterate(start: Any, step: Callable[[Any], Any]) -> Iterator[Any]:
    while True:
        yield start
        start = step(start)


class Stream(JavaClass, package=_STREAMS, partial=True):
    """A stream of objects, which gives each of them once."""

    _kind = "Object"
    _optional: Any = Optional

    def __init__(self, items: Iterable[Any]) -> None:
        self._items: Any = counted(convert(self._kind, one) for one in items)

    def __iter__(self) -> Iterator[Any]:
        return self._items

    @staticmethod
    def over(items: Any) -> Any:
        """A stream of a collection or an array, of the kind that fits."""
        return _KINDS.get(getattr(items, "kind", ""), Stream)(items)

    def reduce(self, *start_and_join: Any) -> Any:
        """The elements joined two by two."""
        if len(start_and_join) > 1:
            return reduce(start_and_join[1], self, start_and_join[0])
        items = list(self)
        return self._optional(reduce(start_and_join[0], items) if items else None)

    of = classmethod(lambda cls, *items: cls(spread(items, primitive=cls is not Stream)))
    empty = classmethod(lambda cls: cls([]))
    iterate = classmethod(lambda cls, start, step: cls(_iterate(start, step)))
    generate = classmethod(lambda cls, make: cls(_repeat(make)))
    concat = classmethod(lambda cls, first, second: cls(chain(first, second)))
    map = lambda self, change: type(self)(map(change, self))
    mapToObj = lambda self, change: Stream(map(change, self))
    mapToInt = lambda self, change: IntStream(map(change, self))
    mapToDouble = lambda self, change: DoubleStream(map(change, self))
    flatMap = lambda self, change: type(self)(chain.from_iterable(map(change, self)))
    filter = lambda self, test: type(self)(filter(test, self))
    limit = lambda self, most: type(self)(islice(self, most))
    skip = lambda self, count: type(self)(islice(self, count, None))
    sorted = lambda self, order=None: type(self)(sort(self, order))
    distinct = lambda self: type(self)(HashSet(list(self)))
    boxed = lambda self: Stream(self)
    collect = lambda self, collector: collector(self)
    forEach = lambda self, action: [action(item) for item in self] and None
    toList = lambda self: ArrayList(list(self))
    toArray = lambda self, make=None: Array(self, make(0).kind if make else self._kind)
    count = lambda self: Long(len(list(self)))
    min = lambda self, order=None: self._optional(next(iter(sort(self, order)), None))
    max = lambda self, order=compare: self.min(lambda a, b: order(b, a))
    findFirst = findAny = lambda self: self._optional(next(iter(self), None))
    anyMatch = lambda self, test: any(test(item) for item in self)
    allMatch = lambda self, test: all(test(item) for item in self)
    noneMatch = lambda self, test: not self.anyMatch(test)


class IntStream(Stream, package=_STREAMS, partial=True):
    """A stream of ints."""

    _kind: str = "int"
    _optional: Any = OptionalInt

    def average(self) -> Any:
        """Their mean."""
        items = list(self)
        return OptionalDouble(float(reduce(add, items, 0.0) / len(items)) if items else None)

    range = classmethod(lambda cls, start, end: cls(range(start, end)))
    rangeClosed = classmethod(lambda cls, start, end: cls(range(start, end + 1)))
    sum = lambda self: reduce(add, self, convert(self._kind, 0))


class DoubleStream(IntStream, package=_STREAMS, partial=True):
    """A stream of doubles."""

    _kind, _optional = "double", OptionalDouble


_KINDS = {"int": IntStream, "double": DoubleStream}


def _join(separator: str = "", start: str = "", end: str = "") -> Callable[..., Any]:
    return lambda items: start + join_texts(separator, map(to_string, items)) + end


make_statics(
    "java.util.stream.Collectors",
    {
        "toList": lambda: lambda items: ArrayList(list(items)),
        "toSet": lambda: lambda items: HashSet(list(items)),
        "joining": _join,
    },
    partial=True,
)


def _comparing(key_of: Callable[..., Any]) -> Any:
    return lambda a, b: compare(key_of(a), key_of(b))


class Functional(JavaClass):
    """Base of the functional interfaces: an object of a learner's that implements one is called."""

    _method = ""

    def __call__(self, *args: Any) -> Any:
        """Call its only method."""
        return getattr(self, self._method)(*args)


DEFAULT_METHODS: dict[str, Callable[..., Callable[..., Any]]] = {  # of functional interfaces
    "andThen": lambda first, after: lambda *args: after(first(*args)),
    "compose": lambda after, first: lambda *args: after(first(*args)),
    "negate": lambda one: lambda *args: not one(*args),
    "and": lambda one, other: lambda *args: one(*args) and other(*args),
    "or": lambda one, other: lambda *args: one(*args) or other(*args),
    "reversed": lambda one: lambda a, b: one(b, a),
    **dict.fromkeys(
        ("thenComparing", "thenComparingInt", "thenComparingDouble", "thenComparingLong"),
        lambda *_: Unknown("thenComparing()"),
    ),
}


def add_default(one: Any, interface: str, name: str, args: Iterable[Any]) -> Callable[..., Any]:
    """What a default method of a functional interface makes of an object: another function."""
    if name == "andThen" and interface.endswith("Consumer"):
        (other,) = args
        return lambda *given: (one(*given), other(*given))[1]
    return DEFAULT_METHODS[name](one, *args)


_IN_FUNCTION = """
accept: Consumer BiConsumer IntConsumer LongConsumer DoubleConsumer ObjDoubleConsumer ObjIntConsumer
test: Predicate BiPredicate IntPredicate LongPredicate DoublePredicate
get: Supplier
getAsBoolean: BooleanSupplier
getAsDouble: DoubleSupplier
getAsInt: IntSupplier
getAsLong: LongSupplier
apply: Function BiFunction UnaryOperator BinaryOperator IntFunction LongFunction DoubleFunction
applyAsDouble: ToDoubleFunction ToDoubleBiFunction DoubleUnaryOperator DoubleBinaryOperator
applyAsDouble: IntToDoubleFunction LongToDoubleFunction
applyAsInt: ToIntFunction ToIntBiFunction IntUnaryOperator IntBinaryOperator DoubleToIntFunction
applyAsLong: ToLongFunction LongUnaryOperator LongBinaryOperator DoubleToLongFunction
"""
_PLACES = {"Runnable": "java.lang", "Callable": "java.util.concurrent", "Comparator": "java.util"}
FUNCTIONAL_INTERFACES = {"Runnable": "run", "Callable": "call", "Comparator": "compare"}
for _line in _IN_FUNCTION.strip().splitlines():
    _called, _, _names = _line.partition(": ")
    FUNCTIONAL_INTERFACES |= dict.fromkeys(_names.split(), _called)


def shape_of(name: str) -> tuple[int, bool]:
    """How many values a functional interface takes, and whether it gives one."""
    none = name.endswith("Supplier") or name in {"Runnable", "Callable"}
    two = name in {"Comparator", "BinaryOperator"} or name.startswith(("Bi", "Obj", "ToDoubleBi"))
    gives = not name.endswith(("Consumer", "Runnable"))
    return 0 if none else 2 if two or "Binary" in name else 1, gives


FUNCTIONAL = frozenset(FUNCTIONAL_INTERFACES.values())
GIVEN = {"AsDouble": "double", "AsLong": "long", "AsInt": "int"}  # by how a method's name ends


_COMPARING: dict[str, Any] = {
    **dict.fromkeys(("comparing", "comparingInt", "comparingDouble"), staticmethod(_comparing)),
    "naturalOrder": staticmethod(lambda: compare),
    "reverseOrder": staticmethod(lambda: lambda a, b: compare(b, a)),
}
for _name, _called in FUNCTIONAL_INTERFACES.items():
    _members = {"_method": _called, **(_COMPARING if _name == "Comparator" else {})}
    _package = _PLACES.get(_name, "java.util.function")
    FakeType(_name, (Functional,), _members, package=_package, partial=True)
