"""The voltage residual of a simulation, plotted over five variables (the residual microscope).

    missing = kA·off' + kV·off        off = measured - simulated velocity

It is computed exactly from one sample to the next, while the voltage is constant, so no average
crosses a jump. Each effect shows in another plot: over the speed, the time since the voltage
jumped, the position, or the battery voltage, or between forward and reverse. Above 0, the robot got
more voltage than the model says; below 0, it got less.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from sim.core.errors import BadRequest
from sim.core.log import Array, Log, Run
from sim.core.units import find_unit
from sim.estimation.measurements import estimate_noise, measure_runs
from sim.physics.model import Model
from sim.physics.replay import replay_log
from sim.plot.decimate import decimate_curve
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

if TYPE_CHECKING:
    from matplotlib.axes import Axes

JUMP = 0.5  # [V] a larger change from one sample to the next is a jump
CLOSE = (0.0, 0.03, 0.07, 0.11, 0.15, 0.21, 0.31, 0.51, 1.01)  # [s] after a jump, edges of bins
BINS = 8  # bins of speed, and of battery voltage
PLACES = 64  # bins of position: a force that repeats needs several for each period
TURNS = 4.0  # [turns] a mechanism that turns farther has no end, so its position is that in a turn
MOST = 200  # samples drawn per plot at most
CURVE = 500  # samples drawn of a run at most
FINE = 16  # bins, above which they are drawn small
FEWEST = 5  # samples needed for the mean of a bin
LEAST = 0.1  # [1] of the squared residual: less than this beyond the noise is noise, too
DRAWN_QUANTILE = 0.98  # [1] of the absolute residuals inside the axis, despite outliers
SPEED, SINCE, POSITION, BATTERY, DIRECTION = (
    "speed", "time since the voltage jumped", "position", "battery voltage", "direction",
)  # fmt: skip
RANK = 1e-9  # [1] of the largest singular value: columns that others already contain

_COLUMNS = (  # of each sample; "ahead" to "driven" are signs of motion, jump and voltage
    "speed", "since", "ahead", "upward", "driven", "missing", "bus", "position", "noise",
)  # fmt: skip


@dataclass(frozen=True, eq=False)
class ResidualView:
    """The voltage residual, binned over one variable.

    Args:
        at: (n,) value of the variable at each sample; nan if it has none.
        volts: (n,) voltage residual [V], in the direction of ``way``.
        way: (n,) ±1, the direction in which the residual is positive.
        edges: (bins + 1,) edges of the bins.
        cell: (n,) the bin of each sample; -1 for none.
        mean: (bins,) mean residual of each bin [V]; nan with too few samples.
        error: (bins,) standard error of the mean [V].
        explains: share of the squared residual beyond noise that the means of the bins explain [1].
    """

    at: Array
    volts: Array
    way: Array
    edges: Array
    cell: NDArray[np.intp]
    mean: Array
    error: Array
    explains: float


@dataclass(frozen=True, eq=False)
class ResidualViews:
    """The voltage residual over several variables.

    Args:
        views: variable -> view; without the battery voltage if it was not recorded or is constant.
        unexplained: share of the squared residual beyond noise that no view explains [1].
        noise: share of the squared residual that is noise [1].
    """

    views: Mapping[str, ResidualView]
    unexplained: float
    noise: float

    @property
    def is_noise(self) -> bool:
        """Whether hardly more than noise is left."""
        return self.noise > 1.0 - LEAST

    @property
    def headline(self) -> str:
        """A sentence about the share of the residual that each view explains."""
        if self.is_noise:
            return f"At least {_format_percent(1.0 - LEAST)} of this is noise."
        share = _format_percent(self.unexplained)
        return f"{share} of the gap beyond noise shows in no plot."


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
    """
    volts = []
    for run, velocity in zip(log.runs, simulated, strict=True):
        off = run.velocity - velocity
        kept = np.exp(-gains["kV"] / gains["kA"] * np.diff(run.time))
        with np.errstate(over="ignore", invalid="ignore"):  # a simulation that diverged
            missing = gains["kV"] * (off[1:] - kept * off[:-1]) / (1.0 - kept)
        volts.append(np.append(missing, np.nan))
    return volts


def simulate_velocity(log: Log, model: Model) -> list[Array]:
    """For each run, (n,) the velocity [m/s or rad/s] that the sensor of a model would show."""
    return [track.seen for track in replay_log(model, log)]


def make_residual_views(
    log: Log,
    model: Model,
    *,
    simulated: Sequence[Array] = (),
    compared: Sequence[NDArray[np.bool_]] = (),
) -> ResidualViews:
    """The voltage residual over five variables.

    Friction and drag act along the motion, an effect after a jump acts along the jump, and a
    voltage drop of the battery acts along the voltage. So the residual of each view is positive in
    that direction. A force that depends on the position does not depend on the direction.

    Args:
        log: the measured runs.
        model: the model that is simulated.
        simulated: for each run, (n,) its velocity [m/s or rad/s]; empty: it is simulated here.
        compared: for each run, (n,) whether a sample counts; empty: all do.

    Raises:
        BadRequest: no sample can be compared.
    """
    simulated, gains = simulated or simulate_velocity(log, model), model.gains
    counts = compared or [np.ones(len(run), dtype=bool) for run in log.runs]
    volts = compute_missing_volts(log, simulated, gains)
    rows = []
    for run, velocity, missing, counted in zip(log.runs, simulated, volts, counts, strict=True):
        ahead = np.sign(np.where(velocity == 0.0, run.voltage, velocity))
        inside = counted & (ahead != 0.0) & np.isfinite(missing)
        since, upward = _find_last_jump(run)
        bus = np.full(len(run), np.nan) if run.bus_voltage is None else run.bus_voltage
        samples = (
            np.abs(velocity), since, ahead, upward, np.sign(run.voltage), missing, bus,
            run.position, _measure_residual_noise(run, gains),
        )  # fmt: skip
        rows.append(np.stack(samples)[:, inside])
    joined = dict(zip(_COLUMNS, np.hstack(rows), strict=True))
    if not joined["missing"].size:
        raise BadRequest(
            "there is too little to compare, or the simulated motion grew without limit",
            advice="Give longer runs, or read the warnings of the fit.",
        )
    measured = measure_runs(log, friction=None, rest_by_position=False)
    variance = joined["noise"] * estimate_noise(measured).velocity ** 2
    return _make_views(joined, variance, log)


def _make_views(joined: Mapping[str, Array], variance: Array, log: Log) -> ResidualViews:
    """The views of all samples; ``variance`` (n,) [V²] is that of the noise."""
    missing, bus = joined["missing"], joined["bus"]
    total = float(np.sum(missing**2)) or 1.0
    beyond = max(total - float(np.sum(variance)), LEAST * total)
    per = find_unit(log.units)
    place = joined["position"] / per.si
    turn = 2.0 * np.pi / per.si
    if per.angular and np.ptp(place) > TURNS * turn:
        place %= turn
    speed = joined["speed"] / per.si
    sides = {
        SPEED: (speed, joined["ahead"], _make_edges(speed, BINS)),
        SINCE: (joined["since"], joined["upward"], np.array(CLOSE)),
        POSITION: (place, np.ones_like(place), _make_edges(place, PLACES)),
    }
    if np.isfinite(bus).all() and np.ptp(bus) > 0.0:
        sides[BATTERY] = (bus, joined["driven"], _make_edges(bus, BINS))
    sides[DIRECTION] = (joined["ahead"], joined["ahead"], np.array([-2.0, 0.0, 2.0]))
    views = {}
    columns = []
    for name, (at, way, edges) in sides.items():
        view = _bin_residual(missing * way, at, way, edges)
        table = _make_columns(view)
        if name == POSITION:  # a push in one direction is at no place
            table -= table.mean(axis=0)
        if name == DIRECTION:  # only the difference of both means: a push in one direction
            table = np.ones((at.size, 1))
        columns.append(table)
        views[name] = replace(
            view, explains=_compute_explained_share(table, missing, variance, beyond=beyond)
        )
    rest = 1.0 - _compute_explained_share(np.hstack(columns), missing, variance, beyond=beyond)
    return ResidualViews(views, rest, min(float(np.sum(variance)) / total, 1.0))


def _make_columns(view: ResidualView) -> Array:
    """(n, bins) regressors that explain the residual by its mean in each bin."""
    known = np.isfinite(view.mean)[view.cell] & (view.cell >= 0)
    table = np.zeros((view.at.size, view.mean.size))
    table[known, view.cell[known]] = view.way[known]
    return table[:, np.isfinite(view.mean)]


def _compute_explained_share(
    table: Array, missing: Array, variance: Array, *, beyond: float
) -> float:
    """Share of the squared residual beyond noise that regressors explain; noise fits a little."""
    if not table.shape[1]:
        return 0.0
    basis, sizes, _ = np.linalg.svd(table, full_matrices=False)
    basis = basis[:, sizes > RANK * sizes[0]]
    by_chance = float(np.sum(basis**2 * variance[:, None]))
    explained = float(np.sum((basis.T @ missing) ** 2)) - by_chance
    return min(max(explained / beyond, 0.0), 1.0)


def _measure_residual_noise(run: Run, gains: Mapping[str, float]) -> Array:
    """(n,) [V²] variance of the voltage residual where that of the velocity is 1."""
    kept = np.exp(-gains["kV"] / gains["kA"] * np.diff(run.time))
    return np.append(gains["kV"] ** 2 * (1.0 + kept**2) / (1.0 - kept) ** 2, np.nan)


def plot_voltage_residual(
    log: Log,
    model: Model,
    *,
    title: str = "",
    simulated: Sequence[Array] = (),
    compared: Sequence[NDArray[np.bool_]] = (),
) -> Picture:
    """The voltage residual over five variables, with the share that each explains, and a run.

    Args:
        log: the measured runs.
        model: the model that is simulated.
        title: what the model is called; may be empty.
        simulated: as for ``make_residual_views``.
        compared: the same.

    Raises:
        BadRequest: no sample can be compared.
    """
    simulated = simulated or simulate_velocity(log, model)
    made = make_residual_views(log, model, simulated=simulated, compared=compared)
    found = made.views
    missing = found[SPEED].volts
    figure, grid = make_panels(2, 3, width=10.0, height=5.4)
    symbol = find_unit(log.units).symbol
    labels = {
        SPEED: f"simulated speed [{symbol}/s]", SINCE: "time since the jump [s]",
        POSITION: f"position [{symbol}]", BATTERY: "battery voltage [V]",
        DIRECTION: "direction of the motion",
    }  # fmt: skip
    places = [axes for row in grid for axes in row]
    means = np.concatenate([view.mean for view in found.values()])
    sizes = np.abs([np.quantile(np.abs(missing), DRAWN_QUANTILE), *means])
    high = 1.15 * max(float(np.nan_to_num(sizes).max()), 1e-9)
    for axes, (name, view) in zip(places, found.items(), strict=False):
        _draw_panel(axes, view, high=high)
        axes.set_title(f"{name}: {_format_percent(view.explains)}", fontsize=10, color=INK)
        axes.set_xlabel(labels[name], color=INK)
        if name == DIRECTION:
            axes.set_xticks([-1.0, 1.0], ["reverse", "forward"])
    for row in grid:
        row[0].set_ylabel("voltage residual [V]", color=INK)
    for axes in places[len(found) : -1]:
        axes.set_axis_off()
    _draw_worst_run(places[-1], log, simulated)
    headline = f"{title}: {made.headline}" if title else made.headline
    figure.suptitle(headline, fontsize=11, color=INK)
    add_legend(figure, (places[0], places[-1]), columns=4)
    typical = float(np.sqrt(np.mean(missing**2)))
    shares = ", ".join(f"{name} {_format_percent(view.explains)}" for name, view in found.items())
    alt = (
        f"{len(found)} views of the voltage residual, which is {to_text(typical)} V "
        "typically. Each sample is a pale dot. A line connects the means of nearby samples, with "
        f"their errors. The means explain this share of the squared residual: {shares}. "
        f"{headline} The last plot shows the measured and the simulated velocity of one run."
    )
    return Picture(figure, alt, Table(("plotted over", "explains", "means [V]"), tuple(
        (name, _format_percent(view.explains), _format_means(view)) for name, view in found.items()
    )))  # fmt: skip


def _draw_worst_run(axes: "Axes", log: Log, simulated: Sequence[Array]) -> None:
    """The measured and the simulated velocity of the run that differ most."""
    with np.errstate(over="ignore"):  # a simulation that diverged
        errors = [np.mean((r.velocity - v) ** 2) for r, v in zip(log.runs, simulated, strict=True)]
    worst = int(np.argmax(errors))
    run, per = log.runs[worst], find_unit(log.units)
    curves = (("measured", run.velocity, 4, 3.0), ("simulated", simulated[worst], 1, 1.2))
    for label, velocity, color, width in curves:
        kept = decimate_curve(velocity, most=CURVE)
        axes.plot(
            run.time[kept] - run.time[0], velocity[kept] / per.si, color=COLORS[color],
            linewidth=width, linestyle=LINES[color == 1], label=label,
        )  # fmt: skip
    axes.set_title(f"worst run: {run.test}", fontsize=10, color=INK)
    axes.set_xlabel("time [s]", color=INK)
    axes.set_ylabel(f"velocity [{per.symbol}/s]", color=INK)


def _find_last_jump(run: Run) -> tuple[Array, Array]:
    """Time since the last voltage jump (n,) [s], nan before the first; and its sign (n,)."""
    change = np.diff(run.voltage, prepend=0.0)
    last = np.maximum.accumulate(np.where(np.abs(change) > JUMP, np.arange(len(run)), -1))
    there = np.maximum(last, 0)
    since = np.where(last >= 0, run.time - run.time[there], np.nan)
    return since, np.sign(change[there])


def _make_edges(at: Array, bins: int) -> Array:
    """Edges of bins of equal width."""
    low, high = float(at.min()), float(at.max())
    return np.linspace(low, high if high > low else low + 1.0, bins + 1)


def _bin_residual(missing: Array, at: Array, way: Array, edges: Array) -> ResidualView:
    cell = np.searchsorted(edges, at, side="right") - 1
    cell[at == edges[-1]] = edges.size - 2
    cell[~np.isfinite(at) | (cell >= edges.size - 1)] = -1
    mean, error = np.full(edges.size - 1, np.nan), np.full(edges.size - 1, np.nan)
    for number in range(mean.size):
        mine = missing[cell == number]
        if mine.size >= FEWEST:
            mean[number] = float(np.mean(mine))
            error[number] = float(np.std(mine)) / np.sqrt(mine.size)
    return ResidualView(at, missing, way, edges, cell, mean, error, 0.0)


def _draw_panel(axes: "Axes", view: ResidualView, *, high: float) -> None:
    inside = np.flatnonzero((view.at >= view.edges[0]) & (view.at <= view.edges[-1]))
    inside = inside[:: max(1, -(-inside.size // MOST))]
    axes.plot(
        view.at[inside], view.volts[inside], ".", color=COLORS[0], markersize=3.5, alpha=0.8,
        label="samples",
    )  # fmt: skip
    middle = 0.5 * (view.edges[:-1] + view.edges[1:])
    many = middle.size > FINE
    axes.axhline(0.0, color=REFERENCE, linewidth=1.0)
    axes.errorbar(
        middle, view.mean, yerr=None if many else view.error, color=COLORS[1], marker=MARKERS[1],
        markersize=2 if many else 5, linestyle=LINES[0], linewidth=1.4, capsize=3,
        label="mean of nearby samples",
    )  # fmt: skip
    axes.set_ylim(-high, high)


def _format_percent(share: float) -> str:
    return f"{100.0 * share:.0f} %"


def _format_means(view: ResidualView) -> str:
    """The means of the bins; of many bins only the lowest and the highest."""
    known = view.mean[np.isfinite(view.mean)]
    if known.size > FINE:
        return f"from {_format_signed(known.min())} to {_format_signed(known.max())}"
    return ",\N{NO-BREAK SPACE}".join("–" if np.isnan(m) else _format_signed(m) for m in view.mean)


def _format_signed(volts: float) -> str:
    return f"{volts:+.2f}".replace("-", "−")
