"""Curves, and points with a line."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from sim.core.errors import BadRequest
from sim.core.log import Array
from sim.plot.picture import (
    COLORS,
    INK,
    LINES,
    MARKERS,
    REFERENCE,
    Picture,
    make_panels,
)
from sim.plot.table import Cell, Table, to_text

if TYPE_CHECKING:
    from matplotlib.axes import Axes

TABLE_ROWS = 8  # rows of a curve's table: more are hard to read


def plot_curves(
    x: Sequence[float] | Array,
    lines: Mapping[str, Sequence[float] | Array],
    *,
    xlabel: str,
    ylabel: str,
    levels: Mapping[str, float] | None = None,
    marked: tuple[float, float] | None = None,
    mark: str = "here",
    log_scale: bool = False,
) -> Picture:
    """One or more curves over a common axis.

    Args:
        x: (n,) values of the horizontal axis.
        lines: name -> (n,) values.
        xlabel: label of the horizontal axis, with unit.
        ylabel: label of the vertical axis, with unit.
        levels: name -> height of a horizontal line, as the truth or a limit.
        marked: a point to mark with a star.
        mark: what the legend calls the marked point.
        log_scale: the vertical axis is logarithmic.

    Raises:
        BadRequest: there are no curves, or one has another length than ``x``.
    """
    if not lines or any(len(y) != len(x) for y in lines.values()):
        raise BadRequest(
            "every curve needs one value for each x", advice="Give one or more, of equal length."
        )
    figure, ((axes,),) = make_panels(1, 1)
    few = -(-len(x) // TABLE_ROWS)
    for index, (name, y) in enumerate(lines.items()):
        axes.plot(
            x, y, color=COLORS[index % len(COLORS)], linestyle=LINES[index % len(LINES)],
            marker=MARKERS[index % len(MARKERS)], markevery=few, markersize=5, label=name,
        )  # fmt: skip
    for name, level in (levels or {}).items():
        axes.axhline(level, color=REFERENCE, linestyle="--", linewidth=1.0, label=name)
    if marked is not None:
        axes.plot(*marked, "*", color=REFERENCE, markersize=14, label=mark)
    axes.set_xlabel(xlabel, color=INK)
    axes.set_ylabel(ylabel, color=INK)
    if log_scale:
        from matplotlib.ticker import FuncFormatter  # noqa: PLC0415 - slow

        axes.set_yscale("log")
        axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.legend(fontsize=8)
    sentences = [f"Curves of {ylabel} over {xlabel}: {', '.join(lines)}."]
    for name, level in (levels or {}).items():
        sentences.append(f"A dashed line marks “{name}”, {to_text(level)}.")
    if marked is not None:
        sentences.append(f"A star marks “{mark}”, {to_text(marked[1])} at {marked[0]:g}.")
    rows = tuple(
        _make_row(f"{x[i]:g}", [float(y[i]) for y in lines.values()]) for i in range(0, len(x), few)
    )
    return Picture(figure, " ".join(sentences), Table((xlabel, *lines), rows, caption=ylabel))


def plot_misses(
    x: Sequence[float] | Array,
    y: Sequence[float] | Array,
    *,
    intercept: float,
    slope: float,
    xlabel: str,
    ylabel: str,
) -> Picture:
    """A few points, a straight line, and the error of the line at each point.

    Args:
        x: (n,) horizontal coordinates of the points.
        y: (n,) vertical coordinates of the points.
        intercept: value of the line at x = 0.
        slope: slope of the line.
        xlabel: label of the horizontal axis, with unit.
        ylabel: label of the vertical axis, with unit.
    """
    across, up = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    predicted = intercept + slope * across
    figure, ((axes,),) = make_panels(1, 1)
    ends = np.array([0.0, 1.05 * across.max()])
    axes.plot(ends, intercept + slope * ends, color=COLORS[1], linestyle="--", label="the line")
    axes.vlines(across, predicted, up, color=COLORS[3], linewidth=2.5, label="errors")
    axes.plot(across, up, "o", color=COLORS[0], markersize=7, label="samples")
    axes.set_xlabel(xlabel, color=INK)
    axes.set_ylabel(ylabel, color=INK)
    axes.legend(fontsize=8)
    total = f"{to_text(float(np.sum((up - predicted) ** 2)))}{_square_unit(ylabel)}"
    _write_in_corner(axes, f"sum of squared errors: {total}")
    alt = (
        f"The picture shows {across.size} samples, with {ylabel} against {xlabel}. The line is "
        f"{to_text(intercept)} + {to_text(slope)} × {xlabel.partition(' ')[0]}. Vertical bars show "
        f"its errors. The sum of their squares is {total}."
    )
    rows = tuple(
        (to_text(float(a)), float(b), float(c), float(b - c))
        for a, b, c in zip(across, up, predicted, strict=True)
    )
    unit = f" {bracket}" if (bracket := _find_unit(ylabel)) else ""
    header = (xlabel, ylabel, f"the line says{unit}", f"error{unit}")
    return Picture(figure, alt, Table(header, rows))


def _make_row(name: str, numbers: Sequence[float]) -> tuple[Cell, ...]:
    return (name, *numbers)


def _find_unit(label: str) -> str:
    """The unit of a label with its brackets; empty if it has none."""
    return f"[{label.partition('[')[2]}" if "[" in label else ""


def _square_unit(label: str) -> str:
    """The square of a label's unit, to append to a number."""
    unit = _find_unit(label).strip("[]")
    if not unit:
        return ""
    return f" {unit}²" if unit.isalpha() else f" ({unit})²"


def _write_in_corner(axes: "Axes", text: str) -> None:
    axes.text(0.98, 0.04, text, transform=axes.transAxes, ha="right", fontsize=9, color=INK)
