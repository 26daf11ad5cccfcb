"""A gauge: numbers as marks on a scale with named bands."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from sim.core.errors import BadRequest
from sim.plot.picture import (
    COLORS,
    INK,
    MARKERS,
    PAPER,
    Picture,
    add_legend,
    make_panels,
    write_number,
)
from sim.plot.table import Table, to_text

if TYPE_CHECKING:
    from matplotlib.axes import Axes

GOOD = COLORS[2]
REST = ((COLORS[4], "//"), (COLORS[3], ".."))  # colors and hatches of the other bands
WORST = (COLORS[1], "xx")
MOST = len(REST) + 2  # bands at most: these, the good one and the worst
# [half a band's height] largest offset of a mark from the middle, if there are several
APART = 0.22
MARGIN = 0.05  # [share of the scale] margin beyond a mark outside the bands


def plot_gauge(
    values: Mapping[str, float],
    bands: Mapping[str, float],
    *,
    label: str,
    good: str,
    least: float = 0.0,
) -> Picture:
    """Numbers as marks on a scale of bands.

    Args:
        values: name -> number.
        bands: name -> upper end, rising; the last band is open, and the scale ends there or beyond
            the largest number.
        label: label of the scale, with unit.
        good: name of the band in which a number needs no action.
        least: start of the scale, unless a number is smaller.

    Raises:
        BadRequest: there are no numbers, the ends do not rise, there are too many bands, or none is
            the good one.
    """
    ends = list(bands.values())
    if not values or good not in bands or ends != sorted(set(ends)) or len(ends) > MOST:
        raise BadRequest(
            f"a gauge needs numbers, and up to {MOST} bands that rise, one of them good",
            advice="Give each band a larger end than the one before it.",
        )
    low, high = _span(list(values.values()), least=least, last=ends[-1])
    figure, ((axes,),) = make_panels(1, 1, height=1.5 + 0.3 * len(values))
    _draw(axes, values, bands, good=good, span=(low, high))
    axes.set_xlim(low, high)
    axes.set_yticks([])
    axes.set_xlabel(label, color=INK)
    add_legend(figure, (axes,), columns=len(bands) + len(values))
    rows = tuple((name, value, find_band(value, bands)) for name, value in values.items())
    names = [f"{name} up to {to_text(end)}" for name, end in list(bands.items())[:-1]]
    alt = f"A scale of {label} with bands: {', '.join(names)}, and {list(bands)[-1]} above."
    return Picture(figure, alt, Table(("which", label, "band"), rows))


def _span(values: Sequence[float], *, least: float, last: float) -> tuple[float, float]:
    """Start and end of the scale: those of the bands, or beyond numbers outside them."""
    low, high = min(least, *values), max(last, *values)
    margin = MARGIN * (high - low)
    return low - margin * (low < least), high + margin * (high > last)


def _draw(
    axes: "Axes",
    values: Mapping[str, float],
    bands: Mapping[str, float],
    *,
    good: str,
    span: tuple[float, float],
) -> None:
    """Draw the bands, and the marks on them."""
    low, high = span
    # So that the band after the good one always looks the same
    below, above = iter(REST), reversed(REST)
    start, last, good_ends = low, list(bands)[-1], bands[good]
    for name, end in bands.items():
        rest = below if end < good_ends else above
        color, hatch = (GOOD, "") if name == good else WORST if name == last else next(rest)
        stop = high if name == last else end
        axes.barh(0, stop - start, left=start, height=1.0, color=color, hatch=hatch, alpha=0.45,
                  edgecolor=PAPER, linewidth=0.0, label=name)  # fmt: skip
        start = stop
    heights = np.linspace(APART, -APART, len(values)) if len(values) > 1 else (0.0,)
    for index, ((name, value), place) in enumerate(zip(values.items(), heights, strict=True)):
        axes.plot(value, place, MARKERS[index % len(MARKERS)], color=INK, markersize=9,
                  clip_on=False, label=name, zorder=5)  # fmt: skip
        write_number(axes, to_text(value), (value, place))


def find_band(value: float, bands: Mapping[str, float]) -> str:
    """The name of the band of a number; the upper end of a band belongs to the band."""
    names = list(bands)
    return next((name for name in names[:-1] if value <= bands[name]), names[-1])
