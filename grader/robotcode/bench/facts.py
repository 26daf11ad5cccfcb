"""Plain facts about a program's behavior on the bench; the checks judge them.

Facts cross from the process that ran the program as JSON (``to_json``, ``from_json``).
"""

import dataclasses
import types
import typing
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any

from grader.robotcode.problems import ParseProblem

TESTS = ("quasistatic-forward", "quasistatic-reverse", "dynamic-forward", "dynamic-reverse")


class Outcome(StrEnum):
    """How a run ended."""

    RAN = "ran"
    CRASHED = "crashed"
    ENDLESS = "endless"
    CANNOT = "cannot"


@dataclass(frozen=True)
class Stop:
    """What ended a program early.

    Args:
        outcome: how.
        where: ``start``, ``drive``, ``log``, ``periodic``, or ``command``.
        said: the error, in words.
        line: where it happened; 0 if unknown.
        test: the test that ran; empty if none did.
    """

    outcome: Outcome
    where: str
    said: str
    line: int = 0
    test: str = ""
    kind: str = ""


@dataclass(frozen=True)
class Setting:
    """A number of the Config.

    Args:
        value: in SI; None where nobody knows it.
        default: whether it was left to WPILib.
        text: what the program passed, for messages: ``0.5 V``.
        line: where the Config was made.
        problem: what is wrong with it, if it is no number of this kind.
        misconception: the one behind that.
    """

    value: float | None = None
    default: bool = False
    text: str = ""
    line: int = 0
    problem: str = ""
    misconception: str = ""


@dataclass(frozen=True)
class Sent:
    """A kind of command that a motor received.

    Args:
        kind: as in ``devices.Command``.
        method: the call.
        line: where it stands.
        phase: the code that called: ``drive``, ``log``, ``periodic`` or ``other``.
    """

    kind: str
    method: str
    line: int
    phase: str


@dataclass(frozen=True)
class Driven:
    """The voltages that one motor received in one test.

    Args:
        loops: of the test.
        wrong: loops in which it got another voltage than the test asked for.
        at: the first such loop: time [s], voltage asked for and voltage got [V].
        ratio: got over asked, if that is the same all the time; else None.
        steady: whether it got one and the same voltage nearly all the time.
        late: whether it got each voltage a loop late.
        never: whether it got no voltage at all.
        flipped: whether its inversion changed during the test.
        unknown: what its voltage comes from, if nobody knows it.
        sent: the commands, each kind once.
        cut: the position [rot] from which on it got no voltage until the end of the test; None if
            there was none.
    """

    loops: int = 0
    wrong: int = 0
    at: tuple[float, float, float] = (0.0, 0.0, 0.0)
    ratio: float | None = None
    steady: bool = False
    late: bool = False
    never: bool = False
    flipped: bool = False
    unknown: str = ""
    sent: tuple[Sent, ...] = ()
    cut: float | None = None


@dataclass(frozen=True)
class Signal:
    """One signal in the log of one motor, in one test.

    Args:
        loops: in which it was written.
        line, unit, family: as the code has them.
        follows: what it is in truth, as ``voltage m_left``: empty if nothing true goes like it.
        owners: the motors of which it could be.
        scale: how much of it one unit of the truth is: 1 for a voltage, SI per rotation of the
            motor for a position or a velocity.
        offset: what it is where the truth is zero.
        still: whether it never changed.
        idle: whether no motor turned all the time, so that nothing can be told.
        asked: whether it is the voltage that the test asked for, also where the motor got less.
        battery: whether it is the battery's voltage.
        absolute: whether it is right but for its sign.
        unknown: what it comes from, if nobody knows it.
        twice: whether it was written more than once in a loop.
        values: the first and the last one.
    """

    loops: int = 0
    line: int = 0
    unit: str = ""
    family: str = ""
    follows: str = ""
    owners: tuple[str, ...] = ()
    scale: float | None = None
    offset: float = 0.0
    still: bool = False
    idle: bool = False
    asked: bool = False
    battery: bool = False
    absolute: bool = False
    unknown: str = ""
    twice: bool = False
    values: tuple[float, float] = (0.0, 0.0)


@dataclass(frozen=True)
class TestRun:
    """One test that a program ran.

    Args:
        lasted: [s] until it ended by itself; infinite if it was still running when let go.
        loops: in which the drive callback was called.
        logs: how often the log callback was.
        motors: by name.
        signals: by the name in the log, then by signal.
        blocked: [s] for which the program kept the loop waiting.
    """

    lasted: float = 0.0
    loops: int = 0
    logs: int = 0
    motors: dict[str, Driven] = field(default_factory=dict)
    signals: dict[str, dict[str, Signal]] = field(default_factory=dict)
    blocked: float = 0.0


@dataclass(frozen=True)
class DeviceFacts:
    """A motor or sensor.

    Args:
        name: of the field that holds it.
        type: of its class.
        motor: whether it is a motor.
        port: in words, the same for two devices that are one.
        number: of the port; negative or too large ones are mistakes.
        line: where it is made.
        follows: the name of its leader; ``?`` if there is none; empty if it follows nothing.
        inverted: whether its settings turn it around.
        backward: whether plus drives its side of the task's mechanism backward.
        mounted: whether the task says how it is built in.
        turned_by: the motor that turns a sensor.
        gearing: rotations of its motor per unit of rotation that it reports.
    """

    name: str
    type: str
    motor: bool
    port: str = ""
    number: float | None = None
    line: int = 0
    follows: str = ""
    inverted: bool = False
    backward: bool = False
    mounted: bool = False
    turned_by: str = ""
    gearing: float = 1.0


@dataclass(frozen=True)
class ProgramFacts:
    """What all runs of a program tell.

    Args:
        language: ``java`` or ``python``.
        name: of the class.
        season: of WPILib, by its packages.
        errors: what a compiler would refuse.
        unknown: what nobody knows: classes and conditions, with their lines.
        stop: what ended the program early; None if nothing did.
    """

    language: str
    name: str
    season: int = 2026
    errors: tuple[ParseProblem, ...] = ()
    unknown: dict[str, int] = field(default_factory=dict)
    stop: Stop | None = None


@dataclass(frozen=True)
class RoutineFacts(ProgramFacts):
    """Facts about the SysIdRoutine of a subsystem.

    Args:
        line: where the routine is made; 0 if there is none.
        kept: whether something keeps the routine, so that a test can be started.
        swapped: whether the routine got its Mechanism first.
        is_subsystem: whether the class is a subsystem.
        requires: ``own``, ``other`` or ``none``: which subsystem the tests require.
        drive, log: whether there is such a callback; None of the log where it is null.
        own_log: whether a vendor's logger records the state.
        ramp, step, timeout: the Config.
        devices: all.
        tests: by name.
    """

    line: int = 0
    kept: bool = True
    swapped: bool = False
    is_subsystem: bool = True
    requires: str = "own"
    drive: bool = True
    log: bool | None = True
    own_log: bool = False
    ramp: Setting = Setting()
    step: Setting = Setting()
    timeout: Setting = Setting()
    devices: tuple[DeviceFacts, ...] = ()
    tests: dict[str, TestRun] = field(default_factory=dict)

    @property
    def motors(self) -> dict[str, DeviceFacts]:
        """The motors by name."""
        return {one.name: one for one in self.devices if one.motor}


def to_json(facts: Any) -> Any:
    """Facts as what JSON can hold."""
    return dataclasses.asdict(facts)


def from_json(kind: Any, content: Any) -> Any:
    """Facts out of what JSON held.

    Raises:
        TypeError: the content is not of this kind.
        KeyError, ValueError: the same.
    """
    origin = typing.get_origin(kind)
    if origin in {typing.Union, types.UnionType}:
        if content is None:
            return None
        return from_json(next(o for o in typing.get_args(kind) if o is not type(None)), content)
    if origin is tuple:
        inner = typing.get_args(kind)
        many = [inner[0]] * len(content) if inner[-1] is Ellipsis else inner
        return tuple(from_json(k, one) for k, one in zip(many, content, strict=True))
    if origin is dict:
        inner = typing.get_args(kind)[1]
        return {str(key): from_json(inner, one) for key, one in content.items()}
    if isinstance(kind, type) and dataclasses.is_dataclass(kind):
        hints = typing.get_type_hints(kind)
        return kind(**{key: from_json(hints[key], one) for key, one in content.items()})
    return _make_plain(kind, content)


def _make_plain(kind: Any, content: Any) -> Any:
    """A number, a text, or a constant of an enum.

    Raises:
        TypeError: the content is not of this kind.
    """
    if kind is float and isinstance(content, int | float) and not isinstance(content, bool):
        return float(content)
    if kind in {int, bool, str} and type(content) is not kind:
        raise TypeError(f"{content!r} is not {kind.__name__}")
    return kind(content)
