"""The sides of a drivetrain in a file before 2024, with corrected signs; their mean, or one.

The old tools gave every voltage sample the sign of its velocity, so teams did not notice voltages
that were recorded without a sign or with the wrong one. Here, a sign is changed only for a whole
run, only if the data leave no choice, and every change is reported as a doubt.

For "combined" gains SysId stacked the rows of both sides in one regression. Here the sides are
averaged into one run, because they are not two experiments: the chassis couples them, so a push
on the right speeds up the left, and only the mean of the voltages and the mean of the velocities
obey one equation. It also reduces the noise, and gives one run per test, so that one test does
not count as two recordings. Each side alone can still be chosen.

A drivetrain that turned on the spot (``Drivetrain (Angular)``) is the same with the left side's
signs reversed: what remains is half of right minus left, the speed of the wheels while turning,
which is what SysId of 2023 fitted too.
"""

from collections.abc import Sequence

import numpy as np

from sim.core.doubt import Doubt
from sim.core.errors import BadRequest
from sim.core.log import STANDSTILL, Array, find_majority_sign
from sim.core.vocabulary import find_test_sign

Side = dict[str, Array]
"""Test -> (3, n) voltage [V], position and velocity [unit of the file, per second]."""

SIDES = ("left", "right")
SIGNED = 0.2  # [share of the largest value] smaller values can have the sign of noise
NOISE = 0.05  # [share of the largest voltage] noise of an unsigned voltage
APART = 0.2  # [share of the RMS of the mean velocity] a larger RMS difference is doubted

# Code of a doubt -> what was found and done, and what to do.
_DOUBTS = {
    "unsigned-voltage": (
        "the voltage was recorded without a sign, so it was given the sign of the velocity",
        "Log the signed voltage next time.",
    ),
    "inverted-voltage": (
        "the voltage had the sign opposite to the velocity and was turned round",
        "Check which motors are inverted.",
    ),
    "inverted-encoder": (
        "position and velocity went against voltage and test and were turned round",
        "Check the phase of the encoder.",
    ),
    "mirrored-side": (
        "this side ran against the other one and against the test, and was turned round",
        "Check which side is inverted.",
    ),
    "sides-differ": (
        "their velocities are far apart, and their mean was used for both",
        "Fit each side alone, and compare.",
    ),
}


def align_signs(
    sides: Sequence[Side], *, angular: bool = False, where: str
) -> tuple[list[Side], list[tuple[Doubt, ...]]]:
    """The sides with reversed signals where they go against the test, and doubts about each.

    If everything goes against the test, only its name is wrong, and nothing is reversed. Of a
    mechanism with one side, only an unsigned voltage is reversed: gravity can cause other
    differences.

    Args:
        sides: one side, or left and right.
        angular: whether it turned on the spot: left runs backward while right runs forward.
        where: the file, for messages.
    """
    aligned: list[Side] = [{} for _ in sides]
    changed: list[dict[str, list[str]]] = [{} for _ in sides]
    unsigned = [_is_unsigned(side) for side in sides]
    for test in sides[0]:
        turned = [-side[test] if angular and side is sides[0] else side[test] for side in sides]
        # 1 if a signal goes with the test, -1 if against it, 0 if that is unclear
        ways = [[find_test_sign(test) * sign for sign in _find_signs(side)] for side in turned]
        some_agree = any(1 in way for way in ways)
        for number, (side, (voltage, motion)) in enumerate(zip(turned, ways, strict=True)):
            code = {
                (-1, 1): "unsigned-voltage" if unsigned[number] else "inverted-voltage",
                (1, -1): "inverted-encoder",
                (-1, -1): "mirrored-side",
            }.get((voltage, motion))
            if not some_agree or (len(sides) == 1 and code != "unsigned-voltage"):
                code = None
            flips = [voltage, motion, motion] if code else [1, 1, 1]
            aligned[number][test] = side * np.array(flips)[:, None]
            if code:
                changed[number].setdefault(code, []).append(test)
    names = SIDES if len(sides) > 1 else ("voltage",)
    return aligned, [
        tuple(_make_doubt(code, name, tests, where=where) for code, tests in found.items())
        for name, found in zip(names, changed, strict=True)
    ]


def choose_side(
    sides: Sequence[Side],
    doubts: Sequence[tuple[Doubt, ...]],
    *,
    motor: str,
    angular: bool,
    where: str,
) -> tuple[Side, list[Doubt]]:
    """The runs of one side of a drivetrain, or of the mean of both, with doubts.

    Args:
        sides: left and right.
        doubts: about each side.
        motor: ``left``, ``right`` or ``combined``.
        angular: whether it turned on the spot.
        where: the file, for messages.

    Raises:
        BadRequest: there is no such motor.
    """
    motors = (*SIDES, "combined")
    if motor not in motors:
        raise BadRequest(
            f"a drivetrain has no motor {motor!r}",
            where=where,
            advice=f"Choose one with --motor: {', '.join(motors)}.",
        )
    found = [doubt for name, own in zip(SIDES, doubts, strict=True) for doubt in own
             if motor in (name, "combined")]  # fmt: skip
    if angular:
        found.append(
            Doubt(
                "turning-drivetrain",
                f"{where}: the drivetrain turns on the spot here, so its velocity is that of the "
                "wheels, counter-clockwise positive. For kV and kA per radian of the robot, "
                "multiply by half the track width.",
            )
        )
    if motor != "combined":
        return sides[SIDES.index(motor)], found
    fastest = [max(np.abs(run[2]).max() for run in side.values()) for side in sides]
    for dead, living in ((0, 1), (1, 0)):
        if fastest[dead] < STANDSTILL * fastest[living]:
            doubt = Doubt(
                "dead-side",
                f"{where}: the {SIDES[dead]} encoder of the drivetrain stands still while the "
                f"other side moves, so only the {SIDES[living]} side was read. Check its plug and "
                "its port.",
            )
            return sides[living], [*found, doubt]
    left, right = sides
    mean = {test: 0.5 * (left[test] + right[test]) for test in left}
    apart = [
        test
        for test, (_, _, velocity) in mean.items()
        if np.mean((left[test][2] - right[test][2]) ** 2) > APART**2 * np.mean(velocity**2)
    ]
    if apart:
        found.append(_make_doubt("sides-differ", "left and right", apart, where=where))
    return mean, found


def _find_signs(side: Array) -> tuple[int, int]:
    """The signs of voltage and of motion: 1, -1, or 0 where unclear.

    A motion is unclear, too, if the position goes against the velocity.
    """
    voltage, position, velocity = side
    moving = np.abs(voltage) > SIGNED * np.abs(voltage).max()
    moving &= np.abs(velocity) > SIGNED * np.abs(velocity).max()
    way = find_majority_sign(velocity[moving])
    along = find_majority_sign(np.diff(position[moving]))
    return find_majority_sign(voltage[moving]), way if way * along >= 0 else 0


def _is_unsigned(side: Side) -> bool:
    """Whether tests of both directions have voltages of the same sign."""
    low = min(float(run[0].min()) for run in side.values())
    high = max(float(run[0].max()) for run in side.values())
    return len(set(map(find_test_sign, side))) > 1 and (
        low >= -NOISE * high or high <= -NOISE * low
    )


def _make_doubt(code: str, name: str, tests: Sequence[str], *, where: str) -> Doubt:
    """The doubt about a side in several tests."""
    what, advice = _DOUBTS[code]
    return Doubt(code, f"{where}, {name}, {', '.join(tests)}: {what}. {advice}")
