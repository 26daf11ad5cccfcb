"""Scores of many fits (as R²), and the errors of their gains, in one picture."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

from matplotlib.axes import Axes

from sim.core.errors import BadRequest
from sim.plot.picture import (
    COLORS,
    INK,
    MARKERS,
    PAPER,
    REFERENCE,
    Picture,
    add_legend,
    make_panels,
    write_number,
)
from sim.plot.table import Table

if TYPE_CHECKING:
    from sim.plot.table import Cell

PASSED, FAILED = ("✓", "#009E73", ""), ("✗", "#D55E00", "///")
PERCENT = 100.0
LINEAR = 10.0  # [%] smaller errors are on a linear scale, larger ones on a logarithmic scale
ROW, FOOT = 0.27, 1.25  # [in] height of a row, and of the rest
TICKS = (-1000, -100, -10, 0, 10, 100, 1000)


def plot_r2_vs_gain_error(
    scores: Mapping[str, float],
    *,
    good: float,
    score: str,
    off: Mapping[str, Mapping[str, float]] | None = None,
) -> Picture:
    """The score of each fit, and the errors of its gains.

    Args:
        scores: fit -> its score, from top to bottom.
        good: the threshold; a higher score passes.
        score: name of the score.
        off: gain -> fit -> relative error, 0.1 is 10 % too large; None hides the errors.

    Raises:
        BadRequest: there are no scores, or a gain lacks a fit.
    """
    if not scores or any(set(found) != set(scores) for found in (off or {}).values()):
        raise BadRequest(
            "every fit needs a score and an error", advice="Give one or more, all of them alike."
        )
    figure, ((left, right),) = make_panels(1, 2, height=FOOT + ROW * len(scores), shared=True)
    _badges(left, scores, good=good, score=score)
    if off is None:
        right.text(
            0.5, 0.5, "hidden", transform=right.transAxes, ha="center", fontsize=14, color=INK
        )
        right.set_xticks([])
    else:
        _errors(right, scores, off)
        add_legend(figure, [right])
    right.set_xlabel("off by [%]", color=INK)
    right.set_title("errors of the gains (known only in simulation)", fontsize=10, color=INK)
    errors = "hidden" if off is None else "shown as marks"
    alt = f"A badge says whether the {score} of each log is above {good:g}. Errors are {errors}."
    return Picture(figure, alt, _table(scores, good, score, off))


def _badges(axes: Axes, scores: Mapping[str, float], *, good: float, score: str) -> None:
    """Draw a bar with sign and number for each score, and the threshold as a line."""
    for place, value in enumerate(scores.values()):
        sign, color, hatch = PASSED if value > good else FAILED
        shown = min(max(value, 0.0), 1.0)
        axes.barh(
            place, shown, height=0.78, color=color, hatch=hatch, edgecolor=PAPER, linewidth=0.0
        )
        write_number(axes, f"{sign} {value:.2f}", (0.0, place), right=True)
    axes.axvline(good, color=REFERENCE, linestyle="--", linewidth=1.2)
    axes.set_xlim(0.0, 1.0)
    axes.set_yticks(range(len(scores)), list(scores))
    axes.set_ylim(len(scores) - 0.4, -0.6)
    axes.set_xlabel(f"{score} (dashed: {good:g})", color=INK)
    axes.set_title("the score", fontsize=10, color=INK)
    axes.set_axisbelow(True)


def _errors(
    axes: Axes, scores: Mapping[str, float], off: Mapping[str, Mapping[str, float]]
) -> None:
    """Draw a marker for each error, on a scale on which both 1 % and 500 % are visible."""
    axes.set_xscale("symlog", linthresh=LINEAR, linscale=0.8)
    axes.axvline(0.0, color=REFERENCE, linewidth=1.2)
    for index, (gain, found) in enumerate(off.items()):
        axes.plot(
            [PERCENT * found[name] for name in scores],
            range(len(scores)),
            MARKERS[index],
            color=COLORS[index],
            markersize=6,
            label=gain,
        )
    most = max(2 * LINEAR, 1.3 * PERCENT * max(abs(v) for f in off.values() for v in f.values()))
    axes.set_xlim(-most, most)
    ticks = [tick for tick in TICKS if abs(tick) <= most]
    axes.set_xticks(ticks, [f"{tick:+d}".replace("-", "−") if tick else "0" for tick in ticks])
    axes.minorticks_off()


def _table(
    scores: Mapping[str, float],
    good: float,
    score: str,
    off: Mapping[str, Mapping[str, float]] | None,
) -> Table:
    header = ("log", score, f"above {good:g}?")
    rows: list[tuple[Cell, ...]] = [
        (name, value, "yes" if value > good else "no") for name, value in scores.items()
    ]
    if off is None:
        return Table(header, tuple(rows))
    full_rows = (
        (*row, *(format_percent(found[name]) for found in off.values()))
        for name, row in zip(scores, rows, strict=True)
    )
    return Table((*header, *(f"{gain} off by" for gain in off)), tuple(full_rows))


def format_percent(share: float) -> str:
    """A ratio as a signed percentage without decimals: 0.1 gives ``+10 %``."""
    whole = round(PERCENT * share)
    return f"{whole:+d} %".replace("-", "−") if whole else "0 %"
