"""Bars of the gaps between models and logs, in multiples of the noise."""

from collections.abc import Mapping

import numpy as np

from sim.plot.picture import COLORS, INK, REFERENCE, Picture, add_legend, make_panels, write_number
from sim.plot.table import Table, to_text

HATCHES = ("", "///", "..")  # one for each log, so that color is not the only difference
THICK = 0.8  # [rows] height of all bars of one model


def plot_gap_bars(gaps: Mapping[str, Mapping[str, float]]) -> Picture:
    """Bars of the gap between each model and each log, in multiples of the noise.

    Args:
        gaps: model -> log -> gap [times the noise]; every model has the same logs, at most three.
    """
    logs = tuple(next(iter(gaps.values())))
    figure, ((axes,),) = make_panels(1, 1, height=1.2 + 0.24 * len(gaps) * len(logs))
    size = THICK / len(logs)
    for number, log in enumerate(logs):
        values = [one[log] for one in gaps.values()]
        places = np.arange(len(gaps)) + (number - 0.5 * (len(logs) - 1)) * size
        axes.barh(
            places, values, height=0.9 * size, color=COLORS[number], hatch=HATCHES[number],
            edgecolor=INK, linewidth=0.5, label=log,
        )  # fmt: skip
        for place, value in zip(places, values, strict=True):
            write_number(axes, to_text(float(value)), (value, place), right=True)
    axes.axvline(1.0, color=REFERENCE, linestyle="--", linewidth=1.2, label="the noise")
    axes.set_yticks(range(len(gaps)), list(gaps))
    axes.set_ylim(len(gaps) - 0.5, -0.5)
    axes.set_xlim(0.0, 1.12 * max(2.0, *(value for one in gaps.values() for value in one.values())))
    axes.set_xlabel("gap [times the noise]", color=INK)
    axes.grid(visible=False, axis="y")
    axes.set_axisbelow(True)
    add_legend(figure, (axes,), columns=4)
    rows: list[tuple[str | float, ...]] = [
        (model, *(one[log] for log in logs)) for model, one in gaps.items()
    ]
    return Picture(
        figure,
        "Bars show how many times the noise each model is away from each log. A dashed line at 1 "
        "marks the noise.",
        Table(("model", *logs), tuple(rows), caption="gap [times the noise]"),
    )
