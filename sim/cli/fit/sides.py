"""The two sides of a drivetrain that one log holds: each fitted alone, and compared."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from sim.core.errors import Refusal

if TYPE_CHECKING:
    from sim.core.doubt import Doubt
    from sim.core.log import Log
    from sim.fit import Fit

SIDES = ("left", "right")
TOGETHER = "several-motors"  # the doubt of a log whose signals are the mean of several motors'
ALONE = "one-motor"  # the doubt of a log that has one motor only, whoever asks
OLD_TOOLS = ".json"  # whose drivetrains have two sides without saying so in a doubt


def split_sides(log: "Log", read: Callable[[str], "Log"]) -> tuple["Log", "Log"] | None:
    """The log of either side, or None if there are no two of them.

    Args:
        log: of both together, as it was read.
        read: the same, of the motor that is named.
    """
    codes = {doubt.code for doubt in log.doubts}
    if TOGETHER not in codes and not log.source.lower().endswith(OLD_TOOLS):
        return None
    try:
        left, right = (read(side) for side in SIDES)
    except Refusal:  # its motors have other names, or there is one only
        return None
    if any(doubt.code == ALONE for side in (left, right) for doubt in side.doubts):
        return None
    return left, right


def compare_side_fits(
    pair: tuple["Log", "Log"], find: Callable[["Log"], "Fit"]
) -> tuple[tuple["Doubt", ...], tuple[str, ...]]:
    """Fit either side alone; where they differ as doubts, or a sentence that they do not.

    Args:
        pair: left and right.
        find: fits one.
    """
    from sim.fit.physics import compare_sides  # noqa: PLC0415 - only where there are two

    fits = []
    for side, log in zip(SIDES, pair, strict=True):
        try:
            fits.append(find(log))
        except Refusal as refusal:
            said = f"The {side} side alone cannot be fitted, so the sides are not compared: "
            return (), (f"{said}{refusal.what}.",)
    left, right = (one.in_log_units() for one in fits)
    doubts = compare_sides(*fits)
    if doubts:
        return doubts, ()
    said = (
        f"Left and right, each fitted alone, agree: kV {left.gains['kV']:.4g} and "
        f"{right.gains['kV']:.4g}, kA {left.gains['kA']:.3g} and {right.gains['kA']:.3g}."
    )
    return (), (said,)
