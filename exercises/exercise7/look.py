"""Draw one of your logs: voltage, velocity, position, and the time between samples.

    python exercises/exercise7/look.py 4
    python exercises/exercise7/look.py 4 dynamic-forward 1.0 1.6
    python exercises/exercise7/look.py any/other/log.wpilog

The first draws log 4, all of it. The second draws a part of one test, with a dot for each sample;
its times count from the beginning of the test. The third draws any log. Each saves a picture beside
the log.
"""

import re
from pathlib import Path
from typing import TYPE_CHECKING

import click
import numpy as np

from sim.bench.dataset.student import make_folder_name
from sim.core.errors import Refusal
from sim.core.units import find_unit
from sim.io import read
from sim.plot.picture import COLORS, INK, Picture, make_panels

if TYPE_CHECKING:
    from collections.abc import Sequence

    from sim.core.log import Log, Run

DATA = Path(__file__).resolve().parent / "data"
TESTS = ("quasistatic-forward", "quasistatic-reverse", "dynamic-forward", "dynamic-reverse")
DOTS = 150  # samples in a picture up to which each gets a dot


@click.command(help=re.sub(r"(?m)^    ", "\b\n    ", __doc__))
@click.argument("log")
@click.argument("test", default="", type=click.Choice(("", *TESTS)))
@click.argument("begin", default=0.0)
@click.argument("end", default=1e9)
@click.option("--student", default="me", help="The name your logs are under.")
def main(log: str, test: str, begin: float, end: float, student: str) -> None:
    """Draw one log, or a part of it."""
    own = DATA / make_folder_name(student) / f"log{int(log):02}.wpilog" if log.isdecimal() else None
    place = own or Path(log)
    try:
        found = read(place)
        runs = [run for run in found.runs if test in ("", run.test)]
        picture = drawn(found, runs, begin=begin, end=end)
        target = place.with_suffix(".svg")
        picture.save(target)
    except Refusal as refusal:
        raise click.ClickException(str(refusal)) from None
    click.echo(f"{picture.alt} Open {target} in a browser.")


def drawn(log: "Log", runs: "Sequence[Run]", *, begin: float = 0.0, end: float = 1e9) -> Picture:
    """Four signals of some tests, one below the other, one test beside the next.

    Args:
        log: which the tests are of; it knows their unit.
        runs: the tests.
        begin: [s] since each test began, what to draw first.
        end: [s] the same, what to draw last.
    """
    per = find_unit(log.units)
    names = ("voltage [V]", f"velocity [{per.symbol}/s]", f"position [{per.symbol}]", "step [ms]")
    figure, grid = make_panels(len(names), len(runs), width=3.4 * len(runs) + 1.0, height=8.4)
    for column, run in enumerate(runs):
        since = run.time - run.time[0]
        kept = (since >= begin) & (since <= end)
        step = np.diff(run.time, prepend=np.nan) * 1e3  # the first sample has none before it
        signals = (run.voltage, run.velocity / per.si, run.position / per.si, step)
        style = "o-" if kept.sum() <= DOTS else "-"
        for row, signal in enumerate(signals):
            axes = grid[row][column]
            axes.plot(since[kept], signal[kept], style, color=COLORS[row], markersize=3, lw=0.9)
            if column == 0:
                axes.set_ylabel(names[row], color=INK)
        grid[0][column].set_title(run.test, fontsize=10, color=INK)
        grid[-1][column].set_xlabel("time since the test began [s]", color=INK)
    said = ", ".join(f"{run.test} ({len(run)} samples)" for run in runs)
    return Picture(figure, f"Voltage, velocity, position and time steps of {said}.")


if __name__ == "__main__":
    main()
