"""What slips make of the numbers of a swerve drive."""

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

from grader.wrong_number import Lookalike, WrongNumber

if TYPE_CHECKING:
    from .drive import Variant

UNITS, LEVER = "M-UNITS", "M-LEVER"
HALF = (
    "half the trackwidth is the lever of a tank. The modules of a square swerve push across the "
    "diagonal"
)


Rows = tuple[tuple[float, str, str], ...]  # a wrong number, what it may be, the misconception


def lookalikes(variant: "Variant") -> dict[str, tuple[Lookalike, ...]]:
    """Name of a number -> what known slips make of it."""
    asked = {name: one.expected for name, one in variant.asked.items()}
    return {
        name: tuple(Lookalike(value, WrongNumber(says, says, code)) for value, says, code in rows)
        for name, rows in (_of_tests(variant, asked) | _of_settings(variant, asked)).items()
    }


def _of_tests(variant: "Variant", asked: Mapping[str, float]) -> dict[str, Rows]:
    """The slips about the spin and about turning."""
    turning = asked["kA_turning"]
    return {
        "worn_radius": (
            (
                variant.radius,
                ("this is the radius in the code. Compute it from the turns of the motor instead"),
                "",
            ),
            (2.0 * asked["worn_radius"], "is this a diameter? Half of it is the radius", UNITS),
            (
                asked["worn_radius"] / variant.ratio,
                "did you use turns of the motor as turns of the wheel? Use the gear ratio",
                UNITS,
            ),
            (
                asked["worn_radius"] * 180.0 / math.pi,
                "57.3 = 180/π. The gyro counts degrees; the formula needs radians",
                UNITS,
            ),
            (
                asked["worn_radius"] / math.sqrt(2.0),
                "did you use half the trackwidth for the lever? A wheel is on the diagonal",
                LEVER,
            ),
        ),
        "lever": (
            (variant.trackwidth / 2.0, HALF, LEVER),
            (
                variant.trackwidth,
                "this is the trackwidth. How far is a wheel from the middle?",
                LEVER,
            ),
            (
                variant.trackwidth * math.sqrt(2.0),
                "this is the whole diagonal. How far is a wheel from the middle?",
                LEVER,
            ),
        ),
        "kA_turning": (
            (
                turning * math.pi / 180.0,
                "57.3 = 180/π. The gyro logs degrees: this is per degree. Write it per radian",
                UNITS,
            ),
            (
                turning * 2.0 * math.pi,
                "2π = 6.28. This is per rotation. Write it per radian",
                UNITS,
            ),
            (asked["kA"], "this is the kA of going straight. Fit turning.wpilog", ""),
        ),
    }


def _of_inertia(variant: "Variant", asked: Mapping[str, float]) -> Rows:
    """The slips about the moment of inertia."""
    lever, turning = asked["lever"], asked["kA_turning"]
    return (
        (asked["inertia"] / math.sqrt(2.0), HALF, LEVER),
        (
            asked["inertia"] * math.sqrt(2.0),
            "did you use the trackwidth for the lever? How far is a wheel from the middle?",
            LEVER,
        ),
        (
            variant.mass * turning / asked["kA"],
            "the lever is missing: the unit would be kg·m. Multiply by the lever",
            UNITS,
        ),
        (
            variant.mass * lever * asked["kA"] / turning,
            "the fraction is upside down: kA of turning belongs on top",
            "",
        ),
        (
            variant.mass * variant.trackwidth**2 / 6.0,
            (
                "this is an estimate for a flat plate with the mass spread evenly. You have "
                "measured yours: use both kA"
            ),
            "",
        ),
        (
            asked["inertia"] * math.pi / 180.0,
            "57.3 = 180/π. Use kA of turning per radian, not per degree",
            UNITS,
        ),
    )


def _of_settings(variant: "Variant", asked: Mapping[str, float]) -> dict[str, Rows]:
    """The slips about what goes into a planner."""
    lever = asked["lever"]
    return {
        "inertia": _of_inertia(variant, asked),
        "slip_current": (
            (
                4.0 * asked["slip_current"],
                "this is for all four motors together. The limit is set for each motor",
                "",
            ),
        ),
        "top_speed": (
            (
                asked["top_speed"] / lever,
                "is this a rate of turning? The planner asks for meters per second",
                UNITS,
            ),
        ),
        "max_torque": (
            (
                asked["max_torque"] * variant.ratio,
                "this is the torque at the wheel. The setting is for the motor, before the gears",
                UNITS,
            ),
            (
                4.0 * asked["max_torque"],
                "this is for all four motors together. The setting is for each motor",
                "",
            ),
        ),
    }
