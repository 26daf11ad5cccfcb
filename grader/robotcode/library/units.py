"""Measures with units: ``edu.wpi.first.units`` of 2024 to 2026 and ``org.wpilib.units`` of 2027.

Every kind of measure is a class of its own, so that a voltage cannot stand for a distance. What a
product or a quotient is follows from its dimension: the powers of meter, kilogram, second, ampere,
radian and kelvin in it. Also WPILib's conversion functions and the units of RobotPy.
"""

import math
import operator
import types
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partialmethod
from typing import Any, ClassVar

from grader.robotcode.library.base import (
    PYTHON,
    TABLES,
    Fake,
    Unknown,
    WrongArgument,
    checked,
    describe,
    fake,
)

PACKAGES = "edu.wpi.first.units org.wpilib.units"
MEASURES = "edu.wpi.first.units.measure org.wpilib.units.measure"
EQUIVALENT = 1e-12  # [base units] the largest difference of equivalent measures
Dimension = frozenset[tuple[str, int]]
KINDS: dict[Dimension, type["Measure"]] = {}  # a dimension -> the class of its measures
CONSTANTS: dict[str, "Unit"] = {}  # name in Units -> unit


def _multiply(one: Dimension, other: Dimension, power: int) -> Dimension:
    """The dimension of a product (power 1) or of a quotient (power -1)."""
    powers = dict(one)
    for letter, exponent in other:
        powers[letter] = powers.get(letter, 0) + power * exponent
    return frozenset((letter, exponent) for letter, exponent in powers.items() if exponent)


def _divide(one: Any, other: Any) -> Any:
    try:
        return one / other
    except ZeroDivisionError:  # Java gives an infinity or NaN
        return one * math.inf


@fake(PACKAGES, complete=True)
@dataclass(frozen=True)
class Unit(Fake):
    """A unit: allwpilib v2026.2.2, wpiunits/.../Unit.java, and its subclasses.

    Args:
        _name: singular, as WPILib has it.
        _symbol: in messages.
        _dimension: powers of the base units.
        _size: in base units.
        _offset: [base units] where its zero lies.
    """

    _name: str
    _symbol: str
    _dimension: frozenset[Any]
    _size: float = 1.0
    _offset: float = 0.0
    _kind: ClassVar[type["Measure"]]

    def __str__(self) -> str:
        return self._name

    def of(self, magnitude: float, *rest: float) -> "Measure":
        if rest:
            raise WrongArgument(
                "of() takes one number: in code it has a point, not a comma, as in 0.5"
            )
        return self._kind(self, self.toBaseUnits(magnitude))

    def ofBaseUnits(self, baseUnitMagnitude: float) -> "Measure":
        return self._kind(self, baseUnitMagnitude)

    def mutable(self, initialMagnitude: float) -> "MutableMeasure":
        return self.of(initialMagnitude).mutableCopy()

    zero = partialmethod(of, 0.0)
    one = partialmethod(of, 1.0)

    def per(self, other: "Unit") -> "Unit":
        return self._combine_units(other, -1, " per ", "/")

    def mult(self, other: "Unit") -> "Unit":
        return self._combine_units(other, 1, "-", "*")

    def _combine_units(self, other: Any, power: int, word: str, mark: str) -> Any:
        if isinstance(other, Unknown):
            return other
        name = f"{self._name}{word}{other._name}"
        symbol = f"{self._symbol}{mark}{other._symbol}"
        dimension = _multiply(self._dimension, other._dimension, power)
        rate = _multiply(dimension, Time._base_unit._dimension, 1)
        kind = KINDS.get(dimension, Velocity if rate in KINDS else Per if power < 0 else Mult)
        return kind._unit_class(name, symbol, dimension, self._size * other._size**power)

    def toBaseUnits(self, valueInNativeUnits: float) -> float:
        return valueInNativeUnits * self._size + self._offset

    def fromBaseUnits(self, valueInBaseUnits: float) -> float:
        return (valueInBaseUnits - self._offset) / self._size

    def getBaseUnit(self) -> "Unit":
        return self._kind._base_unit or type(self)(self._name, self._symbol, self._dimension)

    def name(self) -> str:
        return self._name

    def symbol(self) -> str:
        return self._symbol


@fake(PACKAGES, complete=True)
class Measure(Fake):
    """A value with its unit: allwpilib v2026.2.2, wpiunits/.../Measure.java; v2024.3.2 as well."""

    _unit_class: ClassVar[type[Unit]]
    _mutable_class: ClassVar[type["MutableMeasure"]]
    _base_unit: ClassVar[Unit | None] = None

    def __init__(self, unit: Unit, base: float) -> None:
        self._unit, self._base = unit, base

    def __eq__(self, other: object) -> bool:
        same = isinstance(other, Measure) and self._unit == other._unit
        return same and self._base == other._base

    def __hash__(self) -> int:
        return hash((self._unit, self._base))

    def __str__(self) -> str:
        return self.toShortString()

    def toShortString(self) -> str:
        value = self.magnitude()
        shown = value if isinstance(value, Unknown) else format(value, ".3e")
        return f"{shown} {self._unit._symbol}"

    def _convert_to_base(self, other: Any, method: str) -> Any:
        """Another measure's value in base units, if it has the same dimension."""
        self._require_same_dimension(getattr(other, "_unit", other), method)
        return other._base

    def _require_same_dimension(self, unit: Any, method: str) -> Unit:
        """A unit that measures the same."""
        mine = self._unit
        if isinstance(unit, Unknown) or getattr(unit, "_dimension", None) == mine._dimension:
            return unit
        raise WrongArgument(
            f"{mine._kind.__name__}.{method} works with units such as {mine._symbol}, not with "
            f"{getattr(unit, '_symbol', describe(unit))}"
        )

    def in_(self, unit: Unit) -> float:
        return self._require_same_dimension(unit, "in").fromBaseUnits(self._base)

    def magnitude(self) -> float:
        return self._unit.fromBaseUnits(self._base)

    def baseUnitMagnitude(self) -> float:
        return self._base

    def copy(self) -> "Measure":
        return self._unit.ofBaseUnits(self._base)

    def mutableCopy(self) -> "MutableMeasure":
        return self._unit._kind._mutable_class(self._unit, self._base)

    def unaryMinus(self) -> "Measure":
        return self.times(-1)

    negate = unaryMinus

    def plus(self, other: "Measure") -> "Measure":
        return self._unit.ofBaseUnits(self._base + self._convert_to_base(other, "plus"))

    def minus(self, other: "Measure") -> "Measure":
        return self._unit.ofBaseUnits(self._base - self._convert_to_base(other, "minus"))

    def times(self, multiplier: "float | Measure") -> "Measure":
        if not isinstance(multiplier, Measure):
            return self._unit.ofBaseUnits(self._base * multiplier)
        unit = self._unit.mult(multiplier._unit)
        return (unit._kind._base_unit or unit).ofBaseUnits(self._base * multiplier._base)

    def div(self, divisor: "float | Measure") -> "Measure":
        if not isinstance(divisor, Measure):
            return self._unit.ofBaseUnits(_divide(self._base, divisor))
        unit = self._unit.per(divisor._unit)
        return (unit._kind._base_unit or unit).ofBaseUnits(_divide(self._base, divisor._base))

    timesRatio = times
    divide = divideRatio = div

    def per(self, other: "Unit | Measure") -> "Measure":
        if isinstance(other, Measure):
            return self.div(other)
        return self._unit.per(other).ofBaseUnits(_divide(self._base, other._size))


def _compare(name: str, test: Callable[[Any, Any], Any]) -> None:
    """Give Measure a method that compares it with another one of its dimension."""

    def compare(self: Measure, other: Measure) -> bool:
        return test(self._base, self._convert_to_base(other, name))

    compare.__qualname__ = f"Measure.{name}"
    setattr(Measure, name, checked(compare))


for _name in ("gt", "lt"):
    _compare(_name, getattr(operator, _name))
_compare("gte", lambda a, b: a >= b - EQUIVALENT)
_compare("lte", lambda a, b: a <= b + EQUIVALENT)
_compare("isEquivalent", lambda a, b: abs(a - b) <= EQUIVALENT)


def base_value(value: Any) -> Any:
    """A number, which a measure is in base units."""
    return value._base if isinstance(value, Measure) else value


@fake(f"{PACKAGES} edu.wpi.first.units.mutable org.wpilib.units.mutable", complete=True)
@fake("edu.wpi.first.units.mutable org.wpilib.units.mutable", name="MutableMeasureBase")
class MutableMeasure(Measure):
    """A measure whose value changes: allwpilib v2026.2.2, wpiunits/.../MutableMeasure.java."""

    @staticmethod
    def mutable(measure: Measure) -> "MutableMeasure":
        return measure.mutableCopy()

    def mut_replace(self, magnitude: float | Measure, newUnit: Unit = None) -> "MutableMeasure":
        other: Any = magnitude if newUnit is None else newUnit.of(magnitude)  # type: ignore[arg-type]  # a number, then
        self._base, self._unit = self._convert_to_base(other, "mut_replace"), other._unit
        return self

    def mut_setMagnitude(self, magnitude: float) -> "MutableMeasure":
        return self.mut_replace(magnitude, self._unit)

    def mut_setBaseUnitMagnitude(self, baseUnitMagnitude: float) -> "MutableMeasure":
        return self.mut_replace(self._unit.ofBaseUnits(baseUnitMagnitude))

    def _assign_result(self, method: str, other: Any, unit: Any = None) -> "MutableMeasure":
        """Replace its value by the result of one of its methods."""
        return self.mut_replace(getattr(self, method)(other if unit is None else unit.of(other)))

    mut_plus = partialmethod(_assign_result, "plus")
    mut_minus = partialmethod(_assign_result, "minus")
    mut_times = partialmethod(_assign_result, "times")
    mut_div = mut_divide = partialmethod(_assign_result, "div")

    def mut_acc(self, raw: float | Measure) -> "MutableMeasure":
        return self.mut_plus(raw if isinstance(raw, Measure) else self._unit.of(raw))


class Kind(Measure):
    """A kind of measure, such as a voltage. Its units and its mutable class come with it."""

    def __init_subclass__(cls, units: str = "", **powers: int) -> None:
        """Make the other classes of the kind.

        Args:
            units: of each its name in Units, its symbol and its size; the first is the base unit.
            powers: of the base units in its dimension.
        """
        if issubclass(cls, MutableMeasure):
            return
        text = {"__doc__": cls.__doc__}
        unit_class = type(f"{cls.__name__}Unit", (Unit,), text)
        mutable_class = type(f"Mut{cls.__name__}", (MutableMeasure, cls), text)
        fake(f"{MEASURES} edu.wpi.first.units", complete=True)(cls)  # the latter in 2024
        fake(MEASURES, complete=True)(mutable_class)
        fake(PACKAGES, complete=True)(unit_class)
        unit_class._kind, cls._unit_class, cls._mutable_class = cls, unit_class, mutable_class
        dimension = frozenset(powers.items())
        if units or powers:
            KINDS[dimension] = cls
        for row in filter(None, units.split(", ")):
            names, symbol, size = row.split(" ")
            unit = unit_class(names.split("/")[-1], symbol, dimension, float(size))
            cls._base_unit = cls._base_unit or unit
            CONSTANTS.update(dict.fromkeys(names.split("/"), unit))


class Time(Kind, **TABLES["kinds"]["Time"]):
    """A time span."""


class Angle(Kind, **TABLES["kinds"]["Angle"]):
    """An angle."""


class AngularVelocity(Kind, **TABLES["kinds"]["AngularVelocity"]):
    """An angular velocity."""


class Voltage(Kind, **TABLES["kinds"]["Voltage"]):
    """An electric potential."""


class Velocity(Kind):
    """The rate of change of any other quantity: V/s is a ``Velocity<VoltageUnit>``."""


class Per(Kind):
    """A quotient of units without a class of its own."""


class Mult(Kind):
    """A product of units without a class of its own."""


for _name, _row in TABLES["kinds"].items():
    if _name not in globals():
        types.new_class(_name, (Kind,), _row, lambda body: body.update(__module__=__name__))


@fake(PACKAGES, complete=True)
class Units(Fake):
    """The units by their names: allwpilib v2026.2.2, wpiunits/.../Units.java."""


@fake("edu.wpi.first.math.util org.wpilib.math.util", name="Units", complete=True)
class Conversions(Fake):
    """Conversions of numbers: allwpilib v2026.2.2, wpimath/.../math/util/Units.java."""


def _name_units() -> None:
    """Complete the table of units, and make each one a member of Units."""
    for name in TABLES["units"]["rates"].split():
        unit, *times = (CONSTANTS[part] for part in name.split("Per"))
        for time in times:
            unit = unit.per(time)
        CONSTANTS[name] = unit
        if unit._size == 1.0:
            unit._kind._base_unit = unit
    CONSTANTS["RPM"] = CONSTANTS["RotationsPerMinute"]
    CONSTANTS["Gs"] = replace(CONSTANTS["MetersPerSecondPerSecond"], _name="G", _size=9.80665)
    celsius = replace(CONSTANTS["Kelvin"], _name="Celsius", _symbol="°C", _offset=273.15)
    CONSTANTS["Celsius"] = celsius
    for name, unit in CONSTANTS.items():
        setattr(Units, name, unit)


def _add_conversion(source: str, target: str, size: float) -> None:
    def convert(value: float) -> float:
        return value * size

    name = f"{source}To{target[0].upper()}{target[1:]}"
    convert.__qualname__ = f"Units.{name}"
    PYTHON["wpimath.units"][name] = checked(convert)
    setattr(Conversions, name, staticmethod(checked(convert)))


_name_units()
PYTHON["wpimath.units"] = dict.fromkeys(TABLES["units"]["floats"].split(), float)
for _source, _target, _size in TABLES["units"]["conversions"]:
    _add_conversion(_source, _target, _size)
    _add_conversion(_target, _source, 1 / _size)
