"""Makes the class of a program, and writes down the gains that it holds.

Constants, feedforwards, configurations of motor controllers and feedback loops are read where the
running program keeps them. Only comments, and how a constant was written, come from the text.
"""

import ast
import functools
import re
from collections.abc import Collection, Iterator
from dataclasses import dataclass, field
from typing import Any

from grader.robotcode.bench.constant_holders import (
    Field,
    list_java_holders,
    list_python_holders,
)
from grader.robotcode.bench.facts import ProgramFacts
from grader.robotcode.bench.routine_run import Bench
from grader.robotcode.comments import find_comments_near, list_comments
from grader.robotcode.library.commands import CommandScheduler
from grader.robotcode.library.phoenix6 import Record
from grader.robotcode.library.revlib import BaseConfig
from grader.robotcode.library.units import base_value
from grader.robotcode.library.world import WORLD
from grader.robotcode.python.imports import rename

HOLDER = re.compile(r"characteri[sz]ation", re.IGNORECASE)
# kS, K_S, ks, kSVolts, kvVoltSecondsPerMeter; not kStatic, kAngle.
GAIN = re.compile(r"[kK]_?([svagpSVAGP])(?=$|_|[A-Z0-9])(.*)")
CLASSES = {
    "SimpleMotorFeedforward": ("kS", "kV", "kA"),
    "ElevatorFeedforward": ("kS", "kG", "kV", "kA"),
    "ArmFeedforward": ("kS", "kG", "kV", "kA"),
}
SLOT0, FEED_FORWARD, CLOSED_LOOP = "Slot0Configs", "FeedForwardConfig", "ClosedLoopConfig"
SETTINGS = ("GravityType", "StaticFeedforwardSign")  # of Slot0Configs
RATIOS = ("SensorToMechanismRatio", "RotorToSensorRatio")  # of FeedbackConfigs
FEEDBACKS = ("Feedback", "ExternalFeedback")
PID, PIDS = ("kP", "kI", "kD"), ("PIDController", "ProfiledPIDController")
LETTERS = {"s": "kS", "v": "kV", "a": "kA", "g": "kG", "c": "kCos", "r": "kCosRatio"}
OTHER_SLOTS = {"kSlot1", "kSlot2", "kSlot3"}


@dataclass(frozen=True)
class GainConstant:
    """A gain that the program keeps under its name.

    Args:
        gain: ``kS``, ``kV``, ``kA``, ``kG`` or ``kP``.
        name: as written.
        holder: the class it is in; empty at the top of a file.
        value: the number while the program runs; None if nobody knows it.
        text: what it is given, as written.
        comment: the comments beside it and directly above it.
        line: its line, from 1.
    """

    gain: str
    name: str
    holder: str
    value: float | None
    text: str
    comment: str
    line: int


@dataclass(frozen=True)
class Gains:
    """A feedforward or a feedback loop that the program made, or set in a motor controller.

    Args:
        kind: WPILib's class; ``Slot0Configs``, ``FeedForwardConfig`` or ``ClosedLoopConfig`` in a
            motor controller.
        line: where it is made.
        gains: the numbers in it, by place: ``kV``, ``kCos``, ``SensorToMechanismRatio``; None if
            nobody knows it.
        step: [s] time step of a feedforward of WPILib; None if nobody knows it.
        choices: setting -> constant: ``GravityType`` -> ``Arm_Cosine``.
    """

    kind: str
    line: int
    gains: dict[str, float | None]
    choices: dict[str, str] = field(default_factory=dict)
    step: float | None = None


@dataclass(frozen=True)
class GainFacts(ProgramFacts):
    """The gains that a program holds.

    Args:
        constants: the gains, each once: that in the class for them before others.
        general: the comments in and above the class that is there for them.
        feedforwards, loops: those that were made, in order.
    """

    constants: tuple[GainConstant, ...] = ()
    general: str = ""
    feedforwards: tuple[Gains, ...] = ()
    loops: tuple[Gains, ...] = ()

    def find_constant(self, gain: str) -> GainConstant | None:
        """A gain's constant, if it is there."""
        return next((one for one in self.constants if one.gain == gain), None)


def find_gain_of_name(name: str) -> str:
    """The gain that a name stands for; empty if for none."""
    found = GAIN.fullmatch(name.lstrip("_").removeprefix("m_"))
    return f"k{found[1].upper()}" if found else ""


class GainsBench(Bench):
    """A program, and the gains in it."""

    kind = GainFacts

    def __init__(self, *args: Any) -> None:
        super().__init__(*args)
        watch_configurations()

    def look(self, _facts: dict[str, Any]) -> None:
        """Make the other classes as well, and let the scheduler run once."""
        self.guard(self._make_others)
        self.subject.refill()
        WORLD.mode, self.where = "teleop", "periodic"
        self.guard(lambda: CommandScheduler().run())

    def record_final_state(self, facts: dict[str, Any]) -> None:
        """List the gains."""
        self.subject.refill()
        java = self.subject.language == "java"
        holders = list((list_java_holders if java else list_python_holders)(self))
        constants = [one for holder in holders for one in self._list_constants(*holder)]
        constants.sort(key=lambda one: (not HOLDER.search(one.holder), len(one.name)))
        first = {one.gain: one for one in reversed(constants)}
        own = [one for one in holders if HOLDER.search(one[0])]
        facts |= {
            "constants": tuple(sorted(first.values(), key=lambda one: one.line)),
            "general": self._find_comments(own[0][1], *own[0][2]) if own else "",
            "feedforwards": (*list_feedforwards(), *list_slots(), *list_sparks()),
            "loops": tuple(list_loops()),
        }

    def _make_others(self) -> None:
        """Make the other classes of the file, as long as none holds a feedforward."""
        subject = self.subject
        if subject.language == "java":
            classes = [one for one in subject.program.unit.classes.values() if one.form == "class"]
        else:
            names = [one.name for one in subject.tree.body if isinstance(one, ast.ClassDef)]
            classes = [getattr(subject.module, rename(name)) for name in names]
        for one in classes:
            if not (WORLD.feedforwards or WORLD.pids or WORLD.configurations):
                subject.instance = subject.make(one)

    def _find_comments(self, text: str, first: int, last: int) -> str:
        return find_comments_near(list_comments(text, self.subject.language), first, last)

    def _list_constants(
        self, holder: str, text: str, _lines: object, fields: list[Field]
    ) -> Iterator[GainConstant]:
        for name, value, written, *lines in fields:
            gain = find_gain_of_name(name)
            if gain:
                said, number = self._find_comments(text, *lines), to_number(value)
                yield GainConstant(gain, name, holder, number, written, said, lines[0])


def to_number(value: Any) -> float | None:
    """A number, a measure in SI, or the number in an object that has only one; else None."""
    value = base_value(value)
    if hasattr(type(value), "java"):  # an enum's constant, for instance
        inner = [one for name, one in vars(value).items() if name.startswith(".")]
        value = base_value(inner[0]) if len(inner) == 1 else None
    known = isinstance(value, int | float) and not isinstance(value, bool)
    return float(value) if known else None


# -- feedforwards and loops ------------------------------------------------------------------


def watch_configurations() -> None:
    """Let every configuration of a motor controller be written down when it is made."""
    for base in (Record, BaseConfig):
        make = base.__init__
        if hasattr(make, "watched"):
            continue

        @functools.wraps(make)
        def run(self: Any, *args: Any, make: Any = make, **named: Any) -> None:
            make(self, *args, **named)
            if re.search(r"Config(s|uration)?$", type(self).__name__):
                self._line = WORLD.where()
                WORLD.configurations.append(self)

        run.watched = True  # type: ignore[attr-defined]
        base.__init__ = run  # type: ignore[method-assign]


def _name_class(thing: object, names: Collection[str]) -> str:
    """The name of the library's class from which an object's class derives."""
    return next(one.__name__ for one in type(thing).__mro__ if one.__name__ in names)


def list_feedforwards() -> Iterator[Gains]:
    """The feedforwards of WPILib's classes; those without any gain only if there is no other."""
    made = WORLD.feedforwards
    for one in [one for one in made if one.ks or one.kv or one.ka or one.kg] or made:
        kind = _name_class(one, CLASSES)
        gains = {name: to_number(getattr(one, name.lower())) for name in CLASSES[kind]}
        yield Gains(kind, int(one._line), gains, step=to_number(one.dt))


def _list_configurations(kind: type) -> list[Any]:
    """The configuration objects of a kind that the program created."""
    made = WORLD.configurations
    return [one for one in made if isinstance(one, kind)]


def _find_slots() -> Iterator[tuple[Any, list[Any]]]:
    """Every first slot in use, else every one that was made, and the settings of its feedback."""
    used = [one._config for one in WORLD.devices if hasattr(one, "_config")]
    for records in (used, _list_configurations(Record)):
        slots = [(one, one._values.get("Slot0", one)) for one in records]
        slots = [(one, slot) for one, slot in slots if type(slot).__name__ == SLOT0]
        slots = [
            (one, slot) for one, slot in slots if any(slot._values[f"k{n}"] for n in "PIDSVAG")
        ]
        for one, slot in slots:
            slot._line = getattr(slot, "_line", getattr(one, "_line", 0))
            own = [one] if records is used else records
            parts = [part._values.get(name, part) for part in own for name in FEEDBACKS]
            yield slot, [part for part in parts if RATIOS[0] in part._values]
        if slots:
            return


def list_slots() -> Iterator[Gains]:
    """Phoenix 6's slots with a gain of a feedforward in them."""
    for slot, feedbacks in _find_slots():
        gains = {name: to_number(slot._values[name]) for name in ("kS", "kV", "kA", "kG")}
        if any(value != 0 for value in gains.values()):
            for part in feedbacks:
                for name in RATIOS:
                    if part._values[name] is not part._defaults[name]:  # somebody set it
                        gains[name] = to_number(part._values[name])
            choices = {name: slot._values[name].name for name in SETTINGS}
            yield Gains(SLOT0, int(slot._line), gains, choices)


def _find_sparks(kind: str) -> Iterator[tuple[int, dict[str, Any]]]:
    """Line and settings of REVLib's configurations of a class: those in use, or else all."""
    part = "closedLoop.feedForward." if kind == FEED_FORWARD else "closedLoop."
    used = [
        (
            one._line,
            {n.removeprefix(part): v for n, v in one._settings.items() if n.startswith(part)},
        )
        for one in WORLD.devices
        if hasattr(one, "_settings")
    ]
    made = _list_configurations(BaseConfig)
    built = [(one._line, one._given) for one in made if type(one).__name__ == kind]
    filled = [(line, given) for line, given in used if given]
    return ((int(line), given) for line, given in filled or built if given)


def list_sparks() -> Iterator[Gains]:
    """REVLib's configurations of a feedforward: kV(…) and, for several gains, sva(…)."""
    for line, given in _find_sparks(FEED_FORWARD):
        gains: dict[str, float | None] = {}
        for name, values in given.items():
            if getattr(values[-1], "name", "") not in OTHER_SLOTS:
                names = [name] if name in LETTERS.values() else [LETTERS[one] for one in name]
                gains |= {one: to_number(v) for one, v in zip(names, values, strict=False)}
        if gains:
            yield Gains(FEED_FORWARD, line, gains)


def list_loops() -> Iterator[Gains]:
    """The feedback loops, in the program and in motor controllers."""
    found: list[tuple[str, Any, Any]] = [
        (_name_class(one, PIDS), one._line, (one._p, one._i, one._d)) for one in WORLD.pids
    ]
    for slot, _ in _find_slots():
        found.append((SLOT0, slot._line, [slot._values[name] for name in PID]))
    for line, given in _find_sparks(CLOSED_LOOP):
        pid = [*given.get("pid", given.get("pidf", (0.0,) * 3))][:3]
        for at, name in enumerate("pid"):
            pid[at] = given.get(name, given.get(name.upper(), [pid[at]]))[0]
        found.append((CLOSED_LOOP, line, pid))
    for kind, line, values in found:
        yield Gains(kind, int(line), dict(zip(PID, map(to_number, values), strict=True)))
