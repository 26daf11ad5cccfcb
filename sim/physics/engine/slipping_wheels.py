"""One step of wheels that may slip on the floor.

    wheels:  share·kA·w' = u - kV·w - kS·sgn(w) - F       robot:  (1 - share)·kA·v' = F - F_e

F [V] is the traction, at most ``grip``. As long as less is needed, wheels and robot move as one
body. If more is needed, the wheels spin (or lock), F is ±grip, and both are one body again when
their speeds are equal. Dry friction is that of the gears and acts on the wheels; gravity and the
forces of effects, F_e, act on the robot. A sensor in the motor measures the wheels.

Plain functions of numbers: ``compose.py`` compiles them together with the effects'.
"""

import math

from sim.core.log import Array
from sim.physics.engine.hooks import Numbers, force, grip_limit, motor_inertia_share
from sim.physics.engine.one_body import (
    KV,
    V,
    W,
    X,
    Y,
    compute_gravity_voltage,
    compute_motor_voltage,
    compute_sliding_friction,
    move_exactly,
    step_one_body,
)

HALVINGS = 40  # of a step, to find when the robot has caught up with its wheels
SAME_SPEED = 1e-12  # [share of the faster speed] a smaller difference of speeds is no slip


def step_slipping_wheels(
    state: Array, c: Numbers, w: Numbers, on: Numbers, p: Numbers, memory: Array,
    commanded: float, off: bool, ka: float, dt: float,
) -> float:  # fmt: skip
    """One step of wheels and robot; returns the voltage [V] at the motor in its middle."""
    ahead = state[V] - state[W]
    if abs(ahead) <= SAME_SPEED * max(abs(state[V]), abs(state[W])):
        ahead = compute_excess_traction(state, c, w, on, p, memory, commanded, off)
    if ahead == 0.0:
        return step_gripping(state, c, w, on, p, memory, commanded, off, ka, dt)
    side = math.copysign(1.0, ahead)
    u, spun = step_spinning(state, c, w, on, p, memory, commanded, off, ka, dt, side)
    if spun < dt:
        u = step_gripping(state, c, w, on, p, memory, commanded, off, ka, dt - spun)
    return u


def compute_excess_traction(
    state: Array, c: Numbers, w: Numbers, on: Numbers, p: Numbers, memory: Array,
    commanded: float, off: bool,
) -> float:  # fmt: skip
    """[V] signed traction beyond the grip that motion without slip would need; 0 if none."""
    x, v = state[Y], state[V]
    pull = compute_gravity_voltage(c, x) + force(on, p, x, v)
    drive = compute_motor_voltage(c, w, on, p, memory, commanded, v, off) - pull
    way = math.copysign(1.0, v if v != 0.0 else drive)
    slide = compute_sliding_friction(c, on, p, v, way)
    if v == 0.0 and abs(drive) <= slide:
        return 0.0
    rest = 1.0 - motor_inertia_share(on, p)
    needed = rest * (drive - way * slide - c[KV] * v) + pull
    beyond = abs(needed) - grip_limit(on, p)
    return math.copysign(beyond, needed) if beyond > 0.0 else 0.0


def step_gripping(
    state: Array, c: Numbers, w: Numbers, on: Numbers, p: Numbers, memory: Array,
    commanded: float, off: bool, ka: float, dt: float,
) -> float:  # fmt: skip
    """One step as one body; the distance by which the wheels are ahead of the robot stays."""
    spun = state[X] - state[Y]
    state[X] = state[Y]
    state[W] = state[V]
    u = step_one_body(state, c, w, on, p, memory, commanded, off, ka, dt, False)
    state[X] += spun
    return u


def step_spinning(
    state: Array, c: Numbers, w: Numbers, on: Numbers, p: Numbers, memory: Array,
    commanded: float, off: bool, ka: float, dt: float, side: float,
) -> tuple[float, float]:  # fmt: skip
    """One step of wheels that are faster (``side`` 1) or slower (-1) than the robot.

    Returns:
        The voltage [V] at the motor, and how long [s] the wheels slipped: ``dt``, or less if the
        robot caught up within it.
    """
    part = motor_inertia_share(on, p)
    x, v, y, z = state[X], state[V], state[Y], state[W]
    traction = side * grip_limit(on, p)
    u = compute_motor_voltage(c, w, on, p, memory, commanded, v, off)
    _, middle = move_exactly(c, on, p, x, v, v, u - traction, c[KV], part * ka, 0.5 * dt, 1.0)
    u = compute_motor_voltage(c, w, on, p, memory, commanded, middle, off)
    rate = (traction - compute_gravity_voltage(c, y) - force(on, p, y, z)) / ((1.0 - part) * ka)
    least, most = 0.0, dt
    after, faster = move_exactly(c, on, p, x, v, middle, u - traction, c[KV], part * ka, dt, 1.0)
    if side * (faster - z - rate * dt) < 0.0:
        for _ in range(HALVINGS):
            half = 0.5 * (least + most)
            after, faster = move_exactly(
                c, on, p, x, v, middle, u - traction, c[KV], part * ka, half, 1.0
            )
            if side * (faster - z - rate * half) < 0.0:
                most = half
            else:
                least = half
        after, faster = move_exactly(
            c, on, p, x, v, middle, u - traction, c[KV], part * ka, most, 1.0
        )
        faster = z + rate * most
    state[X], state[V] = after, faster
    state[Y], state[W] = y + most * (z + 0.5 * rate * most), z + rate * most
    return u, most
