"""What is known of a value on its way through a callback: its sources, and what was done to it."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum

from grader.robotcode.ir import Node
from grader.robotcode.readings import DeviceReading
from grader.robotcode.scope import Scope

CHANGED = math.nan  # a factor that is not one, and no constant either: 1 / battery voltage


class Mark(Enum):
    """A source that a value depends on."""

    APPLIED = "applied"  # a voltage the motor controller reports
    DUTY = "duty"  # the share of the bus voltage it reports
    BUS = "bus"  # the bus or battery voltage
    MEASURED = "measured"  # a sensor
    UNSIGNED = "unsigned"  # a function that drops the sign
    COMMANDED = "commanded"  # what the drive callback was asked for


@dataclass(frozen=True)
class MotorLog:
    """What ``log.motor(name)`` gives; the log itself where ``name`` is None."""

    name: str | None = None


@dataclass(frozen=True)
class Value:
    """An abstract value: what the program text tells about it.

    Args:
        origin: the node it comes from, variables followed.
        scope: where that stands.
        me: the object whose code that is: empty for the subsystem, ``m_left.`` for one it owns.
        carries: whether the callback's parameter is in it; None if unknown.
        factor: what the parameter was multiplied with; CHANGED, or None if unknown.
        closed: whether a feedback controller made it.
        marks: its sources.
        readings: the numbers of devices in it.
        scale: what a reading was multiplied with; None if unknown.
        unit: the unit it was wrapped in, as written.
        log: set if it is the routine's log, or the part of it for one motor.
        captured: for a lambda, the variables around it.
    """

    origin: Node
    scope: Scope
    me: str = ""
    carries: bool | None = False
    factor: float | None = 1.0
    closed: bool = False
    marks: frozenset[Mark] = frozenset()
    readings: frozenset[DeviceReading] = frozenset()
    scale: float | None = 1.0
    unit: str = ""
    log: MotorLog | None = None
    captured: "dict[str, Value]" = field(default_factory=dict)

    @property
    def is_scaled(self) -> bool | None:
        """Whether the parameter is changed in it, a sign apart; None if unknown."""
        if not self.carries:
            return self.carries
        return None if self.factor is None else not math.isclose(abs(self.factor), 1.0)

    @property
    def is_informative(self) -> bool:
        """Whether anything is known about it."""
        return self.carries is not False or bool(self.marks) or self.closed or self.log is not None

    def times(self, factor: float | None) -> "Value":
        """The value multiplied by a factor; None if the factor is unknown."""
        known = None if factor is None or self.factor is None else self.factor * factor
        scale = None if factor is None or self.scale is None else self.scale * factor
        return replace(self, factor=known, scale=scale)


def join_values(values: Sequence[Value], *, at: Value) -> Value:
    """One value that is made of several, or may be any of them.

    Args:
        values: the several; a factor survives if all that carry the parameter agree on it.
        at: where the one is: its origin, scope and object are kept.
    """
    factors = {value.factor for value in values if value.carries is not False}
    scales = {value.scale for value in values if value.readings}
    return replace(
        at,
        carries=_any(value.carries for value in values),
        factor=1.0 if not factors else factors.pop() if len(factors) == 1 else None,
        closed=any(value.closed for value in values),
        marks=frozenset().union(*(value.marks for value in values)),
        readings=frozenset().union(*(value.readings for value in values)),
        scale=1.0 if not scales else scales.pop() if len(scales) == 1 else None,
        unit=next((value.unit for value in values if value.unit), ""),
        log=next((value.log for value in values if value.log is not None), None),
    )


def _any(several: Iterable[bool | None]) -> bool | None:
    found = set(several)
    return True if True in found else None if None in found else False
