"""A number with a unit, as people write it: ``0,18``, ``2.5 V·s/m``, ``0.39 V*s/rad``, ``5 kg·m²``.

A unit is read as a product of powers of volt, second, meter, radian, ampere and kilogram, so any
way of writing it will do: ``V·s²/m``, ``V/(m/s^2)``, ``V s^2 per m``, ``volt-seconds squared per
meter``.
"""

import math
import re
from dataclasses import dataclass

LONGEST = 80  # [characters] of a number with its unit; "volt-seconds squared per meter" has 30
MAX_POWER = 9  # of a volt, a second, …; no unit of a gain has more than 3
SHOWN = 20  # [characters] of a longer one in a message
NUMBER = re.compile(r"([+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][+-]?\d+)?)\s*(.*)", re.DOTALL)
PART = re.compile(r"\s*(?:([a-z°]+)|(\^-?\d+)|([*/()])|(1))")
RAISED = str.maketrans("⁻¹²³", "-123")


class NotAUnitError(ValueError):
    """A text that cannot be read as a unit."""


@dataclass(frozen=True)
class Quantity:
    """A product of powers of volt, second, meter, radian, ampere and kilogram.

    Args:
        factor: how many V^a·s^b·m^c·rad^d·A^e·kg^f one of it is.
        powers: a to f.
    """

    factor: float
    powers: tuple[int, ...]

    def multiply(self, other: "Quantity", *, power: int = 1) -> "Quantity":
        """The product of this and a power of the other.

        Raises:
            NotAUnitError: a power is larger than that of any unit.
        """
        powers = tuple(
            mine + power * its for mine, its in zip(self.powers, other.powers, strict=True)
        )
        most = max(map(abs, powers))
        if most > MAX_POWER:
            raise NotAUnitError(f"a power of {most}")
        return Quantity(self.factor * other.factor**power, powers)


ONE = Quantity(1.0, (0, 0, 0, 0, 0, 0))
_TURN = 2.0 * math.pi
SYMBOLS: dict[str, Quantity] = {
    symbol: measure
    for symbols, measure in (
        ("1", ONE),
        ("v volt volts", Quantity(1.0, (1, 0, 0, 0, 0, 0))),
        ("mv millivolt millivolts", Quantity(1e-3, (1, 0, 0, 0, 0, 0))),
        ("s sec second seconds", Quantity(1.0, (0, 1, 0, 0, 0, 0))),
        ("ms millisecond milliseconds", Quantity(1e-3, (0, 1, 0, 0, 0, 0))),
        ("min minute minutes", Quantity(60.0, (0, 1, 0, 0, 0, 0))),
        ("h hour hours", Quantity(3600.0, (0, 1, 0, 0, 0, 0))),
        ("m meter meters metre metres", Quantity(1.0, (0, 0, 1, 0, 0, 0))),
        ("km", Quantity(1000.0, (0, 0, 1, 0, 0, 0))),
        ("cm", Quantity(0.01, (0, 0, 1, 0, 0, 0))),
        ("mm", Quantity(0.001, (0, 0, 1, 0, 0, 0))),
        ("ft foot feet", Quantity(0.3048, (0, 0, 1, 0, 0, 0))),
        ("in inch inches", Quantity(0.0254, (0, 0, 1, 0, 0, 0))),
        ("rad radian radians", Quantity(1.0, (0, 0, 0, 1, 0, 0))),
        ("rot rotation rotations turn turns rev", Quantity(_TURN, (0, 0, 0, 1, 0, 0))),
        ("deg degree degrees °", Quantity(math.pi / 180.0, (0, 0, 0, 1, 0, 0))),
        ("rps", Quantity(_TURN, (0, -1, 0, 1, 0, 0))),
        ("rpm", Quantity(_TURN / 60.0, (0, -1, 0, 1, 0, 0))),
        ("mps", Quantity(1.0, (0, -1, 1, 0, 0, 0))),
        ("a amp amps ampere amperes", Quantity(1.0, (0, 0, 0, 0, 1, 0))),
        ("ma", Quantity(1e-3, (0, 0, 0, 0, 1, 0))),
        ("kg kilogram kilograms", Quantity(1.0, (0, 0, 0, 0, 0, 1))),
        ("g gram grams", Quantity(1e-3, (0, 0, 0, 0, 0, 1))),
        ("lb lbs pound pounds", Quantity(0.45359237, (0, 0, 0, 0, 0, 1))),
        ("n newton newtons", Quantity(1.0, (0, -2, 1, 0, 0, 1))),
        ("nm", Quantity(1.0, (0, -2, 2, 0, 0, 1))),  # newton meters, as people write them
    )
    for symbol in symbols.split()
}


def read_number(text: str) -> tuple[float, str] | None:
    """Split a text into its number and its unit; None if it does not start with one number.

    A comma is a decimal comma. A text with both a comma and a point could be read in two ways, and
    is not read at all; nor is one that is longer than any number with a unit.
    """
    if len(text.strip()) > LONGEST:
        return None
    found = NUMBER.fullmatch(text.strip().replace("−", "-"))
    if found is None or not re.match(r"(1(/|$)|[^\d.,_]|$)", found[2]):  # 1/s is a unit, 12 is not
        return None
    return float(found[1].replace(",", ".")), found[2].strip()


def read_unit(text: str) -> Quantity:
    """Read a unit.

    Raises:
        NotAUnitError: a sign or a name in it is no unit, or it is longer than any; the message is
            that part.
    """
    if len(text) > LONGEST:
        raise NotAUnitError(f"{text[:SHOWN]}…")
    plain = re.sub(r"[⁻¹²³]+", lambda raised: "^" + raised[0].translate(RAISED), text)
    plain = re.sub(r"\*\*", "^", plain).lower()
    plain = re.sub(r"\s*\bsquared\b", "^2", plain)
    plain = re.sub(r"\bvs\b", "v*s", plain)
    plain = re.sub(r"[·⋅×.]|-(?=[a-z])", "*", plain)
    top, *below = re.split(r"\bper\b", plain)
    if not below:
        return _Reader(top).product()
    return _Reader(top).product().multiply(read_unit(" per ".join(below)), power=-1)


class _Reader:
    """Reads one product of units from left to right."""

    def __init__(self, text: str) -> None:
        self.rest = text.strip()
        if not self.rest:
            raise NotAUnitError("nothing")

    def product(self, *, closing: str = "") -> Quantity:
        """Everything up to the closing parenthesis, or to the end."""
        found, power = ONE, 1
        while self.rest:
            part = self._take_token()
            if part == closing:
                return found
            if part in {"*", "/"}:
                power = -1 if part == "/" else 1
                continue
            found, power = found.multiply(self._parse_factor(part), power=power), 1
        if closing:
            raise NotAUnitError("( without )")
        return found

    def _parse_factor(self, part: str) -> Quantity:
        if part != "(" and part not in SYMBOLS:
            raise NotAUnitError(part)
        measure = self.product(closing=")") if part == "(" else SYMBOLS[part]
        raised = re.match(r"\s*\^(-?\d)(?!\d)", self.rest)
        if raised is None:
            return measure
        self.rest = self.rest[raised.end() :].strip()
        return ONE.multiply(measure, power=int(raised[1]))

    def _take_token(self) -> str:
        part = PART.match(self.rest)
        if part is None:
            raise NotAUnitError(self.rest[:8])
        self.rest = self.rest[part.end() :].strip()
        return part[0].strip()
