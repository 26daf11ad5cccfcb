"""What slips make of the numbers of a swerve drive."""

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

from grader.answers.wrong_number import Lookalike, WrongNumber

if TYPE_CHECKING:
    from .drive import Variant

UNITS, LEVER, GEARING = "M-UNITS", "M-LEVER", "M-GEARING"
HALF = (
    "half the trackwidth is the lever of a tank drive. The modules of a square swerve push at a "
    "right angle to the diagonal"
)


BATTERY = 12.0  # [V] of the data sheet
Rows = tuple[tuple[float, str, str], ...]  # a wrong number, what it may be, the misconception


def lookalikes(variant: "Variant") -> dict[str, tuple[Lookalike, ...]]:
    """Name of a number -> what known slips make of it."""
    asked = {name: one.expected for name, one in variant.asked.items()}
    return _named(_of_tests(variant, asked) | _of_settings(variant, asked))


def rarer(variant: "Variant") -> dict[str, tuple[Lookalike, ...]]:
    """Name of a number -> what rarer slips make of it."""
    asked = {name: one.expected for name, one in variant.asked.items()}
    return _named(
        _rarer_of_tests(variant, asked)
        | {"slip_current": _of_current(variant, asked["slip_current"])}
        | {"top_speed": _of_speed(asked["top_speed"])}
        | {"max_torque": _of_torque(variant, asked)}
    )


def _named(found: Mapping[str, Rows]) -> dict[str, tuple[Lookalike, ...]]:
    return {
        name: tuple(Lookalike(value, WrongNumber(says, says, code)) for value, says, code in rows)
        for name, rows in found.items()
    }


def _rarer_of_tests(variant: "Variant", asked: Mapping[str, float]) -> dict[str, Rows]:
    """The rarer slips about going straight, the spin and the moment of inertia."""
    turning = variant.drive.rotation.gains
    lever, around = asked["lever"], 2.0 * math.pi * variant.radius
    own = variant.worn_radius / variant.radius
    alone = "is this the worn module alone? Take all four modules together, without --motor"
    spun = "this is the {} of turning on the spot. Fit straight.wpilog"
    wheel = "is this for each turn of the wheel in a second? How far does one turn go?"
    return {
        "kV": (
            (asked["kV"] * own, alone, ""),
            (turning["kV"], spun.format("kV"), ""),
            (asked["kV"] * around, wheel, GEARING),
        ),
        "kA": (
            (turning["kA"], spun.format("kA"), ""),
            (asked["kA"] * around, wheel, GEARING),
        ),
        "kS": ((turning["kS"], spun.format("kS"), ""),),
        "worn_radius": (
            (
                variant.radius / own,
                "is your ratio of turns upside down? A worn wheel is smaller than the others",
                "",
            ),
            (
                2.0 * math.pi * asked["worn_radius"],
                "this is how far one turn of the wheel goes. That is 2π times the radius",
                GEARING,
            ),
            (
                math.sqrt(2.0) * asked["worn_radius"],
                "did you use the trackwidth for the lever? How far is a wheel from the middle?",
                LEVER,
            ),
        ),
        "inertia": (
            (
                asked["inertia"] * lever,
                "did you multiply by the lever twice? The two kA already contain it once",
                LEVER,
            ),
            (
                variant.mass * lever**2,
                "this puts all the mass at the wheels. You have measured yours: use both kA",
                "",
            ),
        ),
    }


def _of_current(variant: "Variant", slip: float) -> Rows:
    """The rarer slips about the current at which the wheels slip."""
    from sim.bench.swerve_logs import KINETIC  # noqa: PLC0415 - numpy only where it is needed

    stall = BATTERY / variant.drive.motor.resistance
    return (
        (slip / 4.0, "did you divide by four? push.csv already has the current of one motor", ""),
        (
            slip * KINETIC,
            "is this the current just after the slip begins? It falls then. Read the row before",
            "",
        ),
        (
            stall,
            "this is the stall current at 12 V. In push.csv, look where the wheel begins to turn",
            "",
        ),
        (
            slip * BATTERY / stall,
            "is this the voltage at which they begin to slip? Write the current of that row",
            UNITS,
        ),
    )


def _of_speed(speed: float) -> Rows:
    """The rarer slips about the top speed."""
    return (
        (3.6 * speed, "1 m/s is 3.6 km/h. Is this in km/h?", UNITS),
        (speed / 0.3048, "a meter is 3.28 feet. Is this in feet per second?", UNITS),
        (
            1.0 / speed,
            "this is upside down. Which speed takes all of the 12 V, less kS?",
            "",
        ),
    )


def _of_torque(variant: "Variant", asked: Mapping[str, float]) -> Rows:
    """The rarer slips about the torque at the slip current."""
    stall = BATTERY / variant.drive.motor.resistance
    torque = variant.drive.motor.torque_constant * stall
    return (
        (
            torque,
            "this is the stall torque. At the slip current the motor gives less, in proportion",
            "",
        ),
        (
            torque * stall / asked["slip_current"],
            "the fraction is upside down: the slip current is only a part of the stall current",
            "",
        ),
        (
            asked["max_torque"] / variant.ratio,
            "did you divide by the gear ratio? The setting is for the motor, before the gears",
            GEARING,
        ),
        (asked["max_torque"] / 1.3558, "1 N·m is 0.738 lbf·ft. Is this in lbf·ft?", UNITS),
    )


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
            (2.0 * asked["worn_radius"], "is this a diameter? Half of it is the radius", GEARING),
            (
                asked["worn_radius"] / variant.ratio,
                "did you use turns of the motor as turns of the wheel? Use the gear ratio",
                GEARING,
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
                GEARING,
            ),
            (
                4.0 * asked["max_torque"],
                "this is for all four motors together. The setting is for each motor",
                "",
            ),
        ),
    }
