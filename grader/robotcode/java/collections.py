"""Java's collections, Optional and the atomic variables, as far as robot code uses them.

They are Python's: a List is a ``list``, a Map and a Set are a ``dict``, under Java's names. What
Java hands out as a view (``keySet``, ``subList``) is a copy, and nothing refuses to be changed.
``remove`` of a list takes a whole number for an index, never for an element.
"""

# mypy: disable-error-code="assignment, func-returns-value, arg-type"
from collections.abc import Callable, Iterable, Iterator
from functools import cmp_to_key
from typing import Any

from grader.robotcode.java.steps import STATE
from grader.robotcode.java.values import (
    PRIMITIVES,
    Array,
    IndexOutOfBoundsException,
    JavaClass,
    NoSuchElementException,
    NullPointerException,
    OutOfMemoryError,
    compare,
    convert,
    default_value,
    equals,
    hash_code,
    hash_items,
    make_statics,
    spread,
    to_string,
    write_items,
)
from grader.robotcode.library.base import JAVA, FakeType, Unknown

_UTIL = "java.util"
MOST = 100_000  # elements of one collection


def counted(items: Iterable[Any]) -> Iterator[Any]:
    """Items, each of which counts as a step of the program."""
    for item in items:
        STATE.tick()
        yield item


def sort(items: Iterable[Any], comparator: Any = None) -> list[Any]:
    """Items in the order of a comparator; in their own where that is null."""
    if type(comparator) is Unknown:
        return list(items)
    return sorted(counted(items), key=cmp_to_key(comparator or compare))


def make_stream(items: Any) -> Any:
    """A stream of a collection or an array, of the kind that fits."""
    return JAVA["java.util.stream.Stream"].over(items)


class JavaIterable(JavaClass, package="java.lang", name="Iterable"):
    """What a for-each loop takes. A learner's class with iterator() is one as well."""

    def __iter__(self) -> Iterator[Any]:
        iterator = self.iterator()
        while iterator.hasNext():
            yield iterator.next()

    def forEach(self, action: Callable[..., Any]) -> None:
        """Call something with every element."""
        for item in self:
            action(item)


class JavaIterator(JavaIterable, package=_UTIL, name="Iterator", partial=True):
    """Goes through a collection once."""

    iterator = lambda self: self
    forEachRemaining = JavaIterable.forEach


class Cursor(JavaIterator, partial=True):
    """An iterator over a copy of a collection."""

    def __init__(self, items: Iterable[Any]) -> None:
        self._left = list(items)

    def next(self) -> Any:
        """The next element."""
        if not self._left:
            raise NoSuchElementException
        return self._left.pop(0)

    hasNext = lambda self: bool(self._left)


class Collection(JavaIterable, package=_UTIL, others="spliterator hashCode"):
    """Any collection, by means of its length, its elements, ``add`` and ``_replace``."""

    def _grow(self, count: int) -> None:
        STATE.tick(count)
        if len(self) + count > MOST:
            raise OutOfMemoryError("Java heap space")

    def _keep(self, test: Callable[[Any], Any]) -> bool:
        """Keep the elements that pass a test; return whether that changed anything."""
        kept = [one for one in counted(self) if test(one)]
        changed = len(kept) < len(self)
        self._replace(kept)
        return changed

    def remove(self, item: object) -> Any:
        """Take out the first element that equals an object; return whether there was one."""
        gone: list[Any] = []
        return self._keep(lambda one: gone or not equals(item, one) or gone.append(one))

    iterator = lambda self: Cursor(self)
    size = lambda self: len(self)
    isEmpty = lambda self: not len(self)
    contains = lambda self, item: any(equals(item, one) for one in counted(self))
    containsAll = lambda self, items: all(self.contains(one) for one in items)
    addAll = lambda self, items: sum(bool(self.add(one)) for one in list(items)) > 0
    removeIf = lambda self, test: self._keep(lambda one: not test(one))
    removeAll = lambda self, items: self._keep(lambda one: not items.contains(one))
    retainAll = lambda self, items: self._keep(items.contains)
    clear = lambda self: self._replace([])
    stream = parallelStream = lambda self: make_stream(self)
    toArray = lambda self, like=None: Array(self, getattr(like, "kind", "Object"))
    toString = lambda self: write_items("(this Collection)" if x is self else x for x in self)


class List(Collection, list[Any], package=_UTIL, others="listIterator spliterator"):
    """A list."""

    def __init__(self, source: Any = None) -> None:
        if source is not None and type(source) is not int:
            self.addAll(source)

    def _at(self, index: int) -> int:
        if not 0 <= index < len(self):
            raise IndexOutOfBoundsException(f"Index {index} out of bounds for length {len(self)}")
        return index

    def _replace(self, items: Iterable[Any]) -> None:
        self[:] = list(items)

    def _put(self, index: int, item: Any) -> Any:
        before, self[index] = self[self._at(index)], item
        return before

    def addAll(self, *place_and_items: Any) -> bool:
        """Insert elements at an index or at the end."""
        *place, items = place_and_items
        added = list(items)
        self._grow(len(added))
        index = place[0] if place else len(self)
        if not 0 <= index <= len(self):
            raise IndexOutOfBoundsException(f"Index: {index}, Size: {len(self)}")
        self[index:index] = added
        return bool(added)

    def remove(self, item: object) -> Any:
        """Take out the element at an index, or an element."""
        return (
            list.pop(self, self._at(item)) if type(item) is int else Collection.remove(self, item)
        )

    def indexOf(self, wanted: object) -> int:
        """The first place of an element, -1 if there is none."""
        found = (at for at, item in enumerate(counted(self)) if equals(wanted, item))
        return next(found, -1)

    __iter__ = list.__iter__
    __hash__ = lambda self: hash_items(map(hash_code, self), 1)
    hashCode = __hash__
    of = staticmethod(lambda *items: ArrayList(spread(items)))
    copyOf = staticmethod(lambda items: ArrayList(items))
    equals = lambda self, other: (
        isinstance(other, List) and len(self) == len(other) and all(map(equals, self, other))
    )
    add = lambda self, *place_and_item: self.addAll(*place_and_item[:-1], place_and_item[-1:])
    get = lambda self, index: self[self._at(index)]
    set = lambda self, index, item: self._put(index, item)
    lastIndexOf = lambda self, item: max(
        (at for at, one in enumerate(self) if equals(item, one)), default=-1
    )
    sort = lambda self, order=None: self._replace(sort(self, order))
    replaceAll = lambda self, change: self._replace(map(change, list(self)))
    subList = lambda self, start, end: ArrayList(self[start:end])


class ArrayList(List, package=_UTIL, others="listIterator spliterator ensureCapacity trimToSize"):
    """A list in an array."""

    clone = lambda self: type(self)(self)


class LinkedList(ArrayList, package=_UTIL, partial=True):
    """A list with what queues and stacks of Java's can do."""

    def _end(self, index: int, *, take: bool = False, must: bool = False) -> Any:
        if must and not len(self):
            raise NoSuchElementException
        return (list.pop(self, index) if take else self[index]) if len(self) else None

    def remove(self, *item: object) -> Any:
        """Take out the first element, or that element, or the one at that index."""
        return super().remove(*item) if item else self.removeFirst()

    addFirst = push = offerFirst = lambda self, item: self.add(0, item)
    addLast = offer = offerLast = lambda self, item: self.add(item)
    getFirst = element = lambda self: self._end(0, must=True)
    getLast = lambda self: self._end(-1, must=True)
    removeFirst = pop = lambda self: self._end(0, take=True, must=True)
    removeLast = lambda self: self._end(-1, take=True, must=True)
    peek = peekFirst = lambda self: self._end(0)
    peekLast = lambda self: self._end(-1)
    poll = pollFirst = lambda self: self._end(0, take=True)
    pollLast = lambda self: self._end(-1, take=True)


class Entry(JavaClass):
    """A key and its value; setValue changes the map that it is of."""

    def __init__(self, key: Any, value: Any, owner: Any = None) -> None:
        self._key, self._value, self._owner = key, value, owner

    def setValue(self, value: object) -> Any:
        """Store another value; return the one before."""
        before, self._value = self._value, value
        self._owner.put(self._key, value)
        return before

    getKey = lambda self: self._key
    getValue = lambda self: self._value
    toString = lambda self: write_items([self._key], "", "=") + write_items([self._value], "", "")


class Map(JavaClass, dict[Any, Any], package=_UTIL, others="hashCode replace clone"):
    """A map, in the order in which its keys came."""

    Entry = SimpleEntry = Entry

    def __init__(self, source: Any = None, *_size: Any) -> None:
        if isinstance(source, dict):
            self.putAll(source)

    def put(self, key: object, value: object) -> Any:
        """Store a value under a key; return the one before."""
        STATE.tick()
        if len(self) > MOST:
            raise OutOfMemoryError("Java heap space")
        before = dict.get(self, key)
        self[key] = value
        return before

    def putAll(self, other: Any) -> None:
        """Store all that another map has."""
        for key in list(other):
            self.put(key, other[key])

    def get(self, key: object, other: Any = None) -> Any:
        """The value of a key, or another."""
        return key if type(key) is Unknown else dict.get(self, key, other)

    def compute(self, key: object, change: Callable[..., Any]) -> Any:
        """Store what a function makes of key and value; take the key out if that is null."""
        value = change(key, self.get(key))
        if value is None:
            self.remove(key)
        else:
            self.put(key, value)
        return value

    __hash__ = object.__hash__
    of = staticmethod(lambda *parts: HashMap(dict(zip(parts[::2], parts[1::2], strict=True))))
    entry = staticmethod(Entry)
    ofEntries = staticmethod(lambda *some: HashMap({e._key: e._value for e in spread(some)}))
    copyOf = staticmethod(lambda other: HashMap(other))
    getOrDefault = get
    clear = lambda self: dict.clear(self)
    size = lambda self: len(self)
    isEmpty = lambda self: not len(self)
    containsKey = lambda self, key: key in self
    containsValue = lambda self, value: self.values().contains(value)
    remove = lambda self, key: dict.pop(self, key, None)
    putIfAbsent = lambda self, key, value: get_or(self.get(key), lambda: self.put(key, value))
    computeIfAbsent = lambda self, key, make: get_or(
        self.get(key), lambda: self.compute(key, lambda key, _: make(key))
    )
    computeIfPresent = lambda self, key, change: (
        None if self.get(key) is None else self.compute(key, change)
    )
    merge = lambda self, key, value, join: self.compute(
        key, lambda _, before: value if before is None else join(before, value)
    )
    forEach = lambda self, action: [action(key, self[key]) for key in list(self)] and None
    replaceAll = lambda self, change: self.putAll({key: change(key, self[key]) for key in self})
    keySet = lambda self: Set(list(self))
    values = lambda self: ArrayList([self[key] for key in self])
    entrySet = lambda self: ArrayList([Entry(key, self[key], self) for key in self])
    equals = lambda self, other: (
        isinstance(other, Map)
        and len(self) == len(other)
        and all(key in other and equals(self[key], other[key]) for key in self)
    )
    toString = lambda self: write_items(self.entrySet(), "{", "}")


class HashMap(Map, package=_UTIL, others="hashCode replace clone"):
    """A map."""


class TreeMap(HashMap, package=_UTIL, partial=True):
    """A map in the order of its keys."""

    def _nearest(self, sign: int, key: object) -> Any:
        """The key itself, or the nearest one before (-1) or after (1) it."""
        keys = [one for one in list(self)[::sign] if sign * compare(one, key) >= 0]
        return keys[0] if keys else None

    __iter__ = lambda self: iter(sort(list(dict.keys(self))))
    firstKey = lambda self: self.keySet().iterator().next()
    lastKey = lambda self: Cursor(list(self)[::-1]).next()
    firstEntry = lambda self: next(iter(self.entrySet()), None)
    lastEntry = lambda self: next(reversed(self.entrySet()), None)
    floorKey = lambda self, key: self._nearest(-1, key)
    ceilingKey = lambda self, key: self._nearest(1, key)
    floorEntry = lambda self, key: self._entry(self._nearest(-1, key))
    ceilingEntry = lambda self, key: self._entry(self._nearest(1, key))
    _entry = lambda self, key: None if key is None else Entry(key, self[key], self)


class Set(Collection, dict[Any, None], package=_UTIL, others="spliterator hashCode clone"):
    """A set, in the order in which its elements came."""

    def __init__(self, source: Any = None, *_size: Any) -> None:
        if isinstance(source, list | tuple | dict):
            self.addAll(source)

    def add(self, item: object) -> bool:
        """Add an element; return whether it is new."""
        self._grow(1)
        new = item not in self
        self[item] = None
        return new

    def _replace(self, items: Iterable[Any]) -> None:
        kept = list(items)
        dict.clear(self)
        self.update(dict.fromkeys(kept))

    __iter__ = dict.__iter__
    __hash__ = object.__hash__
    of = staticmethod(lambda *items: HashSet(spread(items)))
    copyOf = staticmethod(lambda items: HashSet(list(items)))
    contains = lambda self, item: item in self
    equals = lambda self, other: (
        isinstance(other, Set) and len(self) == len(other) and self.containsAll(other)
    )


class HashSet(Set, package=_UTIL, others="spliterator hashCode clone"):
    """A set."""


class TreeSet(HashSet, package=_UTIL, partial=True):
    """A set in the order of its elements."""

    __iter__ = lambda self: iter(sort(list(dict.keys(self))))
    first = lambda self: self.iterator().next()
    last = lambda self: Cursor(list(self)[::-1]).next()
    of = staticmethod(lambda *items: TreeSet(list(items)))
    noneOf = staticmethod(lambda _cls: TreeSet())
    allOf = staticmethod(lambda cls: TreeSet(cls.getEnumConstants()))


class Optional(JavaClass, package=_UTIL, others="hashCode"):
    """One value or none, which is null here."""

    _kind = "Object"

    def __init__(self, value: Any = None) -> None:
        self._value = convert(self._kind, value)

    def orElseThrow(self, make: Any = None) -> Any:
        """The value; an exception where there is none."""
        if self._value is None:
            raise make() if make else NoSuchElementException("No value present")
        return self._value

    def toString(self) -> str:
        """As Java shows it."""
        name = type(self).__name__
        return f"{name}.empty" if self._value is None else write_items([self._value], f"{name}[")

    of = classmethod(lambda cls, value: cls(require(value)))
    ofNullable = classmethod(lambda cls, value: cls(value))
    empty = classmethod(lambda cls: cls())
    get = getAsDouble = getAsInt = getAsLong = lambda self: self.orElseThrow()
    isPresent = lambda self: self._value is not None
    isEmpty = lambda self: self._value is None
    orElse = lambda self, other: other if self._value is None else self._value
    orElseGet = lambda self, make: get_or(self._value, make)
    ifPresent = lambda self, use: None if self._value is None else use(self._value) and None
    ifPresentOrElse = lambda self, use, no: no() if self._value is None else use(self._value)
    map = lambda self, change: Optional(None if self._value is None else change(self._value))
    flatMap = lambda self, change: self if self._value is None else change(self._value)
    filter = lambda self, test: self if self._value is None or test(self._value) else Optional()
    or_ = lambda self, make: make() if self._value is None else self
    stream = lambda self: make_stream([] if self._value is None else [self._value])
    equals = lambda self, other: isinstance(other, Optional) and equals(self._value, other._value)


class OptionalDouble(Optional, package=_UTIL):
    """A double or none."""

    _kind = "Double"


class OptionalInt(Optional, package=_UTIL):
    """An int or none."""

    _kind = "Integer"


def get_or(value: Any, make: Callable[[], Any]) -> Any:
    """A value; where it is null, another."""
    return make() if value is None else value


def require(value: Any, message: Any = None) -> Any:
    """A value that is not null."""
    if value is None:
        raise NullPointerException(message() if callable(message) else message)
    return value


class Random(JavaClass, package=_UTIL, partial=True):
    """Random numbers, which nobody knows."""


for _name in ("AtomicReference", "AtomicInteger", "AtomicLong", "AtomicBoolean", "AtomicDouble"):
    _text = {"__doc__": "A variable that several threads share, which nobody knows."}
    FakeType(_name, (JavaClass,), _text, package="java.util.concurrent.atomic", partial=True)


def _copy_range(array: Array, start: int, end: int) -> Array:
    STATE.tick(end - start)
    if end - start > MOST:
        raise OutOfMemoryError("Java heap space")
    rest = [default_value(array.kind)] * (end - max(start, len(array)))
    return Array([*array[start:end], *rest], array.kind)


def _deepen(item: Any) -> Any:
    return ArrayList(map(_deepen, item)) if isinstance(item, Array) else item


def _assign(items: Any, new: Iterable[Any]) -> None:
    items[:] = list(new)


def _as_list(*items: Any) -> Any:
    array = len(items) == 1 and isinstance(items[0], Array) and items[0].kind not in PRIMITIVES
    return ArrayList(items[0] if array else items)


make_statics(
    "java.util.Arrays",
    {
        "fill": lambda array, value: _assign(array, [convert(array.kind, value)] * len(array)),
        "setAll": lambda array, make: _assign(array, map(make, range(len(array)))),
        "sort": lambda array, order=None: _assign(array, sort(array, order)),
        "toString": lambda array: "null" if array is None else write_items(array),
        "deepToString": lambda array: to_string(_deepen(array)),
        "equals": lambda a, b: a is b or equals(a and ArrayList(a), b and ArrayList(b)),
        "copyOf": lambda array, length: _copy_range(array, 0, length),
        "copyOfRange": _copy_range,
        "stream": make_stream,
    },
    partial=True,
    asList=staticmethod(_as_list),
)
make_statics(
    "java.util.Collections",
    {
        "sort": lambda items, order=None: items.sort(order),
        "reverse": lambda items: _assign(items, items[::-1]),
        "max": lambda items, order=None: Cursor(sort(items, order)[::-1]).next(),
        "min": lambda items, order=None: Cursor(sort(items, order)).next(),
        "addAll": lambda items, *added: items.addAll(spread(added)),
        "emptyList": lambda: ArrayList(),
        "emptySet": lambda: HashSet(),
        "emptyMap": lambda: HashMap(),
        "singletonList": lambda item: ArrayList([item]),
        "singleton": lambda item: HashSet([item]),
        "reverseOrder": lambda order=compare: lambda a, b: order(b, a),
        "unmodifiableList": lambda items: items,
        "unmodifiableSet": lambda items: items,
        "unmodifiableMap": lambda items: items,
    },
    partial=True,
)
make_statics(
    "java.util.Objects",
    {
        "requireNonNull": require,
        "requireNonNullElse": lambda value, other: require(other) if value is None else value,
        "equals": equals,
        "hash": lambda *items: hash_items(map(hash_code, spread(items)), 1),
        "hashCode": hash_code,
        "toString": lambda value, other="null": other if value is None else to_string(value),
        "isNull": lambda value: value is None,
        "nonNull": lambda value: value is not None,
    },
    partial=True,
)
_ALIASES = {
    LinkedList: "Queue Deque ArrayDeque concurrent.ConcurrentLinkedQueue "
    "concurrent.LinkedBlockingQueue",
    ArrayList: "Vector concurrent.CopyOnWriteArrayList",
    HashMap: "LinkedHashMap Hashtable concurrent.ConcurrentHashMap concurrent.ConcurrentMap "
    "AbstractMap",
    TreeMap: "EnumMap SortedMap NavigableMap",
    HashSet: "LinkedHashSet",
    TreeSet: "EnumSet SortedSet NavigableSet",
}
JAVA.update({f"java.util.{name}": cls for cls in _ALIASES for name in _ALIASES[cls].split()})
