"""Commands v3 of WPILib 2027: commands whose body is one function, which pauses in every loop.

They run on the scheduler of Commands v2, where a command's body runs to its next pause in each
loop. Priorities have no effect. A body runs in a thread of its own, and only while the scheduler
waits for it: so it can pause anywhere, and nothing runs at the same time.
"""

import threading
from collections.abc import Callable
from typing import Any

from grader.robotcode.library import commands as v2
from grader.robotcode.library.base import Fake, WrongArgument, fake
from grader.robotcode.library.commands import CommandScheduler, flatten, nothing
from grader.robotcode.library.timing import in_seconds
from grader.robotcode.library.triggers import Trigger
from grader.robotcode.library.world import WORLD

V3 = "org.wpilib.command3"
BUILDERS = (
    *("NeedsNameBuilderStage", "NeedsExecutionBuilderStage", "StagedCommandBuilder"),
    *("ParallelGroupBuilder", "SequentialGroupBuilder"),
)


class _StoppedError(BaseException):
    """Ends the thread of a body that was cancelled."""


class Coroutine(Fake):
    """One run of a command's body (allwpilib main, commandsv3/.../Coroutine.java)."""

    def __init__(self, command: "Command") -> None:
        self._command = command
        self._done = self._stopping = False
        self._forked: list[Any] = []
        self._error: BaseException | None = None
        self._turn, self._back = threading.Semaphore(0), threading.Semaphore(0)
        threading.Thread(target=self._live, daemon=True).start()

    def _live(self) -> None:
        self._turn.acquire()
        try:
            if not self._stopping:
                self._command.run(self)
        except _StoppedError:
            pass
        except BaseException as error:  # noqa: BLE001 - it is raised where the scheduler runs
            self._error = error
        self._done = True
        self._back.release()

    def _step(self, *, stop: bool = False) -> bool:
        """Run it to its next pause, or stop it there; whether it has come to its end."""
        self._stopping = stop
        if not self._done:
            self._turn.release()
            self._back.acquire()
        if self._done:
            CommandScheduler().cancel(*self._forked)
        error, self._error = self._error, None
        if error is not None:
            raise error
        return self._done

    def yield_(self) -> bool:
        self._back.release()
        self._turn.acquire()
        if self._stopping:
            raise _StoppedError
        return True

    def park(self) -> None:
        self.waitUntil(nothing)

    def wait(self, duration: Any) -> None:
        end = WORLD.time + in_seconds(duration)
        self.waitUntil(lambda: WORLD.time >= end)

    def waitUntil(self, condition: Callable[..., Any]) -> None:
        while not condition():
            self.yield_()

    def fork(self, *commands: Any) -> None:
        self._forked += flatten(commands)
        CommandScheduler().schedule(*commands)

    def _join(self, kind: type, commands: Any) -> None:  # in collections, too
        mine = self._command.getRequirements()
        own = [(one, mine >= set(one.getRequirements())) for one in flatten(commands)]
        group = kind(*[one if owned else v2.ProxyCommand(one) for one, owned in own])
        group.initialize()
        ended = False
        try:
            while not ended:
                group.execute()
                ended = group.isFinished() or not self.yield_()
        finally:
            group.end(not ended)

    def await_(self, *commands: Any) -> None:
        self._join(Parallel, commands)

    awaitAll = await_

    def awaitAny(self, *commands: Any) -> None:
        self._join(Race, commands)


class Command(v2.Command):
    """Something that a robot does (allwpilib main, commandsv3/.../Command.java)."""

    _when_disabled = True
    name = v2.Command.getName

    def run(self, coroutine: Coroutine) -> None:
        """Do nothing, which a subclass changes."""

    def onCancel(self) -> None:
        """Do nothing, which a subclass changes."""

    def onExit(self) -> None:
        """Do nothing, which a subclass changes."""

    def initialize(self) -> None:
        self._coroutine = Coroutine(self)

    def execute(self) -> None:
        self._ended = self._coroutine._step()

    def isFinished(self) -> bool:
        return self._ended

    def end(self, interrupted: bool) -> None:
        if interrupted:
            self._coroutine._step(stop=True)
            self.onCancel()
        self.onExit()

    def requirements(self) -> set[Any]:
        return self._command_needs

    def getRequirements(self) -> set[Any]:
        return set(self.requirements())

    def requires(self, mechanism: "Mechanism") -> bool:
        return mechanism in self.getRequirements()

    def withTimeout(self, timeout: Any) -> "Command":
        return Builder(Race, self, v2.WaitCommand(timeout)).named(self.getName())

    def until(self, condition: Callable[..., Any]) -> "Builder":
        return Builder(Race, self, v2.WaitUntilCommand(condition))

    def andThen(self, *next: Any) -> "Builder":
        return Builder(Sequence, self, *next)

    def alongWith(self, *parallel: Any) -> "Builder":
        return Builder(Parallel, self, *parallel)

    def raceWith(self, *parallel: Any) -> "Builder":
        return Builder(Race, self, *parallel)

    @staticmethod
    def requiring(*mechanisms: Any) -> "Builder":
        return Builder(Command, *mechanisms)

    @staticmethod
    def noRequirements(*body: Any) -> "Builder":
        return Builder(Command).executing(*body or (nothing,))

    @staticmethod
    def sequence(*commands: Any) -> "Builder":
        return Builder(Sequence, *commands)

    @staticmethod
    def parallel(*commands: Any) -> "Builder":
        return Builder(Parallel, *commands)

    @staticmethod
    def race(*commands: Any) -> "Builder":
        return Builder(Race, *commands)

    @staticmethod
    def waitUntil(condition: Callable[..., Any]) -> "Builder":
        return Builder(Parallel, v2.WaitUntilCommand(condition))

    @staticmethod
    def waitFor(duration: Any) -> "Builder":
        return Builder(Parallel, v2.WaitCommand(duration))


class Sequence(v2.SequentialCommandGroup, Command):
    """One command after another."""

    _owning = False


class Parallel(v2.ParallelCommandGroup, Command):
    """All at once, until the last ends."""

    _owning = False


class Race(v2.ParallelRaceGroup, Command):
    """All at once, until the first ends."""

    _owning = False


class Builder(Fake):
    """A command that is being put together (allwpilib main, .../StagedCommandBuilder.java)."""

    def __init__(
        self, kind: type, *parts: Any
    ) -> None:  # the mechanisms, or the commands of a group
        self._kind = kind
        self._parts = list(flatten(parts))
        self._changes: dict[str, Any] = {}
        self._until: Any = None

    def requiring(self, *parts: Any) -> "Builder":
        self._parts += flatten(parts)
        return self

    andThen = alongWith = raceWith = requiring

    def executing(self, body: Callable[..., Any]) -> "Builder":
        if v2.count_parameters(body) == 0:
            raise WrongArgument(
                "run() of a Mechanism takes a coroutine: write runRepeatedly(() -> ...), or"
                " run(coroutine -> ...) with a loop that calls coroutine.yield()"
            )
        self._changes["run"] = body
        return self

    def whenCanceled(self, onCancel: Callable[..., Any]) -> "Builder":
        self._changes["onCancel"] = onCancel
        return self

    def whenExited(self, onExit: Callable[..., Any]) -> "Builder":
        self._changes["onExit"] = onExit
        return self

    def until(self, endCondition: Callable[..., Any]) -> "Builder":
        self._until = endCondition
        return self

    def withPriority(self, priority: int) -> "Builder":  # all are equal here
        return self

    def named(self, name: str) -> Command:
        made = self._kind() if self._kind is Command else self._kind(*self._parts)
        if self._kind is Command:
            made.addRequirements(*self._parts)
        vars(made).update(self._changes)
        if self._until is not None:
            made = Race(made, v2.WaitUntilCommand(self._until))
        made.setName(name)
        return made

    def withAutomaticName(self) -> Command:
        return self.named(", ".join(one.getName() for one in self._parts))


class Mechanism(v2.RobotPart):
    """A part of the robot (allwpilib main, commandsv3/.../Mechanism.java)."""

    def __init__(self, name: str = "", *_scheduler: object) -> None:
        self.setName(name)
        CommandScheduler().registerSubsystem(self)

    def run(self, commandBody: Callable[..., Any]) -> Builder:
        return Builder(Command, self).executing(commandBody)

    def runRepeatedly(self, loopBody: Callable[..., Any]) -> Builder:
        def body(coroutine: Coroutine) -> None:
            coroutine.waitUntil(lambda: loopBody() and False)

        return self.run(body)

    def idle(self) -> Command:
        return self.runRepeatedly(nothing).named(f"{self.getName()}[IDLE]")


class Scheduler(Fake):
    """Runs commands (allwpilib main, commandsv3/.../Scheduler.java), as that of Commands v2."""

    @staticmethod
    def getDefault() -> "Scheduler":
        return Scheduler()

    def getDefaultEventLoop(self) -> v2.EventLoop:
        return CommandScheduler().getDefaultButtonLoop()

    def addPeriodic(self, callback: Callable[..., Any]) -> None:
        WORLD.each_loop.append(callback)

    def isRunning(self, command: Command) -> bool:
        return CommandScheduler().isScheduled(command)

    isScheduled = isScheduledOrRunning = isRunning

    def schedule(self, command: Command) -> None:
        CommandScheduler().schedule(command)

    def cancel(self, command: Command) -> None:
        CommandScheduler().cancel(command)

    def cancelAll(self) -> None:
        CommandScheduler().cancelAll()

    def run(self) -> None:
        CommandScheduler().run()


for _cls in (Coroutine, Command, Mechanism, Scheduler, Trigger):
    fake(V3)(_cls)
for _name in BUILDERS:
    fake(V3, name=_name)(Builder)
