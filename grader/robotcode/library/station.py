"""The driver station, the robot controller, and what else is built into a robot."""

from collections.abc import Callable
from enum import Enum
from typing import Any

from grader.robotcode.library.base import JAVA, PYTHON, Fake, Unknown, fake
from grader.robotcode.library.devices import Device
from grader.robotcode.library.timing import NO_MATCH_TIME, WPILIB, in_seconds
from grader.robotcode.library.units import CONSTANTS
from grader.robotcode.library.world import PERIOD, WORLD, Joystick

STATION = "edu.wpi.first.wpilibj org.wpilib.driverstation"
FRAMEWORK = "edu.wpi.first.wpilibj org.wpilib.framework"
MICROSECONDS = 1e6  # in a second


def make_optional(value: Any) -> Any:  # any value
    """A value that may be absent, as the program's language has it."""
    if WORLD.language == "python":
        return value
    optional = JAVA["java.util.Optional"]
    return optional.empty() if value is None else optional.of(value)


def read_joystick(port: int) -> Joystick:
    """What the driver does with the controller in a port: nothing, if none is plugged in."""
    return WORLD.joysticks.get(port) or Joystick()


def check_edge(port: int, button: int, *, pressed: bool) -> bool:
    """Whether a button was pressed, or else released, since this was last asked."""
    last = WORLD.button_edges
    now = button in read_joystick(port).buttons
    before = last.get((port, button, pressed), False)
    last[port, button, pressed] = now
    return now != before and now == pressed


class Alliance(Enum):
    """The side that a robot plays for."""

    Red = kRed = RED = 0
    Blue = kBlue = BLUE = 1


JAVA["org.wpilib.driverstation.Alliance"] = Alliance


def is_in_test_mode() -> bool:
    """Whether the robot is in test mode; the world keeps where this was asked, and when."""
    WORLD.asked[WORLD.where()] = WORLD.time
    return WORLD.mode == "test"


@fake(STATION, "wpilib", complete=True)
class RobotState(Fake):
    """The mode that the robot is in (allwpilib v2026, wpilibj/.../RobotState.java)."""

    isEnabled = staticmethod(lambda: WORLD.enabled)
    isDisabled = staticmethod(lambda: not WORLD.enabled)
    isEStopped = staticmethod(lambda: False)
    isAutonomous = isAutonomousEnabled = staticmethod(lambda: WORLD.mode == "autonomous")
    isTeleop = isTeleopEnabled = staticmethod(lambda: WORLD.mode == "teleop")
    isTest = isTestEnabled = staticmethod(lambda: is_in_test_mode())
    isUtility = isUtilityEnabled = isTest  # its name from 2027 on
    isDSAttached = staticmethod(lambda: True)
    isFMSAttached = staticmethod(lambda: WORLD.fms)


@fake(STATION, "wpilib", complete=True)
class DriverStation(RobotState):
    """The driver station (allwpilib v2026, wpilibj/.../DriverStation.java)."""

    Alliance = Alliance

    getAlliance = staticmethod(lambda: make_optional(Alliance.__members__.get(WORLD.alliance)))
    getMatchTime = staticmethod(lambda: NO_MATCH_TIME)
    getBatteryVoltage = staticmethod(lambda: WORLD.battery)

    @staticmethod
    def isJoystickConnected(stick: int) -> bool:
        return stick in WORLD.joysticks


@fake(WPILIB, "wpilib")
class RobotController(Fake):
    """The computer on the robot (allwpilib v2026, wpilibj/.../RobotController.java)."""

    getBatteryVoltage = getInputVoltage = staticmethod(lambda: WORLD.battery)
    getMeasureBatteryVoltage = staticmethod(lambda: CONSTANTS["Volts"].of(WORLD.battery))
    getMeasureInputVoltage = getMeasureBatteryVoltage
    getTime = staticmethod(lambda: round(WORLD.time * MICROSECONDS))
    getFPGATime = getMonotonicTime = getTime


@fake(FRAMEWORK, "wpilib")
class RobotBase(RobotState):
    """The base of all robots (allwpilib v2026, wpilibj/.../RobotBase.java)."""

    isReal = staticmethod(lambda: True)
    isSimulation = staticmethod(lambda: False)


def _do_nothing(self: Any) -> None:
    """The behavior of a robot in a mode that its program does not define."""


@fake(FRAMEWORK, "wpilib")
class IterativeRobotBase(RobotBase):
    """A robot whose methods run once a loop (allwpilib v2026, .../IterativeRobotBase.java)."""

    robotInit = driverStationConnected = simulationInit = _do_nothing
    robotPeriodic = simulationPeriodic = _do_nothing
    disabledInit = autonomousInit = teleopInit = testInit = utilityInit = _do_nothing
    disabledPeriodic = autonomousPeriodic = teleopPeriodic = testPeriodic = _do_nothing
    disabledExit = autonomousExit = teleopExit = testExit = utilityExit = _do_nothing
    utilityPeriodic = _do_nothing

    def __init__(self, period: Any = PERIOD) -> None:  # a number or a Time
        self._period = in_seconds(period)

    def getPeriod(self) -> float:
        return self._period


@fake(FRAMEWORK, "wpilib")
class TimedRobot(IterativeRobotBase):
    """The robot that nearly every team has (allwpilib v2026, wpilibj/.../TimedRobot.java)."""

    kDefaultPeriod = PERIOD

    def addPeriodic(self, callback: Callable[..., Any], *times: Any) -> None:
        WORLD.each_loop.append(callback)


@fake(WPILIB, "wpilib")
class Notifier(Fake):
    """Runs a function by itself (allwpilib v2026, wpilibj/.../Notifier.java): once a loop."""

    def __init__(self, callback: Callable[..., Any]) -> None:
        self._callback = callback
        self._due: Any = None  # [s] when it runs once; None if it runs again and again

    def _run_when_due(self) -> None:
        if self._due is None:
            self._callback()
        elif WORLD.time >= self._due:
            self.stop()
            self._callback()

    def _start(self, due: Any) -> None:  # may be unknown
        self._due = due
        self.stop()
        WORLD.each_loop.append(self._run_when_due)

    def startPeriodic(self, period: Any) -> None:  # a number or a measure
        self._start(None)

    def startSingle(self, delay: Any) -> None:  # a number or a Time
        self._start(WORLD.time + in_seconds(delay))

    def stop(self) -> None:
        if self._run_when_due in WORLD.each_loop:
            WORLD.each_loop.remove(self._run_when_due)

    close = stop


@fake("edu.wpi.first.wpilibj org.wpilib.hardware.discrete", "wpilib")
class DigitalInput(Device):
    """A switch (allwpilib v2026, wpilibj/.../DigitalInput.java), whose state the bench sets."""

    _value = False

    def __init__(self, channel: Any) -> None:
        self._register_port("DIO", channel)

    def get(self) -> bool:
        return self._value


for _name in ("getDeployDirectory", "getOperatingDirectory", "reportError", "reportWarning"):
    PYTHON["wpilib"][_name] = Unknown(f"wpilib.{_name}")
