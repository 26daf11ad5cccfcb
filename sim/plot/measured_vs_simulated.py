"""Measured and simulated signals of a fit, and their residuals.

With a correct model, the residual is sensor noise alone. So the residual is drawn below each curve,
with the band that holds 95 % of this noise.
"""

from collections.abc import Iterable, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, SubFigure

from sim.core.log import Array
from sim.core.units import Unit
from sim.fit.replay import RunReplay
from sim.plot.decimate import decimate_curve
from sim.plot.picture import COLORS, INK, PAPER, Picture
from sim.plot.table import Table, to_text

MOST = 500  # samples of a curve drawn at most: a panel has fewer pixels
BAND = 1.96  # [standard deviations] half width of a band with 95 % of the noise
MEASURED, SIMULATED = "measured", "simulated"
MARK = 0.12  # [share of a panel] distance of the simulation's markers
ROWS, HEIGHT, WIDTH = 3, 4.6, 7.6  # panels above each other; [in] of one run
SIDE_BY_SIDE = 2  # runs in a row, in a picture of all runs
MOST_RUNS = 40  # runs in one picture at most: more would be too small to read


def plot_measured_vs_simulated(one: RunReplay, *, per: Unit) -> Picture:
    """One run: velocity and position, measured and simulated, their residuals, and the voltage.

    Args:
        one: the run.
        per: the unit of position to show.
    """
    figure = Figure(figsize=(WIDTH, HEIGHT), layout="constrained", facecolor=PAPER)
    _draw(figure, one, per=per)
    return Picture(figure, describe_run(one, per=per), make_error_table([one], per=per))


def draw_all_runs(
    runs: Sequence[RunReplay], *, per: Unit, more: int = 0
) -> tuple[Figure, list[SubFigure]]:
    """Draw all runs into one figure, two per row.

    Args:
        runs: at most the first ``MOST_RUNS`` are drawn.
        per: the unit of position to show.
        more: number of empty blocks at the end.

    Returns:
        The figure, and its empty blocks.
    """
    drawn = runs[:MOST_RUNS]
    rows = -(-len(drawn) // SIDE_BY_SIDE) + -(-more // SIDE_BY_SIDE)
    size = (SIDE_BY_SIDE * WIDTH, rows * HEIGHT)
    figure = Figure(figsize=size, layout="constrained", facecolor=PAPER)
    parts = figure.subfigures(rows, SIDE_BY_SIDE, squeeze=False).ravel().tolist()
    for part, one in zip(parts, drawn, strict=False):
        _draw(part, one, per=per)
        part.suptitle(one.run.test, fontsize=11, color=INK)
    return figure, parts[SIDE_BY_SIDE * -(-len(drawn) // SIDE_BY_SIDE) :]


def describe_run(one: RunReplay, *, per: Unit) -> str:
    """A description of the picture of a run, with numbers."""
    velocity, position = _rms_residuals(one)
    run, symbol = one.run, per.symbol
    return (
        f"{run.test}: measured and simulated velocity and position over {_duration(one):.2f} s. "
        "Below each is the difference of the two, with the band of noise. The voltage goes from "
        f"{run.voltage[0]:.2f} to {run.voltage[-1]:.2f} V. The velocity reaches "
        f"{to_text(_farthest(run.velocity) / per.si)} {symbol}/s. While it moves, the simulated "
        f"velocity is off by {to_text(velocity / per.si)} {symbol}/s (RMS), which is "
        f"{to_text(velocity / max(one.velocity_noise, 1e-12))} times its noise. The simulated "
        f"position is off by {to_text(position / per.si)} {symbol} (RMS)."
    )


def make_error_table(runs: Sequence[RunReplay], *, per: Unit) -> Table:
    """A table of the simulation errors (RMS) of each run."""
    rows = []
    for one in runs:
        velocity, position = _rms_residuals(one)
        rows.append(
            (
                one.run.test,
                len(one.run),
                round(_duration(one), 2),
                _farthest(one.run.velocity) / per.si,
                velocity / per.si,
                velocity / max(one.velocity_noise, 1e-12),
                position / per.si,
            )
        )
    symbol = per.symbol
    header = (
        "run", "samples", "lasts [s]", f"fastest [{symbol}/s]", f"velocity off, RMS [{symbol}/s]",
        "times its noise", f"position off, RMS [{symbol}]",
    )  # fmt: skip
    return Table(header, tuple(rows))


def _rms_residuals(one: RunReplay) -> tuple[float, float]:
    """RMS residuals of velocity and position in SI, while the mechanism moves."""
    where = one.moving if one.moving.any() else np.ones(len(one.run), dtype=bool)
    return (
        float(np.sqrt(np.mean(one.velocity_error[where] ** 2))),
        float(np.sqrt(np.mean(one.position_error[where] ** 2))),
    )


def _duration(one: RunReplay) -> float:
    return float(one.run.time[-1] - one.run.time[0])


def _farthest(values: Array) -> float:
    return float(values[np.argmax(np.abs(values))])


def _draw(figure: Figure | SubFigure, one: RunReplay, *, per: Unit) -> None:
    """Draw velocity on the left and position on the right, residuals and voltage below them."""
    grid = figure.subplots(
        ROWS, 2, sharex=True, squeeze=False, gridspec_kw={"height_ratios": (3, 1.5, 1.5)}
    )
    make_plain_axes(grid.flat)
    time, symbol = one.run.time - one.run.time[0], per.symbol
    sides = (
        ("velocity", f"{symbol}/s", one.run.velocity, one.velocity, one.velocity_noise),
        ("position", symbol, one.run.position, one.position, one.position_noise),
    )
    for column, (name, unit, measured, simulated, noise) in enumerate(sides):
        _curves(grid[0, column], time, measured / per.si, simulated / per.si)
        grid[0, column].set_ylabel(f"{name} [{unit}]", color=INK, fontsize=9)
        _draw_residual(
            grid[1, column], time, (measured - simulated) / per.si, band=BAND * noise / per.si
        )
        grid[1, column].set_ylabel(f"residual [{unit}]", color=INK, fontsize=9)
        _line(grid[2, column], time, one.run.voltage, color=COLORS[5], label="voltage")
        low, high = grid[2, column].get_ylim()
        grid[2, column].set_ylim(min(low, -0.3), max(high, 0.3))
        grid[2, column].set_ylabel("voltage [V]", color=INK, fontsize=9)
        grid[2, column].set_xlabel("time [s]", color=INK, fontsize=9)
    add_shared_legend(figure, (grid[0, 0], grid[1, 0]))


def add_shared_legend(figure: Figure | SubFigure, axes: Iterable[Axes]) -> None:
    """Add one legend below a figure or a part of one."""
    entries = [panel.get_legend_handles_labels() for panel in axes]
    figure.legend(
        [handle for handles, _ in entries for handle in handles],
        [name for _, labels in entries for name in labels],
        loc="outside lower center",
        ncols=4,
        fontsize=8,
        frameon=False,
        labelcolor=INK,
    )


def make_plain_axes(axes: Iterable[Axes]) -> None:
    """Apply the common style of all pictures to axes."""
    for panel in axes:
        panel.set_facecolor(PAPER)
        panel.grid(visible=True, color="#DDDDDD", linewidth=0.6)
        panel.spines[["top", "right"]].set_visible(False)
        panel.tick_params(colors=INK, labelsize=8)


def _curves(axes: Axes, time: Array, measured: Array, simulated: Array) -> None:
    """Draw the measured curve broad and pale, and over it the simulated one thin with markers."""
    kept = decimate_curve(measured, most=MOST)
    axes.plot(time[kept], measured[kept], color=COLORS[4], linewidth=3.2, label=MEASURED)
    kept = decimate_curve(simulated, most=MOST)
    axes.plot(
        time[kept], simulated[kept], color=COLORS[1], linewidth=1.1, linestyle="--", marker="s",
        markersize=3.2, markevery=MARK, label=SIMULATED,
    )  # fmt: skip


def _draw_residual(axes: Axes, time: Array, rest: Array, *, band: float) -> None:
    axes.axhspan(-band, band, color="#BBBBBB", alpha=0.6, linewidth=0, label="95% of the noise")
    _line(axes, time, rest, color=COLORS[0], label="measured minus simulated")
    axes.axhline(0.0, color=INK, linewidth=0.6)


def _line(axes: Axes, time: Array, values: Array, *, color: str, label: str) -> None:
    kept = decimate_curve(values, most=MOST)
    axes.plot(time[kept], values[kept], color=color, linewidth=0.9, label=label)
