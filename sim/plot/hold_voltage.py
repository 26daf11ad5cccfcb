"""The window of voltages that hold a mechanism against gravity: kG - kS to kG + kS."""

from collections.abc import Mapping, Sequence

import numpy as np

from sim.core.errors import BadRequest
from sim.core.log import Array
from sim.plot.picture import COLORS, INK, MARKERS, REFERENCE, Picture, add_legend, make_panels
from sim.plot.table import Table, to_text

BAND = COLORS[4]
QUARTER_TURN = 90.0  # [deg]
CLOSE = 0.03  # [share of the window] distance from an edge that counts as on it


def plot_hold_window(
    volts: Sequence[float] | Array,
    speeds: Sequence[float] | Array,
    *,
    window: tuple[float, float],
    marks: Mapping[str, float],
) -> Picture:
    """Steady speed over constant voltage, with the window in which friction holds the mechanism.

    Args:
        volts: (n,) constant voltages [V], rising.
        speeds: (n,) steady speed at each [m/s]; negative is down.
        window: lower and upper edge, kG - kS and kG + kS [V].
        marks: name -> voltage to mark [V].

    Raises:
        BadRequest: there is not one speed for each voltage, or the lower edge is above the upper.
    """
    if len(volts) != len(speeds) or not len(volts):
        raise BadRequest("every voltage needs one speed", advice="Give as many speeds as voltages.")
    low, high = window
    if low > high:
        raise BadRequest(f"{low:g} to {high:g} V is no window", advice="Give the lower one first.")
    figure, ((axes,),) = make_panels(1, 1, height=3.6)
    axes.axvspan(low, high, color=BAND, alpha=0.35, label="it stays: kG − kS to kG + kS")
    axes.axhline(0.0, color=REFERENCE, linewidth=0.8)
    axes.plot(volts, speeds, "-", marker=".", color=COLORS[0], markersize=5, label="speed")
    for index, (name, value) in enumerate(marks.items(), start=1):
        axes.plot(
            value, 0.0, MARKERS[index], color=COLORS[index], markersize=10, label=name, zorder=3
        )
    axes.set_xlabel("voltage [V]", color=INK)
    axes.set_ylabel("speed, up is positive [m/s]", color=INK)
    axes.legend(fontsize=8)
    alt = (
        f"The picture shows speed over voltage. Below {to_text(low)} V the mechanism sinks. Above "
        f"{to_text(high)} V it rises. Between them it stays: this part is shaded."
    )
    rows = tuple((name, value, _where(value, low, high)) for name, value in marks.items())
    return Picture(figure, alt, Table(("mark", "voltage [V]", "in the window"), rows))


def _where(value: float, low: float, high: float) -> str:
    """The position of a voltage in the window, in words."""
    near = CLOSE * (high - low)
    if abs(value - low) <= near:
        return "lower edge"
    if abs(value - high) <= near:
        return "upper edge"
    if abs(value - (low + high) / 2.0) <= near:
        return "middle"
    return "below it" if value < low else "above it" if value > high else "inside"


def plot_hold_angles(
    holds: Sequence[tuple[float, float, float]],
    *,
    kg: float,
    ks: float,
) -> Picture:
    """The window of an arm over its angle: a cosine with a constant width.

    Args:
        holds: angle from level [deg], and lower and upper edge of the window measured there [V].
        kg: voltage that holds the arm level [V].
        ks: voltage of static friction [V].
    """
    ends = [angle for angle, *_ in holds]
    angles = np.linspace(min([-QUARTER_TURN, *ends]) - 5.0, max([QUARTER_TURN, *ends]) + 5.0, 181)
    middle = kg * np.cos(np.radians(angles))
    figure, ((axes,),) = make_panels(1, 1, height=3.6)
    axes.fill_between(
        angles, middle - ks, middle + ks, color=BAND, alpha=0.35, label="it stays", linewidth=0
    )
    axes.plot(angles, middle, "--", color=COLORS[0], label="kG·cos(angle)")
    axes.axhline(0.0, color=REFERENCE, linewidth=0.8)
    for index, place, name in ((1, 1, "no longer falls"), (2, 2, "begins to rise")):
        edges = [hold[place] for hold in holds]
        axes.plot(ends, edges, MARKERS[index], color=COLORS[index], markersize=7, label=name)
    axes.axvline(0.0, color=REFERENCE, linestyle=":", linewidth=1.2, label="the arm is level")
    axes.set_xlabel("angle from level [deg]", color=INK)
    axes.set_ylabel("voltage [V]", color=INK)
    add_legend(figure, (axes,))
    alt = (
        "A band shows which voltages hold an arm at each angle. The band is "
        f"{to_text(2 * ks)} V wide everywhere. The middle of the band follows a cosine curve with "
        f"a peak of {to_text(kg)} V. The peak is at 0 degrees: there the arm is level. "
        f"Each of the {len(holds)} measured angles has two marks. They are the lowest and the "
        "highest voltage that hold the arm there."
    )
    header = ("angle [deg]", "no longer falls [V]", "begins to rise [V]", "middle [V]",
              "half the width [V]")  # fmt: skip
    rows = tuple(
        (f"{angle:g}".replace("-", "−"), low, high, (low + high) / 2.0, (high - low) / 2.0)
        for angle, low, high in holds
    )
    return Picture(figure, alt, Table(header, rows))
