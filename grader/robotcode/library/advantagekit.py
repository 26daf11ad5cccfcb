"""AdvantageKit (v26): the Logger, and values and lists on a dashboard.

Source: https://github.com/Mechanical-Advantage/AdvantageKit, akit/src/main/java/.
"""

from grader.robotcode.library.base import Fake, fake
from grader.robotcode.library.station import TimedRobot
from grader.robotcode.library.world import WORLD

JUNCTION = "org.littletonrobotics.junction"
MICROSECONDS = 1e6  # in a second


@fake(JUNCTION, "pykit.logger", complete=True)
class Logger(Fake):
    """Writes values into a log that nobody reads here (.../junction/Logger.java)."""

    @staticmethod
    def getTimestamp() -> int:
        return int(WORLD.time * MICROSECONDS)


for _name in (
    *("LoggedNetworkNumber", "LoggedNetworkBoolean", "LoggedNetworkString"),
    *("LoggedDashboardNumber", "LoggedDashboardBoolean", "LoggedDashboardString"),
    "LoggedDashboardChooser",
):
    _text = {"__doc__": "A value that a dashboard may change (.../junction/networktables/)."}
    _class = type(Fake)(_name, (Fake,), _text)
    fake(f"{JUNCTION}.networktables {JUNCTION}.dashboard")(_class)


@fake(JUNCTION)
class LoggedRobot(TimedRobot):
    """The base class of a robot program (.../junction/LoggedRobot.java)."""


@fake(f"{JUNCTION}.inputs")
class LoggableInputs(Fake):
    """What a mechanism measures, as an interface (.../junction/inputs/LoggableInputs.java)."""
