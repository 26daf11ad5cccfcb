"""One side of a mechanism in a file before 2024, with corrected signs.

The old tools gave every voltage sample the sign of its velocity, so teams did not notice voltages
that were recorded without a sign or with the wrong one. Here, a sign is changed only for a whole
run, only if the data leave no choice, and every change is reported as a doubt.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from sim.core.doubt import Doubt
from sim.core.log import Array
from sim.core.vocabulary import find_test_sign

SIGNED = 0.2  # [share of the largest value] smaller values can have the sign of noise
CLEAR = 0.6  # [mean of the signs] reached if 4 of 5 samples have the same sign
NOISE = 0.05  # [share of the largest voltage] noise of an unsigned voltage

# Code of a doubt -> what was found and done, and what to do.
_DOUBTS = {
    "unsigned-voltage": (
        "the voltage was recorded without a sign; it got that of the velocity",
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
    "unclear-sign": (
        "voltage and velocity agree in sign too seldom to tell which way it went",
        "Look at that run, or record it again.",
    ),
    "sides-differ": (
        "their velocities are far apart, and their mean stands for both",
        "Fit each side alone, and compare.",
    ),
}


@dataclass(frozen=True, eq=False)
class Side:
    """The columns that one side of a mechanism logged in one run.

    Args:
        voltage: (n,) [V].
        position: (n,) [unit of the file].
        velocity: (n,) [unit of the file per second].
    """

    voltage: Array
    position: Array
    velocity: Array

    @property
    def columns(self) -> tuple[Array, Array, Array]:
        """Voltage, position and velocity together."""
        return self.voltage, self.position, self.velocity

    @property
    def signs(self) -> tuple[int, int]:
        """The signs of voltage and velocity while it moves: 1, -1, or 0 if unclear."""
        voltage, velocity = np.abs(self.voltage), np.abs(self.velocity)
        moving = (voltage > SIGNED * voltage.max()) & (velocity > SIGNED * velocity.max())
        if not moving.any():
            return 0, 0
        means = [float(np.sign(one[moving]).mean()) for one in (self.voltage, self.velocity)]
        signs = [0 if abs(mean) < CLEAR else (1 if mean > 0 else -1) for mean in means]
        return signs[0], signs[1]

    def reverse(self, *, voltage: bool = False, motion: bool = False) -> "Side":
        """The side with reversed voltage, or reversed position and velocity (``motion``)."""
        side = replace(self, voltage=-self.voltage) if voltage else self
        return replace(side, position=-side.position, velocity=-side.velocity) if motion else side

    def signals(self, *, time: Array, scale: float) -> dict[str, Array]:
        """The columns for ``make_run``; positions and velocities times ``scale``."""
        return {
            "time": time,
            "voltage": self.voltage,
            "position": self.position * scale,
            "velocity": self.velocity * scale,
        }


def make_doubt(code: str, name: str, tests: list[str], *, where: str) -> Doubt:
    """The doubt about a side in several tests.

    Args:
        code: a key of ``_DOUBTS``.
        name: name of the side.
        tests: the tests.
        where: the file, for messages.
    """
    what, advice = _DOUBTS[code]
    return Doubt(code, f"{where}, {name}, {', '.join(tests)}: {what}. {advice}")


def read_one_side(runs: Mapping[str, Side], *, where: str) -> tuple[dict[str, Side], list[Doubt]]:
    """The runs of a mechanism with one side; an unsigned voltage gets the sign of its test.

    Other differences between the signs of voltage and velocity remain: gravity can cause them.
    """
    low, high = _voltage_range(runs)
    unsigned = [
        test
        for test, side in runs.items()
        if low >= -NOISE * high and find_test_sign(test) < 0 and side.signs == (1, -1)
    ]
    signed = {test: side.reverse(voltage=test in unsigned) for test, side in runs.items()}
    return signed, [
        make_doubt("unsigned-voltage", "voltage", unsigned, where=where)
    ] if unsigned else []


def align_signs(
    runs: Mapping[str, Side], name: str, *, mirrored: bool, where: str
) -> tuple[dict[str, Side], list[Doubt]]:
    """The runs of one drivetrain side, with signs reversed where voltage and velocity disagree.

    Args:
        runs: test -> columns of the side.
        name: ``left`` or ``right``, for messages.
        mirrored: whether the side runs backward in forward tests.
        where: the file, for messages.
    """
    unsigned = _is_unsigned(runs)
    changed: dict[str, list[str]] = {}
    aligned = {}
    for test, given in runs.items():
        side = given.reverse(voltage=mirrored, motion=mirrored)
        voltage, velocity = side.signs
        if voltage * velocity < 0:
            code = "inverted-voltage" if velocity == find_test_sign(test) else "inverted-encoder"
            code = "unsigned-voltage" if unsigned else code
            changed.setdefault(code, []).append(test)
            encoder = code == "inverted-encoder"
            side = side.reverse(voltage=not encoder, motion=encoder)
        elif voltage * velocity == 0 and np.any(side.velocity) and np.any(side.voltage):
            changed.setdefault("unclear-sign", []).append(test)
        aligned[test] = side
    return aligned, [make_doubt(code, name, tests, where=where) for code, tests in changed.items()]


def _voltage_range(runs: Mapping[str, Side]) -> tuple[float, float]:
    """The lowest and the highest voltage of all runs [V]."""
    return (
        min(float(side.voltage.min()) for side in runs.values()),
        max(float(side.voltage.max()) for side in runs.values()),
    )


def _is_unsigned(runs: Mapping[str, Side]) -> bool:
    """Whether tests of both directions have voltages of the same sign."""
    low, high = _voltage_range(runs)
    return len({find_test_sign(test) for test in runs}) > 1 and (
        low >= -NOISE * high or high <= -NOISE * low
    )
