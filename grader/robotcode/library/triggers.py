"""Controllers, their buttons, and the triggers that start commands with them.

``WORLD.bindings`` has every binding of a command, and
``WORLD.controllers`` every controller with what the program reads of it.
"""

import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import Enum
from itertools import product
from types import MappingProxyType
from typing import Any

from grader.robotcode.library.base import TABLES, Fake, WrongArgument, describe, fake
from grader.robotcode.library.commands import CommandScheduler, EventLoop
from grader.robotcode.library.dashboard import make_path, read_value
from grader.robotcode.library.station import (
    STATION,
    RobotState,
    check_edge,
    read_joystick,
)
from grader.robotcode.library.timing import in_seconds
from grader.robotcode.library.world import WORLD

BUTTONS = (
    "edu.wpi.first.wpilibj2.command.button org.wpilib.command2.button org.wpilib.command3.button"
)
PRESSED = 0.5  # from 0 to 1: how far an axis has to be moved to count as a button
ACTIONS = {  # the method that binds a command -> what it does when the trigger comes, and goes
    "onTrue": ("start", ""),
    "onFalse": ("", "start"),
    "onChange": ("start", "start"),
    "whileTrue": ("start", "stop"),
    "whileFalse": ("stop", "start"),
    "toggleOnTrue": ("toggle", ""),
    "toggleOnFalse": ("", "toggle"),
}
UNUSED = TABLES["others"]["controllers"]
POVS = "Up UpRight Right DownRight Down DownLeft Left UpLeft"  # every 45°, clockwise


@dataclass(eq=False)
class Binding:
    """A command that a trigger starts.

    Args:
        trigger: what starts it.
        how: the method that bound it: ``whileTrue``.
        command: the command.
        line: where it was bound.
        before: whether the trigger was active in the last loop.
    """

    trigger: "BooleanEvent"
    how: str
    command: Any
    line: int
    before: Any = False  # in Python a condition may give an object that is asked later, too

    def poll(self) -> None:
        """Start or stop the command, if the trigger has changed."""
        now = self.trigger.evaluate()
        action = ACTIONS[self.how][0 if now else 1] if bool(now) != bool(self.before) else ""
        self.before = now
        if action:
            self.trigger._bind_action(action, self.command, self.line)


@fake("edu.wpi.first.wpilibj.event org.wpilib.event", "wpilib.event")
class BooleanEvent(Fake):
    """A condition that is asked once a loop (allwpilib v2026, wpilibj/.../BooleanEvent.java)."""

    def __init__(self, *parts: Any, loop: Any = None, condition: Any = None) -> None:
        self._loop, self._condition = loop, condition
        for one in parts:
            if isinstance(one, EventLoop):
                self._loop = one
            elif callable(one):
                self._condition = one
        if self._condition is None or not callable(self._condition):
            given = describe(parts[-1] if parts else None)
            raise WrongArgument(f"A trigger needs a condition that it can ask, not {given}.")

    def _derive(self, condition: Callable[..., Any]) -> Any:  # of the same kind
        return BooleanEvent(condition, loop=self._loop)

    def evaluate(self) -> Any:  # in Python, what the condition gives
        return self._condition() if WORLD.language == "python" else bool(self._condition())

    def getAsBoolean(self) -> bool:
        return bool(self.evaluate())

    get = __call__ = __bool__ = getAsBoolean

    def and_(self, trigger: Callable[..., Any]) -> "BooleanEvent":
        return self._derive(lambda: self.evaluate() and trigger())

    def or_(self, trigger: Callable[..., Any]) -> "BooleanEvent":
        return self._derive(lambda: self.evaluate() or trigger())

    def negate(self) -> "BooleanEvent":
        return self._derive(lambda: not self.getAsBoolean())

    __and__, __or__, __invert__, not_ = and_, or_, negate, negate

    def debounce(self, seconds: Any, type: Any = None) -> "BooleanEvent":
        wait = in_seconds(seconds)
        kind = "rising" if type is None else type.name.lower().removeprefix("k")
        resting = kind == "falling"
        since = WORLD.time

        def calculate() -> bool:
            nonlocal resting, since
            now = self.getAsBoolean()
            if now == resting:
                since = WORLD.time
            if WORLD.time - since < wait:
                return resting
            if kind == "both":
                resting, since = now, WORLD.time
            return now

        return self._derive(calculate)


def _bind(how: str) -> Callable[..., Any]:
    def bind(self: Any, command: Any) -> "Trigger":
        if command is None or inspect.isroutine(command):
            raise WrongArgument(f"{how} needs a command. Call a method that returns one.")
        binding = Binding(self, how, command, WORLD.where())
        asked = WORLD.asked.copy()
        binding.before = self.evaluate()
        WORLD.asked = asked  # this is the trigger's question, not one of the program
        WORLD.bindings.append(binding)
        self._loop.bind(binding.poll)
        return self

    return bind


@fake(BUTTONS, "commands2.button", complete=True)
class Trigger(BooleanEvent):
    """What starts commands (allwpilib v2026, .../command/button/Trigger.java)."""

    onTrue, onFalse, onChange = _bind("onTrue"), _bind("onFalse"), _bind("onChange")
    whileTrue, whileFalse = _bind("whileTrue"), _bind("whileFalse")
    toggleOnTrue, toggleOnFalse = _bind("toggleOnTrue"), _bind("toggleOnFalse")

    def __init__(self, *parts: Any, **named: Any) -> None:
        super().__init__(*parts or (() if named else (lambda: False,)), **named)
        self._loop = self._loop or CommandScheduler().getDefaultButtonLoop()

    def _derive(self, condition: Callable[..., Any]) -> "Trigger":
        return Trigger(condition, loop=self._loop)

    def _bind_action(self, action: str, command: Any, line: int) -> None:  # may be unknown
        scheduler = CommandScheduler()
        if action == "stop" or (action == "toggle" and scheduler.isScheduled(command)):
            scheduler._cancel(command)  # not from the program
        else:
            scheduler._schedule(command, line)  # not from the program


@fake(BUTTONS, "commands2.button", complete=True)
class RobotModeTriggers(Fake):
    """Triggers of the modes (allwpilib v2026, .../command/button/RobotModeTriggers.java)."""

    autonomous = staticmethod(lambda: Trigger(RobotState.isAutonomous))
    teleop = staticmethod(lambda: Trigger(RobotState.isTeleop))
    disabled = staticmethod(lambda: Trigger(RobotState.isDisabled))
    test = staticmethod(lambda: Trigger(RobotState.isTest))
    utility = test  # its name from 2027 on


class _Controller(Fake):
    """What controllers with buttons to ask, and with buttons as triggers, have in common."""

    _kind: Any = BooleanEvent

    def _make_event(self, used: str, number: Any, loop: Any, condition: Callable[..., Any]) -> Any:
        self._hid._note_use(used, number)
        return self._kind(condition, loop=loop)

    def button(self, button: int, loop: EventLoop = None) -> BooleanEvent:
        return self._make_event("button", button, loop, lambda: self._hid.getRawButton(button))

    def pov(
        self, *angle: Any
    ) -> BooleanEvent:  # the angle, or the hat's number, the angle and a loop
        degrees = angle[min(len(angle) - 1, 1)] if len(angle) > 2 else angle[0]  # noqa: PLR2004
        loop = angle[-1] if isinstance(angle[-1], EventLoop) else None
        return self._make_event("pov", degrees, loop, lambda: self._hid.getPOV() == degrees)

    def _compare(self, axis: int, loop: Any, test: Callable[..., Any]) -> Any:
        return self._make_event("axis", axis, loop, lambda: test(self._hid.getRawAxis(axis)))

    def axisLessThan(self, axis: int, threshold: float, loop: EventLoop = None) -> BooleanEvent:
        return self._compare(axis, loop, lambda value: value < threshold)

    def axisGreaterThan(self, axis: int, threshold: float, loop: EventLoop = None) -> BooleanEvent:
        return self._compare(axis, loop, lambda value: value > threshold)

    def axisMagnitudeGreaterThan(
        self, axis: int, threshold: float, loop: EventLoop = None
    ) -> BooleanEvent:
        return self._compare(axis, loop, lambda value: abs(value) > threshold)

    def getRawAxis(self, axis: int) -> float:
        self._hid._note_use("axis", axis)
        return read_joystick(self._hid._port).axes.get(axis, 0.0)

    def isConnected(self) -> bool:
        return self._hid._port in WORLD.joysticks


class GenericHID(_Controller):
    """A controller (allwpilib v2026, wpilibj/.../GenericHID.java).

    ``_used``: ("button", number), ("axis", number) and ("pov", angle) that the program reads, each
    with the first line where it does. ``_names``: those inputs that have a name.
    """

    _names: Mapping[tuple[str, int], str] = MappingProxyType({})

    def __init__(self, port: int) -> None:
        self._hid = self
        self._port = port
        self._line = WORLD.where()
        self._used: dict[tuple[str, int], int] = {}
        WORLD.controllers.append(self)

    def _describe(self, kind: str, number: int) -> str:
        """An input by the method that robot code calls, where it has one: ``Y button (y())``."""
        name = self._names.get((kind, number))
        if name is None:
            return f"{kind} {number}"
        ending = f" {kind}" if kind == "button" else ""
        return f"{name}{ending} ({_name_method(name)}())"

    def _note_use(self, kind: str, number: Any) -> None:  # may be unknown
        self._used.setdefault((kind, number), WORLD.where())

    def getPort(self) -> int:
        return self._port

    def getRawButton(self, button: int) -> bool:
        self._note_use("button", button)
        return button in read_joystick(self._port).buttons

    def getRawButtonPressed(self, button: int) -> bool:
        self._note_use("button", button)
        return check_edge(self._port, button, pressed=True)

    def getRawButtonReleased(self, button: int) -> bool:
        self._note_use("button", button)
        return check_edge(self._port, button, pressed=False)

    def getPOV(self, pov: int = 0) -> int:
        return read_joystick(self._port).pov if pov == 0 else -1


class CommandGenericHID(_Controller):
    """A controller whose buttons are triggers (allwpilib v2026, .../CommandGenericHID.java)."""

    _kind = Trigger
    _of = GenericHID

    def __init__(self, port: int) -> None:
        self._hid = self._of(port)

    def getHID(self) -> GenericHID:
        return self._hid


def _name_method(name: str) -> str:
    return name if len(name) == 2 else name[0].lower() + name[1:]  # noqa: PLR2004 - as L1


def _add_button(hid: type, command: type, name: str, number: int) -> None:
    """Add the methods of one button to both classes of a controller."""
    for cls in (hid, command):
        setattr(cls, _name_method(name), lambda self, loop=None: self.button(number, loop))
    for end in ("", "Pressed", "Released"):
        read = getattr(GenericHID, f"getRawButton{end}")
        for form in (f"get{name}{end}", f"get{name}Button{end}"):
            setattr(hid, form, lambda self, read=read: read(self, number))


def _add_axis(cls: type, name: str, number: int) -> None:
    def press(self: Any, threshold: Any = PRESSED, loop: Any = None) -> Any:  # an event or trigger
        limit = PRESSED if isinstance(threshold, EventLoop) else threshold
        return self.axisGreaterThan(number, limit, threshold if limit != threshold else loop)

    getter = f"get{name}" if name[-1] in "XYZe" else f"get{name}Axis"
    setattr(cls, getter, lambda self: self.getRawAxis(number))
    if name.endswith("Trigger"):
        setattr(cls, name[0].lower() + name[1:], press)


def _make_controller(name: str, first: int, buttons: str, axes: str) -> None:
    """Make the two classes of a controller: one that is polled, and one with triggers."""
    numbers = {f"k{button}": number for number, button in enumerate(buttons.split(), first)}
    places = {f"k{axis}": number for number, axis in enumerate(axes.split())}
    enums = {"Button": Enum("Button", numbers), "Axis": Enum("Axis", places)}
    names = {("button", number): one for number, one in enumerate(buttons.split(), first)}
    names |= {
        ("axis", number): one for number, one in enumerate(axes.split()) if one.endswith("Trigger")
    }
    hid = type(name, (GenericHID,), {**enums, "_names": names})
    command = type(f"Command{name}", (CommandGenericHID,), {"_of": hid})
    for number, button in enumerate(buttons.split(), first):
        _add_button(hid, command, button, number)
    for (number, axis), cls in product(enumerate(axes.split()), (hid, command)):
        _add_axis(cls, axis, number)
    _add_fakes(hid, command)


def _add_fakes(hid: type, command: type) -> None:
    fake(STATION, "wpilib wpilib.interfaces", complete=True, others=UNUSED)(hid)
    fake(BUTTONS, "commands2.button", complete=True, others=UNUSED)(command)


for _degrees, _name in zip(range(0, 360, 45), POVS.split(), strict=True):
    setattr(CommandGenericHID, f"pov{_name}", lambda self, at=_degrees: self.pov(at))
_add_fakes(GenericHID, CommandGenericHID)
for _name, _parts in TABLES["controllers"].items():
    _make_controller(_name, **_parts)


class JoystickButton(Trigger):
    """A button by its number (allwpilib v2026, .../command/button/JoystickButton.java)."""

    def __init__(self, joystick: GenericHID, buttonNumber: int) -> None:
        joystick._note_use("button", buttonNumber)
        super().__init__(lambda: joystick.getRawButton(buttonNumber))


class POVButton(Trigger):
    """A direction of a hat (allwpilib v2026, .../command/button/POVButton.java)."""

    def __init__(self, joystick: GenericHID, angle: int, povNumber: int = 0) -> None:
        joystick._note_use("pov", angle)
        super().__init__(lambda: joystick.getPOV(povNumber) == angle)


class NetworkButton(Trigger):
    """A boolean of NetworkTables (allwpilib v2026, .../command/button/NetworkButton.java)."""

    def __init__(self, *path: Any) -> None:
        super().__init__(lambda: read_value(make_path(*map(str, path)), False))


for _cls in (JoystickButton, POVButton, NetworkButton):
    fake(BUTTONS, "commands2.button", complete=True)(_cls)
