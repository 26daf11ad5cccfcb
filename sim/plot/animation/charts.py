"""Charts whose curves menus and sliders select; the page holds the curves of all positions."""

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import product
from typing import Any, Literal

import numpy as np

from sim.core.errors import Refusal
from sim.core.log import Array
from sim.plot.animation import Animation, describe_choices, list_colors, round_numbers
from sim.plot.animation.scene import Choice, Knob
from sim.plot.table import to_text

MARGIN = 0.05  # [share of an axis] beyond the outermost curve
UNKNOWN = 1.0  # [share of the gain] standard error from which a gain is called unknown


@dataclass(frozen=True, eq=False)
class Curve:
    """A curve of a chart.

    Args:
        name: its name in the legend; without one it is not listed.
        x: (n,) horizontal coordinates.
        y: (n,) vertical coordinates, or numbers of the chart's rows; nan interrupts the curve.
        style: ``line``, ``dashed``, ``dots``, ``bar`` (a thick line) or ``area`` (filled).
        color: index in the palette; None is the color of the text.
        notes: text beside each point; may be empty.
    """

    name: str
    x: Sequence[float] | Array
    y: Sequence[float] | Array
    style: Literal["line", "dashed", "dots", "bar", "area"] = "line"
    color: int | None = None
    notes: Sequence[str] = ()


@dataclass(frozen=True, eq=False)
class Chart:
    """A chart at one position of the sliders.

    Args:
        xlabel: label of the horizontal axis, with unit.
        ylabel: label of the vertical axis, with unit.
        curves: what is drawn, the first one at the back.
        rows: names of rows 0, 1, … from top to bottom, instead of a vertical scale.
        title: a sentence above the chart; may be empty.
        x: ends of the horizontal axis; None fits it to the curves of all positions.
        y: ends of the vertical axis, in the same way.
    """

    xlabel: str
    ylabel: str
    curves: Sequence[Curve]
    rows: Sequence[str] = ()
    title: str = ""
    x: tuple[float, float] | None = None
    y: tuple[float, float] | None = None


@dataclass
class _Pool:
    """Data that many positions share, each held once."""

    numbers: dict[str, int] = field(default_factory=dict)

    def add(self, data: Curve | Mapping[str, Any]) -> int:
        """The number of this data."""
        text = json.dumps(data, default=_describe_curve, allow_nan=False, ensure_ascii=False)
        return self.numbers.setdefault(text, len(self.numbers))

    def list_all(self) -> list[Any]:
        """All stored curves and data, in the order of their numbers."""
        return [json.loads(text) for text in self.numbers]


def _describe_curve(curve: Curve) -> dict[str, Any]:
    return vars(curve) | {"x": round_numbers(curve.x), "y": round_numbers(curve.y)}


def compare_values(
    values: Mapping[str, float],
    *,
    truth: float,
    xlabel: str,
    spreads: Mapping[str, float] | None = None,
) -> Chart:
    """Numbers as dots, one in a row, with a dashed line at the true value.

    Args:
        values: name of the row -> number.
        truth: the true value.
        xlabel: label of the scale, with unit.
        spreads: name -> standard deviation, drawn as a bar.
    """
    rows = tuple(values)
    numbers = [values[name] for name in rows]
    bars = [
        Curve("", [values[name] - one, values[name] + one], [rows.index(name)] * 2, "bar", 4)
        for name, one in (spreads or {}).items()
    ]
    line = Curve("", [truth, truth], [-0.6, len(rows) - 0.4], "dashed")
    dots = Curve("", numbers, range(len(rows)), "dots", 0, [to_text(one) for one in numbers])
    return Chart(xlabel, "", (*bars, line, dots), rows)


def chart_gain_errors(errors: Mapping[str, float]) -> Chart:
    """The standard error of each gain as a bar; a gain with a full bar is unknown.

    Args:
        errors: gain -> standard error as a share of the gain, may be infinite.
    """
    bars = []
    for row, error in enumerate(errors.values()):
        share = 100.0 * min(error, UNKNOWN)
        words = f"± {to_text(share)} %" if error < UNKNOWN else "unknown"
        bars.append(Curve("", [0.0, share], [row, row], "bar", row, ["", words]))
    return Chart("standard error [% of the gain]", "", bars, tuple(errors), x=(0.0, 118.0))


def chart_curves(
    x: Sequence[float] | Array,
    lines: Mapping[str, Sequence[float] | Array],
    *,
    xlabel: str,
    ylabel: str,
    levels: Mapping[str, float] | None = None,
    marks: Mapping[str, tuple[float, float]] | None = None,
) -> Chart:
    """One or more curves over a common axis.

    Args:
        x: (n,) values of the horizontal axis.
        lines: name -> (n,) values.
        xlabel: label of the horizontal axis, with unit.
        ylabel: label of the vertical axis, with unit.
        levels: name -> height of a dashed line, as the truth or a limit.
        marks: name -> point to mark.
    """
    ends = [x[0], x[-1]]
    curves = [
        *(Curve(name, x, y, "line", color) for color, (name, y) in enumerate(lines.items())),
        *(Curve(name, ends, [level] * 2, "dashed") for name, level in (levels or {}).items()),
        *(Curve(name, [at], [up], "dots") for name, (at, up) in (marks or {}).items()),
    ]
    return Chart(xlabel, ylabel, curves)


def chart_line_errors(
    x: Array, y: Array, *, intercept: float, slope: float, xlabel: str, ylabel: str
) -> Chart:
    """A few points, a straight line, and the error of the line at each point.

    Args:
        x: (n,) horizontal coordinates of the points.
        y: (n,) vertical coordinates of the points.
        intercept: value of the line at x = 0.
        slope: slope of the line.
        xlabel: label of the horizontal axis, with unit.
        ylabel: label of the vertical axis, with unit.
    """
    line, ends = intercept + slope * x, np.array([0.0, 1.05 * x.max()])
    gap = np.full(x.size, np.nan)  # ends one error before the next begins
    errors = Curve("errors", np.repeat(x, 3), np.stack([line, y, gap], axis=1).ravel(), "line", 3)
    fitted = Curve("the line", ends, intercept + slope * ends, "dashed", 1)
    total = to_text(float(np.sum((y - line) ** 2)))
    title = f"The sum of the squared errors is {total}."
    samples = Curve("samples", x, y, "dots", 0)
    return Chart(xlabel, ylabel, (fitted, errors, samples), title=title)


def chart_bands(values: Mapping[str, float], bands: Mapping[str, float], *, xlabel: str) -> Chart:
    """Numbers as dots, one in a row, on the named bands of a scale.

    Args:
        values: name of the row -> number.
        bands: name -> upper end, rising; the last band is open.
        xlabel: label of the scale, with unit.
    """
    numbers, rows = list(values.values()), range(len(values))
    starts = [min(0.0, *numbers), *bands.values()]
    ends = [*list(bands.values())[:-1], max(*bands.values(), *numbers)]
    curves = [
        Curve("" if row else name, [start, end], [row, row], "bar", color)
        for color, (name, start, end) in enumerate(zip(bands, starts, ends, strict=False), 1)
        for row in rows
    ]
    dots = Curve("", numbers, rows, "dots", None, [to_text(one) for one in numbers])
    return Chart(xlabel, "", (*curves, dots), tuple(values))


def chart_hold_window(
    volts: Sequence[float] | Array,
    speeds: Sequence[float] | Array,
    *,
    window: tuple[float, float],
    marks: Mapping[str, float],
) -> Chart:
    """Steady speed over constant voltage, and the window in which friction holds the mechanism.

    Args:
        volts: (n,) constant voltages [V], rising.
        speeds: (n,) steady speed at each [m/s]; negative is down.
        window: lower and upper edge, kG - kS and kG + kS [V].
        marks: name -> voltage to mark [V].
    """
    (low, high), (down, up) = window, (min(speeds), max(speeds))
    dots = [
        Curve(name, [value], [0.0], "dots", color, [f"{value:.2f} V"])
        for color, (name, value) in enumerate(marks.items(), 1)
    ]
    stays = Curve("it stays", [low, low, high, high], [down, up, up, down], "area", 4)
    curves = (stays, Curve("speed", volts, speeds, "line", 0), *dots)
    return Chart("voltage [V]", "speed, up is positive [m/s]", curves)


def chart_hold_angles(
    holds: Sequence[tuple[float, float, float]], *, kg: float, ks: float
) -> Chart:
    """The voltages that hold an arm, over its angle: a cosine with a constant width.

    Args:
        holds: angle from level [deg], and lower and upper edge of the window measured there [V].
        kg: voltage that holds the arm level [V].
        ks: voltage of static friction [V].
    """
    angles = np.linspace(-95.0, 95.0, 96)
    middle = kg * np.cos(np.radians(angles))
    around = np.concatenate([middle + ks, (middle - ks)[::-1]])
    at, falls, rises = zip(*holds, strict=True)
    curves = (
        Curve("it stays", np.concatenate([angles, angles[::-1]]), around, "area", 4),
        Curve("kG·cos(angle)", angles, middle, "dashed", 0),
        Curve("no longer falls", at, falls, "dots", 1),
        Curve("begins to rise", at, rises, "dots", 2),
    )
    return Chart("angle from level [deg]", "voltage [V]", curves)


def animate_charts(
    draw: Callable[..., Chart | Sequence[Chart]],
    *,
    choices: Sequence[Choice] = (),
    knobs: Sequence[Knob] = (),
) -> Animation:
    """Charts whose curves menus and sliders select.

    ``draw`` is called here for every combination of options and positions, so that the page can
    show each at once, without a kernel. Charts with the same labels have the same axes. Where
    ``draw`` refuses, the page shows the reason.

    Args:
        draw: function of the options and then of the values of the sliders, in their order.
        choices: menus.
        knobs: sliders.
    """
    positions = [choice.options for choice in choices] + [_list_values(knob) for knob in knobs]
    frames = [_draw(draw, position) for position in product(*positions)]
    fitted = _fit_axes([chart for charts in frames for chart in charts])
    axes, curves = _Pool(), _Pool()
    shown = [
        [[axes.add(_describe_axes(one, fitted)), *map(curves.add, one.curves)] for one in charts]
        for charts in frames
    ]
    data = {
        "colors": list_colors(),
        "choices": describe_choices(choices),
        "knobs": [vars(knob) for knob in knobs],
        "axes": axes.list_all(),
        "curves": curves.list_all(),
        "frames": shown,
    }
    return Animation(data, _describe_start(draw, choices, knobs))


def _draw(draw: Callable[..., Chart | Sequence[Chart]], position: Sequence[object]) -> list[Chart]:
    try:
        drawn = draw(*position)
    except Refusal as refusal:
        return [Chart("", "", (), title=str(refusal), x=(0.0, 1.0), y=(0.0, 1.0))]
    return [drawn] if isinstance(drawn, Chart) else list(drawn)


def _describe_start(
    draw: Callable[..., Chart | Sequence[Chart]], choices: Sequence[Choice], knobs: Sequence[Knob]
) -> str:
    """The charts in words, as first shown."""
    start: dict[str, object] = {one.label: one.value or one.options[0] for one in choices}
    start |= {knob.label: knob.value for knob in knobs}
    listed = ", ".join(f"{name} = {value}" for name, value in start.items())
    words = [f"With {listed}:"] if listed else []
    for chart in _draw(draw, [*start.values()]):
        named = [*chart.rows, *(w for one in chart.curves for w in (one.name, *one.notes) if w)]
        words.append(f"{chart.title} {chart.ylabel} over {chart.xlabel} ({', '.join(named)}).")
    return " ".join(" ".join(words).split())


def _list_values(knob: Knob) -> list[float]:
    count = round((knob.high - knob.low) / knob.step)
    return [round(knob.low + number * knob.step, 9) for number in range(count + 1)]


def _fit_axes(charts: Sequence[Chart]) -> dict[str, tuple[float, float]]:
    """Label -> ends of its axis that hold all curves."""
    found: dict[str, tuple[float, float]] = {}
    for chart in charts:
        for label, axis in ((chart.xlabel, "x"), (chart.ylabel, "y")):
            for curve in chart.curves:
                values = np.asarray(getattr(curve, axis), dtype=float)
                joined = [*found.get(label, ()), np.nanmin(values), np.nanmax(values)]
                found[label] = float(min(joined)), float(max(joined))
    for label, (low, high) in found.items():
        margin = MARGIN * ((high - low) or 1.0)
        found[label] = low - margin, high + margin
    return found


def _describe_axes(chart: Chart, fitted: Mapping[str, tuple[float, float]]) -> dict[str, Any]:
    """A chart without its curves as plain data for the script."""
    axes = {name: value for name, value in vars(chart).items() if name != "curves"}
    rows = (len(chart.rows) - 0.4, -0.6) if chart.rows else None
    return axes | {
        "x": chart.x or fitted[chart.xlabel],
        "y": rows or chart.y or fitted[chart.ylabel],
    }
