"""Voltage and velocity of a log over time."""

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from sim.core.errors import BadRequest
from sim.core.log import DIRECTIONS, FOUR_TESTS, Array, Log, Run
from sim.core.units import Unit, find_unit
from sim.inspect.fault import Damage
from sim.plot.decimate import decimate_curve
from sim.plot.picture import (
    COLORS,
    INK,
    LINES,
    MARKERS,
    Picture,
    add_legend,
    make_panels,
)
from sim.plot.table import Table

if TYPE_CHECKING:
    from matplotlib.axes import Axes

KINDS = ("quasistatic", "dynamic")
APART = 0.15  # [share of a panel] distance of markers
MOST = 1000  # samples of a curve drawn at most: a panel has fewer pixels
BACKGROUND = "#F9EEF5"  # of a damaged part; curves drawn over it stay legible


def plot_time_series(
    log: Log,
    *,
    dynamic_seconds: float | None = None,
    damages: Iterable[Damage] = (),
) -> Picture:
    """Voltage and velocity of the four tests over time, in the log's own unit.

    If a test was repeated, its first run is drawn.

    Args:
        log: a log with at least one of the four tests.
        dynamic_seconds: length of the dynamic tests to show [s]; None shows all.
        damages: damaged parts, drawn hatched; those of runs that are not drawn are only described.

    Raises:
        BadRequest: the log has none of the four tests.
    """
    per = find_unit(log.units)
    runs = _take_first_runs(log)
    figure, (upper, lower) = make_panels(2, 2, height=4.4, shared=True)
    drawn: dict[int, list[tuple[Axes, Array]]] = {}
    for kind, *pair in zip(KINDS, upper, lower, strict=True):
        drawn |= _draw_test_kind(runs, kind, pair, per=per)
        pair[0].set_title(f"{kind} tests", fontsize=10, color=INK)
        pair[1].set_xlabel("time since the test began [s]", color=INK)
    upper[0].set_ylabel("voltage [V]", color=INK)
    lower[0].set_ylabel(f"velocity [{per.symbol}/s]", color=INK)
    if dynamic_seconds is not None:
        lower[1].set_xlim(-0.02 * dynamic_seconds, dynamic_seconds)
    sentences = [_mark_damage(log, one, drawn) for one in damages]
    add_legend(figure, lower)
    alt = (
        "Four panels show the log over time: voltage above and velocity below, the quasistatic "
        "tests on the left and the dynamic tests on the right. A solid line with circles is a "
        "forward test. A dashed line with squares is a reverse test."
    )
    return Picture(figure, " ".join([alt, *sentences]), _tabulate_tests(runs, per))


def _mark_damage(
    log: Log, damage: Damage, drawn: Mapping[int, Sequence[tuple["Axes", Array]]]
) -> str:
    """Hatch a damaged part in the color of its curve; a sentence about where it is."""
    where = damage.where
    if where.run is None or where.run not in drawn:
        return f"The picture does not show {damage.fault} in {where.test or 'the whole log'}."
    run = log.runs[where.run]
    start, end = where.start - run.time[0], where.end - run.time[0]
    color = COLORS[DIRECTIONS.index(run.direction)]
    for axes, _ in drawn[where.run]:
        axes.axvspan(
            start, end, facecolor=BACKGROUND, edgecolor=color, hatch="///", zorder=1,
            label=damage.fault,
        )  # fmt: skip
    return f"Hatching marks {damage.fault} in {where.test}, from {start:.2f} to {end:.2f} s."


def _take_first_runs(log: Log) -> dict[int, Run]:
    """Index in the log -> run, for the first run with samples of each of the four tests."""
    found: dict[str, int] = {}
    for index, run in enumerate(log.runs):
        if len(run):
            found.setdefault(run.test, index)
    first = {found[test]: log.runs[found[test]] for test in FOUR_TESTS if test in found}
    if not first:
        raise BadRequest(
            "this log has none of SysId's four tests",
            where=log.source,
            advice="Use a log that a SysIdRoutine recorded.",
        )
    return first


def _draw_test_kind(
    runs: Mapping[int, Run], kind: str, axes: "Sequence[Axes]", *, per: Unit
) -> dict[int, list[tuple["Axes", Array]]]:
    """Draw both directions of a kind of test into two axes: voltage above, velocity below."""
    drawn: dict[int, list[tuple[Axes, Array]]] = {}
    for index, run in runs.items():
        if run.kind != kind:
            continue
        way = DIRECTIONS.index(run.direction)
        drawn[index] = list(zip(axes, (run.voltage, run.velocity / per.si), strict=True))
        for panel, signal in drawn[index]:
            kept = decimate_curve(signal, most=MOST)
            panel.plot(
                run.time[kept] - run.time[0],
                signal[kept],
                color=COLORS[way],
                linestyle=LINES[way],
                linewidth=1.4,
                marker=MARKERS[way],
                markersize=4.0,
                markevery=APART if kept.size > 1 else 1,
                label=f"log, {run.direction}",
            )
    return drawn


def _tabulate_tests(runs: Mapping[int, Run], per: Unit) -> Table:
    rows = tuple(
        (
            run.test,
            len(run),
            float(run.time[-1] - run.time[0]),
            float(run.voltage[0]),
            float(run.voltage[-1]),
            float(run.velocity[np.argmax(np.abs(run.velocity))]) / per.si,
        )
        for run in runs.values()
    )
    header = ("test", "samples", "lasts [s]", "first [V]", "last [V]", f"fastest [{per.symbol}/s]")
    return Table(header, rows, caption="The log in numbers")
