"""The hooks that the engine calls for all effects together: here, their values without effects.

When the engine is composed (``compose.py``), they are replaced by functions with the same names and
arguments that combine the hooks of each effect that is ``on``. ``p`` holds the parameters of all
effects, ``memory`` one number for each effect.
"""

import math

from sim.core.log import Array

Numbers = tuple[float, ...]
"""Numbers that are constant through a run.

Compiled functions count the references to an array at each call, which takes longer than a step. A
tuple is passed by value.
"""


def command_delay(on: Numbers, p: Numbers) -> float:
    """[s] delay of a command."""
    return 0.0


def transform_voltage(
    on: Numbers, p: Numbers, memory: Array, u: float, v: float, kv: float
) -> float:
    """[V] voltage at the motor, after the effects on the voltage."""
    return u


def force(on: Numbers, p: Numbers, x: float, v: float) -> float:
    """[V] sum of the forces of all effects."""
    return 0.0


def coulomb_friction(on: Numbers, p: Numbers, v: float, way: float) -> float:
    """[V] dry friction beyond kS for motion toward ``way``."""
    return 0.0


def added_inertia(on: Numbers, p: Numbers, clock: float) -> float:
    """[V·s²/unit] inertia beyond kA."""
    return 0.0


def impact(on: Numbers, p: Numbers) -> float:
    """[1] 1 if inertia that is added was at rest, 0 if it already moved along."""
    return 0.0


def next_change(on: Numbers, p: Numbers, clock: float) -> float:
    """[s] time on the clock at which an effect changes next."""
    return math.inf


def backlash_gap(on: Numbers, p: Numbers) -> float:
    """[unit] free play between motor and load."""
    return 0.0


def joint_compliance(on: Numbers, p: Numbers) -> float:
    """[unit/V] compliance of the joint between motor and load."""
    return 0.0


def joint_damping(on: Numbers, p: Numbers) -> float:
    """[1] damping of the joint between motor and load, as a share of critical damping."""
    return 0.0


def motor_friction_share(on: Numbers, p: Numbers) -> float:
    """[1] share of the dry friction that acts on the motor's side of the joint."""
    return 0.0


def motor_inertia_share(on: Numbers, p: Numbers) -> float:
    """[1] share of the inertia on the motor's side; 0 with one body."""
    return 0.0


def grip_limit(on: Numbers, p: Numbers) -> float:
    """[V] largest traction that the floor transmits."""
    return math.inf


def update_memory(
    on: Numbers, p: Numbers, memory: Array, dt: float, u: float, v: float, kv: float
) -> None:
    """Update the memory of every effect after ``dt`` [s] under ``u`` [V]."""


def transform_velocity(
    on: Numbers, p: Numbers, now: int, time: Array, position: Array, velocity: Array
) -> float:
    """[unit/s] velocity that the sensor reports at sample ``now``."""
    return float(velocity[now])
