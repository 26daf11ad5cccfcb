"""The residual microscope: the volts that a simulation lacks, seen from four sides.

    missing = kA·off' + kV·off        off = measured - simulated velocity, counted along the motion

(taken from one sample to the next, for which the voltage stands: no average crosses a jump.)

Each effect leaves its trace on another side: over the speed, over the time since the voltage
jumped, over the battery's voltage, or between forward and reverse. Above 0 the robot got more than
the model says, below 0 it got less.
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

JUMP = 0.5  # [V] from one sample to the next; a ramp never rises so fast
CLOSE = (0.0, 0.03, 0.07, 0.11, 0.15, 0.21, 0.31, 0.51, 1.01)  # [s] after a jump, edges of cells
CELLS = 8  # of speed, and of the battery's voltage
MOST = 200  # samples of a side that are drawn: more would cover each other, and take their time
FEWEST = 3  # samples of which a mean says anything
NUMBERS = {3: "Three", 4: "Four"}  # views: a log without the battery's voltage has one less
EASY = 0.98  # [quantile] of the samples that is drawn: one wild row must not flatten the rest
SPEED, SINCE, BATTERY, DIRECTION = (
    "speed", "time since the voltage jumped", "battery voltage", "direction",
)  # fmt: skip

_ASKED = ("speed", "since", "ahead", "upward", "driven")  # of each sample; the last three are signs


@dataclass(frozen=True, eq=False)
class ResidualView:
    """The voltage residual, sorted along one axis.

    Args:
        at: (n,) where each sample is; nan where it is nowhere.
        volts: (n,) [V] missing there.
        edges: (cells + 1,) of the cells.
        mean: (cells,) [V] of each cell; nan where too few samples are.
        error: (cells,) [V] one standard error of it.
        explains: [1] share of the squared missing volts that the cells' means explain.
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
    """Per run, (n,) [V] voltage that the simulation would need in addition to move as the log did.

    Args:
        log: what was measured.
        simulated: a run -> (n,) velocity [m/s or rad/s].
        gains: kV and kA of the simulation, SI.

    Returns:
        A run -> (n,) [V], above 0 where the robot is pushed harder forward than the simulation;
        nan at the last sample, after which nothing is known.

    Raises:
        BadRequest: lengths differ.
    """
    if [len(run) for run in log.runs] != [len(one) for one in simulated]:
        raise BadRequest(
            "the simulation is not of this log", advice="Give one velocity for each sample."
        )
    volts = []
    for run, said in zip(log.runs, simulated, strict=True):
        off = run.velocity - said
        kept = np.exp(-gains["kV"] / gains["kA"] * np.diff(run.time))
        lacks = gains["kV"] * (off[1:] - kept * off[:-1]) / (1.0 - kept)
        volts.append(np.append(lacks, np.nan))
    return volts


def make_residual_views(
    log: Log, simulated: Sequence[Array], gains: Mapping[str, float]
) -> dict[str, ResidualView]:
    """The voltage residual along four axes.

    Friction and drag act along the motion, what follows a jump acts along the jump, and a battery
    that gives way acts along the voltage: each side counts its volts in its own direction.

    Args:
        log: what was measured.
        simulated: a run -> (n,) velocity [m/s or rad/s].
        gains: kV and kA of the simulation, SI.

    Returns:
        Side -> what is seen from there; without the battery's where its voltage was not recorded.
    """
    per = find_unit(log.units)
    columns: dict[str, list[Array]] = {name: [] for name in (*_ASKED, "lacks", "bus")}
    for run, said, lacks in zip(
        log.runs, simulated, compute_missing_volts(log, simulated, gains), strict=True
    ):
        ahead = np.sign(np.where(said == 0.0, run.voltage, said))
        inside = (ahead != 0.0) & np.isfinite(lacks)
        since, upward = _since(run)
        bus = np.full(len(run), np.nan) if run.bus_voltage is None else run.bus_voltage
        asked = (np.abs(said) / per.si, since, ahead, upward, np.sign(run.voltage), lacks, bus)
        for name, values in zip(columns, asked, strict=True):
            columns[name].append(values[inside])
    seen = {name: np.concatenate(values) for name, values in columns.items()}
    lacks, along = seen["lacks"], seen["lacks"] * seen["ahead"]
    found = {
        SPEED: _view(along, seen["speed"], _even(seen["speed"])),
        SINCE: _view(lacks * seen["upward"], seen["since"], np.array(CLOSE)),
    }
    if np.isfinite(seen["bus"]).all() and np.ptp(seen["bus"]) > 0.0:
        found[BATTERY] = _view(lacks * seen["driven"], seen["bus"], _even(seen["bus"]))
    return found | {DIRECTION: _directions(along, seen["ahead"])}


def plot_voltage_residual(
    log: Log, simulated: Sequence[Array], gains: Mapping[str, float]
) -> Picture:
    """The missing volts from four sides, each with how much of them its cells explain.

    Args:
        log: what was measured.
        simulated: a run -> (n,) velocity [m/s or rad/s].
        gains: kV and kA of the simulation, SI.
    """
    found = make_residual_views(log, simulated, gains)
    lacking = found[SPEED].volts
    figure, grid = make_panels(2, 2, height=5.0)
    symbol = find_unit(log.units).symbol
    labels = {
        SPEED: f"simulated speed [{symbol}/s]", SINCE: "time since the voltage jumped [s]",
        BATTERY: "battery voltage [V]", DIRECTION: "direction of the motion",
    }  # fmt: skip
    places = [axes for row in grid for axes in row]
    high = 1.15 * max(float(np.quantile(np.abs(lacking), EASY)), _largest(found), 1e-9)
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
    typical = float(np.sqrt(np.mean(lacking**2)))
    told = ", ".join(f"{name} {_percent(view.explains)}" for name, view in found.items())
    alt = (
        f"{NUMBERS[len(found)]} views of the voltage residual, which is {to_text(typical)} V "
        "typically. Each sample is a pale dot. A line connects the means of nearby samples, with "
        f"their errors. The means explain this share of the squared residual: {told}."
    )
    return Picture(figure, alt, Table(("plotted over", "explains", "means [V]"), tuple(
        (name, _percent(view.explains), _listed(view)) for name, view in found.items()
    )))  # fmt: skip


def _since(run: Run) -> tuple[Array, Array]:
    """(n,) [s] since the voltage last jumped, nan before it did; (n,) ±1 which way it jumped."""
    change = np.diff(run.voltage, prepend=0.0)
    last = np.maximum.accumulate(np.where(np.abs(change) > JUMP, np.arange(len(run)), -1))
    there = np.maximum(last, 0)
    since = np.where(last >= 0, run.time - run.time[there], np.nan)
    return since, np.sign(change[there])


def _even(at: Array) -> Array:
    """Edges of cells of one width."""
    low, high = float(at.min()), float(at.max())
    return np.linspace(low, high if high > low else low + 1.0, CELLS + 1)


def _view(lacking: Array, at: Array, edges: Array) -> ResidualView:
    cell = np.searchsorted(edges, at, side="right") - 1
    cell[at == edges[-1]] = edges.size - 2
    cell[~np.isfinite(at)] = -1
    return _sorted(lacking, at, edges, cell)


def _directions(lacking: Array, way: Array) -> ResidualView:
    """Forward against reverse: only their difference counts, not what both lack."""
    cell = np.where(way > 0.0, 1, 0)
    seen = _sorted(lacking, way, np.array([-2.0, 0.0, 2.0]), cell)
    both = 0.5 * float(np.nansum(seen.mean))
    apart = np.nan_to_num(seen.mean - both)[cell]
    total = float(np.sum(lacking**2)) or 1.0
    return ResidualView(
        way, lacking, seen.edges, seen.mean, seen.error, float(np.sum(apart**2)) / total
    )


def _sorted(lacking: Array, at: Array, edges: Array, cell: NDArray[np.intp]) -> ResidualView:
    mean, error = np.full(edges.size - 1, np.nan), np.full(edges.size - 1, np.nan)
    explained = 0.0
    for number in range(mean.size):
        mine = lacking[cell == number]
        if mine.size >= FEWEST:
            mean[number] = float(np.mean(mine))
            error[number] = float(np.std(mine)) / np.sqrt(mine.size)
            explained += mine.size * float(mean[number]) ** 2
    return ResidualView(
        at, lacking, edges, mean, error, explained / (float(np.sum(lacking**2)) or 1.0)
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


def _listed(view: ResidualView) -> str:
    return ",\N{NO-BREAK SPACE}".join(
        "none" if np.isnan(m) else f"{m:+.2f}".replace("-", "−") for m in view.mean
    )
