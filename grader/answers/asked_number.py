"""A number that an exercise asks for: its value, its unit, and how near is near enough."""

from collections.abc import Mapping
from dataclasses import dataclass

FAST = 0.05  # [s] a time constant kA/kV below this fits into two or three samples of 20 ms


@dataclass(frozen=True)
class Band:
    """The tolerance of an answer: a share of the expected value, or a size, whichever is wider.

    Args:
        full, partial: share of the expected value, for full and for half credit.
        full_size, partial_size: in the unit of the answer.
    """

    full: float
    partial: float
    full_size: float = 0.0
    partial_size: float = 0.0

    def widths(self, expected: float) -> tuple[float, float]:
        """Half the width of both bands around an expected value, in its unit."""
        size = abs(expected)
        return max(self.full * size, self.full_size), max(self.partial * size, self.partial_size)


BANDS: dict[str, Band] = {
    "kS": Band(0.15, 0.35, full_size=0.03, partial_size=0.08),
    "kV": Band(0.03, 0.08),
    "kA": Band(0.15, 0.30),
    "kG": Band(0.04, 0.10),
}
FAST_KA = Band(0.25, 0.50)  # kA where the mechanism is FAST


@dataclass(frozen=True)
class AskedNumber:
    """A number that an exercise asks for: its value, unit and tolerance.

    Args:
        name: as in the answer file: ``kV``.
        expected: the key, in ``unit``.
        unit: ``V·s/m``; empty if it has none.
        band: how near is near enough.
    """

    name: str
    expected: float
    unit: str
    band: Band

    def is_right(self, value: float) -> bool:
        """Whether a value earns full marks."""
        return abs(value - self.expected) <= self.band.widths(self.expected)[0]

    def describe_tolerance(self, width: float, share: float) -> str:
        """A band in plain words: ``±3 %``, or ``±0.03 V`` where that is the wider."""
        if width > share * abs(self.expected):
            return f"±{width:g} {self.unit}"
        return f"±{100 * share:g} %"


def ask_gains(gains: Mapping[str, float], *, position: str) -> dict[str, AskedNumber]:
    """Ask for gains.

    Args:
        gains: gain -> value, per unit of position.
        position: that unit's symbol: ``m``, ``rot``.
    """
    units = {"kS": "V", "kG": "V", "kV": f"V·s/{position}", "kA": f"V·s²/{position}"}
    fast = "kA" in gains and gains["kA"] < FAST * gains.get("kV", 0.0)
    bands = {**BANDS, "kA": FAST_KA} if fast else BANDS
    return {name: AskedNumber(name, gains[name], units[name], bands[name]) for name in gains}
