"""A test on a floor with a tape and a wall: the robot's position, speed and battery voltage."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle

from sim.core.errors import BadRequest
from sim.plot.picture import COLORS, INK, PAPER, REFERENCE, Picture, make_panels
from sim.plot.table import Table
from sim.teaching.runway import FloorTest

LONG, WIDE = 0.8, 0.8  # [m] size of the robot with its bumpers, as drawn
BEHIND = 1.2  # [m] of floor behind the start
TEXT_WIDTH = 0.25  # [share of the floor] width of a label beside the label of the wall
ROBOT, TAPE, BUMP = COLORS[0], COLORS[3], COLORS[1]
LAMP = "#F5C2A3"  # pale, so that text over it stays legible


def plot_runway(drive: FloorTest, *, moment: float = 1.0) -> Picture:
    """A test on a floor, seen from above, and its speed and battery voltage over time.

    Args:
        drive: the test, in meters.
        moment: time at which the robot is drawn, as a share of the test, 0 to 1.

    Raises:
        BadRequest: the moment is not within the test.
    """
    if not 0.0 <= moment <= 1.0:
        raise BadRequest(f"a moment of {moment:g}", advice="Choose 0 (start) to 1 (end).")
    now = round(moment * (drive.time.size - 1))
    figure, ((floor,), (speed,), (battery,)) = make_panels(3, 1, height=5.0)
    _floor(floor, drive, now)
    _over_time(speed, drive, drive.velocity, now)
    speed.set_ylabel("speed [m/s]", color=INK)
    _over_time(battery, drive, drive.battery, now)
    battery.axhline(drive.brownout, color=REFERENCE, linestyle="--", linewidth=1.0)
    battery.annotate(  # at the bottom, because the curve may cross the line
        f"dashed: brownout below {drive.brownout:g} V", (0.0, 0.0), xytext=(3, 3),
        textcoords="offset points", fontsize=8, color=INK,
    )  # fmt: skip
    battery.set_ylim(0.0, 1.12 * float(drive.battery.max()))
    battery.set_ylabel("battery [V]", color=INK)
    battery.set_xlabel("time since the button was pressed [s]", color=INK)
    _lamp(floor, drive)
    table = _table(drive)
    return Picture(figure, _words(drive, now), table)


def _floor(axes: Axes, drive: FloorTest, now: int) -> None:
    """Draw the floor from above: start, tape, wall, and the robot now and at its final position."""
    wall, rests = drive.floor.wall, drive.final_position
    axes.set_xlim(-BEHIND, wall + 0.06 * (wall + BEHIND))
    axes.set_ylim(-1.0, 1.0)
    axes.set_yticks([])
    axes.set_xlabel("distance of the front bumper from the start [m]", color=INK)
    axes.axvspan(wall, wall + 10.0, facecolor="#DDDDDD", edgecolor=INK, hatch="xxx", linewidth=1.0)
    _sign(axes, wall, "wall", ha="right", below=True)
    axes.axvline(0.0, color=INK, linewidth=1.0, linestyle=":")
    _sign(axes, 0.0, "start", ha="left")
    if drive.floor.tape is not None:
        axes.axvline(drive.floor.tape, color=TAPE, linewidth=5.0)
        _sign(axes, drive.floor.tape, "tape", ha="left")
    if drive.hit_wall is None:
        there = float(np.interp(drive.released, drive.time, drive.position))
        axes.axvline(there, color=INK, linewidth=1.2, linestyle=":")
        near = wall - there < TEXT_WIDTH * (wall + BEHIND)
        _sign(axes, there, "motors off", ha="right" if near else "left", below=True)
    _robot(axes, rests, fill=False)
    _robot(axes, float(drive.position[now]), fill=True)
    if drive.hit_wall is not None:
        axes.plot(wall, 0.0, "*", color=BUMP, markersize=22, markeredgecolor=INK)


def _sign(axes: Axes, x: float, text: str, *, ha: str, below: bool = False) -> None:
    offset = {"left": 5, "right": -5, "center": 0}[ha]
    axes.annotate(
        text,
        (x, -0.98 if below else 0.98),
        xytext=(offset, 2 if below else -2),
        textcoords="offset points",
        ha=ha,
        va="bottom" if below else "top",
        fontsize=8,
        color=INK,
        bbox={"facecolor": PAPER, "edgecolor": "none", "pad": 0.8},
    )


def _robot(axes: Axes, front: float, *, fill: bool) -> None:
    """Draw a robot by the position [m] of its front bumper, filled or as an outline."""
    face, edge, line = (ROBOT, INK, "-") if fill else ("none", ROBOT, "--")
    axes.add_patch(
        Rectangle(
            (front - LONG, -WIDE / 2), LONG, WIDE, facecolor=face, edgecolor=edge, linestyle=line,
            linewidth=1.4, zorder=3,
        )
    )  # fmt: skip


def _over_time(
    axes: Axes, drive: FloorTest, signal: "np.typing.NDArray[np.float64]", now: int
) -> None:
    """Draw a signal over time, the time shown, and the time when the motors were turned off."""
    axes.plot(drive.time, signal, color=ROBOT, linewidth=1.6)
    axes.plot(drive.time[now], signal[now], "o", color=ROBOT, markeredgecolor=INK, markersize=8)
    if drive.hit_wall is None:
        axes.axvline(drive.released, color=INK, linestyle=":", linewidth=1.2)
    axes.set_xlim(0.0, float(drive.time[-1]) * 1.02)


def _lamp(axes: Axes, drive: FloorTest) -> None:
    """Draw a lamp that shows by color, sign and word whether there was a brownout."""
    out = drive.browned_out
    axes.set_title("the floor from above", fontsize=10, color=INK, loc="left")
    axes.set_title(
        "✗ BROWNOUT" if out else "✓ battery holds",
        fontsize=10,
        color=INK,
        loc="right",
        x=0.99,  # its frame ends with the floor
        bbox={"facecolor": LAMP if out else PAPER, "edgecolor": INK, "boxstyle": "round,pad=0.3"},
    )


def _passed(drive: FloorTest) -> float | None:
    """The time [s] when the robot passed the tape; None if it did not, or without tape."""
    tape = drive.floor.tape
    if tape is None or drive.final_position < tape:
        return None
    return float(drive.time[int(np.argmax(drive.position >= tape))])


def _table(drive: FloorTest) -> Table:
    passed, top = _passed(drive), float(drive.velocity.max())
    rows: list[tuple[str, str | float]] = [
        ("passes the tape at [s]", "never" if passed is None else passed),
        ("motors off at [s]", drive.released),
        (
            "pushes the wall for [s]",
            "never" if drive.hit_wall is None else drive.released - drive.hit_wall,
        ),
        ("fastest [m/s]", top),
        ("stops at [m]", drive.final_position),
        (
            "room left [m]",
            "none: it hit the wall" if drive.hit_wall else drive.floor.wall - drive.final_position,
        ),
        ("lowest battery [V]", float(drive.battery.min())),
    ]
    return Table(("this test", ""), tuple(rows))


def _words(drive: FloorTest, now: int) -> str:
    tape, passed = drive.floor.tape, _passed(drive)
    text = f"You see a floor from above. A wall stands at {drive.floor.wall:.1f} m. "
    text += "There is no tape. " if tape is None else f"A strip of tape lies at {tape:.1f} m. "
    if passed is not None:
        text += f"The robot passes it after {passed:.2f} s. "
    text += f"The motors are off after {drive.released:.2f} s. "
    if drive.hit_wall is not None:
        text += f"It hits the wall after {drive.hit_wall:.2f} s. "
    else:
        margin = drive.floor.wall - drive.final_position
        text += f"It stops at {drive.final_position:.2f} m, {margin:.2f} m before the wall. "
    text += (
        f"The picture shows it at {drive.time[now]:.2f} s, {drive.position[now]:.2f} m from the "
    )
    text += "start. Below are two curves over time. The speed is at most "
    text += f"{drive.velocity.max():.2f} m/s. The battery has at least {drive.battery.min():.1f} V"
    return text + (", which is a brownout." if drive.browned_out else ", which is enough.")
