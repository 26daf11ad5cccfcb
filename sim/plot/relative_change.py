"""Relative changes of several numbers, each as a multiple of its value before."""

from collections.abc import Mapping

from sim.core.errors import BadRequest
from sim.plot.picture import COLORS, INK, MARKERS, PAPER, REFERENCE, Picture, make_panels
from sim.plot.table import Table, to_text

SAME = 0.005  # [1] smaller relative changes are called the same
WIDTH = 3.0  # least upper end of the scale, so that a small change looks small


def plot_relative_change(times: Mapping[str, float]) -> Picture:
    """Several numbers after a change, each divided by its value before.

    Args:
        times: name -> value after / value before, from top to bottom.

    Raises:
        BadRequest: there are no numbers, or one is not above zero.
    """
    if not times or not all(value > 0.0 for value in times.values()):
        raise BadRequest(
            "a change needs numbers above zero", advice="Divide what is now by what was before."
        )
    figure, ((axes,),) = make_panels(1, 1, height=0.9 + 0.36 * len(times))
    axes.axvline(1.0, color=REFERENCE, linestyle="--", linewidth=1.2)
    rows = []
    for place, (name, value) in enumerate(times.items()):
        color, marker = COLORS[place % len(COLORS)], MARKERS[place % len(MARKERS)]
        axes.plot([1.0, value], [place, place], color=color, linewidth=3.0, alpha=0.6)
        axes.plot(value, place, marker, color=color, markersize=8)
        axes.annotate(
            f"× {to_text(value)}", (value, place), xytext=(0, 7), textcoords="offset points",
            ha="center", fontsize=8, color=INK,
            bbox={"facecolor": PAPER, "edgecolor": "none", "pad": 0.8},
        )  # fmt: skip
        rows.append((name, value, _word(value)))
    axes.set_yticks(range(len(times)), list(times))
    axes.set_ylim(len(times) - 0.4, -0.8)
    axes.set_xlim(0.0, max(WIDTH, 1.05 * max(times.values())))
    axes.set_xlabel("now ÷ before (dashed line: the same)", color=INK)
    alt = "Dots show numbers after a change, divided by what they were before. " + " ".join(
        f"{name}: {to_text(value)} times, {word}." for name, value, word in rows
    )
    return Picture(figure, alt, Table(("which", "now ÷ before", "that is"), tuple(rows)))


def _word(value: float) -> str:
    if abs(value - 1.0) <= SAME:
        return "the same"
    return "more" if value > 1.0 else "less"
