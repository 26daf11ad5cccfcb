"""Tracking: a target velocity, the velocities that follow it, and their errors."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from sim.core.errors import BadRequest
from sim.core.log import Array
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

APART = 0.12  # [share of a panel] distance of markers


@dataclass(frozen=True)
class TrackingError:
    """RMS and largest difference from a target.

    Args:
        typical: root mean square error.
        largest: largest absolute error.
    """

    typical: float
    largest: float


def measure_tracking_error(target: Array, velocity: Array) -> TrackingError:
    """The RMS and the largest error of a velocity.

    Args:
        target: (n,) target velocity.
        velocity: (n,) velocity in the same unit.
    """
    off = np.asarray(velocity) - np.asarray(target)
    return TrackingError(float(np.sqrt(np.mean(off**2))), float(np.abs(off).max()))


def plot_tracking_error(
    time: Array,
    target: Array,
    followers: Mapping[str, Array],
    *,
    unit: str = "m/s",
    title: str = "",
) -> Picture:
    """A target velocity and velocities that follow it, with the error of each below.

    Args:
        time: (n,) [s].
        target: (n,) target velocity.
        followers: name -> (n,) velocity.
        unit: unit of all velocities.
        title: title of the picture; may be empty.

    Raises:
        BadRequest: there is no velocity, or lengths differ.
    """
    if not followers or any(len(one) != len(time) for one in (*followers.values(), target)):
        raise BadRequest(
            "every velocity needs one value for each time",
            advice="Give one or more, of equal length.",
        )
    figure, ((upper,), (lower,)) = make_panels(2, 1, height=4.4, shared=True)
    upper.plot(time, target, color=REFERENCE, linewidth=2.2, label="target")
    lower.axhline(0.0, color=REFERENCE, linewidth=1.2)
    for index, (name, velocity) in enumerate(followers.items()):
        for panel, values in ((upper, velocity), (lower, velocity - target)):
            panel.plot(
                time, values, color=COLORS[(index + 1) % len(COLORS)],
                linestyle=LINES[(index + 1) % len(LINES)], linewidth=1.5, markersize=4,
                marker=MARKERS[(index + 1) % len(MARKERS)], markevery=APART, label=name,
            )  # fmt: skip
    upper.set_ylabel(f"velocity [{unit}]", color=INK)
    lower.set_ylabel(f"too fast by [{unit}]", color=INK)
    lower.set_xlabel("time [s]", color=INK)
    if title:
        upper.set_title(title, fontsize=10, color=INK)
    add_legend(figure, (upper,))
    found = {name: measure_tracking_error(target, velocity) for name, velocity in followers.items()}
    alt = (
        f"A target velocity over time, between {to_text(float(np.min(target)))} and "
        f"{to_text(float(np.max(target)))} {unit}, and curves that follow it. "
        "Below are their errors."
    )
    rows = tuple((name, one.typical, one.largest) for name, one in found.items())
    header = ("curve", f"typical error [{unit}]", f"largest error [{unit}]")
    return Picture(figure, f"{title}. {alt}" if title else alt, Table(header, rows))
