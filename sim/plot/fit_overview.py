"""A fit in one picture: velocity of each run, measured and simulated, the residual, the voltage."""

from collections.abc import Sequence

import numpy as np

from sim.core.errors import BadRequest
from sim.core.units import Unit
from sim.fit.replay import RunReplay
from sim.plot.decimate import decimate_curve
from sim.plot.picture import COLORS, INK, Picture, add_legend, make_panels
from sim.plot.table import to_text

MOST = 500  # samples of a curve drawn at most: a panel has fewer pixels
BAND = 1.96  # [standard deviations] half width of a band with 95 % of the noise
MOST_RUNS = 12  # runs in one picture at most: more would be too small to read
WIDTH, HEIGHT = 3.8, 6.4  # [in] of one run


def plot_fit_overview(runs: Sequence[RunReplay], *, per: Unit) -> Picture:
    """The runs of a fit side by side.

    With a correct model, the residual is sensor noise alone, so the band that holds 95 % of this
    noise is drawn with it.

    Args:
        runs: measured and simulated runs; at most the first ``MOST_RUNS`` are drawn.
        per: the unit of position to show.

    Raises:
        BadRequest: there is nothing to draw.
    """
    if not runs:
        raise BadRequest("there is nothing to draw", advice="First do what the warnings say.")
    drawn, unit = runs[:MOST_RUNS], f"{per.symbol}/s"
    size = {"width": WIDTH * len(drawn), "height": HEIGHT}
    figure, grid = make_panels(3, len(drawn), shared=True, **size)
    for upper, middle, lower, one in zip(*grid, drawn, strict=True):
        time, band = one.run.time - one.run.time[0], BAND * one.velocity_noise / per.si
        upper.set_title(one.run.test, fontsize=10, color=INK)
        middle.axhspan(-band, band, color="#BBBBBB", alpha=0.6, linewidth=0, label="95% of noise")
        for axes, values, color, width, label in (
            (upper, one.run.velocity / per.si, COLORS[4], 3.2, "measured"),
            (upper, one.velocity / per.si, COLORS[1], 1.1, "simulated"),
            (middle, one.velocity_error / per.si, COLORS[0], 0.9, "measured minus simulated"),
            (lower, one.run.voltage, COLORS[5], 0.9, "voltage"),
        ):
            kept = decimate_curve(values, most=MOST)
            axes.plot(time[kept], values[kept], color=color, linewidth=width, label=label)
        lower.set_xlabel("time [s]", color=INK, fontsize=9)
    for row, name in zip(
        grid, (f"velocity [{unit}]", f"residual [{unit}]", "voltage [V]"), strict=True
    ):
        row[0].set_ylabel(name, color=INK, fontsize=9)
    add_legend(figure, [row[0] for row in grid], columns=5)
    sentences = [_describe_replay(one, per=per) for one in drawn]
    if len(runs) > MOST_RUNS:
        sentences.append(f"The other {len(runs) - MOST_RUNS} runs are not drawn.")
    return Picture(figure, " ".join(sentences))


def _describe_replay(one: RunReplay, *, per: Unit) -> str:
    """A description of the picture of a run, with numbers."""
    where = one.moving if one.moving.any() else np.ones(len(one.run), dtype=bool)
    off = float(np.sqrt(np.mean(one.velocity_error[where] ** 2)))
    return (
        f"{one.run.test}: measured and simulated velocity, their difference with the band of "
        f"noise, and the voltage. While it moves, the simulated velocity is off by "
        f"{to_text(off / per.si)} {per.symbol}/s (RMS), which is "
        f"{to_text(off / max(one.velocity_noise, 1e-12))} times its noise."
    )
