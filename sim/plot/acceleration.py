"""Acceleration against velocity of the rows that SysId's regression uses."""

from collections.abc import Mapping

import numpy as np

from sim.core.log import FOUR_TESTS, Array, Log
from sim.core.units import Unit, find_unit
from sim.fit.sysid_rows import prepare_rows
from sim.plot.decimate import decimate_cloud
from sim.plot.picture import COLORS, INK, MARKERS, Picture, add_legend, make_panels
from sim.plot.table import Table

MOST = 300  # samples of a test drawn at most
FEWEST = 3  # samples needed to fit a straight line


def plot_acceleration_velocity(log: Log) -> Picture:
    """Acceleration against velocity of the rows that SysId's regression uses.

    Under a constant voltage the acceleration falls on a straight line, because a step approaches
    its final velocity exponentially. A horizontal part is a sign of a current limit or of a
    slipping wheel.

    Args:
        log: a log with the four tests.

    Raises:
        NotIdentifiable: SysId's recipe cannot use this log.
    """
    per = find_unit(log.units)
    rows = prepare_rows(log).rows
    samples = {
        test: (rows[test].velocity / per.si, rows[test].acceleration / per.si)
        for test in FOUR_TESTS
    }
    figure, ((axes,),) = make_panels(1, 1, height=3.8)
    for index, (test, (speed, height)) in enumerate(samples.items()):
        kept = decimate_cloud(speed, height, most=MOST)
        axes.plot(
            speed[kept],
            height[kept],
            MARKERS[index],
            color=COLORS[index],
            markersize=3.0 if test.startswith("quasi") else 5.0,
            alpha=0.7 if test.startswith("quasi") else 1.0,
            label=test,
        )
    axes.set_xlabel(f"velocity [{per.symbol}/s]", color=INK)
    axes.set_ylabel(f"acceleration [{per.symbol}/s²]", color=INK)
    add_legend(figure, [axes])
    alt = "Acceleration against velocity of each test, as recorded and filtered."
    return Picture(figure, alt, _tabulate(samples, per))


def _fit_line(speed: Array, height: Array) -> tuple[float, float] | tuple[str, str]:
    """Value at velocity 0 and slope of the fitted line; dashes if no line can be fitted."""
    if speed.size < FEWEST or not np.ptp(speed) > 0.0:
        return "–", "–"
    rest, slope = np.polynomial.Polynomial.fit(speed, height, 1).convert().coef
    return float(rest), float(slope)


def _tabulate(samples: Mapping[str, tuple[Array, Array]], per: Unit) -> Table:
    symbol = f"{per.symbol}/s"
    return Table(
        ("test", "samples", f"slowest [{symbol}]", f"fastest [{symbol}]",
         f"at standstill [{symbol}²]", "slope [1/s]"),
        tuple(
            (test, speed.size, float(speed.min()), float(speed.max()), *_fit_line(speed, height))
            for test, (speed, height) in samples.items()
        ),
        caption="Acceleration against velocity, the rows of the fit",
    )  # fmt: skip
