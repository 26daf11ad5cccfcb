"""One step of a single inertia.

    kA·v' = u - kV·v - gravity - force(x, v) - (kS + coulomb_friction)·sgn(v)

The linear part has an exact solution (an exponential), so the base model is exact for any step. The
forces of effects are taken at the middle of each step. The time at which friction changes its sign
is exact: a mechanism that comes to rest in a step stays there until the drive exceeds friction.

Plain functions of numbers: ``compose.py`` compiles them together with the effects'.
"""

import math

from sim.core.log import Array
from sim.physics.engine.hooks import (
    Numbers,
    coulomb_friction,
    force,
    transform_voltage,
)
from sim.physics.engine.power_path import limit_voltage

KS, KV, KA, LOAD, LEVEL, ANGLE, LOW, HIGH = range(8)
"""Places in ``c``: kS [V], kV, kA, constant gravity [V], gravity of an arm that is level [V],
angle [rad] added to the position of an arm, lower and upper end of the travel."""

X, V, Y, W, OFF_UNTIL = range(5)
"""Places in a state: position and velocity of the motor, then of the load, and [s] of the clock
until which a brownout keeps the motors off. With one body, motor and load are the same."""


def bound_travel(c: Numbers, low: float, high: float, extra: float) -> Numbers:
    """Constants of one run: kS is ``extra`` larger, travel ends at ``low`` and ``high`` as well."""
    return (
        max(c[KS] + extra, 0.0), c[KV], c[KA], c[LOAD], c[LEVEL], c[ANGLE],
        max(c[LOW], low), min(c[HIGH], high),
    )  # fmt: skip


def compute_sliding_friction(c: Numbers, on: Numbers, p: Numbers, v: float, way: float) -> float:
    """[V] dry friction while it moves in direction ``way`` (1 or -1), at least 0."""
    return float(max(c[KS] + coulomb_friction(on, p, v, way), 0.0))


def move_exactly(
    c: Numbers, on: Numbers, p: Numbers, x: float, v: float, v_mid: float, drive: float,
    kv: float, ka: float, dt: float, part: float,
) -> tuple[float, float]:  # fmt: skip
    """Position and velocity after ``dt`` under a constant drive [V], turning points included.

    Sliding friction is that at the velocity ``v_mid``; ``part`` [1] is this body's share of the
    friction. At rest friction balances the drive, up to its limit.
    """
    rate = kv / ka
    while dt > 0.0:
        if v == 0.0:
            way = math.copysign(1.0, drive)
            hold = part * compute_sliding_friction(c, on, p, 0.0, way)
            slide = part * compute_sliding_friction(c, on, p, v_mid, way)
            if abs(drive) <= max(hold, slide):
                return x, v
        else:
            way = math.copysign(1.0, v)
            slide = part * compute_sliding_friction(c, on, p, v_mid, way)
        push = (drive - way * slide) / ka
        until = math.inf
        if v != 0.0 and push * way < 0.0:  # it slows down, and may turn
            inside = -v * rate / push
            if abs(inside) < 1e-9:
                until = -v / push
            elif inside > -1.0:
                until = math.log1p(inside) / rate
        step = min(dt, until)
        lost = -math.expm1(-rate * step)
        reach = step if abs(rate * step) < 1e-9 else lost / rate
        rest = 0.5 * step * step if abs(rate * step) < 1e-5 else (step - reach) / rate
        x += v * reach + push * rest
        v = 0.0 if until <= dt else v * (1.0 - lost) + push * reach
        dt -= step
    return x, v


def predict_midpoint(
    c: Numbers, on: Numbers, p: Numbers, x: float, v: float, drive: float,
    kv: float, ka: float, dt: float, part: float,
) -> tuple[float, float]:  # fmt: skip
    """Position at the middle of ``dt`` and velocity at its end, by an Euler step."""
    way = math.copysign(1.0, v if v != 0.0 else drive)
    slide = part * compute_sliding_friction(c, on, p, v, way)
    if v == 0.0 and abs(drive) <= slide:
        return x, v
    after = v + dt * (drive - way * slide - kv * v) / ka
    if v * after < 0.0:
        after = 0.0
    return x + 0.5 * dt * (v + after), after


def compute_gravity_voltage(c: Numbers, x: float) -> float:
    """[V] gravity voltage at position ``x``."""
    if c[LEVEL] == 0.0:
        return float(c[LOAD])
    return float(c[LOAD] + c[LEVEL] * math.cos(x + c[ANGLE]))


def compute_motor_voltage(
    c: Numbers, w: Numbers, on: Numbers, p: Numbers, memory: Array, commanded: float, v: float,
    off: bool,
) -> float:  # fmt: skip
    """[V] voltage at the motor, after limits, wiring and the effects on the voltage."""
    u = limit_voltage(w, 0.0 if off else commanded, v)
    return transform_voltage(on, p, memory, u, v, c[KV])


def clamp_to_travel(c: Numbers, x: float, v: float) -> tuple[float, float]:
    """Stop at the ends of the travel, without a bounce."""
    if x < c[LOW]:
        return c[LOW], max(v, 0.0)
    if x > c[HIGH]:
        return c[HIGH], min(v, 0.0)
    return x, v


def step_one_body(
    state: Array, c: Numbers, w: Numbers, on: Numbers, p: Numbers, memory: Array,
    commanded: float, off: bool, ka: float, dt: float, base_only: bool,
) -> float:  # fmt: skip
    """Advance one body by one step; returns the motor voltage [V] at the middle of the step."""
    x, v = state[X], state[V]
    u = compute_motor_voltage(c, w, on, p, memory, commanded, v, off)
    if not base_only:
        drive = u - compute_gravity_voltage(c, x) - force(on, p, x, v)
        half, v_half = predict_midpoint(c, on, p, x, v, drive, c[KV], ka, 0.5 * dt, 1.0)
        u = compute_motor_voltage(c, w, on, p, memory, commanded, v_half, off)
        drive = u - compute_gravity_voltage(c, half) - force(on, p, half, v_half)
        x, v = move_exactly(c, on, p, x, v, v_half, drive, c[KV], ka, dt, 1.0)
    else:
        x, v = move_exactly(c, on, p, x, v, v, u - c[LOAD], c[KV], ka, dt, 1.0)
    x, v = clamp_to_travel(c, x, v)
    state[X] = state[Y] = x
    state[V] = state[W] = v
    return u
