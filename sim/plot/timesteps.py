"""The time between samples: what SysId calls "Timesteps vs. Time".

SysId draws all steps over one time axis, with their mean as a line. Here every test has its
own panel, the line is the median, which gaps do not change, and the gaps are marked and described.
Source: WPILib SysId 2026, ``view/AnalyzerPlot.cpp``.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from sim.core.errors import BadRequest
from sim.core.log import DIRECTIONS, KINDS, Array, Log, Run
from sim.inspect.log_features import LogFeatures
from sim.plot.decimate import decimate_cloud, decimate_curve
from sim.plot.picture import COLORS, INK, MARKERS, REFERENCE, Picture, add_legend, make_panels
from sim.plot.table import Table, to_text

GAP = 1.5  # [median steps] a longer step is a gap; shorter ones are jitter
HIGHEST = 15.0  # [median steps] largest height of a panel; longer steps are marked at its edge
NEAR_MEDIAN = 2.5  # [median steps] least height of a panel
MOST = 160  # ordinary steps drawn in a panel
MOST_GAPS = 200  # gaps drawn in a panel
# [share of a panel's height] height of the mark of a gap that is longer than the panel
EDGE = 0.955
HEIGHT, ROW = 1.15, 1.6  # [in] height around the panels, and of each row of them
MILLI = 1e3


@dataclass(frozen=True, eq=False)
class _Steps:
    """The steps of one run.

    Args:
        run: the run.
        after: (n,) start of each step since the run began [s].
        length: (n,) length of each step [ms].
        gaps: (n,) whether each step is a gap.
    """

    run: Run
    after: Array
    length: Array
    gaps: "np.ndarray[tuple[int], np.dtype[np.bool_]]"


def plot_timesteps(log: Log) -> Picture:
    """The time between one sample and the next, over the time since each test began.

    Args:
        log: any log; kinds of tests that SysId does not have are drawn, too, and repeated tests are
            drawn in one panel.

    Raises:
        BadRequest: no run has two samples.
    """
    median = LogFeatures(log).period * MILLI
    if not np.isfinite(median):
        raise BadRequest(
            "no run of this log has two samples, so there is no time between them",
            where=log.source,
            advice="Use a log in which a test has two samples or more.",
        )
    all_steps = [_steps(run, median=median) for run in log.runs if len(run) > 1]
    kinds = [kind for kind in KINDS if any(steps.run.kind == kind for steps in all_steps)]
    longest = max(float(steps.length.max()) for steps in all_steps)
    top = median * min(max(NEAR_MEDIAN, 1.15 * longest / median), HIGHEST)
    ways = [way for way in DIRECTIONS if any(one.run.direction == way for one in all_steps)]
    figure, grid = make_panels(len(kinds), len(ways), height=HEIGHT + ROW * len(kinds), shared=True)
    for kind, row in zip(kinds, grid, strict=True):
        for way, axes in zip(ways, row, strict=True):
            these = [one for one in all_steps if one.run.test == f"{kind}-{way}"]
            _draw(axes, these, median=median, top=top)
            _set_title_and_ticks(axes, f"{kind}-{way}", these)
        row[0].set_ylabel("step [ms]", color=INK)
    for axes in grid[-1]:
        axes.set_xlabel("time since the test began [s]", color=INK)
    add_legend(figure, [axes for row in grid for axes in row], columns=5)
    alt = (
        "One panel for each test shows the time from each sample to the next. A solid line marks "
        f"the median of these time steps, {to_text(median)} ms, and a dotted line {GAP:g} times "
        "the median. Diamonds mark longer steps, triangles those too long for the panel."
    )
    return Picture(figure, alt, _table(all_steps))


def _steps(run: Run, *, median: float) -> _Steps:
    length = np.diff(run.time) * MILLI
    return _Steps(run, run.time[:-1] - run.time[0], length, length > GAP * median * (1.0 + 1e-6))


def _draw(axes: Axes, these: Sequence[_Steps], *, median: float, top: float) -> None:
    """Draw the steps of one test."""
    axes.set_ylim(0.0, top)
    axes.axhline(median, color=REFERENCE, linewidth=1.0, label=f"median, {to_text(median)} ms")
    axes.axhline(
        GAP * median,
        color=REFERENCE,
        linestyle=":",
        linewidth=1.0,
        label=f"{GAP:g} × median",
    )
    if not these:
        return
    after, length, gaps = (
        np.concatenate([getattr(one, name) for one in these])
        for name in ("after", "length", "gaps")
    )
    kept = np.flatnonzero(~gaps)
    kept = kept[decimate_curve(length[kept], most=MOST)]  # evenly: a hole would look like a gap
    axes.plot(
        after[kept],
        length[kept],
        MARKERS[0],
        color=COLORS[0],
        markersize=2.5,
        label="a step",
    )
    kept = np.flatnonzero(gaps)
    if not kept.size:
        return
    kept = kept[decimate_cloud(after[kept], length[kept], most=MOST_GAPS)]
    axes.vlines(after[kept], GAP * median, np.minimum(length[kept], top), color=COLORS[1], lw=0.8)
    for marker, these_gaps, label in (
        (MARKERS[3], kept[length[kept] <= top], "a gap"),
        (MARKERS[2], kept[length[kept] > top], "a longer gap"),
    ):
        if these_gaps.size:
            heights = np.minimum(length[these_gaps], EDGE * top)
            axes.plot(
                after[these_gaps], heights, marker, color=COLORS[1], markersize=5.0, label=label
            )


def _set_title_and_ticks(axes: Axes, test: str, these: Sequence[_Steps]) -> None:
    """Set title and ticks; only few ticks, because drawing their labels is slow."""
    gaps = sum(int(one.gaps.sum()) for one in these)
    count = "no" if not gaps else str(gaps)
    text = f"{count} gap{'' if gaps == 1 else 's'}" if these else "not in this log"
    axes.set_title(f"{test}: {text}", fontsize=10, color=INK)
    axes.xaxis.set_major_locator(MaxNLocator(6, steps=[1, 2, 5, 10]))
    axes.yaxis.set_major_locator(MaxNLocator(3, steps=[1, 2, 5, 10]))


def _share(part: int, total: int) -> str:
    """A share as a percentage, with significant digits, so that it is never rounded to 0."""
    return f"{to_text(100.0 * part / total)} %"


def _table(all_steps: Sequence[_Steps]) -> Table:
    rows = tuple(
        (
            one.run.test,
            one.length.size,
            float(np.median(one.length)),
            float(one.length.mean()),
            float(one.length.max()),
            int(one.gaps.sum()),
            _share(int(one.gaps.sum()), one.length.size),
        )
        for one in all_steps
    )
    header = ("test", "steps", "median [ms]", "mean [ms]", "longest [ms]", "gaps", "share")
    return Table(header, rows, caption=f"Time between samples; a gap is longer than {GAP:g} median")
