"""Java's collections and Optional, as far as robot code uses them; what others hold is unknown.

They are Python's: a List is a ``list``, a Map and a Set are a ``dict``, under Java's names. What
Java hands out as a view (``keySet``, ``subList``) is a copy, and nothing refuses to be changed.
"""

# mypy: disable-error-code="assignment, func-returns-value, arg-type"
from collections.abc import Callable, Iterable, Iterator
from functools import cmp_to_key
from typing import Any

from grader.robotcode.java.steps import STATE, refuse
from grader.robotcode.java.values import (
    NAMES,
    PRIMITIVES,
    Array,
    IndexOutOfBoundsException,
    JavaClass,
    NoSuchElementException,
    NullPointerException,
    OutOfMemoryError,
    compare,
    convert,
    equals,
    make_statics,
    spread,
    to_string,
    write_items,
)
from grader.robotcode.library.base import JAVA, Unknown, add_named_classes

_UTIL = "java.util"
MOST = 100_000  # elements of one collection


def counted(items: Iterable[Any]) -> Iterator[Any]:
    """Items, each of which counts as a step of the program."""
    for item in items:
        STATE.tick()
        yield item


def sort(items: Iterable[Any], comparator: Any = None) -> list[Any]:
    """Items in the order of a comparator, unknown with one; in their own where that is null."""
    if type(comparator) is Unknown:
        return shuffle(items)
    return sorted(counted(items), key=cmp_to_key(comparator or compare))


def shuffle(items: Iterable[Any]) -> list[Any]:
    """Items in an unknown order."""
    return [Unknown("an item in an unknown order") for _ in items]


def make_stream(items: Any) -> Any:
    """A stream of a collection or an array, of the kind that fits."""
    return JAVA["java.util.stream.Stream"].over(items)


class JavaIterable(JavaClass, package="java.lang", name="Iterable", partial=True):
    """A value that a for-each loop can iterate over."""

    def forEach(self, action: Callable[..., Any]) -> None:
        """Call something with every element."""
        for item in self:  # what derives from it has elements
            action(item)


class Collection(JavaIterable, package=_UTIL, others="spliterator hashCode iterator"):
    """Any collection, by means of its length, its elements, ``add`` and ``_replace``."""

    def _check_growth(self, count: int) -> None:
        STATE.tick(count)
        if len(self) + count > MOST:
            raise OutOfMemoryError("Java heap space")

    def _keep_passing(self, test: Callable[[Any], Any]) -> bool:
        """Keep the elements that pass a test; return whether that changed anything."""
        kept = [one for one in counted(self) if test(one)]
        changed = len(kept) < len(self)
        self._replace(kept)
        return changed

    def remove(self, item: object) -> Any:
        """Take out the first element that equals an object; return whether there was one."""
        gone: list[Any] = []
        return self._keep_passing(lambda one: gone or not equals(item, one) or gone.append(one))

    size = lambda self: len(self)
    isEmpty = lambda self: not len(self)
    contains = lambda self, item: any(equals(item, one) for one in counted(self))
    containsAll = lambda self, items: all(self.contains(one) for one in items)
    addAll = lambda self, items: sum(bool(self.add(one)) for one in list(items)) > 0
    removeIf = lambda self, test: self._keep_passing(lambda one: not test(one))
    removeAll = lambda self, items: self._keep_passing(lambda one: not items.contains(one))
    retainAll = lambda self, items: self._keep_passing(items.contains)
    clear = lambda self: self._replace([])
    stream = parallelStream = lambda self: make_stream(self)
    toArray = lambda self, like=None: Array(self, getattr(like, "kind", "Object"))
    toString = lambda self: write_items(self)


class List(Collection, list[Any], package=_UTIL, others="listIterator"):
    """A list."""

    def __init__(self, source: Any = None) -> None:
        if source is not None and type(source) is not int:
            self.addAll(source)

    def _check_index(self, index: int) -> int:
        if not 0 <= index < len(self):
            raise IndexOutOfBoundsException(f"Index {index} out of bounds for length {len(self)}")
        return index

    def _replace(self, items: Iterable[Any]) -> None:
        self[:] = list(items)

    def _put(self, index: int, item: Any) -> Any:
        before, self[index] = self[self._check_index(index)], item
        return before

    def addAll(self, *place_and_items: Any) -> bool:
        """Insert elements at an index or at the end."""
        *place, items = place_and_items
        added = list(items)
        self._check_growth(len(added))
        index = place[0] if place else len(self)
        if not 0 <= index <= len(self):
            raise IndexOutOfBoundsException(f"Index: {index}, Size: {len(self)}")
        self[index:index] = added
        return bool(added)

    def remove(self, item: object) -> Any:
        """Take out the element at an index, or an element."""
        if type(item) is not int:
            return Collection.remove(self, item)
        if any(type(one) is int for one in self):
            refuse("remove() of a list of numbers")  # an index, or one of them
        return list.pop(self, self._check_index(item))

    def indexOf(self, wanted: object) -> int:
        """The first place of an element, -1 if there is none."""
        found = (at for at, item in enumerate(counted(self)) if equals(wanted, item))
        return next(found, -1)

    __iter__ = list.__iter__
    __hash__ = object.__hash__
    of = staticmethod(lambda *items: ArrayList(spread(items)))
    copyOf = staticmethod(lambda items: ArrayList(items))
    equals = lambda self, other: (
        isinstance(other, List) and len(self) == len(other) and all(map(equals, self, other))
    )
    add = lambda self, *place_and_item: self.addAll(*place_and_item[:-1], place_and_item[-1:])
    get = lambda self, index: self[self._check_index(index)]
    set = lambda self, index, item: self._put(index, item)
    sort = lambda self, order=None: self._replace(sort(self, order))
    replaceAll = lambda self, change: self._replace(map(change, list(self)))
    subList = lambda self, start, end: ArrayList(self[start:end])


class ArrayList(List, package=_UTIL, others="ensureCapacity trimToSize clone lastIndexOf"):
    """A list in an array."""


class Entry(JavaClass, partial=True):
    """A key and its value."""

    def __init__(self, key: Any, value: Any) -> None:
        self._key, self._value = key, value

    getKey = lambda self: self._key
    getValue = lambda self: self._value


class Map(JavaClass, dict[Any, Any], package=_UTIL, others="hashCode clone toString equals"):
    """A map, in the order in which its keys came."""

    Entry = Entry

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
    remove = lambda self, key: dict.pop(self, key, None)
    putIfAbsent = lambda self, key, value: get_or(self.get(key), lambda: self.put(key, value))
    computeIfAbsent = lambda self, key, make: get_or(
        self.get(key), lambda: [made := make(key), self.put(key, made)][0]
    )
    compute = computeIfPresent = merge = replace = lambda self, key, *_how: [
        self.put(key, Unknown("a changed value of a map")),
        self[key],
    ][1]
    replaceAll = lambda self, _change: self.update(dict.fromkeys(self, Unknown("a changed value")))
    forEach = lambda self, action: [action(key, self[key]) for key in list(self)] and None
    keySet = lambda self: Set(list(self))
    values = lambda self: ArrayList([self[key] for key in self])
    entrySet = lambda self: ArrayList([Entry(key, self[key]) for key in self])


class HashMap(Map, package=_UTIL):
    """A map."""


class Set(Collection, dict[Any, None], package=_UTIL, others="clone"):
    """A set, in the order in which its elements came."""

    def __init__(self, source: Any = None, *_size: Any) -> None:
        if isinstance(source, list | tuple | dict):
            self.addAll(source)

    def add(self, item: object) -> bool:
        """Add an element; return whether it is new."""
        self._check_growth(1)
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


class HashSet(Set, package=_UTIL):
    """A set."""


class Optional(JavaClass, package=_UTIL, others="hashCode toString"):
    """One value or none, which is null here."""

    def __init__(self, value: Any = None) -> None:
        self._value = value

    def orElseThrow(self, make: Any = None) -> Any:
        """The value; an exception where there is none."""
        if self._value is None:
            raise make() if make else NoSuchElementException("No value present")
        return self._value

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


def get_or(value: Any, make: Callable[[], Any]) -> Any:
    """A value; where it is null, another."""
    return make() if value is None else value


def require(value: Any, message: Any = None) -> Any:
    """A value that is not null."""
    if value is None:
        raise NullPointerException(message() if callable(message) else message)
    return value


def _assign(items: Any, new: Iterable[Any]) -> None:
    items[:] = list(new)


def _as_list(*items: Any) -> Any:
    array = len(items) == 1 and isinstance(items[0], Array) and items[0].kind not in PRIMITIVES
    return ArrayList(items[0] if array else items)


make_statics(
    "java.util.Arrays",
    {
        "toString": lambda array: "null" if array is None else write_items(array),
        "stream": make_stream,
    },
    partial=True,
    asList=staticmethod(_as_list),
    fill=staticmethod(
        lambda array, value: _assign(array, [convert(array.kind, value)] * len(array))
    ),
    setAll=staticmethod(lambda array, make: _assign(array, map(make, range(len(array))))),
    sort=staticmethod(lambda array, order=None: _assign(array, sort(array, order))),
)
make_statics(
    "java.util.Collections",
    {
        "reverse": lambda items: _assign(items, items[::-1]),
        "addAll": lambda items, *added: items.addAll(spread(added)),
        "emptyList": lambda: ArrayList(),
        "unmodifiableList": lambda items: items,
        **dict.fromkeys(
            ("shuffle", "swap", "rotate"), lambda items, *_how: _assign(items, shuffle(items))
        ),
    },
    partial=True,
    sort=staticmethod(lambda items, order=None: items.sort(order)),
)
make_statics(
    "java.util.Objects",
    {
        "requireNonNull": require,
        "requireNonNullElse": lambda value, other: require(other) if value is None else value,
        "equals": equals,
        "toString": lambda value, other="null": other if value is None else to_string(value),
        "isNull": lambda value: value is None,
        "nonNull": lambda value: value is not None,
    },
    partial=True,
)
_ALIASES = {
    ArrayList: "Vector concurrent.CopyOnWriteArrayList",
    HashMap: "LinkedHashMap EnumMap Hashtable concurrent.ConcurrentHashMap "
    "concurrent.ConcurrentMap AbstractMap",
    HashSet: "LinkedHashSet",
    Optional: "OptionalDouble OptionalInt OptionalLong",
}
JAVA.update({f"java.util.{name}": cls for cls in _ALIASES for name in _ALIASES[cls].split()})


class _Opaque(JavaClass):
    """A container with unknown content."""

    forEach = lambda self, _action: refuse(f"forEach() of a {type(self).__name__}")


add_named_classes(NAMES["holders"], _Opaque)
