"""One step of two inertias, motor and load, coupled by a spring or backlash.

It pushes through what joins them, free play first. A spring that joins them is part of the exact
solution (``two_body_modes.py``), so a step in which nothing happens is gone in one; a
body that turns, and teeth that meet or part, are closed in by halving.

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

CONTACT = 40.0  # [Hz] at which motor and load bounce on each other's teeth: stiff, but not endless
BLOW = 4  # steps in which one is taken while teeth bounce
MOMENT = 1e-6  # [s] a shorter part of a step is not worth a step of its own
FINE, FINEST = 0.06, 2e-4  # [1] of their pace, [s]: a step in which one turns, or teeth meet
PARTS = 1 << (LEVELS - 1)  # of a step, at most: the half of what swings has a table, too
TINY, HUGE = 1e-9, 1e12  # [V·s/unit] a kV that is none; [1] an inertia that nothing moves


def step_two_bodies(
    state: Array, c: Numbers, w: Numbers, on: Numbers, p: Numbers, memory: Array,
    ways: Array, asked: float, off: bool, ka: float, dt: float,
) -> float:  # fmt: skip
    """One step of a motor and its load; returns the voltage [V] at the motor in its middle.

    As far as nothing happens in it, it is gone in one; what happens is closed in by halving.
    """
    part, play = motor_inertia_share(on, p), backlash_gap(on, p)
    if ways[KNOWN] != ka:
        ways[KNOWN] = ka
        reduced = part * (1.0 - part) * ka
        stiff, damp = compute_joint_stiffness(on, p, reduced)
        pace = min(1.4 * math.sqrt(reduced / stiff), part * ka / max(c[KV], TINY))
        ways[STIFF], ways[DAMP], ways[SMALL] = stiff, damp, max(FINE * pace, FINEST)
    stiff, damp = ways[STIFF], ways[DAMP]
    u, level, gone, size = 0.0, 0, 0, PARTS
    while gone < PARTS:
        take = dt / (1 << level)
        if size == 1 or not take > ways[SMALL]:  # nor where it flies off, and nothing is a number
            u = step_through_contacts(state, c, w, on, p, memory, asked, off, ka, take)
        else:
            push = compute_joint_force(play, stiff, damp, state[X] - state[Y], state[V] - state[W])
            if play == 0.0 or push != 0.0:
                one = step_in_contact(
                    state, c, w, on, p, memory, ways, asked, off, ka, dt, level, play, stiff, damp
                )
            else:
                one = step_in_backlash(
                    state, c, w, on, p, memory, asked, off, ka, take, play, stiff, damp
                )
            if math.isnan(one):
                size, level = size // 2, level + 1
                continue
            u = one
        gone += size
        while level > 0 and gone % (2 * size) == 0:  # as long a part as may begin here
            size, level = 2 * size, level - 1
    return u


def step_in_contact(
    state: Array, c: Numbers, w: Numbers, on: Numbers, p: Numbers, memory: Array,
    ways: Array, asked: float, off: bool, ka: float, whole: float, level: int, play: float,
    stiff: float, damp: float,
) -> float:  # fmt: skip
    """One step of two bodies that push each other, exact but for what is not linear.

    The step is ``whole`` / 2^``level``. What is not linear is taken at its middle. Where one body
    turns, teeth part, or a load that stands begins to move, there is no step: nan is returned.
    """
    part, rub = motor_inertia_share(on, p), motor_friction_share(on, p)
    own, other, rest, dt = part * ka, (1.0 - part) * ka, 1.0 - rub, whole / (1 << level)
    x, v, y, z = state[X], state[V], state[Y], state[W]
    side = 0.5 * play * math.copysign(1.0, x - y)
    d, stands = x - y - side, z == 0.0
    u = compute_motor_voltage(c, w, on, p, memory, asked, v, off)
    r = -compute_gravity_voltage(c, y) - force(on, p, y, z)
    if stands and not stays_at_rest(c, on, p, y, stiff * d + damp * v + r, rest):
        return math.nan
    if stands and v == 0.0:
        return u if is_held(c, on, p, u - stiff * d, rub) else math.nan

    which = STANDS if stands else MOVES
    prepare_series(ways, which, c[KV], own, HUGE * ka if stands else other, stiff, damp)
    half = make_table(ways, which, whole, level + 1)
    full = make_table_from_half(ways, which, whole, level)
    way, toward = math.copysign(1.0, v), math.copysign(1.0, z)
    b = u - way * rub * compute_sliding_friction(c, on, p, v, way)
    r = 0.0 if stands else r - toward * (1.0 - rub) * compute_sliding_friction(c, on, p, z, toward)
    d_half = apply_row(ways, half, d, v, z, b, r)
    v_half = apply_row(ways, half + ROW, d, v, z, b, r)
    z_half = apply_row(ways, half + 2 * ROW, d, v, z, b, r)
    y_half = y + apply_row(ways, half + 3 * ROW, d, v, z, b, r)
    u = compute_motor_voltage(c, w, on, p, memory, asked, v_half, off)
    b = u - way * rub * compute_sliding_friction(c, on, p, v_half, way)
    r = -compute_gravity_voltage(c, y_half) - force(on, p, y_half, z_half)
    r = 0.0 if stands else r - toward * rest * compute_sliding_friction(c, on, p, z_half, toward)
    d_end = apply_row(ways, full, d, v, z, b, r)
    v_end = apply_row(ways, full + ROW, d, v, z, b, r)
    z_end = apply_row(ways, full + 2 * ROW, d, v, z, b, r)
    y_end = y + apply_row(ways, full + 3 * ROW, d, v, z, b, r)
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
    asked: float, off: bool, ka: float, dt: float, play: float, stiff: float, damp: float,
) -> float:  # fmt: skip
    """One step of two bodies within their backlash; nan, and no step, where the teeth meet."""
    part, rub = motor_inertia_share(on, p), motor_friction_share(on, p)
    own, other = part * ka, (1.0 - part) * ka
    x, v, y, z = state[X], state[V], state[Y], state[W]
    u = compute_motor_voltage(c, w, on, p, memory, asked, v, off)
    _, v_half = predict_midpoint(c, on, p, x, v, u, c[KV], own, 0.5 * dt, rub)
    drive = -compute_gravity_voltage(c, y) - force(on, p, y, z)
    y_half, z_half = predict_midpoint(c, on, p, y, z, drive, 0.0, other, 0.5 * dt, 1.0 - rub)
    u = compute_motor_voltage(c, w, on, p, memory, asked, v_half, off)
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
    asked: float, off: bool, ka: float, dt: float,
) -> float:  # fmt: skip
    """One step of two bodies through contacts, in small steps.

    A step in which teeth meet or part is taken in two, on both sides of that moment; and while they
    bounce, in several.
    """
    play = backlash_gap(on, p)
    if play == 0.0:
        return step_by_midpoint(state, c, w, on, p, memory, asked, off, ka, dt)
    u = 0.0
    fine = dt / BLOW
    while dt > 0.0:
        x, v, y, z = state[X], state[V], state[Y], state[W]
        before = abs(x - y) - 0.5 * play
        take = dt
        rush = abs(v - z)
        if before > -rush * dt and rush > 0.02 * (abs(v) + abs(z)):
            take = min(dt, fine)
        u = step_by_midpoint(state, c, w, on, p, memory, asked, off, ka, take)
        after = abs(state[X] - state[Y]) - 0.5 * play
        if before * after < 0.0:
            first = take * before / (before - after) + 0.5 * MOMENT
            if MOMENT < first < take - MOMENT:
                state[X], state[V], state[Y], state[W] = x, v, y, z
                u = step_by_midpoint(state, c, w, on, p, memory, asked, off, ka, first)
                take = first
        dt -= take
    return u


def step_by_midpoint(
    state: Array, c: Numbers, w: Numbers, on: Numbers, p: Numbers, memory: Array,
    asked: float, off: bool, ka: float, dt: float,
) -> float:  # fmt: skip
    """One step of two bodies by the midpoint rule, whatever happens in it."""
    part, play = motor_inertia_share(on, p), backlash_gap(on, p)
    own, other, rub = part * ka, (1.0 - part) * ka, motor_friction_share(on, p)
    stiff, damp = compute_joint_stiffness(on, p, part * other)
    x, v, y, z = state[X], state[V], state[Y], state[W]

    u = compute_motor_voltage(c, w, on, p, memory, asked, v, off)
    push = compute_joint_force(play, stiff, damp, x - y, v - z)
    x_half, v_half = predict_midpoint(c, on, p, x, v, u - push, c[KV], own, 0.5 * dt, rub)
    drive = push - compute_gravity_voltage(c, y) - force(on, p, y, z)
    y_half, z_half = predict_midpoint(c, on, p, y, z, drive, 0.0, other, 0.5 * dt, 1.0 - rub)

    u = compute_motor_voltage(c, w, on, p, memory, asked, v_half, off)
    push = compute_joint_force(play, stiff, damp, x_half - y_half, v_half - z_half)
    x, v = move_exactly(c, on, p, x, v, v_half, u - push, c[KV], own, dt, rub)
    drive = push - compute_gravity_voltage(c, y_half) - force(on, p, y_half, z_half)
    y, z = move_exactly(c, on, p, y, z, z_half, drive, 0.0, other, dt, 1.0 - rub)
    state[X], state[V] = x, v
    state[Y], state[W] = clamp_to_travel(c, y, z)
    return u


def compute_joint_stiffness(on: Numbers, p: Numbers, reduced: float) -> tuple[float, float]:
    """[V/unit] stiffness and [V·s/unit] damping between motor and load.

    ``reduced`` [V·s²/unit] is the inertia of the two against each other.
    """
    soft = joint_compliance(on, p)
    stiff = 1.0 / soft if soft > 0.0 else reduced * (2.0 * math.pi * CONTACT) ** 2
    return stiff, 2.0 * joint_damping(on, p) * math.sqrt(stiff * reduced)


def compute_joint_force(play: float, stiff: float, damp: float, gap: float, rush: float) -> float:
    """[V] coupling force of the motor on the load, from the deflection and its rate."""
    into = abs(gap) - 0.5 * play
    if into <= 0.0:
        return 0.0
    way = math.copysign(1.0, gap)
    push = stiff * into + damp * rush * way
    if play > 0.0:  # teeth push and never pull
        push = max(push, 0.0)
    return push * way
