"""The motion that a student's answer would cause on the robot, over the wanted motion."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from sim.core.errors import BadRequest
from sim.feedback.following import FollowedProfile
from sim.plot.decimate import decimate_curve
from sim.plot.picture import (
    COLORS,
    INK,
    LINES,
    MARKERS,
    REFERENCE,
    Picture,
    add_legend,
    make_panels,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SIDE_BY_SIDE = 2  # panels in a row
HEIGHT, MORE = 0.8, 2.2  # [in] height around the panels, and of each row of them
MOST = 300  # points of a curve drawn at most
MARK = 0.15  # [share of a panel] distance of markers
DIGITS = 3  # significant digits of a curve


@dataclass(frozen=True)
class Trace:
    """One panel: the wanted motion, and the motion that results.

    Args:
        title: what moves.
        ylabel: label of the vertical axis, with unit.
        time: (n,) [s].
        wanted: (n,) target, or a limit.
        actual: name -> (n,) resulting motion.
        limit: whether ``wanted`` is a limit that should be kept.
    """

    title: str
    ylabel: str
    time: Sequence[float]
    wanted: Sequence[float]
    actual: Mapping[str, Sequence[float]]
    limit: bool = False


def make_profile_traces(one: FollowedProfile) -> tuple[Trace, ...]:
    """The panels of a profile that was followed: velocity, and position if it has a label."""
    done, wanted = "what it does", one.target
    of_speed, of_place = f"velocity [{one.symbol}/s]", f"{one.place} [{one.symbol}]"
    speed = Trace(one.name, of_speed, wanted.time, wanted.velocity, {done: one.velocity})
    place = Trace(one.name, of_place, wanted.time, wanted.position, {done: one.position})
    return (speed, place) if one.place else (speed,)


def plot_consequence(shown: Sequence[Trace], *, words: str) -> Picture:
    """The motion that an answer causes, and the wanted motion, in one panel each.

    Args:
        shown: the panels, at least one.
        words: sentences about what happens, with rounded numbers.

    Raises:
        BadRequest: there is no panel, or a curve has another length than its time.
    """
    for one in shown:
        if any(len(values) != len(one.time) for values in (one.wanted, *one.actual.values())):
            raise BadRequest(
                f"a curve of {one.title} does not have one value for each time",
                advice="Give as many values as times.",
            )
    if not shown:
        raise BadRequest("there is no motion to draw", advice="Give at least one panel.")
    columns = min(SIDE_BY_SIDE, len(shown))
    rows = -(-len(shown) // columns)
    figure, grid = make_panels(rows, columns, height=HEIGHT + MORE * rows)
    flat = [axes for row in grid for axes in row]
    for axes, one in zip(flat, shown, strict=False):
        _draw_panel(axes, one)
    for axes in flat[len(shown) :]:
        axes.set_visible(False)
    add_legend(figure, flat[: len(shown)])
    drawn = ", ".join(f"{one.title}'s {one.ylabel.partition(' [')[0]}" for one in shown)
    alt = f"Curves over time show what was wanted, and what your answer causes: {drawn}. {words}"
    return Picture(figure, alt)


def _draw_panel(axes: "Axes", one: Trace) -> None:
    """Draw one panel; the target is a broad line, so that a curve on it stays visible."""
    time = np.asarray(one.time, dtype=float)
    name = "it must have stopped here" if one.limit else "what was wanted"
    axes.plot(
        time, one.wanted, color=REFERENCE, linewidth=1.4 if one.limit else 3.0,
        alpha=1.0 if one.limit else 0.45, linestyle="--" if one.limit else "-", label=name,
    )  # fmt: skip
    for index, (what, values) in enumerate(one.actual.items(), start=1):
        curve = np.array([float(f"{value:.{DIGITS}g}") for value in values])
        kept = decimate_curve(curve, most=MOST)
        axes.plot(
            time[kept], curve[kept], color=COLORS[index], linestyle=LINES[index],
            marker=MARKERS[index], markevery=MARK, markersize=4, linewidth=1.5, label=what,
        )  # fmt: skip
    axes.set_title(one.title, fontsize=10, color=INK)
    axes.set_ylabel(one.ylabel, color=INK)
    axes.set_xlabel("time [s]", color=INK)
