"""Measures with units: ``edu.wpi.first.units`` of 2024 to 2026 and ``org.wpilib.units`` of 2027.

Every kind of measure is a class of its own, so that a voltage cannot stand for a distance. What a
product or a quotient is follows from its dimension: the powers of meter, kilogram, second, ampere,
radian and kelvin in it. Also WPILib's conversion functions and the units of RobotPy.
"""

import math
from dataclasses import dataclass, replace
from functools import partialmethod
from typing import Any, ClassVar

from grader.robotcode.library.base import (
    PYTHON,
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


@fake(
    PACKAGES,
    complete=True,
    others="getConverterToBase getConverterFromBase convertFrom getUnit isBaseUnit equivalent",
)
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
        return self._join(other, -1, " per ", "/")

    def mult(self, other: "Unit") -> "Unit":
        return self._join(other, 1, "-", "*")

    def _join(self, other: "Unit", power: int, word: str, mark: str) -> "Unit":
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


@fake(
    PACKAGES,
    complete=True,
    others="max min inverse reciprocal asFrequency asPeriod toLongString timesInverse timesDivisor "
    "timesConversionFactor ofRelativeUnits ofBaseUnits EQUIVALENCE_THRESHOLD",
)
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

    def _base_of(self, other: Any, method: str) -> Any:
        """Another measure's value in base units, if it has the same dimension."""
        self._require(getattr(other, "_unit", other), method)
        return other._base

    def _require(self, unit: Any, method: str) -> Unit:
        """A unit that measures the same."""
        mine = self._unit
        if isinstance(unit, Unknown) or getattr(unit, "_dimension", None) == mine._dimension:
            return unit
        raise WrongArgument(
            f"{mine._kind.__name__}.{method} works with units such as {mine._symbol}, not with "
            f"{getattr(unit, '_symbol', describe(unit))}"
        )

    def in_(self, unit: Unit) -> float:
        return self._require(unit, "in").fromBaseUnits(self._base)

    def magnitude(self) -> float:
        return self._unit.fromBaseUnits(self._base)

    def baseUnitMagnitude(self) -> float:
        return self._base

    def unit(self) -> Unit:
        return self._unit

    def baseUnit(self) -> Unit:
        return self._unit.getBaseUnit()

    def copy(self) -> "Measure":
        return self._unit.ofBaseUnits(self._base)

    def mutableCopy(self) -> "MutableMeasure":
        return self._unit._kind._mutable_class(self._unit, self._base)

    def abs(self, unit: Unit) -> float:
        return abs(self.in_(unit))

    def copySign(self, other: "Measure", unit: Unit) -> float:
        return math.copysign(self.in_(unit), other.in_(unit))

    def unaryMinus(self) -> "Measure":
        return self.times(-1)

    negate = unaryMinus

    def plus(self, other: "Measure") -> "Measure":
        return self._unit.ofBaseUnits(self._base + self._base_of(other, "plus"))

    def minus(self, other: "Measure") -> "Measure":
        return self._unit.ofBaseUnits(self._base - self._base_of(other, "minus"))

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

    def isNear(self, other: "Measure", tolerance: "float | Measure") -> bool:
        base = self._base_of(other, "isNear")
        allowed = tolerance._base if isinstance(tolerance, Measure) else base * tolerance
        return abs(self._base - base) <= abs(allowed)

    def isEquivalent(self, other: "Measure") -> bool:
        return self.isNear(other, self._unit.getBaseUnit().of(EQUIVALENT))

    def compareTo(self, other: "Measure") -> int:
        base = self._base_of(other, "compareTo")
        return (self._base > base) - (self._base < base)

    def gt(self, other: "Measure") -> bool:
        return self._base > self._base_of(other, "gt")

    def lt(self, other: "Measure") -> bool:
        return self._base < self._base_of(other, "lt")

    def gte(self, other: "Measure") -> bool:
        return self._base >= self._base_of(other, "gte") - EQUIVALENT

    def lte(self, other: "Measure") -> bool:
        return self._base <= self._base_of(other, "lte") + EQUIVALENT


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
        self._base, self._unit = self._base_of(other, "mut_replace"), other._unit
        return self

    def mut_setMagnitude(self, magnitude: float) -> "MutableMeasure":
        return self.mut_replace(magnitude, self._unit)

    def mut_setBaseUnitMagnitude(self, baseUnitMagnitude: float) -> "MutableMeasure":
        return self.mut_replace(self._unit.ofBaseUnits(baseUnitMagnitude))

    def _change(self, method: str, other: Any, unit: Any = None) -> "MutableMeasure":
        """Replace it by what one of its methods gives, of a measure or a number and its unit."""
        return self.mut_replace(getattr(self, method)(other if unit is None else unit.of(other)))

    mut_plus = partialmethod(_change, "plus")
    mut_minus = partialmethod(_change, "minus")
    mut_times = partialmethod(_change, "times")
    mut_div = mut_divide = partialmethod(_change, "div")

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


class Dimensionless(Kind, units="Value <?> 1, Percent % 0.01"):
    """A share or a ratio."""


class Distance(
    Kind,
    m=1,
    units="Meters/Meter m 1, Millimeters/Millimeter mm 1e-3, Centimeters/Centimeter cm 1e-2, "
    "Inches/Inch in 0.0254, Feet/Foot ft 0.3048",
):
    """A length."""


class Time(
    Kind,
    s=1,
    units="Seconds/Second s 1, Milliseconds/Millisecond ms 1e-3, "
    "Microseconds/Microsecond us 1e-6, Minutes/Minute min 60",
):
    """A time span."""


class Angle(
    Kind,
    rad=1,
    units=f"Radians/Radian rad 1, Revolutions/Revolution R {math.tau}, "
    f"Rotations/Rotation R {math.tau}, Degrees/Degree ° {math.radians(1)}",
):
    """An angle."""


class Mass(
    Kind,
    kg=1,
    units="Kilograms/Kilogram Kg 1, Grams/Gram g 1e-3, Pounds/Pound lb. 0.453592, "
    "Ounces/Ounce oz. 0.0283495",
):
    """A mass."""


class Temperature(Kind, kelvin=1, units="Kelvin K 1"):
    """A temperature."""


class Frequency(Kind, s=-1, units="Hertz hz 1, Millihertz mhz 1e-3"):
    """How often a second."""


class LinearVelocity(Kind, m=1, s=-1):
    """How fast something moves along a line."""


class AngularVelocity(Kind, rad=1, s=-1):
    """How fast something turns."""


class LinearAcceleration(Kind, m=1, s=-2):
    """How fast a linear velocity changes."""


class AngularAcceleration(Kind, rad=1, s=-2):
    """How fast an angular velocity changes."""


class Force(Kind, kg=1, m=1, s=-2, units="Newtons/Newton N 1"):
    """A force."""


class Torque(Kind, kg=1, m=2, s=-2, rad=-1, units="NewtonMeters/NewtonMeter N*m 1"):
    """A torque: energy per radian, which keeps it apart from an energy."""


class MomentOfInertia(Kind, kg=1, m=2, units="KilogramSquareMeters Kg*m^2 1"):
    """A moment of inertia."""


class Energy(Kind, kg=1, m=2, s=-2, units="Joules/Joule J 1"):
    """An energy."""


class Power(Kind, kg=1, m=2, s=-3, units="Watts/Watt W 1, Horsepower HP 745.7"):
    """A power."""


class Voltage(Kind, kg=1, m=2, s=-3, amp=-1, units="Volts/Volt V 1, Millivolts/Millivolt mV 1e-3"):
    """An electric potential."""


class Current(Kind, amp=1, units="Amps/Amp A 1, Milliamps/Milliamp mA 1e-3"):
    """An electric current."""


class Resistance(Kind, kg=1, m=2, s=-3, amp=-2, units="Ohms/Ohm Ω 1"):
    """An electric resistance."""


class Velocity(Kind):
    """How fast anything else changes: V/s is a ``Velocity<VoltageUnit>``."""


class Per(Kind):
    """Any other quotient."""


class Mult(Kind):
    """Any other product."""


RATES = (  # each is one of the units above per one or more others: Meters, per Second, per Second
    "MetersPerSecond FeetPerSecond InchesPerSecond RadiansPerSecond DegreesPerSecond "
    "RotationsPerSecond RevolutionsPerSecond RotationsPerMinute MetersPerSecondPerSecond "
    "FeetPerSecondPerSecond InchesPerSecondPerSecond RadiansPerSecondPerSecond "
    "DegreesPerSecondPerSecond RotationsPerSecondPerSecond"
)
OTHER_UNITS = (
    "Milli Micro Kilo derive anonymous PoundsForce PoundForce OuncesForce OunceForce PoundFeet "
    "PoundFoot PoundInches PoundInch OunceInches OunceInch KilogramMetersPerSecond "
    "PoundInchesPerSecond KilogramMetersSquaredPerSecond PoundInchesSquaredPerSecond "
    "PoundSquareInches KiloOhms KiloOhm MilliOhms MilliOhm Millijoules Millijoule Kilojoules "
    "Kilojoule Milliwatts Milliwatt Fahrenheit VoltsPerMeterPerSecond VoltsPerRadianPerSecond "
    "VoltsPerMeterPerSecondSquared VoltsPerRadianPerSecondSquared"
)
CONVERSIONS = (  # 1 of the first is so many of the second
    ("feet", "meters", 0.3048),
    ("inches", "meters", 0.0254),
    ("degrees", "radians", math.pi / 180),
    ("rotations", "radians", math.tau),
    ("rotations", "degrees", 360.0),
    ("rotationsPerMinute", "radiansPerSecond", math.tau / 60),
    ("milliseconds", "seconds", 1e-3),
    ("lbs", "kilograms", 0.453592),
)
FLOATS = (  # units of RobotPy, which all are float by another name
    "volts volts_per_second amperes ohms seconds milliseconds minutes hertz meters centimeters "
    "millimeters inches feet meters_per_second feet_per_second meters_per_second_squared radians "
    "degrees turns radians_per_second degrees_per_second turns_per_second revolutions_per_minute "
    "radians_per_second_squared turns_per_second_squared units_per_second "
    "units_per_second_squared volt_seconds volt_seconds_squared volt_seconds_per_meter "
    "volt_seconds_squared_per_meter volt_seconds_per_radian volt_seconds_squared_per_radian "
    "kilograms pounds newtons newton_meters kilogram_square_meters percent celsius watts joules"
)


@fake(PACKAGES, complete=True, others=OTHER_UNITS)
class Units(Fake):
    """The units by their names: allwpilib v2026.2.2, wpiunits/.../Units.java."""


@fake("edu.wpi.first.math.util org.wpilib.math.util", name="Units", complete=True)
class Conversions(Fake):
    """Conversions of numbers: allwpilib v2026.2.2, wpimath/.../math/util/Units.java."""


def _name_units() -> None:
    """Complete the table of units, and make each one a member of Units."""
    for name in RATES.split():
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
PYTHON["wpimath.units"] = dict.fromkeys(FLOATS.split(), float)
for _source, _target, _size in CONVERSIONS:
    _add_conversion(_source, _target, _size)
    _add_conversion(_target, _source, 1 / _size)
