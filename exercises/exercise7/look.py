"""Draw one of your logs: voltage, velocity, position, and the time between samples.

    python exercises/exercise7/look.py 4
    python exercises/exercise7/look.py 4 dynamic-forward 1.0 1.6
    python exercises/exercise7/look.py any/other/log.wpilog
    python exercises/exercise7/look.py 4 --page

The first draws log 4, all of it. The second draws a part of one test, with a dot for each sample;
its times count from the beginning of the test. The third draws any log. Each saves a picture next
to the log, and no picture replaces another one: log04.svg, log04-dynamic-forward-1-1.6.svg.
The last shows log 4 on a page in your browser: zoom, read values, and drag over a part to get the
line for answers.toml.
"""

import re
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click
import numpy as np

from sim.cli.open.command import serve_page
from sim.cli.open.view import PageView, SpanText
from sim.core.errors import Refusal
from sim.core.units import find_unit
from sim.io import read
from sim.plot.picture import COLORS, INK, Picture, make_panels
from sim.support.student_names import make_folder_name

if TYPE_CHECKING:
    from collections.abc import Sequence

    from sim.core.log import Array, Log, Run

DATA = Path(__file__).resolve().parent / "data"
TESTS = ("quasistatic-forward", "quasistatic-reverse", "dynamic-forward", "dynamic-reverse")
DOTS = 150  # samples in a picture up to which each gets a dot
MARGIN = 0.05  # [share] of an axis above and below what is draw_signals
CLOSEST = 0.1  # [share of the whole log's range] an axis shows at least: noise stays small
ALL = 1e9  # [s] later than any log ends
FAULTS = SpanText(
    span="WHAT, {test}, {begin} to {end}, WHAT-TO-DO",
    between=" + ",
    hint="Write the fault and what to do into it.",
)
NAMED_FAULTS = replace(FAULTS, before='{log} = "', after='"')
PARTS = SpanText(span='{key} = "{begin} to {end}"', hint="These parts are kept.")
STEPS = 2.5  # [median time steps] which the axis of the time steps reaches at least


@click.command(help=re.sub(r"(?m)^    ", "\b\n    ", __doc__))
@click.argument("log")
@click.argument("test", default="", type=click.Choice(("", *TESTS)))
@click.argument("begin", default=0.0)
@click.argument("end", default=ALL)
@click.option("--student", default="me", help="The name your logs are under.")
@click.option("--page", is_flag=True, help="Show it on a page in your browser.")
def main(log: str, test: str, begin: float, end: float, student: str, *, page: bool) -> None:
    """Draw one log, or a part of it."""
    own = DATA / make_folder_name(student) / f"log{int(log):02}.wpilog" if log.isdecimal() else None
    place = own or Path(log)
    if page and test:
        raise click.UsageError("On the page you zoom with the mouse: leave out the test.")
    try:
        found = read(place)
        if page:
            serve_page([place], view=PageView(raw=True, span_text=_load_span_text(place)))
            return
        runs = [run for run in found.runs if test in ("", run.test)]
        picture = draw_signals(found, runs, begin=begin, end=end)
        target = place.with_name(f"{place.stem}{_make_suffix(test, begin, end)}.svg")
        picture.save(target)
    except Refusal as refusal:
        raise click.ClickException(str(refusal)) from None
    click.echo(f"{picture.alt} Open {target} in a browser.")


def _load_span_text(place: Path) -> SpanText:
    """The function that writes a marked part as the exercise of the log reads it."""
    if "exercise8" in place.resolve().parts:
        return PARTS
    return NAMED_FAULTS if re.fullmatch(r"log\d\d", place.stem) else FAULTS


def _make_suffix(test: str, begin: float, end: float) -> str:
    """The suffix for the picture of a part: the test, and the times if there are any."""
    times = (
        "" if (begin, end) == (0.0, ALL) else f"-{begin:g}-{end:g}" if end < ALL else f"-{begin:g}"
    )
    return f"-{test}{times}" if test else times


def draw_signals(
    log: "Log", runs: "Sequence[Run]", *, begin: float = 0.0, end: float = ALL
) -> Picture:
    """Four signals of some tests, one below the other, one test beside the next.

    Args:
        log: which the tests are of; it knows their unit.
        runs: the tests.
        begin: [s] since each test began, what to draw first.
        end: [s] the same, what to draw last.

    All tests have the same axes, so that they can be compared. The time steps begin at zero.
    """
    unit = find_unit(log.units)
    names = (
        "voltage [V]",
        f"velocity [{unit.symbol}/s]",
        f"position [{unit.symbol}]",
        "time step [ms]",
    )
    figure, grid = make_panels(len(names), len(runs), width=3.4 * len(runs) + 1.0, height=8.4)
    shown: list[list[Array]] = []
    for column, run in enumerate(runs):
        since = run.time - run.time[0]
        kept = (since >= begin) & (since <= end)
        signals = _list_signals(run, unit.si)
        shown.append([signal[kept] for signal in signals])
        style = "o-" if kept.sum() <= DOTS else "-"
        for row, signal in enumerate(signals):
            axes = grid[row][column]
            axes.plot(since[kept], signal[kept], style, color=COLORS[row], markersize=3, lw=0.9)
            if column == 0:
                axes.set_ylabel(names[row], color=INK)
        grid[0][column].set_title(run.test, fontsize=10, color=INK)
        grid[-1][column].set_xlabel("time since the test began [s]", color=INK)
    whole = [_list_signals(run, unit.si) for run in log.runs]
    for row, axes_of_row in enumerate(grid):
        limits = _choose_limits([one[row] for one in shown], [one[row] for one in whole])
        if row == len(grid) - 1:
            typical = np.nanmedian(np.concatenate([one[row] for one in whole]))
            limits = (0.0, max(limits[1], STEPS * float(typical)))
        for axes in axes_of_row:
            axes.set_ylim(*limits)
    said = ", ".join(f"{run.test} ({len(run)} samples)" for run in runs)
    return Picture(figure, f"Voltage, velocity, position and time steps of {said}.")


def _list_signals(run: "Run", si: float) -> "tuple[Array, Array, Array, Array]":
    """(n,) voltage [V], velocity and position in the log's own unit, time steps [ms]."""
    step = np.diff(run.time, prepend=np.nan) * 1e3  # the first sample has none before it
    return run.voltage, run.velocity / si, run.position / si, step


def _choose_limits(shown: "list[Array]", whole: "list[Array]") -> tuple[float, float]:
    """The limits of an axis for a signal, but no narrower than its noise deserves."""
    low, high = _find_range(shown)
    least, most = _find_range(whole)
    middle, width = (low + high) / 2, max(high - low, CLOSEST * (most - least)) or 1.0
    half = (0.5 + MARGIN) * width
    return middle - half, middle + half


def _find_range(several: "list[Array]") -> tuple[float, float]:
    """The least and the largest number of all that are numbers; zero twice if none is."""
    every = np.concatenate(several)
    every = every[np.isfinite(every)]
    return (float(every.min()), float(every.max())) if every.size else (0.0, 0.0)


if __name__ == "__main__":
    main()
