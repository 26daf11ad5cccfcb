"""The voltage residual of a simulation, plotted over four variables (the residual microscope).

    missing = kA·off' + kV·off        off = measured - simulated velocity

It is computed exactly from one sample to the next, while the voltage is constant, so no average
crosses a jump. Each effect shows in another plot: over the speed, over the time since the voltage
jumped, over the battery voltage, or between forward and reverse. Above 0, the robot got more
voltage than the model says; below 0, it got less.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from sim.core.errors import BadRequest
from sim.core.log import Array, Log, Run
from sim.core.units import find_unit
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

JUMP = 0.5  # [V] a larger change from one sample to the next is a jump
CLOSE = (0.0, 0.03, 0.07, 0.11, 0.15, 0.21, 0.31, 0.51, 1.01)  # [s] after a jump, edges of bins
BINS = 8  # bins of speed, and of battery voltage
MOST = 200  # samples drawn per plot at most
FEWEST = 3  # samples needed for the mean of a bin
NUMBERS = {3: "Three", 4: "Four"}  # number of views: three without battery voltage
DRAWN_QUANTILE = 0.98  # [1] of the absolute residuals inside the axis, despite outliers
SPEED, SINCE, BATTERY, DIRECTION = (
    "speed", "time since the voltage jumped", "battery voltage", "direction",
)  # fmt: skip

# Of each sample; the last three are signs of motion, jump and voltage.
_COLUMNS = ("speed", "since", "ahead", "upward", "driven")


@dataclass(frozen=True, eq=False)
class ResidualView:
    """The voltage residual, binned over one variable.

    Args:
        at: (n,) value of the variable at each sample; nan if it has none.
        volts: (n,) voltage residual [V].
        edges: (bins + 1,) edges of the bins.
        mean: (bins,) mean residual of each bin [V]; nan with too few samples.
        error: (bins,) standard error of the mean [V].
        explains: share of the squared residual that the means of the bins explain [1].
    """

    at: Array
    volts: Array
    edges: Array
    mean: Array
    error: Array
    explains: float


def compute_missing_volts(
    log: Log, simulated: Sequence[Array], gains: Mapping[str, float]
) -> list[Array]:
    """The voltage [V] that the simulation of each run would need in addition to move as measured.

    Args:
        log: the measured runs.
        simulated: for each run, (n,) velocity [m/s or rad/s].
        gains: kV and kA of the simulation, SI.

    Returns:
        For each run, (n,) [V], above 0 where the robot is pushed forward more than the simulation;
        nan at the last sample, which has no next one.

    Raises:
        BadRequest: the number of runs or the lengths differ.
    """
    if [len(run) for run in log.runs] != [len(one) for one in simulated]:
        raise BadRequest(
            "the simulation is not of this log", advice="Give one velocity for each sample."
        )
    volts = []
    for run, velocity in zip(log.runs, simulated, strict=True):
        off = run.velocity - velocity
        kept = np.exp(-gains["kV"] / gains["kA"] * np.diff(run.time))
        missing = gains["kV"] * (off[1:] - kept * off[:-1]) / (1.0 - kept)
        volts.append(np.append(missing, np.nan))
    return volts


def make_residual_views(
    log: Log, simulated: Sequence[Array], gains: Mapping[str, float]
) -> dict[str, ResidualView]:
    """The voltage residual over four variables.

    Friction and drag act along the motion, an effect after a jump acts along the jump, and a
    voltage drop of the battery acts along the voltage. So the residual of each view is positive in
    that direction.

    Args:
        log: the measured runs.
        simulated: for each run, (n,) velocity [m/s or rad/s].
        gains: kV and kA of the simulation, SI.

    Returns:
        Variable -> view; without the battery voltage if it was not recorded or is constant.

    Raises:
        BadRequest: as ``compute_missing_volts``.
    """
    per = find_unit(log.units)
    columns: dict[str, list[Array]] = {name: [] for name in (*_COLUMNS, "missing", "bus")}
    for run, velocity, missing in zip(
        log.runs, simulated, compute_missing_volts(log, simulated, gains), strict=True
    ):
        ahead = np.sign(np.where(velocity == 0.0, run.voltage, velocity))
        inside = (ahead != 0.0) & np.isfinite(missing)
        since, upward = _find_last_jump(run)
        bus = np.full(len(run), np.nan) if run.bus_voltage is None else run.bus_voltage
        samples = (
            np.abs(velocity) / per.si,
            since,
            ahead,
            upward,
            np.sign(run.voltage),
            missing,
            bus,
        )
        for name, values in zip(columns, samples, strict=True):
            columns[name].append(values[inside])
    joined = {name: np.concatenate(values) for name, values in columns.items()}
    missing, along = joined["missing"], joined["missing"] * joined["ahead"]
    found = {
        SPEED: _view(along, joined["speed"], _equal_edges(joined["speed"])),
        SINCE: _view(missing * joined["upward"], joined["since"], np.array(CLOSE)),
    }
    if np.isfinite(joined["bus"]).all() and np.ptp(joined["bus"]) > 0.0:
        found[BATTERY] = _view(
            missing * joined["driven"], joined["bus"], _equal_edges(joined["bus"])
        )
    return found | {DIRECTION: _directions(along, joined["ahead"])}


def plot_voltage_residual(
    log: Log, simulated: Sequence[Array], gains: Mapping[str, float]
) -> Picture:
    """The voltage residual over four variables, with the share that each explains.

    Args:
        log: the measured runs.
        simulated: for each run, (n,) velocity [m/s or rad/s].
        gains: kV and kA of the simulation, SI.

    Raises:
        BadRequest: as ``compute_missing_volts``.
    """
    found = make_residual_views(log, simulated, gains)
    missing = found[SPEED].volts
    figure, grid = make_panels(2, 2, height=5.0)
    symbol = find_unit(log.units).symbol
    labels = {
        SPEED: f"simulated speed [{symbol}/s]", SINCE: "time since the voltage jumped [s]",
        BATTERY: "battery voltage [V]", DIRECTION: "direction of the motion",
    }  # fmt: skip
    places = [axes for row in grid for axes in row]
    high = 1.15 * max(float(np.quantile(np.abs(missing), DRAWN_QUANTILE)), _largest(found), 1e-9)
    for axes, (name, view) in zip(places, found.items(), strict=False):
        _draw(axes, view, high=high)
        axes.set_title(f"{name}: explains {_percent(view.explains)}", fontsize=10, color=INK)
        axes.set_xlabel(labels[name], color=INK)
        axes.set_ylabel("voltage residual [V]", color=INK)
        if name == DIRECTION:
            axes.set_xticks([-1.0, 1.0], ["reverse", "forward"])
    for axes in places[len(found) :]:
        axes.set_axis_off()
    add_legend(figure, places[:1])
    typical = float(np.sqrt(np.mean(missing**2)))
    shares = ", ".join(f"{name} {_percent(view.explains)}" for name, view in found.items())
    alt = (
        f"{NUMBERS[len(found)]} views of the voltage residual, which is {to_text(typical)} V "
        "typically. Each sample is a pale dot. A line connects the means of nearby samples, with "
        f"their errors. The means explain this share of the squared residual: {shares}."
    )
    return Picture(figure, alt, Table(("plotted over", "explains", "means [V]"), tuple(
        (name, _percent(view.explains), _format_means(view)) for name, view in found.items()
    )))  # fmt: skip


def _find_last_jump(run: Run) -> tuple[Array, Array]:
    """Time since the last voltage jump (n,) [s], nan before the first; and its sign (n,)."""
    change = np.diff(run.voltage, prepend=0.0)
    last = np.maximum.accumulate(np.where(np.abs(change) > JUMP, np.arange(len(run)), -1))
    there = np.maximum(last, 0)
    since = np.where(last >= 0, run.time - run.time[there], np.nan)
    return since, np.sign(change[there])


def _equal_edges(at: Array) -> Array:
    """Edges of bins of equal width."""
    low, high = float(at.min()), float(at.max())
    return np.linspace(low, high if high > low else low + 1.0, BINS + 1)


def _view(missing: Array, at: Array, edges: Array) -> ResidualView:
    cell = np.searchsorted(edges, at, side="right") - 1
    cell[at == edges[-1]] = edges.size - 2
    cell[~np.isfinite(at)] = -1
    return _bin_residual(missing, at, edges, cell)


def _directions(missing: Array, way: Array) -> ResidualView:
    """Forward against reverse: only the difference of their means is explained, not its mean."""
    cell = np.where(way > 0.0, 1, 0)
    joined = _bin_residual(missing, way, np.array([-2.0, 0.0, 2.0]), cell)
    both = 0.5 * float(np.nansum(joined.mean))
    apart = np.nan_to_num(joined.mean - both)[cell]
    total = float(np.sum(missing**2)) or 1.0
    return ResidualView(
        way, missing, joined.edges, joined.mean, joined.error, float(np.sum(apart**2)) / total
    )


def _bin_residual(missing: Array, at: Array, edges: Array, cell: NDArray[np.intp]) -> ResidualView:
    mean, error = np.full(edges.size - 1, np.nan), np.full(edges.size - 1, np.nan)
    explained = 0.0
    for number in range(mean.size):
        mine = missing[cell == number]
        if mine.size >= FEWEST:
            mean[number] = float(np.mean(mine))
            error[number] = float(np.std(mine)) / np.sqrt(mine.size)
            explained += mine.size * float(mean[number]) ** 2
    return ResidualView(
        at, missing, edges, mean, error, explained / (float(np.sum(missing**2)) or 1.0)
    )


def _draw(axes: Axes, view: ResidualView, *, high: float) -> None:
    inside = np.flatnonzero((view.at >= view.edges[0]) & (view.at <= view.edges[-1]))
    inside = inside[:: max(1, -(-inside.size // MOST))]
    axes.plot(
        view.at[inside], view.volts[inside], ".", color=COLORS[0], markersize=3.5, alpha=0.8,
        label="samples",
    )  # fmt: skip
    middle = 0.5 * (view.edges[:-1] + view.edges[1:])
    axes.axhline(0.0, color=REFERENCE, linewidth=1.0)
    axes.errorbar(
        middle, view.mean, yerr=view.error, color=COLORS[1], marker=MARKERS[1], markersize=5,
        linestyle=LINES[0], linewidth=1.4, capsize=3, label="mean of nearby samples",
    )  # fmt: skip
    axes.set_ylim(-high, high)


def _largest(found: Mapping[str, ResidualView]) -> float:
    return max(
        (float(np.nanmax(np.abs(v.mean))) for v in found.values() if np.isfinite(v.mean).any()),
        default=0.0,
    )


def _percent(share: float) -> str:
    return f"{100.0 * share:.0f} %"


def _format_means(view: ResidualView) -> str:
    return ",\N{NO-BREAK SPACE}".join(
        "none" if np.isnan(m) else f"{m:+.2f}".replace("-", "−") for m in view.mean
    )
