"""Commands v3 of WPILib 2027, on the scheduler of Commands v2.

A command that a program builds around a coroutine is bound, guarded and cancelled as any other,
but its body is not run: no test of SysId is in one.
"""

from collections.abc import Callable
from typing import Any

from grader.robotcode.library import commands as v2
from grader.robotcode.library.base import Fake, WrongArgument, fake
from grader.robotcode.library.commands import CommandScheduler, flatten, nothing
from grader.robotcode.library.triggers import Trigger

V3 = "org.wpilib.command3"
BUILDERS = (
    *("NeedsNameBuilderStage", "NeedsExecutionBuilderStage", "StagedCommandBuilder"),
    *("ParallelGroupBuilder", "SequentialGroupBuilder"),
)


class Builder(Fake):
    """A command that is being put together (allwpilib main, .../StagedCommandBuilder.java).

    Its steps lead to itself, except for the last, which gives it its name.
    """

    def __init__(self, *parts: Any) -> None:  # the mechanisms, or the commands of a group
        self._parts, self._body = list(flatten(parts)), nothing

    def requiring(self, *parts: Any) -> "Builder":
        self._parts += flatten(parts)
        return self

    def executing(self, body: Callable[..., Any]) -> "Builder":
        if v2.count_parameters(body) == 0:
            raise WrongArgument(
                "run() of a Mechanism takes a coroutine: write runRepeatedly(() -> ...), or"
                " run(coroutine -> ...) with a loop that calls coroutine.yield()"
            )
        return self

    def named(self, name: str) -> v2.Command:
        commands = [one for one in self._parts if isinstance(one, v2.Command)]
        made = Group(*commands) if commands else v2.RunCommand(self._body, *self._parts)
        made._when_disabled = True
        made.setName(name)
        return made

    def withAutomaticName(self) -> v2.Command:
        return self.named("")

    def __getattr__(self, name: str) -> Any:  # whatever the step is
        if name.startswith("_"):
            raise AttributeError(name)
        return lambda *_settings: self

    andThen = alongWith = raceWith = requiring


class Group(v2.SequentialCommandGroup):
    """Commands of one group: which of them run at the same time does not matter here."""

    _owning = False


class Command(v2.Command):
    """Something that a robot does (allwpilib main, commandsv3/.../Command.java)."""

    _when_disabled = True


class Mechanism(v2.RobotPart):
    """A part of the robot (allwpilib main, commandsv3/.../Mechanism.java)."""

    def __init__(self, name: str = "", *_scheduler: object) -> None:
        self.setName(name)
        CommandScheduler().registerSubsystem(self)

    def run(self, commandBody: Callable[..., Any]) -> Builder:
        return Builder(self).executing(commandBody)

    def runRepeatedly(self, loopBody: Callable[..., Any]) -> Builder:
        builder = Builder(self)
        builder._body = loopBody
        return builder

    def idle(self) -> v2.Command:
        return Builder(self).named(f"{self.getName()}[IDLE]")


class Scheduler(Fake):
    """Runs commands (allwpilib main, commandsv3/.../Scheduler.java), as that of Commands v2."""

    @staticmethod
    def getDefault() -> CommandScheduler:
        return CommandScheduler()


def _build(*parts: Any) -> Builder:
    return Builder(*parts)


for _name in ("requiring", "noRequirements", "sequence", "parallel", "race"):
    setattr(Command, _name, staticmethod(_build))
for _cls in (Command, Mechanism, Scheduler, Trigger):
    fake(V3)(_cls)
for _name in BUILDERS:
    fake(V3, name=_name)(Builder)
