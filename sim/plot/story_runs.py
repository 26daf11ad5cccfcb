"""The runs of a story, measured, and simulated before and after an effect was added."""

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

FEWEST = 4  # [samples] shorter runs are not simulated
DRAWN, MOST = 12, 300  # runs in one picture, and points of each curve
WIDTH, HEIGHT = 7.6, 1.75  # [in] of the picture, and of a run in it
MARK = 0.14  # [share of a panel] distance of markers
BEFORE, AFTER = (COLORS[1], "--"), (COLORS[0], "-")


@dataclass(frozen=True, eq=False)
class RunOverlay:
    """One run of the shown log, with its simulation by two models.

    Args:
        run: the measured run.
        before: (n, 2) position and velocity in SI, simulated by the model before.
        after: (n, 2) the same by the model after; equal to ``before`` if there is only one model.
        compared: (n,) whether each sample is compared.
    """

    run: Run
    before: Array
    after: Array
    compared: NDArray[np.bool_]

    def error(self, track: Array) -> Array:
        """Measured minus simulated position and velocity, (n, 2) in SI; nan if not compared."""
        residual = np.column_stack([self.run.position, self.run.velocity]) - track
        residual[~self.compared | ~np.isfinite(residual).all(axis=1)] = np.nan
        return residual

    def compute_rms_error(self, track: Array) -> float:
        """RMS velocity error in SI; infinite if the simulation diverged or nothing is compared."""
        residual = self.error(track)[:, 1]
        if not np.isfinite(track[self.compared]).all() or np.isnan(residual).all():
            return math.inf
        return float(np.sqrt(np.nanmean(residual**2)))


def make_run_overlays(story: Story, before: int, after: int) -> list[RunOverlay]:
    """The runs of the shown log, simulated by the models of two rounds.

    Args:
        story: result of ``reconcile``.
        before: number of a chapter.
        after: number of another chapter, or of the same.
    """
    runs = [run for run in story.shown.runs if len(run) >= FEWEST]
    counts = story.compared or tuple(np.ones(len(run), dtype=bool) for run in runs)
    first, second = story.chapters[before].tracks, story.chapters[after].tracks
    return [RunOverlay(*parts) for parts in zip(runs, first, second, counts, strict=True)]


def plot_overlays(story: Story, chapter: int = -1) -> Picture:
    """Each shown run, simulated before an effect was added and after.

    Args:
        story: result of ``reconcile``.
        chapter: number of the chapter; -1 is the last. For 0, only the base model is drawn.

    Raises:
        BadRequest: there is no such chapter.
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
    models = _names(story, chapter)
    for (curve, residuals), one in zip(grid.tolist(), drawn, strict=True):
        _draw(curve, residuals, one, models, per=per, noise=noise)
    grid[0, 0].set_title("velocity", fontsize=9, color=INK)
    grid[0, 1].set_title("measured minus simulated", fontsize=9, color=INK)
    for panel in grid[-1]:
        panel.set_xlabel("time [s]", color=INK, fontsize=9)
    add_shared_legend(figure, grid[0])
    return Picture(
        figure, _words(runs, models, per=per, noise=noise), _numbers(runs, models, story)
    )


def _names(story: Story, chapter: int) -> tuple[str, ...]:
    """The names of the simulated models: one for chapter 0, else two."""
    added = [f"with {one.added}" if one.added else "base model" for one in story.chapters]
    return (added[0],) if chapter == 0 else (added[chapter - 1], added[chapter])


def _draw(
    curve: Axes, residuals: Axes, one: RunOverlay, models: Sequence[str], *, per: Unit, noise: float
) -> None:
    time = one.run.time - one.run.time[0]
    measured = one.run.velocity / per.si
    kept = decimate_curve(measured, most=MOST)
    curve.plot(time[kept], measured[kept], color=COLORS[4], linewidth=3.4, label="measured")
    residuals.axhspan(
        -BAND * noise, BAND * noise, color="#BBBBBB", alpha=0.6, linewidth=0,
        label="95% of the noise",
    )  # fmt: skip
    tracks = (one.after,) if len(models) == 1 else (one.before, one.after)
    looks = (BEFORE, AFTER)[-len(models) :]
    span = 1.6 * float(np.max(np.abs(measured))) or 1.0
    widest = 3.0 * noise
    for name, track, (color, line) in zip(models, tracks, looks, strict=True):
        values = np.clip(np.nan_to_num(track[:, 1] / per.si), -span, span)
        kept = decimate_curve(values, most=MOST)
        curve.plot(
            time[kept], values[kept], color=color, linestyle=line, linewidth=1.1, label=name,
            marker="s" if color == BEFORE[0] else "o", markersize=3.0, markevery=MARK,
        )  # fmt: skip
        residual = one.error(track)[:, 1] / per.si
        kept = decimate_curve(np.nan_to_num(residual), most=MOST)
        residuals.plot(time[kept], residual[kept], color=color, linestyle=line, linewidth=0.9)
        if not np.isnan(residual).all():
            widest = max(widest, 1.15 * float(np.nanquantile(np.abs(residual), 0.995)))
    residuals.set_ylim(-widest, widest)
    residuals.axhline(0.0, color=INK, linewidth=0.6)
    curve.set_ylabel(f"{one.run.test}\n[{per.symbol}/s]", color=INK, fontsize=8)
    for panel in (curve, residuals):
        panel.tick_params(labelsize=7)


def _words(runs: Sequence[RunOverlay], models: Sequence[str], *, per: Unit, noise: float) -> str:
    first = (
        f"The picture shows {len(runs)} runs, measured and simulated ({' and '.join(models)}). The "
        "velocity is on the left. Its residual is on the right, with the band of noise."
    )
    errors = []
    for one in runs:
        sizes = [
            _format_noise_multiple(one.compute_rms_error(track) / per.si, noise)
            for track in _tracks(one, models)
        ]
        errors.append(f"{one.run.test}: {' before, '.join(sizes)}{' after' * (len(sizes) - 1)}.")
    if len(runs) > DRAWN:
        errors.append(f"The other {len(runs) - DRAWN} runs are not drawn.")
    return f"{first} Residual of the velocity, RMS, in times its noise: {' '.join(errors)}"


def _tracks(one: RunOverlay, models: Sequence[str]) -> tuple[Array, ...]:
    return (one.after,) if len(models) == 1 else (one.before, one.after)


def _numbers(runs: Sequence[RunOverlay], models: Sequence[str], story: Story) -> Table:
    per = find_unit(story.shown.units)
    rows = tuple(
        (
            f"{number}: {one.run.test}",
            *(
                _format_noise_multiple(one.compute_rms_error(track) / per.si, story.noise_floor)
                for track in _tracks(one, models)
            ),
        )
        for number, one in enumerate(runs, start=1)
    )
    header = ("run", *(f"{name}, error [times the noise]" for name in models))
    return Table(header, rows)


def _format_noise_multiple(gap: float, noise: float) -> str:
    known = math.isfinite(gap) and noise > 0.0
    return to_text(gap / noise) if known else "ran away"
