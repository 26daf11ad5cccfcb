"""Three formulas of a swerve drive that a learner writes, each checked at once.

radius = angle·lever/(2π·turns)     I = mass·lever·kA'/kA     µ = 4·torque·ratio/(radius·mass·g)
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

from sim.teaching.fit_gaps import RIGHT, judge_gap

GRAVITY = 9.81  # [m/s²]
WHEELS = 4
SPIN = (31.4, 0.41, 40.0)  # [rad] of the robot, [m] to a wheel, turns of that wheel
TURNS = (58.0, 0.41, 0.05, 0.24)  # [kg], [m], [V·s²/rad], [V·s²/m]
PUSH = (1.3, 6.75, 0.05, 58.0)  # [N·m] of a motor, turns for one of the wheel, [m], [kg]

Formula = Callable[..., object]


@dataclass(frozen=True)
class FilledFormulas:
    """The formulas: the learner's if they are right, ours if not.

    Args:
        radius: function of robot rotation [rad], lever arm [m] and turns of the wheel; the radius
            of the wheel [m].
        inertia: function of mass [kg], lever arm [m], kA of turning and kA of straight motion; the
            moment of inertia [kg·m²].
        grip: function of motor torque [N·m], gear ratio, wheel radius [m] and mass [kg]; the
            coefficient of friction [1].
        report: the feedback, one line for each formula.
    """

    radius: Callable[[float, float, float], float]
    inertia: Callable[[float, float, float, float], float]
    grip: Callable[[float, float, float, float], float]
    report: str


def compute_radius(turned: float, lever: float, wheel_turns: float) -> float:
    """[m] radius of a wheel that rolled on a circle around the middle of the robot."""
    return turned * lever / (2.0 * math.pi * wheel_turns)


def compute_inertia(mass: float, lever: float, ka_turning: float, ka_straight: float) -> float:
    """[kg·m²] moment of inertia of a robot, from kA of turning on the spot and going straight."""
    return mass * lever * ka_turning / ka_straight


def compute_grip(torque: float, ratio: float, radius: float, mass: float) -> float:
    """[1] Friction of four wheels that begin to slip at a torque [N·m] of each motor."""
    return WHEELS * torque * ratio / (radius * mass * GRAVITY)


def check_formulas(*, radius: Formula, inertia: Formula, grip: Formula) -> FilledFormulas:
    """Check a learner's formulas on the numbers of a made-up robot; ``...`` is an empty gap.

    Args:
        radius: as ``FilledFormulas.radius``, and so the other two.
        inertia: formula 2.
        grip: formula 3.
    """
    first = judge_gap(
        lambda: radius(*SPIN),
        compute_radius(*SPIN),
        "angle · lever is the distance in meters. One turn of the wheel is 2π · radius.",
    )
    second = judge_gap(
        lambda: inertia(*TURNS),
        compute_inertia(*TURNS),
        "kA of turning belongs on top, and the unit has to be kg·m².",
    )
    third = judge_gap(
        lambda: grip(*PUSH),
        compute_grip(*PUSH),
        "torque · ratio / radius is the push of one wheel. There are four, and they hold "
        "µ · mass · 9.81.",
    )
    said = (first, second, third)
    right = [one == RIGHT for one in said]
    return FilledFormulas(
        radius if right[0] else compute_radius,  # type: ignore[arg-type]  # judged to return a number
        inertia if right[1] else compute_inertia,  # type: ignore[arg-type]  # the same
        grip if right[2] else compute_grip,  # type: ignore[arg-type]  # the same
        "\n".join(f"Formula {number}: {one}" for number, one in enumerate(said, start=1)),
    )
