"""SysId's pictures of the velocity: what was recorded, what the fit uses of it, what a model says.

Source: WPILib SysId 2026, ``view/AnalyzerPlot.cpp``: "Quasistatic Velocity vs. Time" and "Dynamic
Velocity vs. Time".
"""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes

from sim.core.log import DIRECTIONS, FOUR_TESTS, Array, Log, Run
from sim.core.units import Unit, find_unit
from sim.fit.sysid_rows import Rows, prepare_rows
from sim.plot.decimate import decimate_cloud, decimate_curve
from sim.plot.picture import COLORS, INK, LINES, REFERENCE, Picture, add_legend, make_panels
from sim.plot.table import Table

KINDS = ("quasistatic", "dynamic")
MOST = 300  # recorded samples of a test that are drawn as dots
MOST_CURVE = 1000  # samples of a curve that are drawn: a panel has fewer pixels across
FAINT = "#767676"  # what is there for comparison; the palest gray that is still easy to see


def plot_velocity_time(
    log: Log,
    *,
    median: int = 1,
    beside: Log | None = None,
    name: str = "simulation",
    dynamic_seconds: float | None = None,
) -> Picture:
    """Velocity over time as SysId sees it: recorded, then filtered and trimmed, and simulated.

    SysId shows one direction at a time; here are all four tests. What stays gray was recorded and
    is not used by the fit: standstill, the rise before the peak acceleration, and what comes after
    90 % of the top speed of a step.

    Args:
        log: with the four tests.
        median: [samples] window of SysId's median filter.
        beside: what a model makes of the same voltages.
        name: what to call that.
        dynamic_seconds: [s] how much of the dynamic tests to show; None shows all.

    Raises:
        BadRequest: SysId offers no such window.
        NotIdentifiable: SysId's recipe cannot use this log.
    """
    per = find_unit(log.units)
    rows = prepare_rows(log, median=median).rows
    figure, grid = make_panels(2, 2, height=4.6)
    for column, kind in enumerate(KINDS):
        for row, way in enumerate(DIRECTIONS):
            test = f"{kind}-{way}"
            other = beside.runs_of_test(test)[0] if beside and beside.runs_of_test(test) else None
            _draw(
                grid[row][column], log.runs_of_test(test)[0], rows[test], other, name=name, per=per
            )
    for axes in grid[-1]:
        axes.set_xlabel("time since the test began [s]", color=INK)
    for line in grid:
        line[0].set_ylabel(f"velocity [{per.symbol}/s]", color=INK)
    if dynamic_seconds is not None:
        for line in grid:
            line[1].set_xlim(-0.02 * dynamic_seconds, dynamic_seconds)
    add_legend(figure, [axes for line in grid for axes in line])
    table = _table(log, rows, beside, name=name, per=per)
    return Picture(figure, _words(log, rows, beside, median=median, name=name, per=per), table)


def _draw(axes: Axes, run: Run, used: Rows, other: Run | None, *, name: str, per: Unit) -> None:
    """Draw one test."""
    kept = decimate_cloud(run.time, run.velocity, most=MOST)
    axes.plot(
        run.time[kept] - run.time[0],
        run.velocity[kept] / per.si,
        "o",
        color=FAINT,
        markersize=1.8,
        label="recorded",
    )
    _curve(
        axes, used.time - run.time[0], used.velocity / per.si, width=2.6, label="used by the fit"
    )
    if other is not None:
        time = other.time - other.time[0]
        _curve(axes, time, other.velocity / per.si, width=1.2, label=name, model=True)
    axes.set_title(f"{run.test}: {len(used)} of {len(run)} used", fontsize=10, color=INK)


def _curve(
    axes: Axes, time: Array, velocity: Array, *, width: float, label: str, model: bool = False
) -> None:
    kept = decimate_curve(velocity, most=MOST_CURVE)
    axes.plot(
        time[kept],
        velocity[kept],
        color=REFERENCE if model else COLORS[0],
        linestyle=LINES[1] if model else LINES[0],
        linewidth=width,
        label=label,
    )


def _miss(run: Run, beside: Log | None) -> float | None:
    """[m/s or rad/s] root mean square between a run and what a model makes of it."""
    if beside is None or not beside.runs_of_test(run.test):
        return None
    other = beside.runs_of_test(run.test)[0]
    model = np.interp(run.time - run.time[0], other.time - other.time[0], other.velocity)
    return float(np.sqrt(np.mean((run.velocity - model) ** 2)))


def _table(
    log: Log, rows: Mapping[str, Rows], beside: Log | None, *, name: str, per: Unit
) -> Table:
    header = ("test", "recorded", "used", "from [s]", "to [s]", f"fastest used [{per.symbol}/s]")
    lines = []
    for test in FOUR_TESTS:
        run, used = log.runs_of_test(test)[0], rows[test]
        fastest = float(used.velocity[np.argmax(np.abs(used.velocity))]) / per.si
        start, end = (float(used.time[i] - run.time[0]) for i in (0, -1))
        miss = _miss(run, beside)
        off = () if beside is None else ("–" if miss is None else miss / per.si,)
        lines.append((test, len(run), len(used), start, end, fastest, *off))
    extra = () if beside is None else (f"off the {name} [{per.symbol}/s]",)
    return Table((*header, *extra), tuple(lines), caption="What SysId's recipe uses of each test")


def _words(
    log: Log,
    rows: Mapping[str, Rows],
    beside: Log | None,
    *,
    median: int,
    name: str,
    per: Unit,
) -> str:
    said = (
        "Four panels show velocity over time. The quasistatic tests are on the left, the dynamic "
        "tests on the right, and each forward test is above its reverse test. Gray dots are the "
        "recorded samples. A thick line connects the samples that the fit uses."
    )
    if median > 1:
        said += f" A median over {median} samples makes that line smoother."
    if beside is not None:
        said += f" A thin dashed line is the {name}."
    for test in FOUR_TESTS:
        run, used = log.runs_of_test(test)[0], rows[test]
        said += f" The fit uses {len(used)} of the {len(run)} samples of {test}: those from "
        said += f"{used.time[0] - run.time[0]:.2f} to {used.time[-1] - run.time[0]:.2f} s. The run "
        said += f"lasts {run.time[-1] - run.time[0]:.2f} s"
        miss = _miss(run, beside)
        if miss is not None:
            said += f", and the velocity of the {name} is off by {miss / per.si:.3f} "
            said += f"{per.symbol}/s (RMS)"
        said += "."
    return said
