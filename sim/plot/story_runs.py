"""The shown runs of a story: measured, and simulated before and after an effect was added."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from sim.core.errors import BadRequest
from sim.core.log import Array, Run
from sim.core.units import Unit, find_unit
from sim.plot.decimate import decimate_curve
from sim.plot.measured_vs_simulated import BAND, add_shared_legend, make_plain_axes
from sim.plot.picture import COLORS, INK, PAPER, Picture
from sim.plot.table import Table, to_text
from sim.reconcile.story import Story

FEWEST = 4  # samples of a run: a solver simulates no shorter ones
DRAWN, MOST = 12, 300  # runs in one picture, and points of each curve
WIDTH, HEIGHT = 7.6, 1.75  # [in] of the picture, and of a run in it
MARK = 0.14  # [share of a panel] between markers
BEFORE, AFTER = (COLORS[1], "--"), (COLORS[0], "-")


@dataclass(frozen=True, eq=False)
class RunOverlay:
    """One run of the shown log, with its simulation by two models.

    Args:
        run: as it was measured.
        before: (n, 2) position and velocity simulated by the model before.
        after: (n, 2) by the model after; the same array where there is one model only.
        compared: (n,) samples that are compared.
    """

    run: Run
    before: Array
    after: Array
    compared: NDArray[np.bool_]

    def error(self, track: Array) -> Array:
        """(n, 2) measured minus simulated; nan where nothing is compared."""
        rest = np.column_stack([self.run.position, self.run.velocity]) - track
        rest[~self.compared | ~np.isfinite(rest).all(axis=1)] = np.nan
        return rest

    def compute_rms_error(self, track: Array) -> float:
        """[unit/s] RMS velocity error; infinite if the simulation diverged."""
        rest = self.error(track)[:, 1]
        if not np.isfinite(track[self.compared]).all() or np.isnan(rest).all():
            return math.inf
        return float(np.sqrt(np.nanmean(rest**2)))


def make_run_overlays(story: Story, before: int, after: int) -> list[RunOverlay]:
    """The runs of the shown log, simulated by the models of two rounds.

    Args:
        story: what was found.
        before: number of a chapter.
        after: of another, or of the same.
    """
    runs = [run for run in story.shown.runs if len(run) >= FEWEST]
    counts = story.compared or tuple(np.ones(len(run), dtype=bool) for run in runs)
    first, second = story.chapters[before].tracks, story.chapters[after].tracks
    return [RunOverlay(*parts) for parts in zip(runs, first, second, counts, strict=True)]


def plot_overlays(story: Story, chapter: int = -1) -> Picture:
    """Each shown run, simulated before an effect was added and after.

    Args:
        story: what was found.
        chapter: its number; -1 is the last. The base, 0, has no before.

    Raises:
        BadRequest: no such chapter.
    """
    count = len(story.chapters)
    if not -count <= chapter < count:
        raise BadRequest(f"no chapter {chapter}", advice=f"Choose one of 0 to {count - 1}.")
    chapter %= count
    runs = make_run_overlays(story, max(chapter - 1, 0), chapter)
    per, noise = find_unit(story.shown.units), story.noise_floor
    drawn = runs[:DRAWN]
    size = (WIDTH, HEIGHT * len(drawn) + 0.5)
    figure = Figure(figsize=size, layout="constrained", facecolor=PAPER)
    grid = figure.subplots(len(drawn), 2, squeeze=False, gridspec_kw={"width_ratios": (3, 2)})
    make_plain_axes(grid.flat)
    said = _names(story, chapter)
    for (curve, left), one in zip(grid.tolist(), drawn, strict=True):
        _draw(curve, left, one, said, per=per, noise=noise)
    grid[0, 0].set_title("velocity", fontsize=9, color=INK)
    grid[0, 1].set_title("measured minus simulated", fontsize=9, color=INK)
    for panel in grid[-1]:
        panel.set_xlabel("time [s]", color=INK, fontsize=9)
    add_shared_legend(figure, grid[0])
    return Picture(figure, _words(runs, said, per=per, noise=noise), _numbers(runs, said, story))


def _names(story: Story, chapter: int) -> tuple[str, ...]:
    """What the simulations are called: one for the base, two for a chapter after it."""
    added = [f"with {one.added}" if one.added else "base model" for one in story.chapters]
    return (added[0],) if chapter == 0 else (added[chapter - 1], added[chapter])


def _draw(
    curve: Axes, left: Axes, one: RunOverlay, said: Sequence[str], *, per: Unit, noise: float
) -> None:
    time = one.run.time - one.run.time[0]
    seen = one.run.velocity / per.si
    kept = decimate_curve(seen, most=MOST)
    curve.plot(time[kept], seen[kept], color=COLORS[4], linewidth=3.4, label="measured")
    left.axhspan(
        -BAND * noise, BAND * noise, color="#BBBBBB", alpha=0.6, linewidth=0,
        label="95% of the noise",
    )  # fmt: skip
    tracks = (one.after,) if len(said) == 1 else (one.before, one.after)
    looks = (BEFORE, AFTER)[-len(said) :]
    span = 1.6 * float(np.max(np.abs(seen))) or 1.0
    widest = 3.0 * noise
    for name, track, (color, line) in zip(said, tracks, looks, strict=True):
        values = np.clip(np.nan_to_num(track[:, 1] / per.si), -span, span)
        kept = decimate_curve(values, most=MOST)
        curve.plot(
            time[kept], values[kept], color=color, linestyle=line, linewidth=1.1, label=name,
            marker="s" if color == BEFORE[0] else "o", markersize=3.0, markevery=MARK,
        )  # fmt: skip
        rest = one.error(track)[:, 1] / per.si
        kept = decimate_curve(np.nan_to_num(rest), most=MOST)
        left.plot(time[kept], rest[kept], color=color, linestyle=line, linewidth=0.9)
        if not np.isnan(rest).all():
            widest = max(widest, 1.15 * float(np.nanquantile(np.abs(rest), 0.995)))
    left.set_ylim(-widest, widest)
    left.axhline(0.0, color=INK, linewidth=0.6)
    curve.set_ylabel(f"{one.run.test}\n[{per.symbol}/s]", color=INK, fontsize=8)
    for panel in (curve, left):
        panel.tick_params(labelsize=7)


def _words(runs: Sequence[RunOverlay], said: Sequence[str], *, per: Unit, noise: float) -> str:
    first = (
        f"The picture shows {len(runs)} runs, measured and simulated ({' and '.join(said)}). The "
        "velocity is on the left. Its residual is on the right, with the band of noise."
    )
    told = []
    for one in runs:
        sizes = [
            _floors(one.compute_rms_error(track) / per.si, noise) for track in _tracks(one, said)
        ]
        told.append(f"{one.run.test}: {' before, '.join(sizes)}{' after' * (len(sizes) - 1)}.")
    if len(runs) > DRAWN:
        told.append(f"The other {len(runs) - DRAWN} runs are not drawn.")
    return f"{first} Residual of the velocity, RMS, in times its noise: {' '.join(told)}"


def _tracks(one: RunOverlay, said: Sequence[str]) -> tuple[Array, ...]:
    return (one.after,) if len(said) == 1 else (one.before, one.after)


def _numbers(runs: Sequence[RunOverlay], said: Sequence[str], story: Story) -> Table:
    per = find_unit(story.shown.units)
    rows = tuple(
        (
            f"{number}: {one.run.test}",
            *(
                _floors(one.compute_rms_error(track) / per.si, story.noise_floor)
                for track in _tracks(one, said)
            ),
        )
        for number, one in enumerate(runs, start=1)
    )
    header = ("run", *(f"{name}, error [times the noise]" for name in said))
    return Table(header, rows)


def _floors(gap: float, noise: float) -> str:
    known = math.isfinite(gap) and noise > 0.0
    return to_text(gap / noise) if known else "ran away"
