"""Dashboards: every value has a path, and the bench can change it.

A boolean that a program reads or writes is a switch. What is in NetworkTables, in Shuffleboard and
in a log is unknown.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from grader.robotcode.library.base import Fake, fake
from grader.robotcode.library.world import WORLD

BOARD = "edu.wpi.first.wpilibj.smartdashboard org.wpilib.smartdashboard"
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
    if path not in WORLD.switches:
        WORLD.switches[path] = Switch(line=WORLD.where())
    return WORLD.switches[path]


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
    """The full path of an entry in a table."""
    return "/".join(one.strip("/") for one in names if one.strip("/"))


def publish(path: str, data: Any) -> None:  # a chooser, a command, a value
    """Put something on a dashboard."""
    if isinstance(data, SendableChooser):
        data._path = path  # it reads its choice from there
    elif isinstance(data, Fake):
        WORLD.sendables[path] = data
    else:
        write_value(path, data)


def add_kinds(put: str, start: str) -> Callable[[type], type]:
    """Give a class the methods for each kind of value: ``getBoolean``, ``putBoolean``.

    The class has a method ``_find_topic``, which makes a key a whole path.

    Args:
        put: the word with which its writing methods begin: ``put`` or ``set``.
        start: the word for those that write only where there is no value yet.
    """

    def add(cls: Any) -> type:  # a class
        for kind, (of, nothing) in KINDS.items():
            for word, one in zip(("get", put, start), make_accessors(of, nothing), strict=True):
                setattr(cls, word + kind, classmethod(one) if hasattr(cls, "_root") else one)
        return cls

    return add


def make_accessors(of: type, nothing: Any) -> tuple[Any, ...]:  # any value
    """Methods that get, put, and put as a start, values of a type by their key."""

    def get(self: Any, key: str, default: of = nothing) -> of:
        return read_value(self._find_topic(key), default)

    def put(self: Any, key: str, value: of) -> bool:
        return write_value(self._find_topic(key), value)

    def start(self: Any, key: str, value: of) -> bool:
        return write_value(self._find_topic(key), value, start=True)

    return get, put, start


@fake(BOARD, "wpilib")
@add_kinds("put", "setDefault")
class SmartDashboard(Fake):
    """The dashboard that every team has (allwpilib v2026, wpilibj/.../SmartDashboard.java)."""

    _root = "SmartDashboard"

    @classmethod
    def _find_topic(cls, key: str) -> str:
        return make_path(cls._root, key)

    @classmethod
    def putData(cls, key: Any, data: Any = None) -> None:  # a key and data, or data only
        name, value = ("", key) if data is None else (key, data)
        publish(cls._find_topic(name or type(value).__name__), value)


@fake("edu.wpi.first.wpilibj org.wpilib.preferences", "wpilib")
@add_kinds("set", "init")
class Preferences(SmartDashboard):
    """Values that a robot keeps when it is off (allwpilib v2026, wpilibj/.../Preferences.java)."""

    _root = "Preferences"


@fake(BOARD, "wpilib", complete=True)
class SendableChooser(Fake):
    """A list to choose from (allwpilib v2026, wpilibj/.../SendableChooser.java)."""

    def __init__(self) -> None:
        self._path = ""
        self._options: dict[str, Any] = {}
        self._default = ""
        self._line = WORLD.where()
        WORLD.choosers.append(self)

    def addOption(self, name: str, object: Any) -> None:
        self._options[name] = object

    def setDefaultOption(self, name: str, object: Any) -> None:
        self._default = name
        self._options[name] = object

    def getSelected(self) -> Any:
        return self._options.get(WORLD.network.get(f"{self._path}/selected", self._default))
