"""Dashboards and NetworkTables: every value has a path, and the bench can change it.

A boolean that a program reads or writes is a switch: ``WORLD.singletons["switches"]`` has each by
its path. ``WORLD.singletons["choosers"]`` has all lists to choose from, and
``WORLD.singletons["sendables"]`` what else is on a dashboard, as a command that a click starts.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from grader.robotcode.library.base import Fake, fake
from grader.robotcode.library.world import WORLD

TABLES = "edu.wpi.first.networktables org.wpilib.networktables"
BOARD = "edu.wpi.first.wpilibj.smartdashboard org.wpilib.smartdashboard"
SHUFFLEBOARD = "edu.wpi.first.wpilibj.shuffleboard"
LOGS = "edu.wpi.first.wpilibj edu.wpi.first.util.datalog org.wpilib.system org.wpilib.datalog"
ARRAYS = ("BooleanArray", "DoubleArray", "FloatArray", "NumberArray", "IntegerArray", "StringArray")
KINDS: dict[str, tuple[type, Any]] = {  # kind of value -> its type, and what stands for no value
    "Boolean": (bool, False),
    "String": (str, ""),
    **dict.fromkeys(("Double", "Float", "Number"), (float, 0.0)),
    **dict.fromkeys(("Integer", "Int", "Long"), (int, 0)),
    **dict.fromkeys((*ARRAYS, "Value", "Raw"), (object, None)),
}


@dataclass
class Switch:
    """A boolean on a dashboard.

    Args:
        defaults: what the program takes it for while nobody has set it; empty if it never reads it.
        written: what the program itself set it to.
        line: where it was first read or written.
    """

    defaults: set[bool] = field(default_factory=set)
    written: set[bool] = field(default_factory=set)
    line: int = 0


def find_switch(path: str) -> Switch:
    """The switch at a path; a new one, if the program has not used it before."""
    switches = WORLD.singletons.setdefault("switches", {})
    if path not in switches:
        switches[path] = Switch(line=WORLD.where())
    return switches[path]


def read_value(path: str, default: Any) -> Any:  # any value
    """The value at a path, or else a default."""
    if isinstance(default, bool):
        find_switch(path).defaults.add(default)
    return WORLD.network.get(path, default)


def write_value(path: str, value: Any, *, start: bool = False) -> bool:  # any value
    """Set the value at a path, from the program.

    Args:
        path: the whole path.
        value: the new value.
        start: only where there is no value yet.
    """
    if start and path in WORLD.network:
        return False
    if isinstance(value, bool):
        find_switch(path).written.add(value)
    WORLD.network[path] = value
    return True


def make_path(*names: str) -> str:
    """A whole path, of a table's and of what is in it."""
    return "/".join(one.strip("/") for one in names if one.strip("/"))


def publish(path: str, data: Any) -> None:  # a chooser, a command, a value
    """Put something on a dashboard."""
    if isinstance(data, SendableChooser):
        data._path = path  # it reads its choice from there
    elif isinstance(data, Fake):
        WORLD.singletons.setdefault("sendables", {})[path] = data
    else:
        write_value(path, data)


def add_kinds(put: str, start: str) -> Callable[[type], type]:
    """Give a class the methods for each kind of value: ``getBoolean``, ``putBoolean``.

    The class has a method ``_find``, which makes a key a whole path.

    Args:
        put: the word with which its writing methods begin: ``put`` or ``set``.
        start: the word for those that write only where there is no value yet.
    """

    def add(cls: Any) -> type:  # a class
        for kind, (of, nothing) in KINDS.items():
            for word, one in zip(("get", put, start), make_accessors(of, nothing), strict=True):
                one.__qualname__ = f"{cls.__name__}.{word}{kind}"
                setattr(cls, word + kind, classmethod(one) if hasattr(cls, "_root") else one)
        return cls

    return add


def make_accessors(of: type, nothing: Any) -> tuple[Any, ...]:  # any value
    """Methods that get, put, and put as a start, values of a type by their key."""

    def get(self: Any, key: str, default: of = nothing) -> of:
        return read_value(self._find(key), default)

    def put(self: Any, key: str, value: of) -> bool:
        return write_value(self._find(key), value)

    def start(self: Any, key: str, value: of) -> bool:
        return write_value(self._find(key), value, start=True)

    return get, put, start


@fake(BOARD, "wpilib")
@add_kinds("put", "setDefault")
class SmartDashboard(Fake):
    """The dashboard that every team has (allwpilib v2026, wpilibj/.../SmartDashboard.java)."""

    _root = "SmartDashboard"

    @classmethod
    def _find(cls, key: str) -> str:
        return make_path(cls._root, key)

    @classmethod
    def putData(cls, key: Any, data: Any = None) -> None:  # a key and data, or data only
        name, value = ("", key) if data is None else (key, data)
        publish(cls._find(name or type(value).__name__), value)

    @classmethod
    def getEntry(cls, key: str) -> "NetworkTableEntry":
        return NetworkTableEntry(cls._find(key))

    @classmethod
    def containsKey(cls, key: str) -> bool:
        return cls._find(key) in WORLD.network


@fake("edu.wpi.first.wpilibj org.wpilib.preferences", "wpilib")
@add_kinds("set", "init")
class Preferences(SmartDashboard):
    """Values that a robot keeps when it is off (allwpilib v2026, wpilibj/.../Preferences.java)."""

    _root = "Preferences"


@fake(BOARD, "wpilib", complete=True, others="close initSendable onChange")
class SendableChooser(Fake):
    """A list to choose from (allwpilib v2026, wpilibj/.../SendableChooser.java)."""

    def __init__(self) -> None:
        self._path = ""
        self._options: dict[str, Any] = {}
        self._default = ""
        self._line = WORLD.where()
        WORLD.singletons.setdefault("choosers", []).append(self)

    def addOption(self, name: str, object: Any) -> None:
        self._options[name] = object

    def setDefaultOption(self, name: str, object: Any) -> None:
        self._default = name
        self._options[name] = object

    def getSelected(self) -> Any:
        return self._options.get(WORLD.network.get(f"{self._path}/selected", self._default))


class NetworkTableEntry(Fake):
    """A value in NetworkTables, as topic, publisher, subscriber and entry (allwpilib, ntcore)."""

    def __init__(self, path: str, default: Any = None) -> None:
        self._path = path
        self._default = default

    def set(self, value: Any) -> None:
        write_value(self._path, value)

    accept = set

    def setDefault(self, value: Any) -> None:
        write_value(self._path, value, start=True)

    def subscribe(self, default: Any = None, *_options: Any) -> Any:  # of its own class
        return type(self)(self._path, default)

    getEntry = subscribe

    def publish(self, *_options: Any) -> Any:  # of its own class
        return self

    getTopic = publish


@add_kinds("put", "setDefault")
class NetworkTable(Fake):
    """A folder of values (allwpilib v2026, ntcore/.../NetworkTable.java)."""

    def __init__(self, path: str = "") -> None:
        self._path = path

    def _find(self, key: str) -> str:
        return make_path(self._path, key)

    def getEntry(self, key: str) -> NetworkTableEntry:
        return NetworkTableEntry(self._find(key))

    def getTable(self, key: str) -> "NetworkTable":
        return NetworkTable(self._find(key))

    getSubTable = getTable

    @staticmethod
    def getDefault() -> "NetworkTable":
        return NetworkTable()


class ShuffleboardTab(Fake):
    """A tab of Shuffleboard, a layout, or a widget (allwpilib v2026, .../shuffleboard)."""

    def __init__(self, path: str) -> None:
        self._path = path

    def add(self, title: Any, value: Any = None, *_more: Any) -> "ShuffleboardTab":
        name, data = ("", title) if value is None else (title, value)
        made = ShuffleboardTab(make_path(self._path, name or type(data).__name__))
        if not callable(data):
            publish(made._path, data)
        return made

    addPersistent = addBoolean = addNumber = addDouble = addInteger = addString = add

    def getLayout(self, title: str, *_how: Any) -> "ShuffleboardTab":
        return ShuffleboardTab(make_path(self._path, title))

    def getEntry(self) -> NetworkTableEntry:
        return NetworkTableEntry(self._path)

    def withWidget(self, *_how: Any) -> "ShuffleboardTab":  # how it looks
        return self

    withPosition = withSize = withProperties = withWidget

    @staticmethod
    def getTab(title: str) -> "ShuffleboardTab":
        return ShuffleboardTab(make_path("Shuffleboard", title))


def _add_entry(kind: str, of: type, nothing: Any) -> None:  # any value
    """Make the class for values of a kind, and give every entry the methods for it."""

    def get(self: Any, default: of = None) -> of:
        start = nothing if self._default is None else self._default
        return read_value(self._path, start if default is None else default)

    get.__qualname__ = f"{kind}Entry.get"
    reads = {"get": get, "getAsBoolean": get, "getAsDouble": get, "getAsLong": get}
    made = type(f"{kind}Entry", (NetworkTableEntry,), reads)
    for word in ("Topic", "Subscriber", "Publisher", "Entry"):
        fake(TABLES, "ntcore", name=kind + word)(made)

    def get_topic(self: Any, key: str) -> made:
        return made(self._find(key))

    setattr(NetworkTable, f"get{kind}Topic", get_topic)
    setattr(NetworkTableEntry, f"get{kind}", get)
    setattr(NetworkTableEntry, f"set{kind}", NetworkTableEntry.set)
    setattr(NetworkTableEntry, f"setDefault{kind}", NetworkTableEntry.setDefault)


for _kind, _of in KINDS.items():
    _add_entry(_kind, *_of)
for _name, _cls in {
    **dict.fromkeys(("NetworkTableEntry", "GenericEntry"), NetworkTableEntry),
    **dict.fromkeys(("NetworkTable", "NetworkTableInstance"), NetworkTable),
    **dict.fromkeys(("Shuffleboard", "ShuffleboardTab", "SimpleWidget"), ShuffleboardTab),
}.items():
    fake(f"{TABLES} {SHUFFLEBOARD}", "ntcore wpilib.shuffleboard", name=_name)(_cls)
for _word in ("Topic", "Subscriber", "Publisher", "Entry"):
    for _name in (f"Struct{_word}", f"StructArray{_word}"):
        fake(TABLES, "ntcore", name=_name)(type(Fake)(_name, (Fake,), {}))
for _name in ("DataLogManager", "DataLog", *(f"{kind}LogEntry" for kind in KINDS)):
    fake(LOGS, "wpilib wpiutil.log", name=_name)(type(_name, (Fake,), {}))
