"""The moment of inertia of a robot, from a test straight ahead and one turning on the spot.

    straight:  kA = c·m          turning:  kA' = c·J/R          J = m·R·kA'/kA

with c [V/N] the voltage per force at the wheels, and R the lever arm: the distance of a wheel's
line of force from the center. For a tank drive it is half the trackwidth; the modules of a square
swerve are at the corners and push at a right angle to the diagonal, so it is trackwidth/√2. The
speeds give it, too: a wheel moves at R·ω, so R = kV'/kV. (PathPlanner, "Robot Config", and Choreo,
"Estimating MoI", give the formula, both with half the trackwidth.)

If the test straight ahead was logged in rotations of a motor, as Phoenix 6 does, the lever arm
gives the unit: kV'/R is the kV per meter, for any wheel and gearing. Then J = m·R²·τ'/τ, with τ =
kA/kV.

Both kA contain wheels and rotors. If these are equivalent to a share s of the mass, the inertia of
the robot without them is J - s·(m·R² - J).
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

from sim.core.doubt import Doubt
from sim.core.errors import BadRequest
from sim.core.units import convert_gains, find_unit
from sim.fit.physics.parts import SURELY, fit_in_si
from sim.fit.physics.theory import FACTORS
from sim.fit.result import Fit

ROTORS = 0.03, 0.10  # [share of the mass] equivalent mass of rotors and wheels, as in parts.py
NEAR = 0.06  # [share] by which the lever arm from the speeds may differ from the given one
MISTAKEN = (
    (
        math.sqrt(2.0),
        "you gave half the trackwidth T, the lever of a tank drive. Give T/√2 for a square swerve",
    ),
    (1.0 / math.sqrt(2.0), "you gave the trackwidth T. Give T/√2 for a square swerve"),
    (0.5, "you gave the trackwidth. For a tank drive, give half of the trackwidth"),
    *FACTORS,
)
"""Ratio of the lever arm from the speeds to the given one, and the mistake that causes it."""


@dataclass(frozen=True)
class MomentOfInertia:
    """The moment of inertia of a robot, with its error and the lever arm that was used.

    Args:
        value: [kg·m²] J = m·R·kA'/kA, rotors and wheels included.
        error: [kg·m²] one standard error, from those of the two kA.
        without_rotors: [kg·m²] lower and upper limit for the robot without rotors and wheels.
        lever: [m] lever arm that was used.
        lever_seen: [m] lever arm from the speeds, kV'/kV; None if ``straight`` is not in meters.
        doubts: warnings.
    """

    value: float
    error: float
    without_rotors: tuple[float, float]
    lever: float
    lever_seen: float | None
    doubts: tuple[Doubt, ...] = ()

    def to_json(self) -> dict[str, object]:
        """Data for JSON; the keys are fixed, because other programs read them."""
        return {name: value for name, value in vars(self).items() if name != "doubts"}


def compute_moment_of_inertia(
    turning: Fit,
    straight: Fit,
    *,
    mass: float,
    lever: float | None = None,
    by_wheels: bool = False,
) -> MomentOfInertia:
    """The moment of inertia from two fits of the same motors.

    Args:
        turning: fit of a test on the spot, whose position is the angle of the robot.
        straight: fit of a test straight ahead, whose position is a length, or rotations of a motor.
        mass: [kg] mass of the robot.
        lever: [m] lever arm of a wheel; None computes it from the speeds.
        by_wheels: whether the position of ``turning`` is the distance of the wheels instead.

    Raises:
        BadRequest: a mass or a lever arm that is not positive, no lever arm although one is needed,
            a position of the wrong kind, or a kV or kA that is not positive.
    """
    if by_wheels:
        turning = _convert_to_radians(turning, lever)
    _refuse_unusable(turning, straight, mass=mass, lever=lever)
    turn, go = fit_in_si(turning), fit_in_si(straight)
    in_turns = find_unit(straight.units).angular
    from_speeds = turn.gains["kV"] / go.gains["kV"]
    if in_turns and lever is not None:  # the lever arm gives the meters per rotation
        go, from_speeds = _scale_gains(go, from_speeds / lever), lever
    arm = from_speeds if lever is None else lever
    value = mass * arm * turn.gains["kA"] / go.gains["kA"]
    parts = [one.errors["kA"] / one.gains["kA"] for one in (turn, go)]
    if lever is None or in_turns:
        parts += [one.errors["kV"] / one.gains["kV"] for one in (turn, go)]
    own = sorted(value - share * (mass * arm**2 - value) for share in ROTORS)
    doubts = () if lever is None else tuple(_doubt_lever(turn, go, from_speeds, lever))
    error, seen = value * math.hypot(*parts), None if in_turns else from_speeds
    return MomentOfInertia(value, error, (own[0], own[1]), arm, seen, doubts)


def _convert_to_radians(turning: Fit, lever: float | None) -> Fit:
    """The fit of turning per radian of the robot, from that per meter of its wheels."""
    if lever is None:
        raise BadRequest(
            "the log of turning contains the distance of the wheels, not the angle of the robot",
            advice="Give --lever as well: trackwidth/√2 of a square swerve, or /2 of a tank drive.",
        )
    found = _scale_gains(turning.in_units("meters"), lever)
    return replace(found, units="radians", log_units="radians")


def _scale_gains(found: Fit, factor: float) -> Fit:
    """The fit with kV and kA for a unit of position that is ``factor`` times as large."""
    return replace(
        found,
        gains=convert_gains(found.gains, factor=factor),
        errors=convert_gains(found.errors, factor=factor),
    )


def _refuse_unusable(turning: Fit, straight: Fit, *, mass: float, lever: float | None) -> None:
    """Refuse what ``compute_moment_of_inertia`` cannot use."""
    for name, number, unit in (("mass", mass, "kg"), ("lever", lever, "m")):
        if number is not None and not (math.isfinite(number) and number > 0.0):
            raise BadRequest(f"no {name} is {number:g} {unit}", advice="Give a number above zero.")
    if not find_unit(turning.units).angular:
        raise BadRequest(
            f"the log of turning is in {turning.units}",
            advice="Give the angle of the robot: a gyro's position and velocity, with --position, "
            "--velocity and --units degrees.",
        )
    if find_unit(straight.units).angular and lever is None:
        raise BadRequest(
            (
                f"the log of going straight is in {straight.units}, so the lever cannot be "
                "computed from the speeds"
            ),
            advice="Give --lever as well: trackwidth/√2 of a square swerve, or /2 of a tank drive.",
        )
    for what, one in (("turning", turning), ("going straight", straight)):
        low = [gain for gain in ("kV", "kA") if not one.gains[gain] > 0.0]
        if low:
            raise BadRequest(
                (
                    f"{low[0]} of {what} is {one.gains[low[0]]:.3g}, and no inertia can be "
                    "computed from that"
                ),
                advice="First run `sysid inspect` on that log.",
            )


def _doubt_lever(turn: Fit, go: Fit, from_speeds: float, lever: float) -> Iterator[Doubt]:
    """A doubt if the lever arm from the speeds differs from the given one."""
    unsure = SURELY * math.hypot(*(one.errors["kV"] / one.gains["kV"] for one in (turn, go)))
    share = from_speeds / lever
    if abs(share - 1.0) <= NEAR + unsure:
        return
    near = [
        (abs(math.log(share / factor)), why)
        for factor, why in MISTAKEN
        if abs(share / factor - 1.0) <= NEAR + unsure
    ]
    cause = min(near)[1] if near else "the lever, the wheel's radius or a unit is wrong"
    yield Doubt(
        "lever",
        f"kV turning / kV straight is the lever (half the trackwidth in a tank drive): your logs "
        f"give {from_speeds:.3g} m, but you gave {lever:.3g} m. Probably {cause}.",
        grave=True,
    )
