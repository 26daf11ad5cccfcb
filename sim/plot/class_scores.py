"""Scores of a class: a histogram, and a heatmap of students by exercises."""

from collections.abc import Sequence

import numpy as np
from matplotlib.ticker import MaxNLocator

from sim.core.errors import BadRequest
from sim.plot.picture import COLORS, INK, Picture, make_panels
from sim.plot.table import Table

NAMED = 40  # students at most whose names are written: more would be too small to read
BINS = 10


def plot_score_histogram(shares: Sequence[float]) -> Picture:
    """Histogram of the shares of all points that students earned.

    Args:
        shares: one for each student, 0 to 1.

    Raises:
        BadRequest: there are no students.
    """
    if not shares:
        raise BadRequest("nobody was graded", advice="Grade somebody first.")
    edges = np.linspace(0.0, 1.0, BINS + 1)
    counts, _ = np.histogram(np.clip(shares, 0.0, 1.0), edges)
    figure, ((axes,),) = make_panels(1, 1, height=2.4)
    axes.bar(100 * edges[:-1] + 50 / BINS, counts, width=90 / BINS, color=COLORS[0], edgecolor=INK)
    axes.set_xlabel("share of all points [%]", color=INK)
    axes.set_ylabel("students", color=INK)
    axes.set_xlim(0, 100)
    axes.yaxis.set_major_locator(MaxNLocator(integer=True))
    rows = tuple(
        (f"{100 * low:.0f} to {100 * high:.0f}", str(count))
        for low, high, count in zip(edges[:-1], edges[1:], counts, strict=True)
    )
    alt = (
        f"Bars count students by their share of all points. Half of the {len(shares)} have at "
        f"least {100 * float(np.median(shares)):.0f} %."
    )
    return Picture(figure, alt, Table(("share [%]", "students"), rows))


def plot_score_heatmap(
    students: Sequence[str], exercises: Sequence[str], shares: Sequence[Sequence[float]]
) -> Picture:
    """A heatmap of scores: students by exercises, the best students on top.

    Args:
        students: names of the students.
        exercises: names of the exercises.
        shares: a row for each student with a share of points (0 to 1) for each exercise; NaN where
            nothing was graded.

    Raises:
        BadRequest: there are no students or no exercises.
    """
    if not students or not exercises:
        raise BadRequest("nobody was graded", advice="Grade somebody first.")
    table = np.array(shares, dtype=float)
    order = np.argsort(-np.nan_to_num(table).sum(axis=1), kind="stable")
    rows = min(len(students), NAMED)
    figure, ((axes,),) = make_panels(1, 1, height=max(2.4, 1.4 + 0.2 * rows))
    drawn = axes.imshow(
        np.ma.masked_invalid(100 * table[order]), cmap="cividis", vmin=0, vmax=100, aspect="auto",
        interpolation="nearest",
    )  # fmt: skip
    axes.set_facecolor("white")
    axes.grid(visible=False)
    axes.set_xticks(range(len(exercises)), exercises, rotation=45, ha="right")
    if len(students) <= NAMED:
        axes.set_yticks(range(len(students)), [students[place] for place in order])
    else:
        axes.set_ylabel(f"{len(students)} students, the best above", color=INK)
    figure.colorbar(drawn, ax=axes, label="points [%]")
    means = _means(table)
    alt = (
        "Each row is a student, and each column an exercise. The color shows the share of the "
        f"points. It is white where nothing was graded. {_describe_hardest(exercises, means)}"
    )
    numbers = tuple(
        (name, "" if np.isnan(mean) else f"{100 * mean:.0f}")
        for name, mean in zip(exercises, means, strict=True)
    )
    return Picture(figure, alt, Table(("exercise", "mean share [%]"), numbers))


def _describe_hardest(exercises: Sequence[str], means: "np.typing.NDArray[np.float64]") -> str:
    """A sentence about the exercise with the lowest mean score, if any score is not full."""
    if np.isnan(means).all():
        return "Nothing was graded yet."
    worst = int(np.nanargmin(means))
    if means[worst] >= 1.0:
        return "Everything that was graded has all points."
    return (
        f"The exercise with the fewest points is {exercises[worst]}: "
        f"{100 * means[worst]:.0f} % on average."
    )


def _means(table: "np.typing.NDArray[np.float64]") -> "np.typing.NDArray[np.float64]":
    """(exercises,) mean score over graded students; NaN where nothing was graded."""
    there = ~np.isnan(table)
    count = there.sum(axis=0)
    total = np.where(there, table, 0.0).sum(axis=0)
    return np.where(count > 0, total / np.maximum(count, 1), np.nan)
