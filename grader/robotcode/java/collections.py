"""Java's collections: lists, maps, sets, queues, Optional, Random and the atomic variables.

Lists are Python lists, and everything can be gone through with ``for``; a map gives its keys.
``remove`` of a list takes a whole number for an index, never for an element. ``subList``,
``Arrays.asList`` and ``Collections.unmodifiableList`` and their like are copies.
"""

import math
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cmp_to_key, partial
from operator import ge, gt, le, lt
from typing import Any

from grader.robotcode.java.steps import ELEMENTS, STATE
from grader.robotcode.java.values import (
    PRIMITIVES,
    Array,
    ConcurrentModificationException,
    IllegalArgumentException,
    IllegalStateException,
    IndexOutOfBoundsException,
    JavaClass,
    Long,
    NoSuchElementException,
    NullPointerException,
    OutOfMemoryError,
    RuntimeException,
    UnsupportedOperationException,
    add,
    compare,
    convert,
    default_value,
    equals,
    hash_code,
    hash_items,
    make_statics,
    spread,
    to_string,
    wrap,
    write_items,
)
from grader.robotcode.library.base import JAVA

_UTIL = "java.util"
MOST = 100_000  # elements of one collection
MOVED = 2_000  # elements of a list, that cost as much time to shift as a step
FULL = 0.75  # a hash table grows when it is fuller
SMALLEST = 16  # buckets of a hash table
SEED = 20_260  # of a Random that got none
_LCG, _STATE = 0x5DEECE66D, (1 << 48) - 1  # the factor and the bits of Random's state


def counted(items: Iterable[Any]) -> Iterator[Any]:
    """Items, each of which counts as a step of the program."""
    for item in items:
        STATE.tick()
        yield item


class EmptyStackException(RuntimeException, package=_UTIL):
    """Nothing is left on a stack."""


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


class JavaIterator(JavaIterable, package=_UTIL, name="Iterator"):
    """Goes through a collection once."""

    iterator = lambda self: self
    forEachRemaining = JavaIterable.forEach


class ListIterator(JavaIterator, package=_UTIL, others="add"):
    """Goes through a collection and notices when somebody else changes it.

    Args:
        owner: the collection.
        items: its elements, or a copy of them in their order.
        cursor: index of the element that comes next.
    """

    def __init__(self, owner: Any, items: Any, cursor: int = 0) -> None:
        self._owner, self._items, self._cursor, self._last = owner, items, cursor, -1
        self._seen = owner._changes()

    def _step(self, index: int, cursor: int) -> Any:
        if self._owner._changes() != self._seen:
            raise ConcurrentModificationException
        if not 0 <= index < len(self._items):
            raise NoSuchElementException
        self._last, self._cursor = index, cursor
        return self._items[index]

    def remove(self) -> None:
        """Take out what was last seen."""
        if self._last < 0:
            raise IllegalStateException
        self._owner._discard(self._items, self._last)
        self._cursor -= self._last < self._cursor
        self._last, self._seen = -1, self._owner._changes()

    hasNext = lambda self: self._cursor != len(self._items)
    nextIndex = lambda self: self._cursor
    previousIndex = lambda self: self._cursor - 1
    next = lambda self: self._step(self._cursor, self._cursor + 1)
    hasPrevious = lambda self: self._cursor > 0
    previous = lambda self: self._step(self._cursor - 1, self._cursor - 1)
    set = lambda self, item: self._owner.set(self._last, item) and None


class Collection(JavaIterable, package=_UTIL):
    """Any collection, by means of ``_items``, ``_discard`` and ``add``."""

    _modified = 0
    _frozen = ""  # what is refused: changes of the ``size``, or ``all``

    def _modify(self, growth: int = 0) -> None:
        """Note a change of the size; refuse it where it must not be."""
        if self._frozen:
            raise UnsupportedOperationException
        if len(self) + growth > MOST:
            raise OutOfMemoryError("Java heap space")
        STATE.tick(growth + len(self) // MOVED)
        self._modified += 1

    def _freeze(self, what: str = "all") -> Any:
        self._frozen = what
        return self

    def _remove_where(self, test: Callable[..., Any], most: int = MOST) -> bool:
        items = self._items()
        STATE.tick(len(items))
        gone = [index for index, item in enumerate(items) if test(item)][:most]
        for index in reversed(gone):
            self._discard(items, index)
        return bool(gone)

    _changes = lambda self: self._modified
    iterator = lambda self: ListIterator(self, self._items())
    size = lambda self: len(self)
    isEmpty = lambda self: not len(self)
    contains = lambda self, item: any(equals(item, one) for one in counted(self._items()))
    containsAll = lambda self, items: all(self.contains(one) for one in items)
    addAll = lambda self, items: sum(self.add(one) for one in list(items)) > 0
    remove = lambda self, item: self._remove_where(partial(equals, item), 1)
    removeIf = lambda self, test: self._remove_where(test)
    removeAll = lambda self, items: self._remove_where(HashSet(items).contains)
    retainAll = lambda self, items: self._remove_where(_not_in(HashSet(items)))
    clear = lambda self: self._remove_where(lambda _: True) and None
    stream = parallelStream = lambda self: make_stream(self)
    toArray = lambda self, like=None: _make_array(self, like)
    toString = lambda self: write_items("(this Collection)" if x is self else x for x in self)


def _not_in(items: Any) -> Callable[[Any], bool]:
    return lambda item: not items.contains(item)


def _make_array(items: Iterable[Any], like: Any) -> Array:
    like = like(0) if callable(like) else like
    return Array(items, like.kind if isinstance(like, Array) else "Object")


def make_stream(items: Any) -> Any:
    """A stream of a collection or an array, of the kind that fits."""
    return JAVA["java.util.stream.Stream"].over(items)


def sort(items: Iterable[Any], comparator: Any = None) -> list[Any]:
    """Items in the order of a comparator; in their own where that is null."""
    listed = list(items)
    STATE.tick(len(listed))
    return sorted(listed, key=cmp_to_key(comparator or compare))


def _without_null(made: Collection) -> Any:
    """The same, unchangeable."""
    if made.contains(None):
        raise NullPointerException
    return made._freeze()


class List(Collection, package=_UTIL):
    """Any list, by means of its elements: one, a slice of them, and their number."""

    def _discard(self, _items: list[Any], index: int) -> Any:
        self._modify()
        item = self[index]
        del self[index]
        return item

    def _at(self, index: int, past: int = 0) -> int:
        if not 0 <= index < len(self) + past:
            known = f"Index {index} out of bounds for length {len(self)}"
            raise IndexOutOfBoundsException(f"Index: {index}, Size: {len(self)}" if past else known)
        return index

    def _assign(self, place: int | slice, value: Any) -> Any:
        if self._frozen == "all":
            raise UnsupportedOperationException
        before, self[place] = self[place], value
        return before

    def addAll(self, *place_and_items: Any) -> bool:
        """Insert elements at an index or at the end."""
        *place, items = place_and_items
        index, added = self._at(place[0], 1) if place else len(self), list(items)
        self._modify(len(added))
        self[index:index] = added
        return bool(added)

    def remove(self, item: object) -> Any:
        """Take out the element at an index, or an element."""
        return self._discard([], self._at(item)) if type(item) is int else super().remove(item)

    def subList(self, start: int, end: int) -> Any:
        """A part: a change of the one is a change of the other."""
        if not 0 <= start <= end <= len(self):
            raise IndexOutOfBoundsException(f"fromIndex: {start}, toIndex: {end}")
        return ListView(self, start, end)

    of = staticmethod(lambda *items: _without_null(ArrayList(spread(items))))
    copyOf = staticmethod(lambda items: _without_null(ArrayList(items)))
    equals = lambda self, other: (
        isinstance(other, List) and len(self) == len(other) and all(map(equals, self, other))
    )
    hashCode = lambda self: hash_items(map(hash_code, self), 1)
    _items = lambda self: self
    add = lambda self, *place_and_item: self.addAll(*place_and_item[:-1], place_and_item[-1:])
    get = lambda self, index: self[self._at(index)]
    set = lambda self, index, item: self._assign(self._at(index), item)
    clear = lambda self: self._modify() or (self._assign(slice(None), []) and None)
    indexOf = lambda self, item: _find(enumerate(self), item)
    lastIndexOf = lambda self, item: _find(reversed(list(enumerate(self))), item)
    sort = lambda self, order=None: self._assign(slice(None), sort(self, order)) and None
    replaceAll = lambda self, change: self._assign(slice(None), list(map(change, self))) and None
    listIterator = lambda self, index=0: ListIterator(self, self, index)


class ListView(List):
    """A part of a list or an array, or the whole of it where no end is given."""

    def __init__(self, source: Any, start: int = 0, end: int | None = None) -> None:
        self._source, self._start, self._end = source, start, end

    def __getitem__(self, place: int | slice) -> Any:
        return self._source[self._start : self._end][place]

    def __setitem__(self, place: int | slice, value: Any) -> None:
        items = self[:]
        items[place] = value
        self._replace(items)

    def __delitem__(self, place: int) -> None:
        items = self[:]
        del items[place]
        self._replace(items)

    def _replace(self, items: list[Any]) -> None:
        self._source[self._start : self._end] = items
        self._end = None if self._end is None else self._start + len(items)

    __len__ = lambda self: len(self[:])


class ArrayList(List, list[Any], package=_UTIL):
    """A list in an array."""

    def __init__(self, source: Any = None) -> None:
        if type(source) is int and source < 0:
            raise IllegalArgumentException(f"Illegal Capacity: {source}")
        if source is not None and type(source) is not int:
            self.addAll(source)

    clone = lambda self: type(self)(self)


def _find(items: Iterable[tuple[int, Any]], wanted: object) -> int:
    return next((index for index, item in counted(items) if equals(wanted, item)), -1)


class LinkedList(ArrayList, package=_UTIL):
    """A list with what every queue of Java's can do."""

    def _end(self, index: int, *, take: bool = False, must: bool = False) -> Any:
        if not len(self) and must:
            raise NoSuchElementException
        return (self._discard(self, index) if take else self[index]) if len(self) else None

    def remove(self, *item: object) -> Any:
        """Take out the first element, or that element, or the one at that index."""
        return super().remove(*item) if item else self.removeFirst()

    addFirst = push = lambda self, item: self.add(0, item) and None
    addLast = lambda self, item: self.add(item) and None
    offer = offerLast = lambda self, item: self.add(item)
    offerFirst = lambda self, item: self.add(0, item)
    getFirst = element = lambda self: self._end(0, must=True)
    getLast = lambda self: self._end(-1, must=True)
    removeFirst = pop = lambda self: self._end(0, take=True, must=True)  # type: ignore[assignment]
    removeLast = lambda self: self._end(-1, take=True, must=True)
    peek = peekFirst = lambda self: self._end(0)
    peekLast = lambda self: self._end(-1)
    poll = pollFirst = lambda self: self._end(0, take=True)
    pollLast = lambda self: self._end(-1, take=True)
    descendingIterator = lambda self: ArrayList(self[::-1]).iterator()


class ArrayDeque(LinkedList, package=_UTIL):
    """A queue without nulls."""

    def addAll(self, *place_and_items: Any) -> bool:
        """Insert elements at an index or at the end."""
        if any(one is None for one in place_and_items[-1]):
            raise NullPointerException
        return super().addAll(*place_and_items)


class PriorityQueue(ArrayDeque, package=_UTIL):
    """A queue in its elements' order; gone through in it, which Java does not promise."""

    def __init__(self, source: Any = None, comparator: Any = None) -> None:
        self._comparator = source if callable(source) else comparator
        super().__init__(source if isinstance(source, Collection) else None)

    def addAll(self, items: Iterable[Any]) -> bool:
        """Add elements, each at its place in the order."""
        return super().addAll(items) and not self.sort(self._comparator)


class Stack(ArrayList, package=_UTIL):
    """A stack: its top is the end of the list."""

    def peek(self) -> Any:
        """The top."""
        if not len(self):
            raise EmptyStackException
        return self[-1]

    push = lambda self, item: (self.add(item), item)[1]
    pop = lambda self: (self.peek(), self._discard(self, -1))[1]  # type: ignore[assignment]
    empty = lambda self: not len(self)


class Entry(JavaClass):
    """A key and its value; setValue changes the map that it is of."""

    _frozen = False

    def __init__(self, key: Any, value: Any) -> None:
        self._key, self._value = key, value

    def setValue(self, value: object) -> Any:
        """Store another value; return the one before."""
        if self._frozen:
            raise UnsupportedOperationException
        before, self._value = self._value, value
        return before

    getKey = lambda self: self._key
    getValue = lambda self: self._value
    equals = lambda self, other: (
        isinstance(other, Entry)
        and all(map(equals, (self._key, self._value), (other._key, other._value)))
    )
    hashCode = lambda self: hash_code(self._key) ^ hash_code(self._value)
    toString = lambda self: write_items([self._key], "", "=") + write_items([self._value], "", "")
    comparingByKey = staticmethod(lambda order=compare: lambda a, b: order(a.getKey(), b.getKey()))
    comparingByValue = staticmethod(
        lambda order=compare: lambda a, b: order(a.getValue(), b.getValue())
    )


class _Key:
    """A key of a map as Python's dict needs it: equal and hashed as Java does."""

    __slots__ = ("_hash", "value")

    def __init__(self, value: object) -> None:
        self.value, self._hash = value, hash_code(value)

    def __hash__(self) -> int:
        return self._hash

    def __eq__(self, other: object) -> bool:
        return type(other) is _Key and bool(equals(self.value, other.value))


class Map(JavaClass, package=_UTIL):
    """Any map."""

    Entry = SimpleEntry = Entry
    of = staticmethod(lambda *parts: _map_of(zip(parts[::2], parts[1::2], strict=True)))
    entry = staticmethod(Entry)
    ofEntries = staticmethod(lambda *entries: _map_of((e._key, e._value) for e in spread(entries)))
    copyOf = staticmethod(lambda other: _map_of((key, other[key]) for key in other))


def _map_of(pairs: Iterable[tuple[Any, Any]], what: str = "key") -> Any:
    made = LinkedHashMap()
    for key, value in pairs:
        if key is None or value is None:
            raise NullPointerException
        if key in made:
            raise IllegalArgumentException(f"duplicate {what}: {to_string(key)}")
        made.put(key, value)
    return made._freeze()


def _count_buckets(wanted: int) -> int:
    """Buckets of a hash table that is made for that many: a power of two."""
    return 1 << max(wanted - 1, 0).bit_length()


class HashMap(Map, package=_UTIL):
    """A map, gone through in Java's order: by buckets, each in the order of arrival."""

    _frozen = False

    def __init__(self, source: Any = None, _full: float = FULL) -> None:
        self._entries: dict[Any, Entry] = {}
        self._modified = 0
        self._order: tuple[int, list[Entry]] = (-1, [])
        self._buckets = _count_buckets(source) if isinstance(source, int) else 0
        if isinstance(source, Mapping):
            self.putAll(source)

    def __getitem__(self, key: object) -> Any:
        if key not in self:
            raise KeyError(key)
        return self.get(key)

    def _sort(self, entries: list[Entry]) -> list[Entry]:
        def bucket(entry: Entry) -> int:
            code = hash_code(entry._key) & 0xFFFFFFFF
            return (code ^ code >> 16) & (self._buckets - 1)

        return sorted(entries, key=bucket)

    def _items(self) -> list[Entry]:
        """The entries in their order."""
        STATE.tick(len(self) // ELEMENTS)
        if self._order[0] != self._modified:
            self._order = self._modified, self._sort(list(self._entries.values()))
        return list(self._order[1])

    def _modify(self, growth: int = 0) -> None:
        if self._frozen:
            raise UnsupportedOperationException
        if len(self) + growth > MOST:
            raise OutOfMemoryError("Java heap space")
        STATE.tick(growth + len(self) // MOVED)
        self._modified += 1

    def _freeze(self) -> Any:
        self._frozen = True
        for one in self._entries.values():
            one._frozen = True
        return self

    def put(self, key: object, value: object) -> Any:
        """Store a value under a key; return the one before."""
        place = self._place(key)
        if place in self._entries:
            return self._entries[place].setValue(value)
        self._modify(1)
        self._entries[place] = Entry(key, value)
        self._buckets = self._buckets or SMALLEST
        if len(self) > FULL * self._buckets:
            self._buckets *= 2
        return None

    def putAll(self, other: Any) -> None:
        """Store all that another map has."""
        if not len(self):
            self._buckets = max(self._buckets, _count_buckets(int(len(other) / FULL + 1)))
        for key in other:
            self.put(key, other[key])

    def remove(self, key: object, *value: object) -> Any:
        """Take out a key, or only if it has that value."""
        entry = self._find(key)
        if entry is None or (value and not equals(entry._value, value[0])):
            return False if value else None
        place = self._place(key)
        self._modify()
        del self._entries[place]
        return True if value else entry._value

    def compute(self, key: object, change: Callable[..., Any]) -> Any:
        """Store what a function makes of key and value; take the key out if that is null."""
        value = change(key, self.get(key))
        if value is None:
            self.remove(key)
        else:
            self.put(key, value)
        return value

    def replaceAll(self, change: Callable[..., Any]) -> None:
        """Store what a function makes of each key and value."""
        for one in self._items():
            one.setValue(change(one._key, one._value))

    __len__ = size = lambda self: len(self._entries)
    __iter__ = lambda self: iter(self.keySet())
    __contains__ = containsKey = lambda self, key: self._find(key) is not None
    _place = lambda self, key: key if type(key) is str else _Key(key)
    _find = lambda self, key: self._entries.get(self._place(key))
    _changes = lambda self: self._modified
    isEmpty = lambda self: not self._entries
    get = lambda self, key: getattr(self._find(key), "_value", None)
    getOrDefault = lambda self, key, other: getattr(self._find(key), "_value", other)
    containsValue = lambda self, value: self.values().contains(value)
    clear = lambda self: self._modify() or self._entries.clear()
    putIfAbsent = lambda self, key, value: get_or(self.get(key), lambda: self.put(key, value))
    replace = lambda self, key, value: self.put(key, value) if key in self else None
    computeIfAbsent = lambda self, key, make: get_or(
        self.get(key), lambda: self.compute(key, lambda key, _: make(key))
    )
    computeIfPresent = lambda self, key, change: (
        None if self.get(key) is None else self.compute(key, change)
    )
    merge = lambda self, key, value, join: self.compute(
        key, lambda _, before: value if before is None else join(before, value)
    )
    forEach = lambda self, action: self.entrySet().forEach(lambda one: action(one._key, one._value))
    keySet = navigableKeySet = lambda self: MapKeys(self)
    values = lambda self: MapView(self, Entry.getValue)
    entrySet = lambda self: Set(self, lambda one: one)
    equals = lambda self, other: (
        isinstance(other, HashMap) and self.entrySet().equals(other.entrySet())
    )
    hashCode = lambda self: self.entrySet().hashCode()
    toString = lambda self: write_items(self._items(), "{", "}")
    clone = lambda self: type(self)(self)


Mapping.register(HashMap)


def get_or(value: Any, make: Callable[[], Any]) -> Any:
    """A value; where it is null, another."""
    return make() if value is None else value


class LinkedHashMap(HashMap, package=_UTIL):
    """A map in the order of arrival."""

    _sort = lambda self, entries: entries


class TreeMap(HashMap, package=_UTIL):
    """A map in the order of its keys; its parts are copies."""

    def __init__(self, source: Any = None) -> None:
        ordered = callable(source) and not isinstance(source, Mapping | type)
        self._comparator = source if ordered else compare
        super().__init__(source)

    def _place(self, key: object) -> Any:
        """The key that is neither before nor after; the comparator refuses what has no order."""
        self._comparator(key, key)
        near = self._near(ge, key)
        return _Key(near._key if near and self._comparator(near._key, key) == 0 else key)

    def _near(self, test: Callable[..., Any], key: object) -> Any:
        """The nearest entry before or after a key."""
        items = self._items()
        side = bisect_left if test in (ge, lt) else bisect_right
        place = side(items, 0, key=lambda one: self._comparator(one._key, key))
        place -= test in (lt, le)
        return items[place] if 0 <= place < len(items) else None

    def _poll(self, index: int) -> Any:
        entry = self._items()[index] if len(self) else None
        if entry is not None:
            self.remove(entry._key)
        return entry

    def _part(self, *tests: tuple[Callable[..., bool], object]) -> Any:
        """A copy of the entries whose keys pass all tests."""
        made = type(self)(self._comparator)
        for one in self._items():
            if all(test(self._comparator(one._key, key), 0) for test, key in tests):
                made.put(one._key, one._value)
        return made

    def descendingMap(self) -> Any:
        """A copy in the opposite order."""
        made = TreeMap(lambda a, b: self._comparator(b, a))
        made.putAll(self)
        return made

    def _edge(self, index: int) -> Any:
        if not len(self):
            raise NoSuchElementException
        return self._items()[index]._key

    _sort = lambda self, entries: sort(entries, lambda a, b: self._comparator(a._key, b._key))
    firstKey = lambda self: self._edge(0)
    lastKey = lambda self: self._edge(-1)
    firstEntry = lambda self: next(iter(self._items()), None)
    lastEntry = lambda self: next(reversed(self._items()), None)
    floorEntry = lambda self, key: self._near(le, key)
    lowerEntry = lambda self, key: self._near(lt, key)
    ceilingEntry = lambda self, key: self._near(ge, key)
    higherEntry = lambda self, key: self._near(gt, key)
    floorKey = lambda self, key: _key_of(self._near(le, key))
    lowerKey = lambda self, key: _key_of(self._near(lt, key))
    ceilingKey = lambda self, key: _key_of(self._near(ge, key))
    higherKey = lambda self, key: _key_of(self._near(gt, key))
    pollFirstEntry = lambda self: self._poll(0)
    pollLastEntry = lambda self: self._poll(-1)
    headMap = lambda self, end, also=False: self._part((le if also else lt, end))
    tailMap = lambda self, start, also=True: self._part((ge if also else gt, start))
    subMap = lambda self, start, end: self._part((ge, start), (lt, end))
    descendingKeySet = lambda self: self.descendingMap().keySet()


def _key_of(entry: Entry | None) -> Any:
    return None if entry is None else entry._key


class EnumMap(TreeMap, package=_UTIL):
    """A map in the order of an enum's constants."""

    def __init__(self, source: Any = None) -> None:
        super().__init__(source if isinstance(source, Mapping) else None)


class MapView(Collection):
    """What a map shows of its entries: a change of the one is a change of the other."""

    def __init__(self, shown: Any, show: Callable[[Entry], Any]) -> None:
        self._map, self._show = shown, show

    def _discard(self, items: list[Any], index: int) -> None:
        items.pop(index)
        self._map.remove(self._map._items()[index]._key)

    __len__ = lambda self: len(self._map)
    _changes = lambda self: self._map._modified
    _items = lambda self: list(map(self._show, self._map._items()))


class Set(MapView, package=_UTIL):
    """Any set."""

    of = staticmethod(
        lambda *items: HashSet._over(_map_of([(x, True) for x in spread(items)], "element"))
    )
    copyOf = staticmethod(lambda items: Set.of(*LinkedHashSet(items)))
    equals = lambda self, other: (
        isinstance(other, Set) and len(self) == len(other) and self.containsAll(other)
    )
    hashCode = lambda self: wrap(sum(map(hash_code, self)))


class MapKeys(Set):
    """Map.keySet()."""

    def __init__(self, shown: Any) -> None:
        super().__init__(shown, _key_of)

    contains = lambda self, item: item in self._map
    remove = lambda self, item: item in self._map and self._map.remove(item) is not None


class HashSet(MapKeys, package=_UTIL):
    """A set: the keys of a map."""

    _backing: type = HashMap

    def __init__(self, source: Any = None, _full: float = FULL) -> None:
        several = isinstance(source, Collection | list | tuple | Mapping)
        size = max(int(len(source) / FULL) + 1, SMALLEST) if several else source
        super().__init__(self._backing(size))
        if several:
            self.addAll(source)

    @classmethod
    def _over(cls, shown: HashMap) -> Any:
        made = cls()
        made._map = shown
        return made

    add = lambda self, item: self._map.put(item, item) is None
    clone = lambda self: type(self)(self)


class LinkedHashSet(HashSet, package=_UTIL):
    """A set in the order of arrival."""

    _backing = LinkedHashMap


class TreeSet(HashSet, package=_UTIL):
    """A set in the order of its elements; its parts are copies."""

    _backing = TreeMap
    first = lambda self: self._map.firstKey()
    last = lambda self: self._map.lastKey()
    floor = lambda self, item: self._map.floorKey(item)
    lower = lambda self, item: self._map.lowerKey(item)
    ceiling = lambda self, item: self._map.ceilingKey(item)
    higher = lambda self, item: self._map.higherKey(item)
    pollFirst = lambda self: _key_of(self._map.pollFirstEntry())
    pollLast = lambda self: _key_of(self._map.pollLastEntry())
    headSet = lambda self, *bound: TreeSet._over(self._map.headMap(*bound))
    tailSet = lambda self, *bound: TreeSet._over(self._map.tailMap(*bound))
    subSet = lambda self, *bounds: TreeSet._over(self._map.subMap(*bounds))
    descendingSet = lambda self: TreeSet._over(self._map.descendingMap())
    descendingIterator = lambda self: self.descendingSet().iterator()


class EnumSet(TreeSet, package=_UTIL):
    """A set in the order of an enum's constants."""

    of = staticmethod(lambda *items: EnumSet(items))
    copyOf = staticmethod(lambda items: EnumSet(list(items)))
    noneOf = staticmethod(lambda _cls: EnumSet())
    allOf = staticmethod(lambda cls: EnumSet(cls.getEnumConstants()))
    complementOf = staticmethod(lambda those: EnumSet(_constants(those, those.contains)))
    range = staticmethod(
        lambda a, b: EnumSet(_constants([a], lambda x: compare(x, a) < 0 or compare(b, x) < 0))
    )


def _constants(like: Iterable[Any], without: Callable[[Any], bool]) -> list[Any]:
    """The constants of the enum that has some constant, but for some of them."""
    kind = next((type(one) for one in like), None)
    every = JAVA["java.lang.Class"].of(kind).getEnumConstants() if kind is not None else []
    return [one for one in every if not without(one)]


class Optional(JavaClass, package=_UTIL):
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
    hashCode = lambda self: hash_code(self._value)


def require(value: Any, message: Any = None) -> Any:
    """A value that is not null."""
    if value is None:
        raise NullPointerException(message() if callable(message) else message)
    return value


class OptionalDouble(Optional, package=_UTIL):
    """A double or none."""

    _kind = "Double"


class OptionalInt(Optional, package=_UTIL):
    """An int or none."""

    _kind = "Integer"


class OptionalLong(Optional, package=_UTIL):
    """A long or none."""

    _kind = "Long"


class Random(JavaClass, package=_UTIL):
    """Java's own random numbers for a seed, and always the same without one."""

    def __init__(self, seed: int = SEED) -> None:
        self.setSeed(seed)

    def setSeed(self, seed: int) -> None:
        """Start anew."""
        self._state, self._spare = (seed ^ _LCG) & _STATE, None

    def _next(self, bits: int) -> int:
        self._state = (self._state * _LCG + 0xB) & _STATE
        return wrap(self._state >> (48 - bits))

    def nextInt(self, *bounds: int) -> int:
        """A whole number, below a bound or between two."""
        start, size = bounds[0] if bounds[1:] else 0, bounds[-1] if bounds else 0
        if not bounds:
            return self._next(32)
        if size <= start:
            raise IllegalArgumentException("bound must be positive")
        size -= start
        drawn = self._next(31)
        if size & (size - 1) == 0:
            return start + (size * drawn >> 31)
        while drawn - drawn % size + size - 1 >= 1 << 31:
            drawn = self._next(31)
        return start + drawn % size

    def nextGaussian(self) -> float:
        """A normally distributed number."""
        value, self._spare = self._spare, None
        square = 0.0
        while value is None and not 0 < square < 1:
            first, second = (2 * self.nextDouble() - 1 for _ in range(2))
            square = first * first + second * second
        if value is None:
            scale = math.sqrt(-2 * math.log(square) / square)
            value, self._spare = first * scale, second * scale
        return value

    nextLong = lambda self: Long((self._next(32) << 32) + self._next(32))
    nextBoolean = lambda self: self._next(1) != 0
    nextDouble = lambda self: ((self._next(26) << 27) + self._next(27)) * 2.0**-53


_ATOMIC = "java.util.concurrent.atomic"


class AtomicReference(JavaClass, package=_ATOMIC, others="accumulateAndGet getPlain"):
    """A variable that several threads share."""

    _start: Any = None

    def __init__(self, value: Any = None) -> None:
        self._value = self._start if value is None else value

    def _change(self, change: Callable[[Any], Any]) -> tuple[Any, Any]:
        """Change the value; return it before and after."""
        before, self._value = self._value, change(self._value)
        return before, self._value

    def compareAndSet(self, expected: object, value: object) -> bool:
        """Change the value if it is the expected one; return whether it was."""
        alike = bool(equals(self._value, expected))
        self._value = value if alike else self._value
        return alike

    get = intValue = lambda self: self._value
    set = lazySet = lambda self, value: self._change(lambda _: value) and None
    getAndSet = lambda self, value: self._change(lambda _: value)[0]
    getAndUpdate = lambda self, change: self._change(change)[0]
    updateAndGet = lambda self, change: self._change(change)[1]
    getAndAdd = lambda self, more: self._change(partial(add, more))[0]
    addAndGet = lambda self, more: self._change(partial(add, more))[1]
    getAndIncrement = lambda self: self.getAndAdd(1)
    incrementAndGet = lambda self: self.addAndGet(1)
    getAndDecrement = lambda self: self.getAndAdd(-1)
    decrementAndGet = lambda self: self.addAndGet(-1)
    toString = lambda self: write_items([self._value], "", "")


class AtomicInteger(AtomicReference, package=_ATOMIC):
    """The same for an int."""

    _start = 0


class AtomicLong(AtomicReference, package=_ATOMIC):
    """The same for a long."""

    _start = Long()


class AtomicBoolean(AtomicReference, package=_ATOMIC):
    """The same for a boolean."""

    _start = False


def _copy_range(array: Array, start: int, end: int) -> Array:
    if end - start > MOST:
        raise OutOfMemoryError("Java heap space")
    STATE.tick((end - start) // ELEMENTS)
    rest = [default_value(array.kind)] * (end - max(start, len(array)))
    return Array([*array[start:end], *rest], array.kind)


def _fill(array: Array, *place_and_value: Any) -> None:
    *place, value = place_and_value
    start, end = place or (0, len(array))
    STATE.tick((end - start) // ELEMENTS)
    array[start:end] = [convert(array.kind, value)] * (end - start)


def _sort_array(array: Array, *where_and_order: Any) -> None:
    part = slice(*([one for one in where_and_order if isinstance(one, int)] or (None,)))
    array[part] = sort(array[part], where_and_order[-1] if len(where_and_order) % 2 else None)


def _search(items: Any, wanted: object, order: Any = compare) -> int:
    place = bisect_left(items, 0, key=lambda one: order(one, wanted))
    return place if place < len(items) and order(items[place], wanted) == 0 else -place - 1


def _deepen(item: Any) -> Any:
    return ArrayList(map(_deepen, item)) if isinstance(item, Array) else item


def _assign(items: Any, values: Iterable[Any]) -> None:
    items[:] = list(values)


def _as_list(*items: Any) -> Any:
    array = len(items) == 1 and isinstance(items[0], Array) and items[0].kind not in PRIMITIVES
    return (ListView(items[0]) if array else ArrayList(items))._freeze("size")


make_statics(
    "java.util.Arrays",
    {
        "fill": _fill,
        "setAll": lambda array, make: _assign(array, map(make, range(len(array)))),
        "sort": _sort_array,
        "toString": lambda array: "null" if array is None else write_items(array),
        "deepToString": lambda array: to_string(_deepen(array)),
        "equals": lambda a, b: a is b or equals(a and ArrayList(a), b and ArrayList(b)),
        "deepEquals": lambda a, b: equals(_deepen(a), _deepen(b)),
        "hashCode": lambda array: hash_items(map(hash_code, array), 1),
        "copyOf": lambda array, length: _copy_range(array, 0, length),
        "copyOfRange": _copy_range,
        "binarySearch": _search,
        "stream": lambda array, *part: make_stream(
            Array(array[slice(*part or (None,))], array.kind)
        ),
    },
    asList=staticmethod(_as_list),
)


def _repeat(count: int, item: object) -> ArrayList:
    if count > MOST:
        raise OutOfMemoryError("Java heap space")
    return ArrayList([item] * count)._freeze()


def _find_extreme(items: Collection, order: Any, index: int) -> Any:
    if not len(items):
        raise NoSuchElementException
    return sort(items, order)[index]


def _freeze_map(source: Any) -> Any:
    made = LinkedHashMap()
    made.putAll(source)
    return made._freeze()


make_statics(
    "java.util.Collections",
    {
        "sort": lambda items, order=None: items.sort(order),
        "reverse": lambda items: _assign(items, items[::-1]),
        "swap": lambda items, i, k: items.set(i, items.set(k, items.get(i))) and None,
        "max": lambda items, order=None: _find_extreme(items, order, -1),
        "min": lambda items, order=None: _find_extreme(items, order, 0),
        "disjoint": lambda a, b: not any(map(b.contains, a)),
        "fill": lambda items, value: items.replaceAll(lambda _: value),
        "frequency": lambda items, wanted: sum(bool(equals(wanted, one)) for one in items),
        "nCopies": _repeat,
        "addAll": lambda items, *added: items.addAll(spread(added)),
        "emptyList": lambda: ArrayList()._freeze(),
        "emptySet": lambda: Set.of(),
        "emptyMap": lambda: Map.of(),
        "singletonList": lambda item: ArrayList([item])._freeze(),
        "singleton": lambda item: Set.of(item),
        "reverseOrder": lambda order=compare: lambda a, b: order(b, a),
        "unmodifiableList": lambda items: ListView(items)._freeze(),
        "unmodifiableCollection": lambda items: ArrayList(items)._freeze(),
        "unmodifiableSet": lambda items: HashSet._over(_freeze_map(items._map)),
        "unmodifiableMap": _freeze_map,
    },
)
make_statics(
    "java.util.Objects",
    {
        "requireNonNull": require,
        "requireNonNullElse": lambda value, other: require(other) if value is None else value,
        "requireNonNullElseGet": get_or,
        "equals": equals,
        "hash": lambda *items: hash_items(map(hash_code, spread(items)), 1),
        "hashCode": hash_code,
        "toString": lambda value, other="null": other if value is None else to_string(value),
        "isNull": lambda value: value is None,
        "nonNull": lambda value: value is not None,
        "compare": lambda a, b, order: 0 if a is b else order(a, b),
    },
)
_ALIASES = {
    LinkedList: "Queue Deque concurrent.ConcurrentLinkedQueue concurrent.LinkedBlockingQueue",
    ArrayList: "Vector concurrent.CopyOnWriteArrayList",
    HashMap: "Hashtable concurrent.ConcurrentHashMap concurrent.ConcurrentMap",
    TreeMap: "SortedMap NavigableMap concurrent.ConcurrentSkipListMap",
    TreeSet: "SortedSet NavigableSet",
    Map: "AbstractMap",
}
JAVA.update({f"java.util.{name}": cls for cls in _ALIASES for name in _ALIASES[cls].split()})
