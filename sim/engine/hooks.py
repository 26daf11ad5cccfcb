"""What the engine asks of the effects together; here, the answers where there are none.

When the engine is composed (``sim/engine/compose.py``), these functions are replaced by others of
the same names and arguments that ask each effect that is ``on``. ``p`` holds the parameters of all
effects, ``memory`` one number for each effect.
"""

from sim.log import Array


def late(on: Array, p: Array) -> float:
    """[s] by which a command comes late."""
    return 0.0


def passes(on: Array, p: Array, memory: Array, u: float, v: float, kv: float) -> float:
    """[V] that gets through to the motor."""
    return u


def pull(on: Array, p: Array, x: float, v: float) -> float:
    """[V] that terms take from the motor's."""
    return 0.0


def grip(on: Array, p: Array, v: float, way: float) -> float:
    """[V] of dry friction beyond kS when moving toward ``way``."""
    return 0.0


def heft(on: Array, p: Array, clock: float) -> float:
    """[V·s²/unit] of inertia beyond kA."""
    return 0.0


def jolt(on: Array, p: Array) -> float:
    """[1] of the momentum it needs that joining inertia takes from what moves."""
    return 0.0


def slack(on: Array, p: Array) -> float:
    """[unit] of free play between motor and load."""
    return 0.0


def softness(on: Array, p: Array) -> float:
    """[unit/V] of what joins motor and load."""
    return 0.0


def share(on: Array, p: Array) -> float:
    """[1] of the inertia that is on the motor's side; 0 where there is one body."""
    return 0.0


def remembers(on: Array, p: Array, memory: Array, dt: float, u: float, v: float, kv: float) -> None:
    """Bring every effect's memory up to date, after ``dt`` [s] under ``u`` [V]."""


def sees(on: Array, p: Array, now: int, time: Array, position: Array, velocity: Array) -> float:
    """[unit/s] that the sensor says at sample ``now``."""
    return float(velocity[now])
