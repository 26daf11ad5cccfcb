"""Units of position. Logs and gains in memory are in SI: meters or radians, and seconds."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from sim.core.errors import refuse_unknown

GRAVITY = 9.81  # [m/s²]
TURN = 2.0 * math.pi  # [rad]
ROBUST = 1.4826  # standard deviations in a median absolute deviation
BATTERY = 12.0  # [V] nominal: a motor's data sheet is for it, and a controller gives no more


@dataclass(frozen=True)
class Unit:
    """A unit of position.

    Args:
        name: name on the command line: ``meters``.
        symbol: symbol in messages and tables: ``m``.
        si: [m or rad] its size in SI.
        angular: whether it measures an angle.
    """

    name: str
    symbol: str
    si: float
    angular: bool

    def format_speed(self, speed: float) -> str:
        """A speed [m/s or rad/s] in this unit: ``1.25 m/s``."""
        return f"{speed / self.si:.3g} {self.symbol}/s"


UNITS: dict[str, Unit] = {
    unit.name: unit
    for unit in (
        Unit("meters", "m", 1.0, angular=False),
        Unit("feet", "ft", 0.3048, angular=False),
        Unit("inches", "in", 0.0254, angular=False),
        Unit("radians", "rad", 1.0, angular=True),
        Unit("rotations", "rot", TURN, angular=True),
        Unit("degrees", "deg", math.pi / 180.0, angular=True),
    )
}


def convert_gains(gains: Mapping[str, float], *, factor: float) -> dict[str, float]:
    """Gains converted to a unit of position that is ``factor`` times as large.

    Args:
        gains: gain -> value; only kV and kA depend on the unit of position.
        factor: ``find_unit("rotations").si`` converts gains per radian to gains per rotation.

    Examples:
        >>> convert_gains({"kV": 0.02}, factor=find_unit("rotations").si)["kV"]  # [V·s/rotation]
        0.12566370614359174
    """
    return {
        name: value * factor if name in {"kV", "kA"} else value for name, value in gains.items()
    }


def find_unit(name: str) -> Unit:
    """Look up a unit by name, in any case.

    Raises:
        BadRequest: no such unit; the message lists those there are.

    Examples:
        >>> find_unit("Degrees").symbol
        'deg'
    """
    name = name.strip().lower()
    refuse_unknown("units", name, UNITS)
    return UNITS[name]


def compute_unit_ratio(new: Unit, old: Unit, *, radius: float | None = None) -> float:
    """A new unit of position in old ones [1]; nan if that needs a radius above zero, and has none.

    Args:
        new: the new unit.
        old: the old unit.
        radius: of wheel or drum [m], where one is a length and the other an angle.

    Examples:
        >>> compute_unit_ratio(find_unit("rotations"), find_unit("meters"), radius=0.5)  # [m]
        3.141592653589793
    """
    if new.angular == old.angular:
        return new.si / old.si
    if radius is None or not 0.0 < radius < math.inf:
        return math.nan
    return new.si / old.si * (radius if new.angular else 1.0 / radius)
