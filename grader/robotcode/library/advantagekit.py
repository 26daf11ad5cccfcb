"""AdvantageKit (v26): the Logger, and values and lists on a dashboard.

Source: https://github.com/Mechanical-Advantage/AdvantageKit, akit/src/main/java/.
"""

from typing import Any

from grader.robotcode.library.base import Fake, fake
from grader.robotcode.library.dashboard import (
    SendableChooser,
    make_path,
    read_value,
    write_value,
)
from grader.robotcode.library.world import WORLD

JUNCTION = "org.littletonrobotics.junction"
MICROSECONDS = 1e6  # in a second


@fake(JUNCTION, "pykit.logger", complete=True)
class Logger(Fake):
    """Writes values into a log that is not read here (.../junction/Logger.java)."""

    @staticmethod
    def getTimestamp() -> int:
        return int(WORLD.time * MICROSECONDS)


NETWORK = f"{JUNCTION}.networktables {JUNCTION}.dashboard"


class LoggedValue(Fake):
    """A value that a dashboard may change (.../junction/networktables/)."""

    _nothing: Any = None

    def __init__(self, key: str, default: Any = None) -> None:
        self._path = make_path(key)
        self.setDefault(self._nothing if default is None else default)

    def setDefault(self, value: Any) -> None:
        self._default = value

    def set(self, value: Any) -> None:
        write_value(self._path, value)

    def get(self) -> Any:
        return read_value(self._path, self._default)

    getAsBoolean = getAsDouble = __call__ = get


for _kind, _value in (("Number", 0.0), ("Boolean", False), ("String", "")):
    for _place in ("Network", "Dashboard"):
        _text = {"__doc__": LoggedValue.__doc__, "_nothing": _value}
        fake(NETWORK)(type(Fake)(f"Logged{_place}{_kind}", (LoggedValue,), _text))


@fake(NETWORK)
class LoggedDashboardChooser(SendableChooser):
    """A list to choose from (.../junction/networktables/LoggedDashboardChooser.java)."""

    def __init__(self, key: str, chooser: SendableChooser | None = None) -> None:
        super().__init__()
        self._path = make_path("SmartDashboard", key)
        if chooser is not None:
            self._options, self._default = dict(chooser._options), chooser._default

    get = SendableChooser.getSelected
    addDefaultOption = SendableChooser.setDefaultOption
