"""Acceleration against velocity, as SysId draws it: what back-EMF takes off, and the fit's line.

Source: WPILib SysId 2026, ``view/AnalyzerPlot.cpp``, "Acceleration vs. Velocity".
"""

from collections.abc import Mapping

import numpy as np

from sim.core.errors import BadRequest
from sim.core.log import FOUR_TESTS, Array, Log
from sim.core.units import Unit, find_unit
from sim.fit.sysid_rows import Rows, prepare_rows
from sim.plot.decimate import decimate_cloud
from sim.plot.picture import COLORS, INK, MARKERS, REFERENCE, Picture, add_legend, make_panels
from sim.plot.table import Table, to_text

MOST = 300  # samples of a test that are drawn
FEWEST = 3  # samples that a straight line can miss


def plot_acceleration_velocity(
    log: Log, *, gains: Mapping[str, float] | None = None, median: int = 1
) -> Picture:
    """Acceleration against velocity of the rows that SysId's regression uses.

    With gains it is SysId's "Acceleration vs. Velocity": of each acceleration, what voltage,
    friction and gravity account for is taken off, so that back-EMF alone is left, and the fit is a
    straight line through the origin:

        a - (V - kS·sgn(v) - kG)/kA   against   -kV/kA · v

    with kG·cos(θ + offset) for an arm. SysId itself (at least until 2026) takes kG/kA off where it
    should be added, and leaves an arm's offset out, so its dots of an elevator lie beside its line;
    its gains are not concerned. Here they lie on it.

    Without gains it is the acceleration itself: under a constant voltage it falls on a straight
    line, too, because a step approaches its end exponentially. A stretch at one height is what a
    current limit or a slipping wheel looks like.

    Args:
        log: with the four tests.
        gains: kS [V], kV [V·s/unit], kA [V·s²/unit], kG [V], offset_rad [rad] in SI, as ``Fit`` and
            ``Mechanism`` have them.
        median: [samples] window of SysId's median filter.

    Raises:
        BadRequest: kS, kV or kA is missing, kA is zero, or SysId offers no such window.
        NotIdentifiable: SysId's recipe cannot use this log.
    """
    if gains is not None:
        _checked(gains)
    per = find_unit(log.units)
    rows = prepare_rows(log, median=median).rows
    speeds = {test: rows[test].velocity / per.si for test in FOUR_TESTS}
    heights = {test: _height(rows[test], gains, type=log.type) / per.si for test in FOUR_TESTS}
    figure, ((axes,),) = make_panels(1, 1, height=3.8)
    for index, test in enumerate(FOUR_TESTS):
        kept = decimate_cloud(speeds[test], heights[test], most=MOST)
        axes.plot(
            speeds[test][kept],
            heights[test][kept],
            MARKERS[index],
            color=COLORS[index],
            markersize=3.0 if test.startswith("quasi") else 5.0,
            alpha=0.7 if test.startswith("quasi") else 1.0,
            label=test,
        )
    if gains is not None:
        every = np.concatenate([*speeds.values()])
        ends = np.array([every.min(), every.max()])
        fall = -gains["kV"] / gains["kA"]
        axes.plot(ends, fall * ends, color=REFERENCE, linewidth=1.6, label="fit: −kV/kA · v")
    what = "acceleration" if gains is None else "acceleration by back-EMF"
    axes.set_xlabel(f"velocity [{per.symbol}/s]", color=INK)
    axes.set_ylabel(f"{what} [{per.symbol}/s²]", color=INK)
    add_legend(figure, [axes])
    table = _table(speeds, heights, gains, per)
    return Picture(figure, _words(table, gains, per), table)


def _height(rows: Rows, gains: Mapping[str, float] | None, *, type: str) -> Array:  # noqa: A002 - SysId's word
    """(n,) [m/s² or rad/s²] the acceleration, less what is not due to the velocity."""
    if gains is None:
        return rows.acceleration
    push = rows.voltage - np.copysign(gains["kS"], rows.velocity)
    swings = type == "arm" or "offset_rad" in gains
    lean = np.cos(rows.position + gains.get("offset_rad", 0.0)) if swings else 1.0
    return np.asarray(rows.acceleration - (push - gains.get("kG", 0.0) * lean) / gains["kA"])


def _checked(gains: Mapping[str, float]) -> None:
    missing = [name for name in ("kS", "kV", "kA") if name not in gains]
    if missing:
        raise BadRequest(
            f"gains without {' and '.join(missing)}", advice="Give kS, kV and kA, as a fit does."
        )
    if not all(np.isfinite(value) for value in gains.values()) or gains["kA"] == 0.0:
        raise BadRequest(
            "gains that are not finite, or a kA of zero", advice="Give the gains of a fit."
        )


def _line(speed: Array, height: Array) -> tuple[float, float] | None:
    """The straight line that the samples themselves suggest: at standstill, and its slope."""
    if speed.size < FEWEST or not np.ptp(speed) > 0.0:
        return None
    across, up = speed - speed.mean(), height - height.mean()
    slope = float(across @ up) / float(across @ across)
    return float(height.mean() - slope * speed.mean()), slope


def _table(
    speeds: Mapping[str, Array],
    heights: Mapping[str, Array],
    gains: Mapping[str, float] | None,
    per: Unit,
) -> Table:
    lines = []
    for test in FOUR_TESTS:
        speed, height = speeds[test], heights[test]
        ends = (float(speed.min()), float(speed.max()))
        if gains is None:
            fit = _line(speed, height)
            rest: tuple[str | float, ...] = ("–", "–") if fit is None else fit
        else:
            off = height + gains["kV"] / gains["kA"] * speed
            rest = (float(off.mean()), float(np.sqrt(np.mean(off**2))))
        lines.append((test, speed.size, *ends, *rest))
    symbol = f"{per.symbol}/s"
    last = (
        (f"at standstill [{symbol}²]", "slope [1/s]")
        if gains is None
        else (f"mean off the line [{symbol}²]", f"typical miss [{symbol}²]")
    )
    header = ("test", "samples", f"slowest [{symbol}]", f"fastest [{symbol}]", *last)
    return Table(header, tuple(lines), caption="Acceleration against velocity, the rows of the fit")


def _words(table: Table, gains: Mapping[str, float] | None, per: Unit) -> str:
    """What the picture shows; the numbers are those of the table."""
    square, said = f"{per.symbol}/s²", "The picture shows acceleration against velocity"
    if gains is None:
        said += ", as recorded and filtered."
    else:
        said += ". The acceleration from voltage, friction and gravity is subtracted. A black "
        said += "line through the origin is −kV/kA · v. Its slope is "
        said += f"{to_text(-gains['kV'] / gains['kA'])} per second."
    for test, samples, slowest, fastest, first, second in table.rows:
        said += f" {test} has {samples} samples from {to_text(slowest)} to {to_text(fastest)} "
        said += f"{per.symbol}/s"
        if gains is not None:
            mean = float(first)
            side = "above" if mean > 0.0 else "below"
            said += f". Their distance from the line is {to_text(second)} {square} (RMS). Their "
            said += f"mean is {to_text(abs(mean))} {square} {side} the line."
        elif isinstance(second, str):
            said += ", too few for a line."
        else:
            said += f". Their line is at {to_text(first)} {square} for velocity 0. Its slope is "
            said += f"{to_text(second)} per second."
    return said
