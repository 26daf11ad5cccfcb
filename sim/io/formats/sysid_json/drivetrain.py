"""A drivetrain in a file before 2024: the mean of its two sides, or one of them.

For "combined" gains SysId stacked the rows of both sides in one regression. Here the sides are
averaged into one run, because they are not two experiments: the chassis couples them, so a push
on the right speeds up the left, and only the mean of the voltages and the mean of the velocities
obey one equation. It also reduces the noise, and gives one run per test, so that one test does
not count as two recordings. Each side alone can still be chosen.

A drivetrain that turned on the spot (``Drivetrain (Angular)``) is the same with the left side's
signs reversed: what remains is half of right minus left, the speed of the wheels while turning,
which is what SysId of 2023 fitted too.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from sim.core.doubt import Doubt
from sim.core.errors import BadRequest
from sim.core.log import STANDSTILL
from sim.core.vocabulary import find_test_sign
from sim.io.formats.sysid_json.side import Side, align_signs, make_doubt

# [share of the RMS of the mean velocity] a larger RMS difference of the sides is doubted
APART = 0.2
SIDES = ("left", "right")
MOTORS = (*SIDES, "combined")


def read_drivetrain(
    sides: Sequence[Mapping[str, Side]], *, motor: str, angular: bool, where: str
) -> tuple[dict[str, Side], list[Doubt]]:
    """The runs of one side of a drivetrain, or of the mean of both, with doubts.

    Args:
        sides: left and right; each test -> columns of the side.
        motor: ``left``, ``right`` or ``combined``.
        angular: whether it turned on the spot: left runs backward while right runs forward.
        where: the file, for messages.

    Raises:
        BadRequest: there is no such motor.
    """
    if motor not in MOTORS:
        raise BadRequest(
            f"a drivetrain has no motor {motor!r}",
            where=where,
            advice=f"Choose one with --motor: {', '.join(MOTORS)}.",
        )
    doubts: list[Doubt] = []
    halves = []
    for runs, name in zip(sides, SIDES, strict=True):
        settled, odd = align_signs(runs, name, mirrored=angular and name == "left", where=where)
        halves.append(settled)
        doubts += odd if motor in (name, "combined") else []
    for index, tests in _align_sides(halves).items():
        if motor in (SIDES[index], "combined"):
            doubts.append(make_doubt("mirrored-side", SIDES[index], tests, where=where))
    if angular:
        doubts.append(_doubt_turning(where))
    dead = _find_dead_side(halves) if motor == "combined" else None
    if dead is not None:
        motor = SIDES[1 - dead]
        doubts.append(_doubt_dead_side(SIDES[dead], motor, where))
    if motor != "combined":
        return halves[SIDES.index(motor)], doubts
    doubts += _doubt_sides_differ(halves, where=where)
    return {test: _average_sides(halves[0][test], halves[1][test]) for test in sides[0]}, doubts


def _align_sides(halves: list[dict[str, Side]]) -> dict[int, list[str]]:
    """Reverse a side that runs against the other and the test, in place.

    Returns:
        Index of the reversed side -> its tests.
    """
    changed: dict[int, list[str]] = {}
    for test in halves[0]:
        ways = [half[test].signs[1] for half in halves]
        if ways[0] * ways[1] < 0:
            wrong = ways.index(-find_test_sign(test))
            halves[wrong][test] = halves[wrong][test].reverse(voltage=True, motion=True)
            changed.setdefault(wrong, []).append(test)
    return changed


def _doubt_sides_differ(halves: list[dict[str, Side]], *, where: str) -> list[Doubt]:
    """A doubt if the sides move differently."""
    left, right = halves
    apart = []
    for test in left:
        gap = np.mean((left[test].velocity - right[test].velocity) ** 2)
        if gap > APART**2 * np.mean(_average_sides(left[test], right[test]).velocity ** 2):
            apart.append(test)
    return [make_doubt("sides-differ", "left and right", apart, where=where)] if apart else []


def _find_dead_side(halves: Sequence[Mapping[str, Side]]) -> int | None:
    """Index of a side that stands still while the other one moves; None if there is none."""
    fastest = [max(np.abs(side.velocity).max() for side in half.values()) for half in halves]
    return next((i for i in (0, 1) if fastest[i] < STANDSTILL * fastest[1 - i]), None)


def _doubt_dead_side(dead: str, living: str, where: str) -> Doubt:
    """The doubt about a side whose encoder stands still."""
    return Doubt(
        "dead-side",
        f"{where}: the {dead} encoder of the drivetrain stands still while the other side moves, "
        f"so only the {living} side was read. Check its plug and its port.",
    )


def _average_sides(left: Side, right: Side) -> Side:
    """The mean of both sides."""
    return Side(*(0.5 * (a + b) for a, b in zip(left.columns, right.columns, strict=True)))


def _doubt_turning(where: str) -> Doubt:
    """The doubt that explains the gains of a drivetrain that turned on the spot."""
    return Doubt(
        "turning-drivetrain",
        f"{where} is of a drivetrain turning on the spot: its velocity is the wheels' while "
        "turning, counter-clockwise positive. For kV and kA per radian of the robot, multiply by "
        "half the track width.",
    )
