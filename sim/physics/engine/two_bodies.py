"""One step of two inertias, motor and load, coupled by a spring or backlash.

While they push each other, the exact solution (``two_body_modes.py``) includes the spring between
them, so one step of any length will do. A step in which a body changes direction, or teeth meet or
part, is halved until that time is found.

Plain functions of numbers: ``compose.py`` compiles them together with the effects'.
"""

import math

from sim.core.log import Array
from sim.physics.engine.hooks import (
    Numbers,
    backlash_gap,
    force,
    joint_compliance,
    joint_damping,
    motor_friction_share,
    motor_inertia_share,
)
from sim.physics.engine.one_body import (
    HIGH,
    KV,
    LOW,
    V,
    W,
    X,
    Y,
    clamp_to_travel,
    compute_gravity_voltage,
    compute_motor_voltage,
    compute_sliding_friction,
    move_exactly,
    predict_midpoint,
)
from sim.physics.engine.two_body_modes import (
    DAMP,
    KNOWN,
    LEVELS,
    MOVES,
    ROW,
    SMALL,
    STANDS,
    STIFF,
    apply_row,
    make_table,
    make_table_from_half,
    prepare_series,
)

CONTACT = 40.0  # [Hz] frequency at which motor and load bounce on rigid teeth
BLOW = 4  # steps into which one is divided while teeth bounce
MOMENT = 1e-6  # [s] a shorter part of a step is not simulated separately
FINE, FINEST = 0.06, 2e-4  # [of the fastest time scale], [s] the shortest parts of a halved step
PARTS = 1 << (LEVELS - 1)  # parts of a step, at most: each level has a table, and so has its half
TINY, HUGE = 1e-9, 1e12  # [V·s/unit] least kV; [1] times kA, inertia of a load that stands


def step_two_bodies(
    state: Array, c: Numbers, w: Numbers, on: Numbers, p: Numbers, memory: Array,
    tables: Array, commanded: float, off: bool, ka: float, dt: float,
) -> float:  # fmt: skip
    """One step of a motor and its load; returns the voltage [V] at the motor in its middle.

    A step that fails, because a body turns or teeth meet or part in it, is halved and tried again.
    """
    part, play = motor_inertia_share(on, p), backlash_gap(on, p)
    if tables[KNOWN] != ka:
        tables[KNOWN] = ka
        reduced = part * (1.0 - part) * ka
        stiff, damp = compute_joint_stiffness(on, p, reduced)
        pace = min(1.4 * math.sqrt(reduced / stiff), part * ka / max(c[KV], TINY))
        tables[STIFF], tables[DAMP], tables[SMALL] = stiff, damp, max(FINE * pace, FINEST)
    stiff, damp = tables[STIFF], tables[DAMP]
    u, level, done, size = 0.0, 0, 0, PARTS
    while done < PARTS:
        take = dt / (1 << level)
        if size == 1 or not take > tables[SMALL]:  # also if the state is nan
            u = step_through_contacts(state, c, w, on, p, memory, commanded, off, ka, take)
        else:
            push = compute_joint_force(play, stiff, damp, state[X] - state[Y], state[V] - state[W])
            if play == 0.0 or push != 0.0:
                one = step_in_contact(
                    state, c, w, on, p, memory, tables, commanded, off, ka, dt, level, play, stiff,
                    damp,
                )  # fmt: skip
            else:
                one = step_in_backlash(
                    state, c, w, on, p, memory, commanded, off, ka, take, play, stiff, damp
                )
            if math.isnan(one):
                size, level = size // 2, level + 1
                continue
            u = one
        done += size
        while level > 0 and done % (2 * size) == 0:  # the longest part that can begin here
            size, level = 2 * size, level - 1
    return u


def step_in_contact(
    state: Array, c: Numbers, w: Numbers, on: Numbers, p: Numbers, memory: Array,
    tables: Array, commanded: float, off: bool, ka: float, whole: float, level: int, play: float,
    stiff: float, damp: float,
) -> float:  # fmt: skip
    """One step of two bodies in contact, exact for the linear part of the model.

    The step is ``whole`` / 2^``level`` long. Nonlinear forces are taken at its middle. If a body
    turns, teeth part, or a load at rest begins to move, the state stays and nan is returned.
    """
    part, rub = motor_inertia_share(on, p), motor_friction_share(on, p)
    own, other, rest, dt = part * ka, (1.0 - part) * ka, 1.0 - rub, whole / (1 << level)
    x, v, y, z = state[X], state[V], state[Y], state[W]
    side = 0.5 * play * math.copysign(1.0, x - y)
    d, stands = x - y - side, z == 0.0
    u = compute_motor_voltage(c, w, on, p, memory, commanded, v, off)
    r = -compute_gravity_voltage(c, y) - force(on, p, y, z)
    if stands and not stays_at_rest(c, on, p, y, stiff * d + damp * v + r, rest):
        return math.nan
    if stands and v == 0.0:
        return u if is_held(c, on, p, u - stiff * d, rub) else math.nan

    which = STANDS if stands else MOVES
    prepare_series(tables, which, c[KV], own, HUGE * ka if stands else other, stiff, damp)
    half = make_table(tables, which, whole, level + 1)
    full = make_table_from_half(tables, which, whole, level)
    way, toward = math.copysign(1.0, v), math.copysign(1.0, z)
    b = u - way * rub * compute_sliding_friction(c, on, p, v, way)
    r = 0.0 if stands else r - toward * (1.0 - rub) * compute_sliding_friction(c, on, p, z, toward)
    d_half = apply_row(tables, half, d, v, z, b, r)
    v_half = apply_row(tables, half + ROW, d, v, z, b, r)
    z_half = apply_row(tables, half + 2 * ROW, d, v, z, b, r)
    y_half = y + apply_row(tables, half + 3 * ROW, d, v, z, b, r)
    u = compute_motor_voltage(c, w, on, p, memory, commanded, v_half, off)
    b = u - way * rub * compute_sliding_friction(c, on, p, v_half, way)
    r = -compute_gravity_voltage(c, y_half) - force(on, p, y_half, z_half)
    r = 0.0 if stands else r - toward * rest * compute_sliding_friction(c, on, p, z_half, toward)
    d_end = apply_row(tables, full, d, v, z, b, r)
    v_end = apply_row(tables, full + ROW, d, v, z, b, r)
    z_end = apply_row(tables, full + 2 * ROW, d, v, z, b, r)
    y_end = y + apply_row(tables, full + 3 * ROW, d, v, z, b, r)
    slowest = min(v * way, v_half * way, v_end * way)
    if stands:
        y_end, z_end = y, 0.0
        load = stiff * d_end + damp * v_end - compute_gravity_voltage(c, y) - force(on, p, y, 0.0)
        slowest = slowest if stays_at_rest(c, on, p, y, load, rest) else 0.0
    else:
        slowest = min(slowest, z * toward, z_half * toward, z_end * toward)
    if not slowest > 0.0:
        return math.nan
    if play > 0.0:
        halfway = compute_joint_force(play, stiff, damp, d_half + side, v_half - z_half)
        after = compute_joint_force(play, stiff, damp, d_end + side, v_end - z_end)
        long = dt * math.sqrt(stiff / (part * other)) > 1.0  # enough to part and meet within it
        if not min(halfway * side, after * side) > 0.0 or (long and deflection_jumps(d, d_end)):
            return math.nan
    state[X], state[V] = y_end + d_end + side, v_end
    state[Y], state[W] = clamp_to_travel(c, y_end, z_end)
    return u


def deflection_jumps(before: float, after: float) -> bool:
    """Whether a deflection changes by more than half of the larger one within a step."""
    return abs(after - before) > 0.5 * max(abs(before), abs(after))


def is_held(c: Numbers, on: Numbers, p: Numbers, drive: float, part: float) -> bool:
    """Whether friction holds a body at rest; ``part`` is its share of the friction."""
    return abs(drive) <= part * compute_sliding_friction(c, on, p, 0.0, math.copysign(1.0, drive))


def stays_at_rest(c: Numbers, on: Numbers, p: Numbers, y: float, drive: float, part: float) -> bool:
    """Whether a load at rest stays there, held by friction or lying on a stop."""
    lies = (y <= c[LOW] and drive <= 0.0) or (y >= c[HIGH] and drive >= 0.0)
    return bool(lies or is_held(c, on, p, drive, part))


def step_in_backlash(
    state: Array, c: Numbers, w: Numbers, on: Numbers, p: Numbers, memory: Array,
    commanded: float, off: bool, ka: float, dt: float, play: float, stiff: float, damp: float,
) -> float:  # fmt: skip
    """One step of two bodies within their backlash; nan, and no change, if the teeth meet."""
    part, rub = motor_inertia_share(on, p), motor_friction_share(on, p)
    own, other = part * ka, (1.0 - part) * ka
    x, v, y, z = state[X], state[V], state[Y], state[W]
    u = compute_motor_voltage(c, w, on, p, memory, commanded, v, off)
    _, v_half = predict_midpoint(c, on, p, x, v, u, c[KV], own, 0.5 * dt, rub)
    drive = -compute_gravity_voltage(c, y) - force(on, p, y, z)
    y_half, z_half = predict_midpoint(c, on, p, y, z, drive, 0.0, other, 0.5 * dt, 1.0 - rub)
    u = compute_motor_voltage(c, w, on, p, memory, commanded, v_half, off)
    x, v = move_exactly(c, on, p, x, v, v_half, u, c[KV], own, dt, rub)
    drive = -compute_gravity_voltage(c, y_half) - force(on, p, y_half, z_half)
    y, z = move_exactly(c, on, p, y, z, z_half, drive, 0.0, other, dt, 1.0 - rub)
    if compute_joint_force(play, stiff, damp, x - y, v - z) != 0.0:
        return math.nan
    state[X], state[V] = x, v
    state[Y], state[W] = clamp_to_travel(c, y, z)
    return u


def step_through_contacts(
    state: Array, c: Numbers, w: Numbers, on: Numbers, p: Numbers, memory: Array,
    commanded: float, off: bool, ka: float, dt: float,
) -> float:  # fmt: skip
    """One step of two bodies whose teeth meet or part, in smaller steps.

    It is divided where the teeth meet or part, and into several while they bounce.
    """
    play = backlash_gap(on, p)
    if play == 0.0:
        return step_by_midpoint(state, c, w, on, p, memory, commanded, off, ka, dt)
    u = 0.0
    fine = dt / BLOW
    while dt > 0.0:
        x, v, y, z = state[X], state[V], state[Y], state[W]
        before = abs(x - y) - 0.5 * play
        take = dt
        rush = abs(v - z)
        if before > -rush * dt and rush > 0.02 * (abs(v) + abs(z)):
            take = min(dt, fine)
        u = step_by_midpoint(state, c, w, on, p, memory, commanded, off, ka, take)
        after = abs(state[X] - state[Y]) - 0.5 * play
        if before * after < 0.0:
            first = take * before / (before - after) + 0.5 * MOMENT
            if MOMENT < first < take - MOMENT:
                state[X], state[V], state[Y], state[W] = x, v, y, z
                u = step_by_midpoint(state, c, w, on, p, memory, commanded, off, ka, first)
                take = first
        dt -= take
    return u


def step_by_midpoint(
    state: Array, c: Numbers, w: Numbers, on: Numbers, p: Numbers, memory: Array,
    commanded: float, off: bool, ka: float, dt: float,
) -> float:  # fmt: skip
    """One step of two bodies by the midpoint rule, also through contacts and turns."""
    part, play = motor_inertia_share(on, p), backlash_gap(on, p)
    own, other, rub = part * ka, (1.0 - part) * ka, motor_friction_share(on, p)
    stiff, damp = compute_joint_stiffness(on, p, part * other)
    x, v, y, z = state[X], state[V], state[Y], state[W]

    u = compute_motor_voltage(c, w, on, p, memory, commanded, v, off)
    push = compute_joint_force(play, stiff, damp, x - y, v - z)
    x_half, v_half = predict_midpoint(c, on, p, x, v, u - push, c[KV], own, 0.5 * dt, rub)
    drive = push - compute_gravity_voltage(c, y) - force(on, p, y, z)
    y_half, z_half = predict_midpoint(c, on, p, y, z, drive, 0.0, other, 0.5 * dt, 1.0 - rub)

    u = compute_motor_voltage(c, w, on, p, memory, commanded, v_half, off)
    push = compute_joint_force(play, stiff, damp, x_half - y_half, v_half - z_half)
    x, v = move_exactly(c, on, p, x, v, v_half, u - push, c[KV], own, dt, rub)
    drive = push - compute_gravity_voltage(c, y_half) - force(on, p, y_half, z_half)
    y, z = move_exactly(c, on, p, y, z, z_half, drive, 0.0, other, dt, 1.0 - rub)
    state[X], state[V] = x, v
    state[Y], state[W] = clamp_to_travel(c, y, z)
    return u


def compute_joint_stiffness(on: Numbers, p: Numbers, reduced: float) -> tuple[float, float]:
    """[V/unit] stiffness and [V·s/unit] damping between motor and load.

    ``reduced`` [V·s²/unit] is the reduced inertia of the two bodies.
    """
    soft = joint_compliance(on, p)
    stiff = 1.0 / soft if soft > 0.0 else reduced * (2.0 * math.pi * CONTACT) ** 2
    return stiff, 2.0 * joint_damping(on, p) * math.sqrt(stiff * reduced)


def compute_joint_force(play: float, stiff: float, damp: float, gap: float, rush: float) -> float:
    """[V] force of the motor on the load through the joint.

    ``gap`` [unit] and ``rush`` [unit/s] are position and velocity of the motor minus those of the
    load, ``play`` [unit] the backlash, ``stiff`` [V/unit] and ``damp`` [V·s/unit] the joint's.
    """
    into = abs(gap) - 0.5 * play
    if into <= 0.0:
        return 0.0
    way = math.copysign(1.0, gap)
    push = stiff * into + damp * rush * way
    if play > 0.0:  # teeth cannot pull
        push = max(push, 0.0)
    return push * way
