"""Mistakes that can be recognized by a wrong number, such as a factor of 2π.

A slip is a suspect when undoing it brings the number into the band for full marks. One suspect is
named, two or three are named side by side, and more say nothing.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations
from pathlib import Path

from grader.answers.asked_number import AskedNumber
from grader.checks.texts import read_texts

MANY = 3  # more suspects than this tell the learner nothing
NOTICED = 1.2  # a gear ratio nearer to 1 would explain any number that is a little off
LARGE = 1000.0  # from here on a factor is written without decimals
NO_FRICTION = 0.1  # [share of kS] a fit in which forward and reverse cancel finds less
ALIKE = 0.02  # [share] how near a number has to be to what a wrong recipe gives on the same log


@dataclass(frozen=True)
class WrongNumber:
    """One way to get a wrong number.

    Args:
        code: a short name; the same slip in two numbers has the same code.
        says: what it may have been, for the learner: a question, as a number alone proves no slip.
        misconception: its code, or empty.
    """

    code: str
    says: str
    misconception: str = ""


@dataclass(frozen=True)
class Lookalike:
    """The number that a wrong method gives on the learner's own log."""

    value: float
    slip: WrongNumber


class Slips:
    """The slips of an exercise, with the sentences about each from its file ``slips.toml``.

    A name comes before its sentence. A slip stands in the table of its misconception, or above all
    tables if it has none::

        measured = "is this the measured kV? Compute the theoretical one"
        [M-UNITS]
        rpm = "60 seconds are a minute. Did you divide by rpm?"

    Args:
        path: of the file.
    """

    def __init__(self, path: Path) -> None:
        found = read_texts(path)
        self._says = {code: (one, "") for code, one in found.items() if isinstance(one, str)}
        for misconception, table in found.items():
            if isinstance(table, dict):
                self._says |= {code: (says, misconception) for code, says in table.items()}

    def name(self, code: str, **fields: object) -> WrongNumber:
        """A slip in words.

        Args:
            code: its name in the file.
            fields: what stands for the ``{}`` of its sentence.
        """
        says, misconception = self._says[code]
        return WrongNumber(code, says.format(**fields) if fields else says, misconception)

    def list_lookalikes(
        self, numbers: Iterable[tuple[str, float]], **fields: object
    ) -> tuple[Lookalike, ...]:
        """The numbers that slips give, each with its words.

        Args:
            numbers: the slip's name, and the number that it gives.
            fields: what stands for the ``{}`` of their sentences.
        """
        return tuple(Lookalike(value, self.name(code, **fields)) for code, value in numbers)


def are_distinguishable(
    lookalikes: Sequence[Lookalike], *, apart: float, by: Callable[[WrongNumber], str]
) -> bool:
    """Whether no slip's number passes for that of a slip with other advice.

    Args:
        lookalikes: the numbers of slips.
        apart: [share] by which two of them differ at least.
        by: what is said of a slip: two with the same advice may look alike.
    """
    return all(
        by(one.slip) == by(other.slip) or abs(one.value / other.value - 1.0) >= apart
        for one, other in combinations(lookalikes, 2)
    )


@dataclass(frozen=True)
class Scene:
    """Facts about the mechanism and the tests that help to recognize slips.

    Args:
        angular: whether the mechanism turns instead of going along.
        ratio: turns of the motor for one of the mechanism.
        motors: how many motors drive it.
        ramp: [V/s] of the quasistatic test.
        period: [s] between two samples; 0 if there are none.
        lookalikes: gain -> numbers of wrong methods, in the unit of the answer.
        rarer: the same, of recipes that are suspected only where nothing else explains a number.
        computed: whether a program computed the number from the log: no pocket calculator, data
            sheet or rounding is behind it.
    """

    angular: bool = False
    ratio: float = 1.0
    motors: int = 1
    ramp: float = 0.0
    period: float = 0.0
    lookalikes: Mapping[str, tuple[Lookalike, ...]] = field(default_factory=dict)
    rarer: Mapping[str, tuple[Lookalike, ...]] = field(default_factory=dict)
    computed: bool = False


@dataclass(frozen=True)
class AnswerKey:
    """The numbers of an exercise, and the mechanism and tests they belong to."""

    asked: Mapping[str, AskedNumber]
    scene: Scene = field(default_factory=Scene)


def explain_wrong_number(name: str, value: float, key: AnswerKey) -> tuple[WrongNumber, ...]:
    """The mistakes that would explain a wrong number.

    Args:
        name: the gain: ``kV``.
        value: the learner's number, in the unit of the answer.
        key: the right numbers, the mechanism and its tests.
    """
    asked, scene = key.asked, key.scene
    right = asked[name].is_right
    found = list(_explain_by_factors(name, value, asked[name], scene))
    rarer = tuple(likely.slip for likely in scene.rarer.get(name, ()) if _looks_like(value, likely))
    if name == "kS" and {"kV", "kA"} <= asked.keys() and not rarer:  # theirs is the narrower band
        excess = asked["kA"].expected / asked["kV"].expected * scene.ramp
        if excess > 0 and right(value - excess):
            found.append(_INTERCEPT)
        if scene.period and not found and abs(value) <= NO_FRICTION * asked[name].expected:
            found.append(_CANCELED)
    if name in {"kV", "kA"} and value and right(1.0 / value):
        found.append(_UPSIDE_DOWN)
    for likely in () if _is_rounded(value, asked[name]) else scene.lookalikes.get(name, ()):
        if _looks_like(value, likely) and likely.slip not in found:
            found.append(likely.slip)
    return tuple(found) or rarer


def _is_rounded(value: float, asked: AskedNumber) -> bool:
    """Whether a number is the right one, rounded to the digits that the learner wrote."""
    return round(asked.expected, len(repr(value).partition(".")[2])) == value


def _looks_like(value: float, likely: Lookalike) -> bool:
    return abs(value - likely.value) <= ALIKE * abs(likely.value)


_INTERCEPT = WrongNumber(
    "intercept",
    "a little too large, by about the voltage that accelerates the mechanism during the ramp. Is "
    "your kS where the line through the quasistatic runs crosses v = 0?",
    "M-KS-INTERCEPT",
)

_CANCELED = WrongNumber(
    "canceled",
    "there is almost no friction in this. Is the column of kS in your fit the same number in every "
    "row? Then forward and reverse cancel: it has to be sgn(v)",
)

_UPSIDE_DOWN = WrongNumber(
    "upside-down", "is this upside down? kV and kA are volts for a unit, not units for a volt"
)


def _explain_by_factors(
    name: str, value: float, asked: AskedNumber, scene: Scene
) -> Iterator[WrongNumber]:
    if asked.is_right(-value):
        says = "the size is right, the sign is not"
        if scene.ramp and asked.unit.startswith("V"):
            says += (
                ". Do all your gains have the wrong sign? Then the voltage or the velocity has it: "
                "positive volts have to give a positive velocity. Else look for a lost minus"
            )
        yield WrongNumber("sign", says)
    factors = [*_list_factors(scene, velocity=name in {"kV", "kA"}, unit=asked.unit)]
    if name == "kA" and scene.period:
        says = (
            f"the time between two samples is {scene.period:g} s. Did you divide the change of "
            "velocity by this time?"
        )
        factors.append((1.0 / scene.period, WrongNumber("period", says)))
    for factor, slip in factors:
        for times, way in ((factor, "small"), (1.0 / factor, "large")):
            if asked.is_right(value * times):
                shown = f"{factor:.3g}" if factor < LARGE else f"{factor:.0f}"
                says = f"about {shown} times too {way}: {slip.says}"
                yield replace(slip, says=says)


def _list_factors(
    scene: Scene, *, velocity: bool, unit: str
) -> Iterator[tuple[float, WrongNumber]]:
    """The factors a number may be off by; kS and kG have no velocity in their unit."""
    if scene.computed:
        return
    if unit.startswith("V"):
        duty = "12 V is a full battery. Did you use an output between -1 and 1 in place of volts?"
        yield (12.0, WrongNumber("duty", duty, "M-DUTY"))
    if not velocity:
        small = {
            "V": "1 V is 1000 mV. Are these millivolts?",
            "m": "1 m is 1000 mm. Is this in mm?",
        }
        if unit in small:
            yield (1000.0, WrongNumber("milli", small[unit], "M-UNITS"))
        return
    yield from _list_unit_factors(scene)
    gears = max(scene.ratio, 1.0 / scene.ratio)
    if gears > NOTICED:
        says = f"{gears:.3g} is the gear ratio. Is this the motor's velocity, not the mechanism's?"
        yield (gears, WrongNumber("gear", says, "M-GEARING"))
    says = "a diameter is 2 times a radius. Did you mix them up?"
    yield (2.0, WrongNumber("radius", says, "M-GEARING"))
    if scene.motors > 1:
        says = (
            f"there are {scene.motors} motors. Did you multiply or divide something by their "
            "number?"
        )
        yield (float(scene.motors), WrongNumber("motors", says))


def _list_unit_factors(scene: Scene) -> Iterator[tuple[float, WrongNumber]]:
    angular = (
        (2.0 * math.pi, "turns", "2π = 6.28. Did you mix up radians and rotations?"),
        (180.0 / math.pi, "degrees", "57.3 = 180/π. Did you mix up degrees and radians?"),
        (60.0, "minutes", "one minute has 60 seconds. Is your velocity in rpm, per minute?"),
    )
    turning = (
        (360.0, "circle", "a rotation is 360°. Is your velocity in degrees per second?"),
        (4.0 * math.pi**2, "turns-twice", "39.5 = (2π)². Multiply or divide by 2π: which is it?"),
    )
    going = (
        (1.0 / 0.3048, "feet", "a meter is 3.28 feet. Is your velocity in feet per second?"),
        (1.0 / 0.0254, "inches", "a meter is 39.4 inches. Is your velocity in inches per second?"),
        (100.0, "centi", "a meter is 100 cm. Is your velocity in centimeters per second?"),
    )
    for number, code, says in angular + (turning if scene.angular else going):
        yield (number, WrongNumber(code, says, "M-UNITS"))
