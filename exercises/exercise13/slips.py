"""What slips make of the numbers of a swerve drive."""

import math
from pathlib import Path

from grader.answers.wrong_number import Lookalike, Slips
from sim.bench.swerve_logs import KINETIC

from .drive import BATTERY, Variant

SLIPS = Slips(Path(__file__).with_name("slips.toml"))
PROPOSED = 0.85  # [of the free speed] what PathPlanner's page proposes without a measurement
DEGREE, HALF = math.pi / 180.0, math.sqrt(0.5)  # [rad], [1] of a square's side to its diagonal
Numbers = dict[str, tuple[Lookalike, ...]]  # name of a number -> what slips make of it


def list_lookalikes(variant: Variant) -> Numbers:
    """Name of a number -> its values after known slips."""
    asked = {name: one.expected for name, one in variant.asked.items()}
    radius, inertia, lever = asked["worn_radius"], asked["inertia"], asked["lever"]
    turning, straight, mass = asked["kA_turning"], asked["kA"], variant.mass
    side, stall = variant.trackwidth, BATTERY / variant.drive.motor.resistance
    found = {
        "worn_radius": {
            "coded-radius": variant.radius,
            "diameter": 2.0 * radius,
            "motor-turns": radius / variant.ratio,
            "gyro-degrees": radius / DEGREE,
            "half-trackwidth": radius * HALF,
        },
        "lever": {"tank": side / 2.0, "whole-trackwidth": side, "diagonal": side / HALF},
        "kA": {"as-kv": asked["kV"], "spun": variant.drive.rotation.gains["kA"]},
        "kA_turning": {
            "per-degree": turning * DEGREE,
            "per-rotation": turning * 2.0 * math.pi,
            "straight": straight,
        },
        "inertia": {
            "tank": inertia * HALF,
            "trackwidth": inertia / HALF,
            "no-lever": mass * turning / straight,
            "turned-inertia": mass * lever * straight / turning,
            "plate": mass * side**2 / 6.0,
        },
        "slip_current": {"four-currents": 4.0 * asked["slip_current"]},
        "top_speed": {"rate": asked["top_speed"] / lever},
        "max_torque": {
            "stall-torque": variant.drive.motor.torque_constant * stall,
            "wheel-torque": asked["max_torque"] * variant.ratio,
            "four-torques": 4.0 * asked["max_torque"],
        },
    }
    return {name: SLIPS.list_lookalikes(one.items(), gain=name) for name, one in found.items()}


def list_rarer_slips(variant: Variant) -> Numbers:
    """Name of a number -> its values with slips that are less common."""
    asked = {name: one.expected for name, one in variant.asked.items()}
    turning, motor = variant.drive.rotation.gains, variant.drive.motor
    lever, around = asked["lever"], 2.0 * math.pi * variant.radius
    own, slip = variant.worn_radius / variant.radius, asked["slip_current"]
    stall = BATTERY / motor.resistance
    torque = motor.torque_constant * stall
    found = {
        "kV": {
            "worn-alone": asked["kV"] * own,
            "spun": turning["kV"],
            "per-turn": asked["kV"] * around,
        },
        "kA": {"per-turn": asked["kA"] * around},
        "kS": {"spun": turning["kS"]},
        "worn_radius": {
            "turned-turns": variant.radius / own,
            "circumference": 2.0 * math.pi * asked["worn_radius"],
            "trackwidth": asked["worn_radius"] / HALF,
        },
        "inertia": {
            "lever-twice": asked["inertia"] * lever,
            "mass-at-wheels": variant.mass * lever**2,
            "no-mass": asked["inertia"] / variant.mass,
            "inertia-degrees": asked["inertia"] * DEGREE,
        },
        "slip_current": {
            "quarter-current": slip / 4.0,
            "after-slip": slip * KINETIC,
            "stall-current": stall,
            "slip-voltage": slip * BATTERY / stall,
        },
        "top_speed": {
            "km-per-hour": 3.6 * asked["top_speed"],
            "feet": asked["top_speed"] / 0.3048,
            "turned-speed": 1.0 / asked["top_speed"],
            "multiplied": BATTERY * asked["kV"],
            "share": PROPOSED * asked["top_speed"],
            "free-share": PROPOSED * motor.free_speed * variant.radius / variant.ratio,
        },
        "max_torque": {
            "turned-torque": torque * stall / slip,
            "geared-torque": asked["max_torque"] / variant.ratio,
            "pound-feet": asked["max_torque"] / 1.3558,
        },
    }
    return {name: SLIPS.list_lookalikes(one.items(), gain=name) for name, one in found.items()}
