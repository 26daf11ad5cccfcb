"""Maps of the residuals of a story: blue where the robot is slower, orange where it is faster."""

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap, Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from sim.core.errors import BadRequest
from sim.core.log import Array
from sim.core.units import Unit, find_unit
from sim.gap import BinnedResiduals, GapMap
from sim.gap.place import POSITION, REST, RUN, SPEED, STEPS, format_noises
from sim.plot.picture import INK, PAPER, Picture
from sim.plot.table import Table
from sim.reconcile.residual_map import map_residuals
from sim.reconcile.story import Story

VELOCITY = 1  # index of the velocity among the two signals
MOST_RUNS = 12  # rows of a map at most
FULL_SHADE = 20.0  # [times the noise] at the end of the color scale, about logarithmic above 1
TICKS = (-20, -5, -1, 0, 1, 5, 20)
DESCRIBED = 5  # places in the description and in the table
DECIMALS = 4  # decimals of a tick label at most
# [in] width of the picture, height of a row, height around each map
WIDE, ROW, SPARE = 8.4, 0.27, 0.72
# Pale tones of Okabe and Ito's blue and orange, so that dark numbers on them stay legible.
SHADES = LinearSegmentedColormap.from_list("gap", ["#4C9BD1", PAPER, "#F08A4B"])
NO_SAMPLES = "#E9E9E9"  # no samples
TITLES = {
    RUN: "run by run, from its beginning to its end",
    SPEED: "by speed",
    POSITION: "by position",
    STEPS: "after the voltage jumps (faster: the reaction is too strong)",
    REST: "where the model stands still",
}


def plot_residual_maps(story: Story) -> Picture:
    """Maps of the residuals on the shown log, of the base model and of the last model.

    Raises:
        BadRequest: there is nothing to compare, or each simulation diverged.
    """
    base, *more = story.chapters
    wanted = {"base model": base}
    if more:
        wanted[f"with {', '.join(one.added for one in more)}"] = more[-1]
    maps = {title: _map(story, chapter.tracks) for title, chapter in wanted.items()}
    if not any(maps.values()):
        raise BadRequest(
            "there is too little to compare, or the simulated motion grew without limit",
            advice="Give longer runs, or read the warnings of the fit.",
        )
    titles = [title for title, one in maps.items() if one]
    found = [one for one in maps.values() if one]
    per = find_unit(story.shown.units)
    return Picture(
        _draw(found, titles, per=per),
        _words(found, titles),
        _numbers(found, ["base" if one == "base model" else "last" for one in titles]),
    )


def _map(story: Story, tracks: Sequence[Array]) -> GapMap | None:
    """The residual maps of a model on the shown runs; None without enough velocity samples."""
    floor = story.noise_floor * find_unit(story.shown.units).si
    if not floor > 0.0:
        raise BadRequest("the noise is not known", advice="Give runs in which it moves.")
    made = map_residuals(story.shown, tracks, compared=story.compared, floor=floor)
    return made if made and any(map(_has_velocity, made.all_maps)) else None


def _draw(found: Sequence[GapMap], titles: Sequence[str], *, per: Unit) -> Figure:
    first = found[0]
    kinds = [
        n
        for n in range(len(first.all_maps))
        if any(_has_velocity(one.all_maps[n]) for one in found)
    ]
    rows = [min(len(first.all_maps[number].rows), MOST_RUNS) for number in kinds]
    height = sum(rows) * ROW + SPARE * len(rows) + 1.3
    figure = Figure(figsize=(WIDE, height), layout="constrained", facecolor=PAPER)
    grid = figure.subplots(
        len(kinds), len(found), squeeze=False,
        gridspec_kw={"height_ratios": [count * ROW + 0.3 for count in rows]},
    )  # fmt: skip
    for line, number in enumerate(kinds):
        for column, one in enumerate(found):
            cells = one.all_maps[number]
            _heat(grid[line, column], cells, per=per, named=column == 0)
            grid[line, column].set_title(TITLES[cells.what], fontsize=8, color=INK, loc="left")
    _draw_headings(figure, grid, titles)
    return figure


def _has_velocity(cells: BinnedResiduals) -> bool:
    """Whether any cell has enough samples of the velocity."""
    return bool(np.isfinite(cells.mean[VELOCITY]).any())


def _draw_headings(figure: Figure, grid: "np.ndarray[tuple[int, int], np.dtype[np.object_]]",
           titles: Sequence[str]) -> None:  # fmt: skip
    """Draw the title of each column, the color scale and the legend."""
    for column, title in enumerate(titles):
        text = f"{title}\n{grid[0, column].get_title(loc='left')}"
        grid[0, column].set_title(text, fontsize=8, color=INK, loc="left")
    full = float(_shade(np.array(FULL_SHADE)))
    bar = figure.colorbar(
        ScalarMappable(Normalize(-full, full), SHADES), ax=grid.ravel().tolist(), location="bottom",
        shrink=0.7, aspect=40, ticks=[float(_shade(np.array(float(tick)))) for tick in TICKS],
    )  # fmt: skip
    bar.ax.set_xticklabels([f"{tick:+d}".replace("-", "−") if tick else "0" for tick in TICKS])
    bar.ax.tick_params(labelsize=8, colors=INK)
    bar.set_label(
        "the robot is slower (−) or faster (+) than the simulation, in times the noise of the "
        "velocity;\nnumbers are written where the error is larger than the noise",
        fontsize=8, color=INK,
    )  # fmt: skip
    figure.legend(
        handles=[Patch(facecolor=NO_SAMPLES, edgecolor="#AAAAAA", hatch="///", label="no samples")],
        loc="outside lower right", fontsize=8, frameon=False, labelcolor=INK,
    )  # fmt: skip


def _heat(axes: Axes, cells: BinnedResiduals, *, per: Unit, named: bool) -> None:
    mean = cells.mean[VELOCITY][:MOST_RUNS]
    significant = np.abs(np.nan_to_num(mean)) >= 1.0
    full = float(_shade(np.array(FULL_SHADE)))
    axes.set_facecolor(NO_SAMPLES)
    rows, columns = mean.shape
    axes.add_patch(_make_background(columns, rows))
    axes.imshow(
        _shade(mean), cmap=SHADES, vmin=-full, vmax=full, aspect="auto", interpolation="nearest",
        zorder=2,
    )  # fmt: skip
    for row, column in zip(*np.nonzero(significant), strict=True):
        text = _format_cell(float(mean[row, column]))
        axes.text(column, row, text, ha="center", va="center", fontsize=6, color=INK, zorder=3)
    axes.set_yticks(range(rows), cells.rows[:MOST_RUNS] if named else [""] * rows)
    axes.tick_params(labelsize=7, colors=INK, length=2)
    axes.set_xticks(*_ticks(cells, per=per))
    axes.spines[:].set_color("#AAAAAA")


def _make_background(columns: int, rows: int) -> Patch:
    """The hatched background, visible where a cell has no samples."""
    return Rectangle(
        (-0.5, -0.5), columns, rows, facecolor=NO_SAMPLES, edgecolor="#AAAAAA", hatch="///",
        linewidth=0, zorder=1,
    )  # fmt: skip


def _ticks(cells: BinnedResiduals, *, per: Unit) -> tuple[list[float], list[str]]:
    """Positions and labels of the column edges, in the log's unit."""
    count = cells.edges.shape[1]
    if cells.what == RUN:
        return [-0.5, count / 2.0 - 1.0, count - 1.5], ["begins", "", "ends"]
    some = range(0, count, 2 if count > 8 else 1)  # noqa: PLR2004 - more labels would touch
    units = {SPEED: f"{per.symbol}/s", POSITION: per.symbol, STEPS: "s", REST: "V"}
    scale = per.si if cells.what in {SPEED, POSITION} else 1.0
    values = cells.edges[0] / scale
    digits = max(1 - math.floor(math.log10(float(np.ptp(values)) / count or 1.0)), 0)
    form = f".{digits}f" if digits <= DECIMALS else ".1e"
    labels = [f"{values[edge]:{form}}".replace("-", "−") for edge in some]
    labels[-1] += f" {units[cells.what]}"
    return [edge - 0.5 for edge in some], labels


def _shade(mean: Array) -> Array:
    """Position on the color scale, asinh(mean), which separates 1, 5 and 20 times the noise."""
    return np.asarray(np.arcsinh(mean))


def _format_cell(value: float) -> str:
    text = f"{value:+.0f}" if abs(value) >= 1.0 else f"{value:+.1f}"
    return text.replace("-", "−")


def _signed(value: float) -> str:
    return f"{'+' if value > 0.0 else ''}{format_noises(value)}".replace("-", "−")


def _words(found: Sequence[GapMap], titles: Sequence[str]) -> str:
    first = (
        "The maps show where the robot is slower or faster than the simulation. There is one for "
        "each run, and one each by speed, by position, by the time since the voltage jumped, and "
        "for where the model stands still."
    )
    sentences = [first]
    for one, title in zip(found, titles, strict=True):
        places = one.find_places(DESCRIBED, signal="velocity")
        if places:
            sentences.append(f"{title}: " + ". ".join(place.sentence for place in places) + ".")
        else:
            sentences.append(f"{title}: nowhere clearly more than the noise.")
    again = [f"{pair.test}, repeated: what is left {pair.verdict}" for pair in found[0].repeats]
    return " ".join(sentences + [". ".join(again) + "."] * bool(again))


def _numbers(found: Sequence[GapMap], titles: Sequence[str]) -> Table:
    rows = [
        (place.where, _signed(place.error), f"{place.sure:.0f}", title)
        for one, title in zip(found, titles, strict=True)
        for place in one.find_places(DESCRIBED, signal="velocity")
    ]
    if not rows:
        rows = [("nowhere clearly more than the noise", "", "", "any")]
    header = ("where", "error [times the noise]", "how sure [standard errors]", "model")
    return Table(header, tuple(rows), "Where the velocity is off: above 0 the robot is faster")
