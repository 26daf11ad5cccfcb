"""What a log holds, to look at before anything is fitted to it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes

from sim.errors import BadRequest
from sim.log import Log, Run
from sim.plot.picture import COLORS, INK, LINES, MARKERS, REFERENCE, Dash, Picture, panels
from sim.plot.table import Table
from sim.units import Unit, unit

KINDS = ("quasistatic", "dynamic")
WAYS = ("forward", "reverse")
APART = 0.15  # [share of a panel] between markers: lines can be told apart, and still be seen
MOST = 150  # samples of a ramp in a panel that shows all of it: more are not seen, but cost time
HIDDEN = "_"  # matplotlib leaves out of the legend what begins with this


@dataclass(frozen=True)
class Line:
    """A straight line in the picture of voltage over velocity: V = intercept + slope·v.

    Args:
        intercept: [V].
        slope: [V·s/unit].
    """

    intercept: float
    slope: float


@dataclass(frozen=True)
class _Pen:
    """How a test is drawn."""

    color: str
    line: Dash
    marker: str
    width: float


_PENS = tuple(_Pen(COLORS[i], LINES[i], MARKERS[i], 1.4) for i in range(len(WAYS)))
_THIN = _Pen(REFERENCE, ":", "", 1.2)


def time_series(
    log: Log,
    *,
    beside: Log | None = None,
    names: tuple[str, str] = ("log", "what happened"),
    dynamic_seconds: float | None = None,
) -> Picture:
    """Voltage and velocity of the four tests over time, in the log's own unit.

    Args:
        log: with at least one of the four tests.
        beside: the same tests another way, drawn in thin black: what really happened, or what a
            model makes of the same voltage.
        names: what to call the log and what is beside it.
        dynamic_seconds: [s] how much of the dynamic tests to show; None shows all.

    Raises:
        BadRequest: the log has none of the four tests.
    """
    per = unit(log.units)
    table = _tests_table(log, per)
    figure, (upper, lower) = panels(2, 2, height=4.4, shared=True)
    labels = tuple(f"{names[0]}, {way}" for way in WAYS)
    for kind, *pair in zip(KINDS, upper, lower, strict=True):
        _draw(log, kind, pair, pens=_PENS, labels=labels)
        if beside is not None:
            _draw(beside, kind, pair, pens=(_THIN, _THIN), labels=(names[1], HIDDEN))
        pair[0].set_title(f"{kind} tests", fontsize=10, color=INK)
        pair[1].set_xlabel("time since the test began [s]", color=INK)
    upper[0].set_ylabel("voltage [V]", color=INK)
    lower[0].set_ylabel(f"velocity [{per.symbol}/s]", color=INK)
    if dynamic_seconds is not None:
        lower[1].set_xlim(-0.02 * dynamic_seconds, dynamic_seconds)
    figure.legend(
        *lower[0].get_legend_handles_labels(),
        fontsize=9,
        loc="outside lower center",
        ncols=3,
        frameon=False,
    )
    alt = _time_words(table, per, names if beside is not None else names[:1])
    return Picture(figure, alt, table)


def voltage_velocity(
    log: Log, *, lines: Mapping[str, Line] | None = None, zoom: float | None = None
) -> Picture:
    """Voltage over velocity of the quasistatic tests, all of it and the part near standstill.

    Args:
        log: with a quasistatic test.
        lines: name -> straight line for forward motion, per the log's unit; extended to v = 0.
        zoom: [unit/s] width of the second panel; None takes an eighth of the top speed.

    Raises:
        BadRequest: the log has no quasistatic test.
    """
    per = unit(log.units)
    runs = [run for run in log.runs if run.kind == "quasistatic"]
    if not runs:
        raise BadRequest(
            "this log has no quasistatic test", advice="Give a log with a slow ramp in it."
        )
    top = max(float(np.abs(run.velocity).max()) for run in runs) / per.si
    most = max(float(np.abs(run.voltage).max()) for run in runs)
    drawn = dict(lines or {})
    near = zoom or top / 8.0
    figure, ((whole, close),) = panels(1, 2)
    for axes, most_shown in ((whole, MOST), (close, None)):
        _draw_over_velocity(axes, runs, drawn, per=per, top=top, most=most_shown)
        axes.set_xlabel(f"velocity [{per.symbol}/s]", color=INK)
    close.set_xlim(-0.15 * near, near)
    close.set_ylim(0.0, 1.3 * most * near / top + 0.05)
    whole.set_ylabel("voltage [V]", color=INK)
    whole.set_title("the whole ramp", fontsize=10, color=INK)
    close.set_title("close to standstill", fontsize=10, color=INK)
    whole.legend(fontsize=9)
    return Picture(figure, _line_words(drawn, per, top=top, most=most), _line_table(drawn, per))


def _draw(
    log: Log, kind: str, axes: Sequence[Axes], *, pens: Sequence[_Pen], labels: Sequence[str]
) -> None:
    """Draw both directions of a kind of test into two axes: voltage above, velocity below."""
    per = unit(log.units)
    for way, pen, label in zip(WAYS, pens, labels, strict=True):
        for run in log.of(f"{kind}-{way}")[:1]:
            for panel, signal in zip(axes, (run.voltage, run.velocity / per.si), strict=True):
                panel.plot(
                    run.time - run.time[0],
                    signal,
                    color=pen.color,
                    linestyle=pen.line,
                    linewidth=pen.width,
                    marker=pen.marker,
                    markersize=4.0,
                    markevery=APART,
                    label=label,
                )


def _draw_over_velocity(
    axes: Axes,
    runs: Sequence[Run],
    lines: Mapping[str, Line],
    *,
    per: Unit,
    top: float,
    most: int | None,
) -> None:
    """Draw every sample, or at most so many of each run, and the lines."""
    for run in runs:
        index = WAYS.index(run.direction)
        axes.plot(
            run.velocity / per.si,
            run.voltage,
            MARKERS[index],
            color=COLORS[index],
            markevery=max(len(run) // most, 1) if most else 1,
            markersize=2.5,
            alpha=0.6,
            label=run.direction,
        )
    ends = np.array([0.0, top])
    for index, (name, line) in enumerate(lines.items(), start=len(WAYS)):
        axes.plot(
            ends,
            line.intercept + line.slope * ends,
            color=REFERENCE if index == len(WAYS) else COLORS[index % len(COLORS)],
            linestyle=LINES[index % len(LINES)],
            linewidth=1.8,
            label=name,
        )


def _tests_table(log: Log, per: Unit) -> Table:
    runs = [run for kind in KINDS for way in WAYS for run in log.of(f"{kind}-{way}")[:1]]
    if not runs:
        raise BadRequest(
            "this log has none of SysId's four tests", advice="Give a log of a SysIdRoutine."
        )
    rows = tuple(
        (
            run.test,
            len(run),
            float(run.time[-1] - run.time[0]),
            float(run.voltage[0]),
            float(run.voltage[-1]),
            float(run.velocity[np.argmax(np.abs(run.velocity))]) / per.si,
        )
        for run in runs
    )
    header = ("test", "samples", "lasts [s]", "first V", "last V", f"fastest [{per.symbol}/s]")
    return Table(header, rows, caption="The log in numbers")


def _time_words(table: Table, per: Unit, names: Sequence[str]) -> str:
    said = "Four panels over time: voltage above velocity, quasistatic tests left, dynamic tests "
    said += "right, forward as circles on a solid line, reverse as squares on a dashed line."
    for test, _, lasts, first, last, fastest in table.rows:
        said += f" In {test} the voltage goes from {first:.2f} to {last:.2f} V in {lasts:.1f} s, "
        said += f"and the velocity reaches {fastest:.2f} {per.symbol}/s."
    if len(names) > 1:
        said += f" A thin dotted black line shows {names[1]} beside the {names[0]}."
    return said


def _line_words(lines: Mapping[str, Line], per: Unit, *, top: float, most: float) -> str:
    said = "Two panels of voltage over velocity: the whole ramp, and its start. The samples of "
    said += f"each direction lie almost on a line, up to {most:.2f} V at {top:.2f} {per.symbol}/s."
    for name, line in lines.items():
        said += f" The line “{name}” meets standstill at {line.intercept:.3f} V and rises by "
        said += f"{line.slope:.3f} V per {per.symbol}/s."
    return said


def _line_table(lines: Mapping[str, Line], per: Unit) -> Table | None:
    rows = tuple((name, line.intercept, line.slope) for name, line in lines.items())
    header = ("line", "at standstill [V]", f"slope [V·s/{per.symbol}]")
    return Table(header, rows) if rows else None
