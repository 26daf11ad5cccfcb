"""Three formulas of a swerve drive that a student writes, each checked at once.

radius = angle·lever/(2π·turns)     I = mass·lever·kA'/kA     µ = 4·torque·ratio/(radius·mass·g)
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

from sim.core.units import GRAVITY
from sim.teaching.fit_gaps import Gap, judge_gaps

WHEELS = 4
SPIN = (31.4, 0.41, 40.0)  # rotation of the robot [rad], lever arm [m], turns of the wheel
TURNS = (58.0, 0.41, 0.05, 0.24)  # mass [kg], lever arm [m], kA [V·s²/rad], kA [V·s²/m]
PUSH = (1.3, 6.75, 0.05, 58.0)  # motor torque [N·m], gear ratio, wheel radius [m], mass [kg]

Formula = Callable[..., object]


@dataclass(frozen=True)
class FilledFormulas:
    """The formulas: the student's if they are right, else the right ones.

    Args:
        radius: function of robot rotation [rad], lever arm [m] and turns of the wheel; the radius
            of the wheel [m].
        inertia: function of mass [kg], lever arm [m], kA of turning and kA of straight motion; the
            moment of inertia [kg·m²].
        grip: function of motor torque [N·m], gear ratio, wheel radius [m] and mass [kg]; the
            coefficient of friction [1].
        report: the feedback to each formula.
    """

    radius: Callable[[float, float, float], float]
    inertia: Callable[[float, float, float, float], float]
    grip: Callable[[float, float, float, float], float]
    report: str


def compute_radius(turned: float, lever: float, wheel_turns: float) -> float:
    """The radius [m] of a wheel that rolled on a circle around the middle of the robot."""
    return turned * lever / (2.0 * math.pi * wheel_turns)


def compute_inertia(mass: float, lever: float, ka_turning: float, ka_straight: float) -> float:
    """The moment of inertia [kg·m²] of a robot, from kA of turning and of straight motion."""
    return mass * lever * ka_turning / ka_straight


def compute_grip(torque: float, ratio: float, radius: float, mass: float) -> float:
    """The coefficient of friction [1] of four wheels that begin to slip at a motor torque [N·m]."""
    return WHEELS * torque * ratio / (radius * mass * GRAVITY)


def check_formulas(*, radius: Formula, inertia: Formula, grip: Formula) -> FilledFormulas:
    """Check a student's formulas with the numbers of an example; ``...`` is an empty blank.

    Args:
        radius: formula 1, as ``FilledFormulas.radius``.
        inertia: formula 2, as ``FilledFormulas.inertia``.
        grip: formula 3, as ``FilledFormulas.grip``.
    """
    (first, second, third), report = judge_gaps(
        "Formula",
        Gap(
            radius,
            compute_radius,
            SPIN,
            "angle · lever is the distance in meters. One turn of the wheel is 2π · radius.",
        ),
        Gap(
            inertia,
            compute_inertia,
            TURNS,
            "Is kA of turning above the fraction bar? Is the lever in it once? The unit is kg·m².",
        ),
        Gap(
            grip,
            compute_grip,
            PUSH,
            "torque · ratio / radius is the push of one wheel. All four "
            "together push with µ · mass · 9.81.",
        ),
    )
    return FilledFormulas(first, second, third, report)
