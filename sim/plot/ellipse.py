"""Confidence ellipses of two gains, from their information matrix.

If the rows hold no information about some combination of the gains, the ellipse is infinitely long
in its direction: two parallel lines, and with little noise one line.
"""

import math
from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes

from sim.core.errors import BadRequest
from sim.core.log import Array
from sim.core.vocabulary import FOUR_TESTS
from sim.fit.sysid_rows import Rows
from sim.plot.decimate import decimate_cloud
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
from sim.plot.table import Table, to_text

LEVEL = 5.991  # 95 % quantile of chi-squared with two degrees of freedom
FLAT = 1e-9  # smaller eigenvalues of the scaled information matrix are rounding errors
ALONG = 1e-6  # smaller components of the unknown direction leave a gain known
ENDLESS = 100.0  # [panels] drawn length of an infinite half axis
MOST = 250  # samples of a test drawn at most


def plot_ellipses(
    information: Mapping[str, Array],
    *,
    names: tuple[str, str],
    truth: tuple[float, float],
    reach: tuple[float, float],
) -> Picture:
    """95 % confidence ellipses of two gains, for several sets of rows.

    Args:
        information: set of rows -> (2, 2) information matrix of both gains [1/unit²], see
            ``sim.fit.information_matrix``.
        names: names of the two gains, with their units: ``kS [V]``.
        truth: the true gains, the centers of the ellipses.
        reach: half width and half height of the panel, in the units of the gains.

    Raises:
        BadRequest: there is nothing to draw.
    """
    if not information:
        raise BadRequest("there is nothing to draw", advice="Give at least one set of rows.")
    figure, ((axes,),) = make_panels(1, 1, height=4.0)
    for index, (name, matrix) in enumerate(information.items()):
        _draw(axes, matrix, index, truth=truth, reach=reach, name=name)
    _finish(axes, names=names, truth=truth, reach=reach)
    axes.legend(fontsize=8)
    alt = f"Each shape shows how well {names[0]} and {names[1]} are known together: 95 of 100 fits "
    alt += "fall inside. "
    alt += " ".join(f"“{name}”: {_words(info, names)}" for name, info in information.items())
    return Picture(figure, alt, _table(information, names))


def plot_information_map(
    rows: Mapping[str, Rows],
    information: Array,
    *,
    names: tuple[str, str],
    truth: tuple[float, float],
    reach: tuple[float, float],
) -> Picture:
    """Velocity and acceleration of the rows, and the confidence ellipse of two gains.

    Args:
        rows: one of the four tests -> its rows.
        information: (2, 2) information matrix of both gains, see ``sim.fit.information_matrix``.
        names: names of the two gains, with their units.
        truth: the true gains, the center of the ellipse.
        reach: half width and half height of its panel, in the units of the gains.
    """
    figure, ((left, right),) = make_panels(1, 2, height=3.8)
    for test, part in rows.items():
        place = FOUR_TESTS.index(test)  # the same color and marker of a test in every map
        kept = decimate_cloud(part.velocity, part.acceleration, most=MOST)
        left.plot(
            part.velocity[kept],
            part.acceleration[kept],
            MARKERS[place],
            color=COLORS[place],
            markersize=5,
            alpha=0.7,
            label=test,
        )
    left.set_xlabel("velocity [m/s]", color=INK)
    left.set_ylabel("acceleration [m/s²]", color=INK)
    left.set_title("where the rows lie", fontsize=10, color=INK)
    _draw(right, information, 0, truth=truth, reach=reach, name="95 of 100 fits")
    _finish(right, names=names, truth=truth, reach=reach)
    right.set_title("how well two gains are known", fontsize=10, color=INK)
    add_legend(figure, [left, right])
    alt = "The left panel shows acceleration against velocity. "
    alt += " ".join(
        f"{test} has {len(part)} rows, with {_span(part.velocity)} m/s and "
        f"{_span(part.acceleration)} m/s²."
        for test, part in rows.items()
    )
    alt += f" The right panel shows {names[1]} over {names[0]}: {_words(information, names)}"
    return Picture(figure, alt, _table({"these tests": information}, names))


def _span(values: Array) -> str:
    return f"{to_text(float(values.min()))} to {to_text(float(values.max()))}"


def _axes(information: Array) -> tuple[Array, Array]:
    """Half axes (2,) of the ellipse, possibly infinite, and their directions (2, 2) in columns."""
    size = np.sqrt(np.diag(information))
    size = np.where(size > 0.0, size, 1.0)
    scaled = information / np.outer(size, size)
    if np.linalg.eigvalsh(scaled)[0] < FLAT:
        values, vectors = np.linalg.eigh(information)
        return np.array([math.inf, math.sqrt(LEVEL / max(float(values[1]), 1e-300))]), vectors
    values, vectors = np.linalg.eigh(information)
    return np.sqrt(LEVEL / values), vectors


def _draw(
    axes: Axes,
    information: Array,
    index: int,
    *,
    truth: tuple[float, float],
    reach: tuple[float, float],
    name: str,
) -> None:
    half, directions = _axes(information)
    half = np.minimum(half, ENDLESS * math.hypot(*reach))
    turn = np.linspace(0.0, 2.0 * math.pi, 721)
    edge = directions @ (half[:, None] * np.stack([np.cos(turn), np.sin(turn)]))
    color = COLORS[index % len(COLORS)]
    axes.fill(truth[0] + edge[0], truth[1] + edge[1], color=color, alpha=0.2, linewidth=0)
    axes.plot(
        truth[0] + edge[0],
        truth[1] + edge[1],
        linestyle=LINES[index % len(LINES)],
        linewidth=1.8,
        label=name,
        color=color,
    )


def _finish(
    axes: Axes, *, names: tuple[str, str], truth: tuple[float, float], reach: tuple[float, float]
) -> None:
    axes.plot(*truth, "x", color=REFERENCE, markersize=8, label="the truth", zorder=3)
    axes.set_xlim(truth[0] - reach[0], truth[0] + reach[0])
    axes.set_ylim(truth[1] - reach[1], truth[1] + reach[1])
    axes.set_xlabel(names[0], color=INK)
    axes.set_ylabel(names[1], color=INK)


def _errors(information: Array) -> tuple[float, float]:
    """The standard errors of both gains; infinite without information about a gain."""
    half, directions = _axes(information)
    if math.isinf(half[0]):
        along = np.abs(directions[:, 0])
        each = np.where(along > ALONG, math.inf, half[1] / math.sqrt(LEVEL))
        return float(each[0]), float(each[1])
    spread = np.linalg.inv(information)
    return math.sqrt(float(spread[0, 0])), math.sqrt(float(spread[1, 1]))


def _words(information: Array, names: tuple[str, str]) -> str:
    half, directions = _axes(information)
    if math.isinf(half[0]):
        along = directions[:, 0] / directions[0, 0] if directions[0, 0] else directions[:, 0]
        return (
            f"a straight band that goes on beyond the picture. Along the band, {names[1]} changes "
            f"by {to_text(float(along[1]))} when {names[0]} changes by 1. The true gains can be "
            "anywhere in the band."
        )
    first, second = _errors(information)
    return (
        f"an ellipse. The standard error of {names[0]} is {to_text(first)}, and that of "
        f"{names[1]} is {to_text(second)}."
    )


def _table(information: Mapping[str, Array], names: tuple[str, str]) -> Table:
    def cell(error: float) -> str:
        return to_text(error) if math.isfinite(error) else "unknown"

    return Table(
        ("rows of", *(f"± {name}" for name in names)),
        tuple((name, *map(cell, _errors(info))) for name, info in information.items()),
        caption="One standard error of each gain",
    )
