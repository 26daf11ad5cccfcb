"""Commands v2: the scheduler with its rules, commands, and how they are put together."""

import inspect
from collections.abc import Callable, Iterator
from enum import Enum
from typing import Any, Self

from grader.robotcode.library.base import (
    PYTHON,
    Fake,
    FakeType,
    Unknown,
    WrongArgument,
    describe,
    fake,
)
from grader.robotcode.library.station import TimedRobot
from grader.robotcode.library.timing import NO_MATCH_TIME, in_seconds
from grader.robotcode.library.world import WORLD

V2 = "edu.wpi.first.wpilibj2.command org.wpilib.command2"


class IllegalCommandUse(ValueError):
    """A command that is used in a way that WPILib refuses."""


PYTHON.setdefault("commands2", {})["IllegalCommandUse"] = IllegalCommandUse


class InterruptionBehavior(Enum):
    """What happens when another command needs the same subsystem."""

    kCancelSelf = CANCEL_SELF = 0
    kCancelIncoming = CANCEL_INCOMING = 1


PYTHON["commands2"]["InterruptionBehavior"] = InterruptionBehavior


def flatten(values: Any) -> Iterator[Any]:  # arguments, alone or in collections
    """The arguments of a method that takes any number, or an array, or a collection of them."""
    for one in values:
        if isinstance(one, list | tuple | set | frozenset | dict):
            yield from flatten(one)
        else:
            yield one


def count_parameters(function: Any) -> int:  # anything that can be called
    """The number of arguments that a function takes; -1 if it is unknown."""
    if hasattr(function, "arity"):
        return function.arity
    try:
        return len(inspect.signature(function).parameters)
    except (TypeError, ValueError):
        return -1


def as_commands(values: Any) -> list["Command"]:  # arguments
    """The commands among arguments.

    Raises:
        WrongArgument: one is no command.
    """
    found = [_UnknownCommand(v) if isinstance(v, Unknown) else v for v in flatten(values)]
    for one in found:
        if not isinstance(one, Command):
            raise WrongArgument(f"This needs a Command, not {describe(one)}.")
    return found


@fake("edu.wpi.first.wpilibj.event org.wpilib.event", "wpilib.event", complete=True)
class EventLoop(Fake):
    """Conditions that are polled once a loop (allwpilib v2026, wpilibj/.../EventLoop.java)."""

    def __init__(self) -> None:
        self._actions: list[Callable[..., Any]] = []

    def bind(self, action: Callable[..., Any]) -> None:
        self._actions.append(action)

    def poll(self) -> None:
        for action in list(self._actions):
            action()

    def clear(self) -> None:
        self._actions.clear()


@fake(V2, "commands2", complete=True)
class CommandScheduler(Fake):
    """Runs commands (allwpilib v2026, wpilibNewCommands/.../CommandScheduler.java).

    ``_scheduled``: the commands that run, in order. ``_subsystems``: each with its default
    command. ``_events``: (kind, command, time, line) of each ``schedule``, ``finish`` and
    ``interrupt``.
    """

    def __new__(cls) -> Self:
        if WORLD.scheduler is None:
            WORLD.scheduler = made = super().__new__(cls)
            made._scheduled: dict[Command, None] = {}
            made._subsystems: dict[Subsystem, Command | None] = {}
            made._owners: dict[Subsystem, Command] = {}
            made._composed: dict[Command, int] = {}  # with the line where it became part of another
            made._events: list[tuple[str, Command, float, int]] = []
            made._loop = EventLoop()
            made._in_loop = False  # while it goes through the commands, what is asked has to wait
            made._to_schedule: dict[Command, int] = {}
            made._to_cancel: dict[Command, None] = {}
            made._ending: set[Command] = set()
        return WORLD.scheduler

    @staticmethod
    def getInstance() -> "CommandScheduler":
        return CommandScheduler()

    def _record_event(self, kind: str, command: "Command") -> None:
        self._events.append((kind, command, WORLD.time, command._scheduled_line))

    def schedule(self, *commands: Any) -> None:
        for one in flatten(commands):
            if one is not None:
                self._events.append(("ask", one, WORLD.time, WORLD.where()))
                self._schedule(one, WORLD.where())

    def _schedule(self, command: "Command", line: int) -> None:
        if isinstance(command, Unknown):
            return
        if self._in_loop:
            self._to_schedule[command] = line
            return
        self.requireNotComposed(command)
        if command in self._scheduled or not (WORLD.enabled or command.runsWhenDisabled()):
            return
        needed = list(command.getRequirements())
        owners = {self._owners[one] for one in needed if one in self._owners}
        refused = InterruptionBehavior.kCancelIncoming
        if any(one.getInterruptionBehavior() is refused for one in owners):
            return
        for one in [one for one in self._scheduled if one in owners]:
            self._cancel(one)
        command._scheduled_line = line
        self._scheduled[command] = None
        self._owners.update(dict.fromkeys(needed, command))
        command.initialize()
        self._record_event("schedule", command)

    def cancel(self, *commands: Any) -> None:
        for one in flatten(commands):
            self._cancel(one)

    def _cancel(self, command: "Command") -> None:
        if command in self._ending or isinstance(command, Unknown):
            return
        if self._in_loop:
            self._to_cancel[command] = None
        elif command in self._scheduled:
            self._end(command, "interrupt")

    def _end(self, command: "Command", kind: str) -> None:
        self._ending.add(command)
        command.end(kind == "interrupt")
        self._record_event(kind, command)
        self._ending.discard(command)
        self._scheduled.pop(command, None)
        for one in [one for one, owner in self._owners.items() if owner is command]:
            del self._owners[one]

    def cancelAll(self) -> None:
        self.cancel(*self._scheduled)

    def run(self) -> None:
        for subsystem in list(self._subsystems):
            subsystem.periodic()
        self._loop.poll()
        self._in_loop = True
        try:
            for command in list(self._scheduled):
                self._run_one_loop(command)
        finally:
            self._in_loop = False
        for command, line in list(self._to_schedule.items()):
            self._schedule(command, line)
        for command in list(self._to_cancel):
            self._cancel(command)
        self._to_schedule.clear()
        self._to_cancel.clear()
        for subsystem, command in list(self._subsystems.items()):
            if command is not None and subsystem not in self._owners:
                self._schedule(command, command._line)

    def _run_one_loop(self, command: "Command") -> None:
        if not (WORLD.enabled or command.runsWhenDisabled()):
            self._cancel(command)
            return
        command.execute()
        if command.isFinished():
            self._end(command, "finish")

    def registerSubsystem(self, *subsystems: Any) -> None:
        for one in flatten(subsystems):
            self._subsystems.setdefault(one)

    def setDefaultCommand(self, subsystem: "RobotPart", defaultCommand: "Command") -> None:
        (command,) = as_commands([defaultCommand])
        self.requireNotComposed(command)
        if subsystem not in command.getRequirements() and command is defaultCommand:
            raise IllegalCommandUse(
                f"The default command of {subsystem.getName()} has to require it: make it with a"
                " method of the subsystem, or give it the subsystem as its requirement."
            )
        self._subsystems[subsystem] = command

    def registerComposedCommands(self, *commands: Any) -> None:
        parts = list(flatten(commands))
        if len(set(parts)) != len(parts):
            raise IllegalCommandUse("A command cannot be in the same group twice.")
        self.requireNotComposedOrScheduled(*parts)
        self._composed.update(dict.fromkeys(parts, WORLD.where()))

    def requireNotComposed(self, *commands: Any) -> None:
        for one in [one for one in flatten(commands) if one in self._composed]:
            raise IllegalCommandUse(
                f"The command {one.getName()} became part of another command in line"
                f" {self._composed[one]}. It cannot be scheduled by itself, bound to a button,"
                " or put into a second one: make a new command for each use."
            )

    def requireNotComposedOrScheduled(self, *commands: Any) -> None:
        for one in [one for one in flatten(commands) if one in self._scheduled]:
            raise IllegalCommandUse(
                f"The command {one.getName()} runs by itself, so it cannot become part of"
                " another command: make a new command for each use."
            )
        self.requireNotComposed(*commands)

    def removeDefaultCommand(self, subsystem: "RobotPart") -> None:
        self._subsystems[subsystem] = None

    def getDefaultCommand(self, subsystem: "RobotPart") -> "Command":
        return self._subsystems.get(subsystem)

    def requiring(self, subsystem: "Subsystem") -> "Command":
        return self._owners.get(subsystem)

    def isScheduled(self, *commands: Any) -> bool:
        return all(one in self._scheduled for one in flatten(commands))

    def getDefaultButtonLoop(self) -> EventLoop:
        return self._loop

    getActiveButtonLoop = getDefaultButtonLoop


class Command(Fake):
    """Something that a robot does for a while (allwpilib v2026, .../command/Command.java).

    ``_line``: where it was made. ``_scheduled_line``: where what scheduled it stands.
    """

    InterruptionBehavior = InterruptionBehavior
    _when_disabled = False

    def __new__(cls, *_args: Any, **_keywords: Any) -> Self:
        made = super().__new__(cls)
        made._line = WORLD.where()
        made._scheduled_line = 0
        made._command_name = ""
        made._command_needs = set()
        return made

    def initialize(self) -> None:
        """Do nothing, which a subclass changes."""

    def execute(self) -> None:
        """Do nothing, which a subclass changes."""

    def end(self, interrupted: bool) -> None:
        """Do nothing, which a subclass changes."""

    def isFinished(self) -> bool:
        return False

    def runsWhenDisabled(self) -> bool:
        return self._when_disabled

    def getInterruptionBehavior(self) -> InterruptionBehavior:
        return InterruptionBehavior.kCancelSelf

    def getRequirements(self) -> set[Any]:
        return self._command_needs

    def addRequirements(self, *requirements: Any) -> None:
        for one in flatten(requirements):
            if not isinstance(one, RobotPart | Unknown):
                raise WrongArgument(f"A command requires subsystems, not {describe(one)}.")
            self._command_needs.add(one)

    def getName(self) -> str:
        return self._command_name or type(self).__name__

    def setName(self, name: str) -> None:
        self._command_name = name

    def hasRequirement(self, requirement: "Subsystem") -> bool:
        return requirement in self.getRequirements()

    def schedule(self) -> None:
        CommandScheduler().schedule(self)

    def cancel(self) -> None:
        CommandScheduler().cancel(self)

    def isScheduled(self) -> bool:
        return CommandScheduler().isScheduled(self)


def make_steps(first: Any = (), *more: Any) -> list[Any]:  # commands, or a function
    """Commands that follow each other; or one, of a function and the subsystems that it needs."""
    runnable = callable(first) and not isinstance(first, Command | Unknown)
    return [InstantCommand(first, *more)] if runnable else [first, *more]


class _UnknownCommand(Command):
    """An unknown command, such as another library's: it may end, or not."""

    def __init__(self, value: Unknown) -> None:
        self._value = value

    def isFinished(self) -> bool:
        return bool(self._value)


class FunctionalCommand(Command):
    """A command made of functions (allwpilib v2026, .../command/FunctionalCommand.java)."""

    def __init__(
        self, onInit: Any, onExecute: Any, onEnd: Any, isFinished: Any, *requirements: Any
    ) -> None:
        self._functions = onInit, onExecute, onEnd, isFinished
        self.addRequirements(*requirements)

    def initialize(self) -> None:
        self._functions[0]()

    def execute(self) -> None:
        self._functions[1]()

    def end(self, interrupted: bool) -> None:
        self._functions[2](interrupted)

    def isFinished(self) -> bool:
        return bool(self._functions[3]())


def nothing(*_args: object) -> bool:
    """Do nothing; a condition that never becomes true."""
    return False


class InstantCommand(FunctionalCommand):
    """Does one thing at once (allwpilib v2026, .../command/InstantCommand.java)."""

    def __init__(self, toRun: Callable[..., Any] = nothing, *requirements: Any) -> None:
        super().__init__(toRun, nothing, nothing, lambda: True, *requirements)


class RunCommand(FunctionalCommand):
    """Does one thing in each loop (allwpilib v2026, .../command/RunCommand.java)."""

    def __init__(self, toRun: Callable[..., Any], *requirements: Any) -> None:
        super().__init__(nothing, toRun, nothing, nothing, *requirements)


class StartEndCommand(FunctionalCommand):
    """Does one thing first and one last (allwpilib v2026, .../command/StartEndCommand.java)."""

    def __init__(
        self, onInit: Callable[..., Any], onEnd: Callable[..., Any], *requirements: Any
    ) -> None:
        super().__init__(onInit, nothing, lambda _: onEnd(), nothing, *requirements)


class PrintCommand(InstantCommand):
    """Prints a text (allwpilib v2026, .../command/PrintCommand.java): the bench has no console."""

    _when_disabled = True

    def __init__(self, message: Any) -> None:  # nobody reads it
        super().__init__()


class ScheduleCommand(InstantCommand):
    """Lets others run by themselves (allwpilib v2026, .../command/ScheduleCommand.java)."""

    _when_disabled = True

    def __init__(self, *toSchedule: Any) -> None:
        super().__init__(lambda: CommandScheduler().schedule(*toSchedule))


class WaitCommand(Command):
    """Waits for some time (allwpilib v2026, .../command/WaitCommand.java)."""

    _when_disabled = True

    def __init__(self, seconds: Any) -> None:
        self._seconds = in_seconds(seconds)
        self._since = 0.0

    def initialize(self) -> None:
        self._since = WORLD.time

    def isFinished(self) -> bool:
        return WORLD.time - self._since >= self._seconds


class WaitUntilCommand(FunctionalCommand):
    """Waits for a condition (allwpilib v2026, .../command/WaitUntilCommand.java)."""

    _when_disabled = True

    def __init__(self, condition: Any) -> None:  # a condition, or a time of the match
        ready = condition if callable(condition) else lambda: condition < NO_MATCH_TIME
        super().__init__(nothing, nothing, nothing, ready)


class _Composition(Command):
    """A command that is made of others, which belong to it from then on."""

    _owning = True
    _alone = False  # whether its parts run at the same time, so that none may need another's

    def __init__(self, *commands: Any) -> None:
        self._parts: list[Command] = []
        self.addCommands(*commands)

    def addCommands(self, *commands: Any) -> None:
        new = as_commands(commands)
        if self._owning:
            CommandScheduler().registerComposedCommands(*new)
        for one in new:
            needed = one.getRequirements()
            if self._alone and not self._command_needs.isdisjoint(needed):
                raise IllegalCommandUse(
                    f"The command {one.getName()} requires a subsystem that another command of"
                    " the same parallel group requires: only one of them can have it."
                )
            self._command_needs |= set(needed)
            self._parts.append(one)

    def runsWhenDisabled(self) -> bool:
        return all(one.runsWhenDisabled() for one in self._parts)

    def getInterruptionBehavior(self) -> InterruptionBehavior:
        found = {one.getInterruptionBehavior() for one in self._parts}
        alone = len(found) == 1
        return found.pop() if alone else InterruptionBehavior.kCancelSelf


class SequentialCommandGroup(_Composition):
    """One command after another (allwpilib v2026, .../SequentialCommandGroup.java)."""

    _at = 0

    def initialize(self) -> None:
        self._at = 0
        if self._parts:
            self._parts[0].initialize()

    def execute(self) -> None:
        if self.isFinished():
            return
        self._parts[self._at].execute()
        if self._parts[self._at].isFinished():
            self._parts[self._at].end(False)
            self._at += 1
            if not SequentialCommandGroup.isFinished(self):
                self._parts[self._at].initialize()

    def end(self, interrupted: bool) -> None:
        if interrupted and self._at < len(self._parts):
            self._parts[self._at].end(True)

    def isFinished(self) -> bool:
        return self._at == len(self._parts)


class ParallelCommandGroup(_Composition):
    """All at once, until the last ends (allwpilib v2026, .../ParallelCommandGroup.java)."""

    _alone = True
    _running: Any = ()

    def initialize(self) -> None:
        self._running = list(self._parts)
        for one in self._parts:
            one.initialize()

    def execute(self) -> None:
        for one in list(self._running):
            one.execute()
            if one.isFinished():
                one.end(False)
                self._running.remove(one)

    def end(self, interrupted: bool) -> None:  # those that run are interrupted
        for one in self._running:
            one.end(True)

    def isFinished(self) -> bool:
        return not self._running


class ParallelRaceGroup(ParallelCommandGroup):
    """All at once, until the first ends (allwpilib v2026, .../ParallelRaceGroup.java)."""

    def isFinished(self) -> bool:
        return len(self._running) < len(self._parts)


class ParallelDeadlineGroup(ParallelCommandGroup):
    """All at once, until a certain one ends (allwpilib v2026, .../ParallelDeadlineGroup.java)."""

    def __init__(self, deadline: Command, *commands: Any) -> None:
        super().__init__(deadline, *commands)
        self._deadline = self._parts[0]

    def setDeadline(self, deadline: Command) -> None:
        self.addCommands(*(() if deadline in self._parts else (deadline,)))
        self._deadline = deadline

    def isFinished(self) -> bool:
        return self._deadline not in self._running


class _Choice(_Composition):
    """One of several commands, chosen when it starts; ``_choose_command`` does it."""

    def _delegate_method(method: str) -> Any:  # makes a method
        def call(self: Any, *args: Any) -> Any:  # as the part's
            return getattr(self._chosen, method)(*args)

        return call

    execute, end, isFinished = (
        _delegate_method("execute"),
        _delegate_method("end"),
        _delegate_method("isFinished"),
    )

    def __init__(self, *commands: Any) -> None:
        super().__init__(*commands)
        self._chosen = self._parts[0] if self._parts else InstantCommand()

    def initialize(self) -> None:
        self._chosen = self._choose_command()
        self._chosen.initialize()


class ConditionalCommand(_Choice):
    """One of two commands (allwpilib v2026, .../command/ConditionalCommand.java)."""

    def __init__(self, onTrue: Command, onFalse: Command, condition: Callable[..., Any]) -> None:
        super().__init__(onTrue, onFalse)
        self._choose_command = lambda: self._parts[0 if condition() else 1]


class WrapperCommand(_Choice):
    """A command with something changed (allwpilib v2026, .../command/WrapperCommand.java)."""

    def __init__(
        self, command: Command, name: str = "", at_end: Callable[..., Any] = nothing, **fixed: Any
    ) -> None:
        super().__init__(command)
        self._choose_command = lambda: self._parts[0]
        self._at_end = at_end
        self._fixed = fixed  # what it answers instead of the command
        self.setName(name or self._parts[0].getName())

    def end(self, interrupted: bool) -> None:
        self._chosen.end(interrupted)
        self._at_end(*(interrupted,) if count_parameters(self._at_end) else ())

    def runsWhenDisabled(self) -> bool:
        return self._fixed.get("when_disabled", self._parts[0].runsWhenDisabled())

    def getInterruptionBehavior(self) -> InterruptionBehavior:
        return self._fixed.get("behavior", self._parts[0].getInterruptionBehavior())


class DeferredCommand(_Choice):
    """A command that is made when it starts (allwpilib v2026, .../DeferredCommand.java)."""

    def __init__(self, supplier: Callable[..., Any], *requirements: Any) -> None:
        super().__init__()
        self._supplier = supplier
        self.addRequirements(*requirements)

    def _choose_command(self) -> Command:
        made = self._supplier()
        (command,) = as_commands([InstantCommand() if made is None else made])
        CommandScheduler().registerComposedCommands(command)
        return command

    def runsWhenDisabled(self) -> bool:
        return False


class RepeatCommand(_Composition):
    """A command again and again (allwpilib v2026, .../command/RepeatCommand.java)."""

    def initialize(self) -> None:
        self._ended = False
        self._parts[0].initialize()

    def execute(self) -> None:
        if self._ended:
            self.initialize()
        self._parts[0].execute()
        if self._parts[0].isFinished():
            self._parts[0].end(False)
            self._ended = True

    def end(self, interrupted: bool) -> None:
        if not self._ended:
            self._parts[0].end(interrupted)


class ProxyCommand(Command):
    """Schedules another command and waits for it (allwpilib v2026, .../ProxyCommand.java)."""

    _when_disabled = True

    def __init__(self, command: Any) -> None:  # or what makes one
        self._supplier = (lambda: command) if isinstance(command, Command) else command
        self._proxied: Any = None

    def initialize(self) -> None:
        self._proxied = self._supplier()
        CommandScheduler().schedule(self._proxied)

    def end(self, interrupted: bool) -> None:
        if interrupted:
            CommandScheduler().cancel(self._proxied)

    def isFinished(self) -> bool:
        return self._proxied is None or not CommandScheduler().isScheduled(self._proxied)


def _make_factory(cls: type) -> Any:  # a static method
    """A static method that makes a command of a class."""

    def make(*args: Any, **named: Any) -> Command:  # the class checks them
        return cls(*args, **named)

    return staticmethod(make)


class Commands(Fake):
    """Methods that make commands (allwpilib v2026, .../command/Commands.java)."""

    none, runOnce, run = (
        _make_factory(InstantCommand),
        _make_factory(InstantCommand),
        _make_factory(RunCommand),
    )
    startEnd, print, print_ = (
        _make_factory(StartEndCommand),
        _make_factory(PrintCommand),
        _make_factory(PrintCommand),
    )
    waitSeconds, waitUntil = _make_factory(WaitCommand), _make_factory(WaitUntilCommand)
    waitTime, defer, deferredProxy = (
        waitSeconds,
        _make_factory(DeferredCommand),
        _make_factory(ProxyCommand),
    )
    either = _make_factory(ConditionalCommand)
    sequence, parallel = _make_factory(SequentialCommandGroup), _make_factory(ParallelCommandGroup)
    race, deadline = _make_factory(ParallelRaceGroup), _make_factory(ParallelDeadlineGroup)

    @staticmethod
    def idle(*requirements: Any) -> Command:
        return RunCommand(nothing, *requirements)

    @staticmethod
    def runEnd(run: Callable[..., Any], end: Callable[..., Any], *requirements: Any) -> Command:
        return FunctionalCommand(nothing, run, lambda _: end(), nothing, *requirements)

    @staticmethod
    def startRun(start: Callable[..., Any], run: Callable[..., Any], *requirements: Any) -> Command:
        return FunctionalCommand(start, run, nothing, nothing, *requirements)

    @staticmethod
    def repeatingSequence(*commands: Any) -> Command:
        return RepeatCommand(SequentialCommandGroup(*commands))


class RobotPart(Fake):
    """What subsystems, and the mechanisms of Commands v3, have in common."""

    _subsystem_name = ""

    def periodic(self) -> None:
        """Do nothing, which a subclass changes."""

    def simulationPeriodic(self) -> None:
        """Do nothing, which a subclass changes."""

    def getName(self) -> str:
        return self._subsystem_name or type(self).__name__

    def setName(self, name: str) -> None:
        self._subsystem_name = name

    def register(self) -> None:
        CommandScheduler().registerSubsystem(self)

    def setDefaultCommand(self, defaultCommand: Command) -> None:
        CommandScheduler().setDefaultCommand(self, defaultCommand)

    def getDefaultCommand(self) -> Command:
        return CommandScheduler().getDefaultCommand(self)

    def removeDefaultCommand(self) -> None:
        CommandScheduler().removeDefaultCommand(self)


class Subsystem(RobotPart):
    """A part of the robot (allwpilib v2026, .../command/Subsystem.java)."""


class SubsystemBase(Subsystem):
    """A subsystem that the scheduler knows at once (allwpilib v2026, .../SubsystemBase.java)."""

    def __new__(cls, *_args: Any, **_keywords: Any) -> Self:
        made = super().__new__(cls)
        CommandScheduler().registerSubsystem(made)
        return made

    def __init__(self, name: str = "") -> None:
        self._subsystem_name = name


class PIDSubsystem(SubsystemBase):
    """A subsystem with a controller, whose work is unknown (allwpilib v2026, removed later)."""

    def __init__(self, *_settings: Any) -> None:
        super().__init__()


class ProfiledPIDSubsystem(PIDSubsystem):
    """A subsystem with a profiled controller."""


class TimedCommandRobot(TimedRobot):
    """A robot that runs the scheduler itself (RobotPy commands2, timedcommandrobot.py)."""

    def __init__(self, period: float = 0.02) -> None:
        super().__init__(period)
        self.addPeriodic(CommandScheduler().run, period)


DECORATORS: dict[str, Callable[..., Any]] = {
    "withTimeout": lambda self, seconds: ParallelRaceGroup(self, WaitCommand(seconds)),
    "until": lambda self, condition: ParallelRaceGroup(self, WaitUntilCommand(condition)),
    "onlyWhile": lambda self, condition: self.until(lambda: not condition()),
    "beforeStarting": lambda self, before, *needed: SequentialCommandGroup(
        *make_steps(before, *needed), self
    ),
    "andThen": lambda self, *then: SequentialCommandGroup(self, *make_steps(*then)),
    "deadlineFor": lambda self, *parallel: ParallelDeadlineGroup(self, *parallel),
    "deadlineWith": lambda self, *parallel: ParallelDeadlineGroup(self, *parallel),
    "withDeadline": lambda self, deadline: ParallelDeadlineGroup(deadline, self),
    "alongWith": lambda self, *parallel: ParallelCommandGroup(self, *parallel),
    "raceWith": lambda self, *parallel: ParallelRaceGroup(self, *parallel),
    "repeatedly": lambda self: RepeatCommand(self),
    "asProxy": lambda self: ProxyCommand(self),
    "unless": lambda self, condition: ConditionalCommand(InstantCommand(), self, condition),
    "onlyIf": lambda self, condition: ConditionalCommand(self, InstantCommand(), condition),
    "ignoringDisable": lambda self, yes: WrapperCommand(self, when_disabled=yes),
    "withInterruptBehavior": lambda self, behavior: WrapperCommand(self, behavior=behavior),
    "finallyDo": lambda self, end: WrapperCommand(self, at_end=end),
    "handleInterrupt": lambda self, handler: WrapperCommand(
        self, at_end=lambda interrupted: handler() if interrupted else None
    ),
    "withName": lambda self, name: WrapperCommand(self, name=name),
}
MAKERS: dict[str, Callable[..., Any]] = {
    "run": lambda self, action: RunCommand(action, self),
    "runOnce": lambda self, action: InstantCommand(action, self),
    "runEnd": lambda self, run, end: Commands.runEnd(run, end, self),
    "startEnd": lambda self, start, end: StartEndCommand(start, end, self),
    "startRun": lambda self, start, run: Commands.startRun(start, run, self),
    "defer": lambda self, supplier: DeferredCommand(supplier, self),
    "idle": lambda self: Commands.idle(self),
    "getCurrentCommand": lambda self: CommandScheduler().requiring(self),
}
for _name, _method in DECORATORS.items():
    setattr(Command, _name, _method)
for _name, _method in MAKERS.items():
    setattr(Subsystem, _name, _method)
_OTHERS = "addChild close getSubsystem initSendable setSubsystem"
for _cls in [one for one in vars().values() if isinstance(one, FakeType)]:
    if _cls.__module__ == __name__ and _cls not in {EventLoop, CommandScheduler}:
        _whole = _cls is not Commands and not issubclass(_cls, PIDSubsystem | TimedRobot)
        fake(V2, "commands2", complete=_whole, others=_OTHERS)(_cls)
PYTHON["commands2"]["Subsystem"] = SubsystemBase  # RobotPy has only one of them
PYTHON["commands2.cmd"] = {
    one: getattr(Commands, one) for one in vars(Commands) if not one.startswith(("_", "fake_"))
}
