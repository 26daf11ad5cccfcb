"""Java's streams, collectors and functional interfaces.

A stream is lazy and can be used once. A collector is a function from the elements to the result.
"""

import math
from collections.abc import Callable, Iterable, Iterator
from functools import partial, reduce
from itertools import chain, dropwhile, islice, takewhile
from typing import Any

from grader.robotcode.java.collections import (
    ArrayList,
    HashMap,
    HashSet,
    LinkedHashSet,
    Optional,
    OptionalDouble,
    OptionalInt,
    OptionalLong,
    counted,
    sort,
)
from grader.robotcode.java.text import format
from grader.robotcode.java.values import (
    Array,
    IllegalStateException,
    JavaClass,
    Long,
    add,
    compare,
    convert,
    equals,
    join_texts,
    make_statics,
    spread,
    to_string,
)
from grader.robotcode.library.base import FakeType

_STREAMS = "java.util.stream"


def _repeat(make: Callable[[], Any]) -> Iterator[Any]:
    while True:
        yield make()


def _iterate(start: Any, *test_and_step: Callable[..., Any]) -> Iterator[Any]:
    while len(test_and_step) == 1 or test_and_step[0](start):
        yield start
        start = test_and_step[-1](start)


def _peek(items: Iterable[Any], action: Callable[..., Any]) -> Iterator[Any]:
    for item in items:
        action(item)
        yield item


def _later(change: Callable[[Iterable[Any]], Iterable[Any]], items: Iterable[Any]) -> Iterator[Any]:
    """What has to see all elements before it gives the first."""
    yield from change(items)


class Stream(JavaClass, package=_STREAMS, others="close onClose parallel sequential unordered"):
    """A stream of objects."""

    _kind = "Object"
    _optional: Any = Optional

    def __init__(self, items: Iterable[Any]) -> None:
        self._items: Any = counted(convert(self._kind, one) for one in items)

    def __iter__(self) -> Iterator[Any]:
        items, self._items = self._items, None
        if items is None:
            raise IllegalStateException("stream has already been operated upon or closed")
        return items

    @staticmethod
    def over(items: Any) -> Any:
        """A stream of a collection or an array, of the kind that fits."""
        return _KINDS.get(getattr(items, "kind", ""), Stream)(items)

    def collect(self, collector: Any, accumulate: Any = None, _combine: Any = None) -> Any:
        """What a collector makes of the elements."""
        if accumulate is None:
            return collector(self)
        result = collector()
        for item in self:
            accumulate(result, item)
        return result

    def reduce(self, *start_and_join: Any) -> Any:
        """The elements joined two by two."""
        if len(start_and_join) > 1:
            return reduce(start_and_join[1], self, start_and_join[0])
        items = list(self)
        return self._optional(reduce(start_and_join[0], items) if items else None)

    def _test_any(self, test: Callable[..., Any], *, wanted: bool) -> bool:
        return any(bool(test(item)) == wanted for item in self)

    of = classmethod(lambda cls, *items: cls(spread(items, primitive=cls is not Stream)))
    ofNullable = classmethod(lambda cls, item: cls([] if item is None else [item]))
    empty = classmethod(lambda cls: cls([]))
    iterate = classmethod(lambda cls, start, *steps: cls(_iterate(start, *steps)))
    generate = classmethod(lambda cls, make: cls(_repeat(make)))
    concat = classmethod(lambda cls, first, second: cls(chain(first, second)))
    map = lambda self, change: type(self)(map(change, self))
    mapToObj = lambda self, change: Stream(map(change, self))
    mapToInt = lambda self, change: IntStream(map(change, self))
    mapToLong = lambda self, change: LongStream(map(change, self))
    mapToDouble = lambda self, change: DoubleStream(map(change, self))
    flatMap = lambda self, change: type(self)(chain.from_iterable(map(change, self)))
    filter = lambda self, test: type(self)(filter(test, self))
    peek = lambda self, action: type(self)(_peek(self, action))
    limit = lambda self, most: type(self)(islice(self, most))
    skip = lambda self, count: type(self)(islice(self, count, None))
    takeWhile = lambda self, test: type(self)(takewhile(test, self))
    dropWhile = lambda self, test: type(self)(dropwhile(test, self))
    sorted = lambda self, order=None: type(self)(_later(lambda items: sort(items, order), self))
    distinct = lambda self: type(self)(_later(LinkedHashSet, list(self)))
    boxed = lambda self: Stream(self)
    asDoubleStream = lambda self: DoubleStream(self)
    asLongStream = lambda self: LongStream(self)
    parallel = sequential = unordered = lambda self: self
    iterator = lambda self: ArrayList(list(self)).iterator()
    forEach = forEachOrdered = lambda self, action: [action(item) for item in self] and None
    toList = lambda self: ArrayList(list(self))._freeze()
    toArray = lambda self, make=None: Array(self, make(0).kind if make else self._kind)
    count = lambda self: Long(sum(1 for _ in self))
    min = lambda self, order=None: self._optional(next(iter(sort(self, order)), None))
    max = lambda self, order=compare: self.min(lambda a, b: order(b, a))
    findFirst = findAny = lambda self: self._optional(next(iter(self), None))
    anyMatch = lambda self, test: self._test_any(test, wanted=True)
    allMatch = lambda self, test: not self._test_any(test, wanted=False)
    noneMatch = lambda self, test: not self._test_any(test, wanted=True)


class _NumberStream(Stream):
    """A stream of primitives."""

    def average(self) -> Any:
        """Their mean."""
        items = list(self)
        return OptionalDouble(_mean(items) if items else None)

    sum = lambda self: _sum(self, convert(self._kind, 0))
    summaryStatistics = lambda self: Statistics(self, self._kind)


class IntStream(_NumberStream, package=_STREAMS):
    """A stream of ints."""

    _kind: str = "int"
    _optional: Any = OptionalInt
    range = classmethod(lambda cls, start, end: cls(range(start, end)))
    rangeClosed = classmethod(lambda cls, start, end: cls(range(start, end + 1)))


class LongStream(IntStream, package=_STREAMS):
    """A stream of longs."""

    _kind, _optional = "long", OptionalLong


class DoubleStream(_NumberStream, package=_STREAMS):
    """A stream of doubles."""

    _kind, _optional = "double", OptionalDouble


_KINDS = {"int": IntStream, "long": LongStream, "double": DoubleStream}


def _sum(items: Iterable[Any], start: Any) -> Any:
    return reduce(add, items, start)


def _mean(items: list[Any]) -> float:
    return float(_sum(items, 0.0) / len(items)) if items else 0.0


class Statistics(JavaClass):
    """java.util.IntSummaryStatistics and its sisters."""

    def __init__(self, items: Iterable[Any], kind: str) -> None:
        self._items, self._kind = list(items), kind

    def toString(self) -> str:
        """Name and values."""
        values = [self.getSum(), self.getMin(), self.getAverage(), self.getMax()]
        texts = [format("%f" if isinstance(one, float) else "%d", [one]) for one in values]
        sums = "count={}, sum={}, min={}, average={}, max={}".format(self.getCount(), *texts)
        return f"{self._kind.title()}SummaryStatistics{{{sums}}}"

    accept = lambda self, item: self._items.append(convert(self._kind, item))
    getCount = lambda self: Long(len(self._items))
    getSum = lambda self: _sum(self._items, 0.0 if self._kind == "double" else Long())
    getMin = lambda self: min(self._items, default=convert(self._kind, _EMPTY[self._kind][0]))
    getMax = lambda self: max(self._items, default=convert(self._kind, _EMPTY[self._kind][1]))
    getAverage = lambda self: _mean(self._items)


_EMPTY = {
    "int": (2**31 - 1, -(2**31)),
    "long": (2**63 - 1, -(2**63)),
    "double": (math.inf, -math.inf),
}


def _join(separator: str = "", start: str = "", end: str = "") -> Callable[..., Any]:
    return lambda items: start + join_texts(separator, map(to_string, items)) + end


def _refuse_duplicate(key: Any, before: Any, value: Any) -> Any:
    raise IllegalStateException(
        f"Duplicate key {to_string(key)} (attempted merging values {to_string(before)}"
        f" and {to_string(value)})"
    )


def _to_map(
    key_of: Callable[..., Any],
    value_of: Callable[..., Any],
    join: Any = None,
    make: Callable[..., Any] = HashMap,
) -> Callable[..., Any]:
    def collect(items: Iterable[Any]) -> Any:
        made = make()
        for item in items:
            key, value = key_of(item), value_of(item)
            made.merge(key, value, join or partial(_refuse_duplicate, key))
        return made

    return collect


def _group_by(key_of: Callable[..., Any], *make_and_collector: Callable[..., Any]) -> Any:
    *make, collector = make_and_collector or (ArrayList,)

    def collect(items: Iterable[Any]) -> Any:
        made = make[0]() if make else HashMap()
        for item in items:
            made.computeIfAbsent(key_of(item), lambda _: []).append(item)
        made.replaceAll(lambda _, group: collector(group))
        return made

    return collect


def _partition(test: Callable[..., Any], collector: Callable[..., Any] = ArrayList) -> Any:
    def collect(items: Iterable[Any]) -> Any:
        made = HashMap()
        groups: tuple[list[Any], list[Any]] = ([], [])
        for item in items:
            groups[bool(test(item))].append(item)
        for side, group in enumerate(groups):
            made.put(bool(side), collector(group))
        return made

    return collect


def _over(result: Callable[..., Any]) -> Callable[..., Any]:
    """A collector of what a function gives for each element."""
    return lambda change: lambda items: result(map(change, items))


def _finish_stream(name: str) -> Callable[..., Any]:
    return lambda *args: lambda items: getattr(Stream(items), name)(*args)


Collectors = make_statics(
    "java.util.stream.Collectors",
    {
        "toList": lambda: lambda items: ArrayList(list(items)),
        "toUnmodifiableList": _finish_stream("toList"),
        "toSet": lambda: lambda items: HashSet(list(items)),
        "toCollection": lambda make: lambda items: _fill(make(), items),
        "toMap": _to_map,
        "joining": _join,
        "groupingBy": _group_by,
        "partitioningBy": _partition,
        "counting": _finish_stream("count"),
        "reducing": _finish_stream("reduce"),
        "minBy": _finish_stream("min"),
        "maxBy": _finish_stream("max"),
        "mapping": lambda change, then: lambda items: then(map(change, items)),
        "filtering": lambda test, then: lambda items: then(filter(test, items)),
        "collectingAndThen": lambda first, change: lambda items: change(first(items)),
        **dict.fromkeys(
            ("averagingDouble", "averagingInt", "averagingLong"), _over(lambda x: _mean(list(x)))
        ),
        "summingInt": _over(lambda items: _sum(items, 0)),
        "summingLong": _over(lambda items: _sum(items, Long())),
        "summingDouble": _over(lambda items: _sum(items, 0.0)),
        "summarizingDouble": _over(lambda items: Statistics(items, "double")),
        "summarizingInt": _over(lambda items: Statistics(items, "int")),
    },
)


def _fill(made: Any, items: Iterable[Any]) -> Any:
    made.addAll(items)
    return made


def _comparing(key_of: Callable[..., Any] = lambda item: item, order: Any = None) -> Any:
    return lambda a, b: (order or compare)(key_of(a), key_of(b))


def _nulls(order: Any, sign: int) -> Callable[[Any, Any], Any]:
    """A comparator to which null is less than everything, or more."""

    def run(a: Any, b: Any) -> Any:
        if a is None or b is None:
            return sign * ((b is None) - (a is None))
        return order(a, b) if order else 0

    return run


def _and_then(first: Callable[..., Any], second: Callable[..., Any]) -> Callable[..., Any]:
    """Function.andThen hands on the result; Consumer.andThen calls both with the arguments."""

    def run(*args: Any) -> Any:
        result = first(*args)
        interface = getattr(first, "interface", None)
        consumes = result is None if interface is None else "Consumer" in interface.__name__
        return second(*args) if consumes else second(result)

    return run


def _then(first: Callable[..., Any], second: Any, order: Any = None) -> Callable[..., Any]:
    """Comparator.thenComparing takes another comparator, or a key and perhaps its order."""
    code = getattr(second, "__code__", None)
    pair = getattr(second, "arity", code.co_argcount if code else 1) > 1
    then = second if pair else _comparing(second, order)
    return lambda a, b: first(a, b) or then(a, b)


class Functional(JavaClass):
    """Base of the functional interfaces: an object of a learner's that implements one is called."""

    _method = ""

    def __call__(self, *args: Any) -> Any:
        """Call its only method."""
        return getattr(self, self._method)(*args)


def _composing(make: Callable[..., Any]) -> Callable[..., Any]:
    """The same; what it makes has the default methods of the functional interfaces in turn."""
    return lambda *args: Composed(make(*args))


FUNCTION_METHODS: dict[str, Callable[..., Any]] = {
    "andThen": _and_then,
    "compose": lambda second, first: lambda *args: second(first(*args)),
    "negate": lambda test: lambda *args: not test(*args),
    "and_": lambda test, other: lambda *args: test(*args) and other(*args),
    "or_": lambda test, other: lambda *args: test(*args) or other(*args),
    "reversed": lambda order: lambda a, b: order(b, a),
    **dict.fromkeys(
        ("thenComparing", "thenComparingInt", "thenComparingDouble", "thenComparingLong"), _then
    ),
}
FUNCTION_METHODS = {name: _composing(make) for name, make in FUNCTION_METHODS.items()}


class Composed(Functional):
    """A function made of others, as every functional interface."""

    def __init__(self, run: Callable[..., Any]) -> None:
        self._run = run
        self.arity = getattr(getattr(run, "__code__", None), "co_argcount", -1)

    __call__ = lambda self, *args: self._run(*args)


for _name, _method in FUNCTION_METHODS.items():
    setattr(Functional, _name, _method)
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


def _call_as(name: str) -> Callable[..., Any]:
    kind = next((kind for end, kind in GIVEN.items() if name.endswith(end)), "")
    return lambda self, *args: convert(kind, self(*args))


for _name in FUNCTIONAL:
    setattr(Composed, _name, _call_as(_name))
_STATICS: dict[str, dict[str, Callable[..., Any]]] = {
    "Function": {"identity": lambda: lambda item: item},
    "UnaryOperator": {"identity": lambda: lambda item: item},
    "Predicate": {
        "not_": FUNCTION_METHODS["negate"],
        "isEqual": lambda wanted: lambda item: equals(wanted, item),
    },
    "BinaryOperator": {
        "minBy": lambda order: lambda a, b: b if order(a, b) > 0 else a,
        "maxBy": lambda order: lambda a, b: b if order(a, b) < 0 else a,
    },
    "Comparator": {
        **dict.fromkeys(
            ("comparing", "comparingInt", "comparingDouble", "comparingLong"), _comparing
        ),
        "naturalOrder": lambda: lambda a, b: compare(a, b),
        "reverseOrder": lambda: lambda a, b: compare(b, a),
        "nullsFirst": lambda order: _nulls(order, 1),
        "nullsLast": lambda order: _nulls(order, -1),
    },
}
for _name, _called in FUNCTIONAL_INTERFACES.items():
    _members = {key: staticmethod(_composing(one)) for key, one in _STATICS.get(_name, {}).items()}
    _package = _PLACES.get(_name, "java.util.function")
    FakeType(_name, (Functional,), {"_method": _called, **_members}, package=_package)
