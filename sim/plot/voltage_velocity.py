"""Voltage against velocity: the line of kS and kV through the quasistatic tests."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from sim.core.errors import BadRequest
from sim.core.log import DIRECTIONS, Array, Log, Run
from sim.core.units import Unit, find_unit
from sim.plot.decimate import decimate_cloud
from sim.plot.picture import COLORS, INK, LINES, MARKERS, REFERENCE, Picture, make_panels
from sim.plot.table import Table

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MOST = 150  # samples of a ramp drawn in the panel of the whole ramp
CLOSEST = 500  # samples of a ramp drawn in the panel near standstill
MOVING = 0.05  # [share of the top speed] slower samples count as standstill
FEWEST = 3  # samples needed to fit a straight line
OUTSIDE = 0.02  # [share of the samples near standstill] that may lie outside the panel, at each end


@dataclass(frozen=True)
class Line:
    """A straight line in the picture of voltage against velocity: V = intercept + slope·v.

    Args:
        intercept: voltage at velocity 0 [V].
        slope: [V·s/unit].
    """

    intercept: float
    slope: float


@dataclass(frozen=True, eq=False)
class _Ramps:
    """All quasistatic tests of one direction.

    Args:
        way: ``forward`` or ``reverse``.
        velocity: (n,) [unit/s].
        voltage: (n,) [V].
    """

    way: str
    velocity: Array
    voltage: Array


def plot_voltage_velocity(log: Log, *, lines: Mapping[str, Line] | None = None) -> Picture:
    """Voltage against velocity of the quasistatic tests, as a whole and near standstill.

    The second panel shows speeds up to an eighth of the top speed: of forward motion, or of both
    directions for elevators and arms, whose voltage at standstill is kG + kS or kG - kS.

    Args:
        log: a log with a quasistatic test.
        lines: name -> line for forward motion, in the log's unit; drawn from v = 0.

    Raises:
        BadRequest: the log has no quasistatic test.
    """
    per = find_unit(log.units)
    ramps = _join_ramps([run for run in log.runs if run.kind == "quasistatic" and len(run)], per)
    if not ramps:
        raise BadRequest(
            "this log has no quasistatic test",
            where=log.source,
            advice="Use a log with a slow ramp in it.",
        )
    drawn = dict(lines or {})
    top = max(float(np.abs(one.velocity).max()) for one in ramps)
    near = top / 8.0 or 1.0  # without motion, any width will do
    figure, ((whole, close),) = make_panels(1, 2)
    _draw_ramps(whole, ramps, drawn, top=top, most=MOST)
    _set_limits(close, ramps, drawn, near=near, both=log.type in {"elevator", "arm"})
    _draw_ramps(close, _select_shown(ramps, close), drawn, top=top, most=CLOSEST)
    for axes in (whole, close):
        axes.set_xlabel(f"velocity [{per.symbol}/s]", color=INK)
    whole.set_ylabel("voltage [V]", color=INK)
    whole.set_title("the whole ramp", fontsize=10, color=INK)
    close.set_title("close to standstill", fontsize=10, color=INK)
    whole.legend(fontsize=9)
    alt = "Two panels show voltage against velocity: the whole voltage ramp, and its slow part."
    return Picture(figure, alt, _tabulate_lines(ramps, drawn, per, top=top))


def _join_ramps(runs: Sequence[Run], per: Unit) -> list[_Ramps]:
    """The runs joined by direction; directions without runs are left out."""
    found = []
    for way in DIRECTIONS:
        these = [run for run in runs if run.direction == way]
        if these:
            velocity = np.concatenate([run.velocity for run in these]) / per.si
            voltage = np.concatenate([run.voltage for run in these])
            found.append(_Ramps(way, velocity, voltage))
    return found


def _set_limits(
    axes: "Axes", ramps: Sequence[_Ramps], lines: Mapping[str, Line], *, near: float, both: bool
) -> None:
    """Set the limits of the panel near standstill to the samples and lines in it."""
    ways = {one.way for one in ramps}
    left = -near if both or ways == {"reverse"} else -0.15 * near
    right = 0.15 * near if ways == {"reverse"} and not both else near
    axes.set_xlim(left, right)
    there = np.concatenate(
        [
            one.voltage[(one.velocity >= left) & (one.velocity <= right)]
            for one in ramps
            if both or one.way == "forward" or len(ways) == 1
        ]
    )
    usual = np.quantile(there, [OUTSIDE, 1.0 - OUTSIDE]) if there.size else np.zeros(0)
    ends = [line.intercept + line.slope * v for line in lines.values() for v in (0.0, near)]
    seen = np.array([0.0, *usual, *ends])
    margin = 0.06 * (float(np.ptp(seen)) or 1.0)
    axes.set_ylim(float(seen.min()) - margin, float(seen.max()) + margin)


def _select_shown(ramps: Sequence[_Ramps], axes: "Axes") -> list[_Ramps]:
    """The samples that a panel shows."""
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    shown = []
    for one in ramps:
        seen = (one.velocity >= left) & (one.velocity <= right)
        seen &= (one.voltage >= bottom) & (one.voltage <= top)
        shown.append(_Ramps(one.way, one.velocity[seen], one.voltage[seen]))
    return shown


def _draw_ramps(
    axes: "Axes", ramps: Sequence[_Ramps], lines: Mapping[str, Line], *, top: float, most: int
) -> None:
    """Draw the samples, at most so many of each direction, and the lines."""
    for one in ramps:
        index = DIRECTIONS.index(one.way)
        kept = (
            decimate_cloud(one.velocity, one.voltage, most=most) if one.velocity.size else slice(0)
        )
        axes.plot(
            one.velocity[kept],
            one.voltage[kept],
            MARKERS[index],
            color=COLORS[index],
            markersize=2.5,
            alpha=0.6,
            label=one.way,
        )
    ends = np.array([0.0, top])
    for index, (name, line) in enumerate(lines.items(), start=len(DIRECTIONS)):
        axes.plot(
            ends,
            line.intercept + line.slope * ends,
            color=REFERENCE if index == len(DIRECTIONS) else COLORS[index % len(COLORS)],
            linestyle=LINES[index % len(LINES)],
            linewidth=1.8,
            label=name,
        )


def _measure_rms_from_line(one: _Ramps, *, top: float) -> float | None:
    """RMS distance [V] of moving samples from their best straight line; None if undefined."""
    sign = 1.0 if one.way == "forward" else -1.0
    moving = sign * one.velocity > MOVING * top  # an elevator falls at first
    velocity, voltage = one.velocity[moving], one.voltage[moving]
    if velocity.size < FEWEST or not np.ptp(velocity) > 0.0:
        return None
    line = np.polynomial.Polynomial.fit(velocity, voltage, 1)
    return float(np.sqrt(np.mean((voltage - line(velocity)) ** 2)))


def _tabulate_lines(
    ramps: Sequence[_Ramps], lines: Mapping[str, Line], per: Unit, *, top: float
) -> Table:
    """A table of the lines; without lines, of the samples."""
    if lines:
        return Table(
            ("line", "at standstill [V]", f"slope [V·s/{per.symbol}]"),
            tuple((name, line.intercept, line.slope) for name, line in lines.items()),
        )
    rows = tuple(
        (
            one.way,
            one.velocity.size,
            float(one.voltage[np.argmax(np.abs(one.voltage))]),
            float(one.velocity[np.argmax(np.abs(one.velocity))]),
            "–" if (stray := _measure_rms_from_line(one, top=top)) is None else stray,
        )
        for one in ramps
    )
    header = (
        "direction",
        "samples",
        "most V",
        f"fastest [{per.symbol}/s]",
        "off a straight line [V]",
    )
    return Table(header, rows)
