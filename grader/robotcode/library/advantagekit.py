"""AdvantageKit (v26): the Logger, and values and lists on a dashboard.

Source: https://github.com/Mechanical-Advantage/AdvantageKit, akit/src/main/java/.
"""

from typing import Any

from grader.robotcode.library.base import Fake, fake
from grader.robotcode.library.dashboard import SendableChooser, make_path, read_value, write_value
from grader.robotcode.library.station import TimedRobot
from grader.robotcode.library.world import WORLD

JUNCTION = "org.littletonrobotics.junction"
MICROSECONDS = 1e6  # in a second


@fake(
    JUNCTION,
    "pykit.logger",
    complete=True,
    others="addDataReceiver registerDashboardInput registerURCL setReplaySource start end "
    "disableDeterministicTimestamps disableConsoleCapture recordMetadata processInputs "
    "hasReplaySource getReceiverQueueFault runEveryN getRealTimestamp AdvancedHooks",
)
class Logger(Fake):
    """Writes values into the log (.../junction/Logger.java). All of them are kept as outputs."""

    @staticmethod
    def recordOutput(key: str, value: Any, *_more: Any) -> None:
        WORLD.singletons.setdefault("outputs", []).append((key, value, WORLD.time))

    @staticmethod
    def getTimestamp() -> int:
        return int(WORLD.time * MICROSECONDS)


class NetworkValue(Fake):
    """A value that a dashboard may change (.../junction/networktables/)."""

    _root = ""
    _nothing: Any = 0.0

    def __init__(self, key: str, defaultValue: Any = None) -> None:
        self._path = make_path(self._root, key)
        self._default = self._nothing if defaultValue is None else defaultValue

    def get(self) -> Any:
        return read_value(self._path, self._default)

    def set(self, value: Any) -> None:
        write_value(self._path, value)

    def setDefault(self, value: Any) -> None:
        self._default = value

    getAsDouble = getAsBoolean = get


for _kind, _nothing in (("Number", 0.0), ("Boolean", False), ("String", "")):
    for _place, _root in (("Network", ""), ("Dashboard", "SmartDashboard")):
        _members = {"__doc__": NetworkValue.__doc__, "_root": _root, "_nothing": _nothing}
        _class = type(f"Logged{_place}{_kind}", (NetworkValue,), _members)
        fake(f"{JUNCTION}.networktables {JUNCTION}.dashboard")(_class)


@fake(f"{JUNCTION}.networktables {JUNCTION}.dashboard")
class LoggedDashboardChooser(SendableChooser):
    """A list on a dashboard (.../junction/networktables/LoggedDashboardChooser.java)."""

    def __init__(self, key: str, chooser: Any = None) -> None:
        super().__init__()
        self._path = make_path("SmartDashboard", key)
        if isinstance(chooser, SendableChooser):
            self._options, self._default = chooser._options, chooser._default

    addDefaultOption, get = SendableChooser.setDefaultOption, SendableChooser.getSelected

    def getSendableChooser(self) -> SendableChooser:
        return self


@fake(JUNCTION)
class LoggedRobot(TimedRobot):
    """The base class of a robot program (.../junction/LoggedRobot.java)."""


@fake(f"{JUNCTION}.inputs")
class LoggableInputs(Fake):
    """What a mechanism measures, as an interface (.../junction/inputs/LoggableInputs.java)."""
