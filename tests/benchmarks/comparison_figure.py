"""The comparison as one figure: three ways to spoil a simulated log, and real robots."""

from collections.abc import Sequence

import numpy as np
from bench_real import HeldOutScore
from comparison_fits import OURS, RECIPE, Found
from comparison_measured import Measured, ratios
from comparison_page import WAYS, share, told
from comparison_plan import LAG, LIGHT, NOISE, Row, Section
from matplotlib.axes import Axes

from sim.plot.picture import COLORS, INK, MARKERS, REFERENCE, Picture, add_legend, make_panels

LOOKS = {RECIPE: (COLORS[1], MARKERS[1], -0.12), OURS: (COLORS[0], MARKERS[0], 0.12)}
"""Method -> color, marker, place beside the middle: color never speaks alone."""
LEAST, MOST = 0.3, 30.0  # [1] times the truth that are shown; what is farther has an arrow
TIMES = (0.5, 1.0, 2.0, 5.0, 10.0, 20.0)
SHORT = {
    "m/s": "",
    "V·s²/m, ": "\n",
    "averaged over ": "avg.\n",
    "all 20 ms late, ": "late,\n",
    "all 20 ms late": "20 ms\nlate",
}
"""Words of a row that its tick has no room for."""


def picture(figures: Measured) -> Picture:
    """All panels; the last is left out where there are no logs of real robots."""
    across = 2
    figure, grid = make_panels(2, across, width=8.4, height=6.2)
    axes = [panel for row in grid for panel in row]
    sections = ((NOISE, "velocity noise [m/s]"), (LIGHT, "true kA [V·s²/m], noise [m/s]"))
    said = []
    for panel, (section, label) in zip(axes, (*sections, (LAG, "velocity")), strict=False):
        said.append(simulated(panel, section, figures))
        panel.set_xlabel(label, color=INK)
    add_legend(figure, axes[:1], columns=3)
    if figures.real:
        said.append(real(axes[-1], figures.real))
        some = ratios(figures)
        said[-1] += (
            f" It is {np.median(some):.2f} times the recipe's error in the median run, and "
            f"{some.max():.2f} times in the worst run."
        )
    else:
        axes[-1].remove()
    alt = (
        "For two methods: the median kA, divided by the true kA, and the velocity error on "
        "held-out runs of real robots. " + " ".join(said)
    )
    return Picture(figure, alt)


def simulated(axes: Axes, section: Section, figures: Measured) -> str:
    """Found kA over its truth, row by row; what it shows in words."""
    rows = [row for row in section.rows if row in figures.rows]
    axes.axhline(1.0, color=REFERENCE, linestyle="--", linewidth=1.2, label="the truth")
    for method, (color, marker, aside) in LOOKS.items():
        found = [figures.rows[row][method] for row in rows]
        points(axes, rows, found, color=color, marker=marker, aside=aside, name=WAYS[method])
    axes.set_yscale("log")
    axes.set_ylim(LEAST, MOST)
    axes.set_yticks(TIMES, [f"{x:g}" for x in TIMES])
    axes.minorticks_off()
    axes.set_xticks(range(len(rows)), [tick(row.name) for row in rows], fontsize=8)
    axes.set_xlim(-0.5, len(rows) - 0.5)
    axes.set_ylabel("kA found / true kA", color=INK)
    axes.set_title(section.title, fontsize=10, color=INK, loc="left")
    row = told(section, figures)
    medians = {w: _compared(np.median(figures.rows[row][w].gains["kA"]) / row.ka) for w in WAYS}
    return (
        f"{section.title} ({row.name}): {WAYS[RECIPE]} is {medians[RECIPE]}, {WAYS[OURS]} "
        f"{medians[OURS]}."
    )


def _compared(value: float) -> str:
    """How far a share of the truth is from it, as the end of a sentence."""
    text = share(float(value))
    return f"{text} off" if text.endswith("%") else f"{text} the true kA"


def points(
    axes: Axes, rows: Sequence[Row], found: Sequence[Found], *, color: str, marker: str,
    aside: float, name: str,
) -> None:  # fmt: skip
    """Medians with bars from the least to the most; an arrow where the picture ends first."""
    for place, (row, one) in enumerate(zip(rows, found, strict=True)):
        shares = one.gains["kA"] / row.ka
        if not shares.size:
            continue
        ends = np.clip([shares.min(), np.median(shares), shares.max()], LEAST, MOST)
        at = place + aside
        axes.plot([at, at], [ends[0], ends[2]], color=color, linewidth=1.6)
        axes.plot(
            at, ends[1], marker, color=color, markersize=7, clip_on=False,
            label=name if not place else None,
        )  # fmt: skip
        for end, shown in ((shares.min(), "v"), (shares.max(), "^")):
            if not LEAST <= end <= MOST:
                axes.plot(at, np.clip(end, LEAST, MOST), shown, color=color, clip_on=False)


def real(axes: Axes, runs: Sequence[HeldOutScore]) -> str:
    """Our error over the recipe's, run by run of each log; what it shows in words."""
    logs = list(dict.fromkeys(one.log for one in runs))
    color, marker, _ = LOOKS[OURS]
    axes.axhline(1.0, color=LOOKS[RECIPE][0], linewidth=1.6)
    for place, log in enumerate(logs):
        some = [one.ours / one.recipe for one in runs if one.log == log]
        axes.plot(np.full(len(some), place), some, marker, color=color, markersize=6, alpha=0.8)
    axes.set_yscale("log")
    low = min(0.5 * axes.get_ylim()[0], 0.02)
    axes.set_ylim(low, max(axes.get_ylim()[1], 2.0))
    ticks = [x for x in (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0) if x >= low]
    axes.set_yticks(ticks, [f"{x:g}" for x in ticks])
    axes.minorticks_off()
    named = [log.replace("-arm", "").replace("-drivetrain", "").replace("-", "\n") for log in logs]
    axes.set_xticks(range(len(logs)), named, fontsize=8)
    axes.set_xlim(-0.5, len(logs) - 0.5)
    axes.set_ylabel("velocity error, ours / recipe's", color=INK)
    axes.annotate(
        "the recipe", (len(logs) - 0.5, 1.0), xytext=(-3, 4), textcoords="offset points",
        ha="right", fontsize=8, color=INK,
    )  # fmt: skip
    axes.set_title("Real robots: a run held out, predicted", fontsize=10, color=INK, loc="left")
    better = sum(one.ours <= one.recipe for one in runs)
    return f"Real robots: our error is no larger than the recipe's in {better} of {len(runs)} runs."


def tick(name: str) -> str:
    """A row's name, as short as the axis allows."""
    for long, short in SHORT.items():
        name = name.replace(long, short)
    return name.strip()
