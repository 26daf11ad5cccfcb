"""Move a mechanism along a voltage: the one engine of the bench.

    kA·v' = u - kV·v - gravity - pull(x, v) - (kS + grip)·sgn(v)

The linear part has an exact solution (an exponential), so the base model is exact whatever the
step. What an effect pulls is taken at the middle of each step, and friction's change of sign is met
at its exact time: a step that ends at rest stays there until friction gives way. With two bodies, a
motor with its share of the inertia pushes the load through what joins them, free play first; a
spring that joins them is part of the exact solution (``sim/engine/joined.py``).

Plain functions of numbers: ``sim/engine/compose.py`` compiles them together with the effects'.
"""

import math

import numpy as np

from sim.engine.hooks import (  # composed: begin
    Numbers,
    grip,
    heft,
    jolt,
    late,
    passes,
    pull,
    remembers,
    sees,
    share,
    slack,
    softness,
)
from sim.engine.joined import HALF, ROW, WHOLE, becomes, tabled
from sim.engine.wires import CUT, EMF, OHM, REST, STOP, bus_at, reaches
from sim.log import Array  # composed: end

KS, KV, KA, LOAD, LEVEL, ANGLE, LOW, HIGH = range(8)
"""Places in ``c``: kS [V], kV, kA, constant gravity [V], gravity of an arm that is level [V],
angle [rad] added to the position of an arm, lower and upper end of the travel."""

X, V, Y, W, OFF_UNTIL = range(5)
"""Places in a state: position and velocity of the motor, then of the load, and [s] of the clock
until which a brownout keeps the motors off. With one body, motor and load are the same."""

POSITION, VELOCITY, LOAD_POSITION, APPLIED, BUS, CURRENT, EXPECTED, SEEN = range(8)
"""Columns of what is recorded. Where a measurement corrects the motion, the first three are after
it; the position that was expected and the velocity that the sensor would see are before."""

CONTACT = 40.0  # [Hz] at which motor and load bounce on each other's teeth: stiff, but not endless
DAMPING = 0.3  # [1] of critical, of that contact: steel teeth in grease
BLOW = 4  # steps in which one is taken while teeth bounce
MOMENT = 1e-6  # [s] a shorter part of a step is not worth a step of its own
LOOSE_DAMPING = 0.05  # [1] of critical, of a belt, a chain or an arm that bends
FINE, FINEST = 0.06, 2e-4  # [1] of their pace, [s]: a step in which one turns, or teeth meet
TINY, HUGE = 1e-9, 1e12  # [V·s/unit] a kV that is none; [1] an inertia that nothing moves


def slides(c: Numbers, on: Numbers, p: Numbers, v: float, way: float) -> float:
    """[V] of dry friction toward ``way``, never below none."""
    return float(max(c[KS] + grip(on, p, v, way), 0.0))


def glide(
    c: Numbers, on: Numbers, p: Numbers, x: float, v: float, v_mid: float, drive: float,
    kv: float, ka: float, dt: float, part: float,
) -> tuple[float, float]:  # fmt: skip
    """Position and velocity after ``dt`` under a constant drive [V], turning points included.

    Friction while it slides is that at ``v_mid``, of which ``part`` is this body's; at rest it is
    whatever the drive is, up to a bound.
    """
    rate = kv / ka
    while dt > 0.0:
        if v == 0.0:
            way = math.copysign(1.0, drive)
            hold = part * slides(c, on, p, 0.0, way)
            slide = part * slides(c, on, p, v_mid, way)
            if abs(drive) <= max(hold, slide):
                return x, v
        else:
            way = math.copysign(1.0, v)
            slide = part * slides(c, on, p, v_mid, way)
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


def ahead(
    c: Numbers, on: Numbers, p: Numbers, x: float, v: float, drive: float,
    kv: float, ka: float, dt: float, part: float,
) -> tuple[float, float]:  # fmt: skip
    """Position and velocity a moment ahead, along a straight line: where a step has its middle."""
    way = math.copysign(1.0, v if v != 0.0 else drive)
    slide = part * slides(c, on, p, v, way)
    if v == 0.0 and abs(drive) <= slide:
        return x, v
    after = v + dt * (drive - way * slide - kv * v) / ka
    if v * after < 0.0:
        after = 0.0
    return x + 0.5 * dt * (v + after), after


def gravity(c: Numbers, x: float) -> float:
    """[V] that gravity takes."""
    if c[LEVEL] == 0.0:
        return float(c[LOAD])
    return float(c[LOAD] + c[LEVEL] * math.cos(x + c[ANGLE]))


def through(
    c: Numbers,
    w: Numbers,
    on: Numbers,
    p: Numbers,
    memory: Array,
    asked: float,
    v: float,
    off: bool,
) -> float:
    """[V] at the motor, after the wires and then the paths."""
    u = reaches(w, 0.0 if off else asked, v)
    return passes(on, p, memory, u, v, c[KV])


def within(c: Numbers, x: float, v: float) -> tuple[float, float]:
    """Stop at the ends of the travel, without a bounce."""
    if x < c[LOW]:
        return c[LOW], max(v, 0.0)
    if x > c[HIGH]:
        return c[HIGH], min(v, 0.0)
    return x, v


def single(
    state: Array, c: Numbers, w: Numbers, on: Numbers, p: Numbers, memory: Array,
    asked: float, off: bool, ka: float, dt: float, plain: bool,
) -> float:  # fmt: skip
    """One step of one body; returns the voltage [V] at the motor in its middle."""
    x, v = state[X], state[V]
    u = through(c, w, on, p, memory, asked, v, off)
    if not plain:
        drive = u - gravity(c, x) - pull(on, p, x, v)
        half, v_half = ahead(c, on, p, x, v, drive, c[KV], ka, 0.5 * dt, 1.0)
        u = through(c, w, on, p, memory, asked, v_half, off)
        drive = u - gravity(c, half) - pull(on, p, half, v_half)
        x, v = glide(c, on, p, x, v, v_half, drive, c[KV], ka, dt, 1.0)
    else:
        x, v = glide(c, on, p, x, v, v, u - c[LOAD], c[KV], ka, dt, 1.0)
    x, v = within(c, x, v)
    state[X] = state[Y] = x
    state[V] = state[W] = v
    return u


def joins(soft: float, reduced: float) -> tuple[float, float]:
    """[V/unit] stiffness and [V·s/unit] damping of what joins motor and load."""
    stiff, damping = reduced * (2.0 * math.pi * CONTACT) ** 2, DAMPING
    if soft > 0.0:
        stiff, damping = 1.0 / soft, LOOSE_DAMPING
    return stiff, 2.0 * damping * math.sqrt(stiff * reduced)


def joint(play: float, stiff: float, damp: float, gap: float, rush: float) -> float:
    """[V] with which the motor pushes the load, from how far and how fast it is ahead."""
    into = abs(gap) - 0.5 * play
    if into <= 0.0:
        return 0.0
    way = math.copysign(1.0, gap)
    force = stiff * into + damp * rush * way
    if play > 0.0:  # teeth push and never pull
        force = max(force, 0.0)
    return force * way


def double(
    state: Array, c: Numbers, w: Numbers, on: Numbers, p: Numbers, memory: Array,
    ways: Array, asked: float, off: bool, ka: float, dt: float,
) -> float:  # fmt: skip
    """One step of a motor and its load; returns the voltage [V] at the motor in its middle.

    As far as nothing happens in it, it is gone in one; what happens is closed in by halving.
    """
    part = share(on, p)
    play, soft = slack(on, p), softness(on, p)
    own, reduced = part * ka, part * (1.0 - part) * ka
    stiff, damp = joins(soft, reduced)
    pace = min(1.4 * math.sqrt(reduced / stiff), own / max(c[KV], TINY))
    fine = max(FINE * pace, FINEST)
    take, u = dt, 0.0
    while dt > 0.0:
        take = min(take, dt)
        if not take > fine:  # nor where it flies off, and nothing is a number
            u = meeting(state, c, w, on, p, memory, asked, off, ka, take)
        else:
            push = joint(play, stiff, damp, state[X] - state[Y], state[V] - state[W])
            if play == 0.0 or push != 0.0:
                one = swing(
                    state, c, w, on, p, memory, ways, asked, off, ka, take, play, stiff, damp
                )
            else:
                one = loose(state, c, w, on, p, memory, asked, off, ka, take, play, stiff, damp)
            if math.isnan(one):
                take *= 0.5
                continue
            u = one
        dt -= take
        take = dt
    return u


def swing(
    state: Array, c: Numbers, w: Numbers, on: Numbers, p: Numbers, memory: Array,
    ways: Array, asked: float, off: bool, ka: float, dt: float, play: float, stiff: float,
    damp: float,
) -> float:  # fmt: skip
    """The same of bodies that push each other, exactly but for what is not linear.

    That is taken at the middle of the step. Where one of them turns, teeth part, or a load that
    stands begins to move, there is no step, and nan is returned.
    """
    part = share(on, p)
    rest = 1.0 - part
    own, other = part * ka, rest * ka
    x, v, y, z = state[X], state[V], state[Y], state[W]
    side = 0.5 * play * math.copysign(1.0, x - y)
    d = x - y - side
    u = through(c, w, on, p, memory, asked, v, off)
    r = -gravity(c, y) - pull(on, p, y, z)
    stands = z == 0.0
    if stands and not stays(c, on, p, y, stiff * d + damp * v + r, rest):
        return math.nan
    if stands and v == 0.0:
        return u if held(c, on, p, u - stiff * d, part) else math.nan

    tabled(ways, dt, c[KV], own, HUGE * ka if stands else other, stiff, damp)
    way, toward = math.copysign(1.0, v), math.copysign(1.0, z)
    b = u - way * part * slides(c, on, p, v, way)
    r = 0.0 if stands else r - toward * rest * slides(c, on, p, z, toward)
    d_half = becomes(ways, HALF, d, v, z, b, r)
    v_half = becomes(ways, HALF + ROW, d, v, z, b, r)
    z_half = becomes(ways, HALF + 2 * ROW, d, v, z, b, r)
    y_half = y + becomes(ways, HALF + 3 * ROW, d, v, z, b, r)
    u = through(c, w, on, p, memory, asked, v_half, off)
    b = u - way * part * slides(c, on, p, v_half, way)
    r = -gravity(c, y_half) - pull(on, p, y_half, z_half)
    r = 0.0 if stands else r - toward * rest * slides(c, on, p, z_half, toward)
    d_end = becomes(ways, WHOLE, d, v, z, b, r)
    v_end = becomes(ways, WHOLE + ROW, d, v, z, b, r)
    z_end = becomes(ways, WHOLE + 2 * ROW, d, v, z, b, r)
    y_end = y + becomes(ways, WHOLE + 3 * ROW, d, v, z, b, r)

    slowest = min(v * way, v_half * way, v_end * way)
    if stands:
        y_end, z_end = y, 0.0
        load = stiff * d_end + damp * v_end - gravity(c, y) - pull(on, p, y, 0.0)
        slowest = slowest if stays(c, on, p, y, load, rest) else 0.0
    else:
        slowest = min(slowest, z * toward, z_half * toward, z_end * toward)
    if not slowest > 0.0:
        return math.nan
    if play > 0.0:
        least = joint(play, stiff, damp, d_half + side, v_half - z_half) * side
        least = min(least, joint(play, stiff, damp, d_end + side, v_end - z_end) * side)
        shakes = abs(d_end - d) > 0.5 * max(abs(d), abs(d_end))
        long = dt * math.sqrt(stiff / (part * other)) > 1.0  # enough to part and meet within it
        if not least > 0.0 or (shakes and long):
            return math.nan
    state[X], state[V] = y_end + d_end + side, v_end
    state[Y], state[W] = within(c, y_end, z_end)
    return u


def held(c: Numbers, on: Numbers, p: Numbers, drive: float, part: float) -> bool:
    """Whether friction holds a body at rest that has such a part of it."""
    return abs(drive) <= part * slides(c, on, p, 0.0, math.copysign(1.0, drive))


def stays(c: Numbers, on: Numbers, p: Numbers, y: float, drive: float, part: float) -> bool:
    """Whether a load at rest stays there, held by friction or lying on a stop."""
    lies = (y <= c[LOW] and drive <= 0.0) or (y >= c[HIGH] and drive >= 0.0)
    return bool(lies or held(c, on, p, drive, part))


def loose(
    state: Array, c: Numbers, w: Numbers, on: Numbers, p: Numbers, memory: Array,
    asked: float, off: bool, ka: float, dt: float, play: float, stiff: float, damp: float,
) -> float:  # fmt: skip
    """The same of bodies between whose teeth there is room; nan, and no step, where they meet."""
    part = share(on, p)
    own, other = part * ka, (1.0 - part) * ka
    x, v, y, z = state[X], state[V], state[Y], state[W]
    u = through(c, w, on, p, memory, asked, v, off)
    _, v_half = ahead(c, on, p, x, v, u, c[KV], own, 0.5 * dt, part)
    drive = -gravity(c, y) - pull(on, p, y, z)
    y_half, z_half = ahead(c, on, p, y, z, drive, 0.0, other, 0.5 * dt, 1.0 - part)
    u = through(c, w, on, p, memory, asked, v_half, off)
    x, v = glide(c, on, p, x, v, v_half, u, c[KV], own, dt, part)
    drive = -gravity(c, y_half) - pull(on, p, y_half, z_half)
    y, z = glide(c, on, p, y, z, z_half, drive, 0.0, other, dt, 1.0 - part)
    if joint(play, stiff, damp, x - y, v - z) != 0.0:
        return math.nan
    state[X], state[V] = x, v
    state[Y], state[W] = within(c, y, z)
    return u


def meeting(
    state: Array, c: Numbers, w: Numbers, on: Numbers, p: Numbers, memory: Array,
    asked: float, off: bool, ka: float, dt: float,
) -> float:  # fmt: skip
    """The same of whatever happens, in small steps.

    A step in which teeth meet or part is taken in two, on both sides of that moment; and while they
    bounce, in several.
    """
    play = slack(on, p)
    if play == 0.0:
        return pair(state, c, w, on, p, memory, asked, off, ka, dt)
    u = 0.0
    fine = dt / BLOW
    while dt > 0.0:
        x, v, y, z = state[X], state[V], state[Y], state[W]
        before = abs(x - y) - 0.5 * play
        take = dt
        rush = abs(v - z)
        if before > -rush * dt and rush > 0.02 * (abs(v) + abs(z)):
            take = min(dt, fine)
        u = pair(state, c, w, on, p, memory, asked, off, ka, take)
        after = abs(state[X] - state[Y]) - 0.5 * play
        if before * after < 0.0:
            first = take * before / (before - after) + 0.5 * MOMENT
            if MOMENT < first < take - MOMENT:
                state[X], state[V], state[Y], state[W] = x, v, y, z
                u = pair(state, c, w, on, p, memory, asked, off, ka, first)
                take = first
        dt -= take
    return u


def pair(
    state: Array, c: Numbers, w: Numbers, on: Numbers, p: Numbers, memory: Array,
    asked: float, off: bool, ka: float, dt: float,
) -> float:  # fmt: skip
    """One step of two bodies, as ``double``, whatever happens in it."""
    part, play = share(on, p), slack(on, p)
    own, other = part * ka, (1.0 - part) * ka
    stiff, damp = joins(softness(on, p), part * other)
    x, v, y, z = state[X], state[V], state[Y], state[W]

    u = through(c, w, on, p, memory, asked, v, off)
    push = joint(play, stiff, damp, x - y, v - z)
    x_half, v_half = ahead(c, on, p, x, v, u - push, c[KV], own, 0.5 * dt, part)
    drive = push - gravity(c, y) - pull(on, p, y, z)
    y_half, z_half = ahead(c, on, p, y, z, drive, 0.0, other, 0.5 * dt, 1.0 - part)

    u = through(c, w, on, p, memory, asked, v_half, off)
    push = joint(play, stiff, damp, x_half - y_half, v_half - z_half)
    x, v = glide(c, on, p, x, v, v_half, u - push, c[KV], own, dt, part)
    drive = push - gravity(c, y_half) - pull(on, p, y_half, z_half)
    y, z = glide(c, on, p, y, z, z_half, drive, 0.0, other, dt, 1.0 - part)
    state[X], state[V] = x, v
    state[Y], state[W] = within(c, y, z)
    return u


def advance(
    state: Array, c: Numbers, w: Numbers, on: Numbers, p: Numbers, memory: Array, ways: Array,
    asked: float, clock: float, dt: float, plain: bool, ka: float,
) -> float:  # fmt: skip
    """One step; returns the inertia [V·s²/unit] after it.

    Inertia that joins on the way and was at rest shares the momentum. Inertia that leaves takes its
    own momentum along.
    """
    heavy = c[KA] + heft(on, p, clock)
    if heavy > ka:
        kept = 1.0 - jolt(on, p) * (1.0 - ka / heavy)
        state[V] *= kept
        state[W] *= kept
    off = clock < state[OFF_UNTIL]
    if w[REST] != 0.0 and not off:
        u = reaches(w, asked, state[V])
        bus = bus_at(w, u, (u - w[EMF] * state[V]) / w[OHM])
        if bus < w[STOP]:  # noticed now, acted on from the next step on
            state[OFF_UNTIL] = clock + 0.5 * dt + CUT
    if share(on, p) > 0.0:
        u = double(state, c, w, on, p, memory, ways, asked, off, heavy, dt)
    else:
        u = single(state, c, w, on, p, memory, asked, off, heavy, dt, plain)
    remembers(on, p, memory, dt, u, state[V], c[KV])
    return float(heavy)


def record(out: Array, k: int, state: Array, w: Numbers, asked: float, clock: float) -> None:
    """Write down what is true at sample ``k``, but for what the sensor says."""
    out[k, POSITION], out[k, VELOCITY] = state[X], state[V]
    out[k, LOAD_POSITION] = state[Y]
    off = clock < state[OFF_UNTIL]
    u = reaches(w, 0.0 if off else asked, state[V])
    out[k, APPLIED] = u
    if w[REST] != 0.0:
        current = (u - w[EMF] * state[V]) / w[OHM]
        out[k, BUS] = bus_at(w, u, current)
        out[k, CURRENT] = current


def correct(state: Array, ahead: float, faster: float, trust: Array) -> None:
    """Move the whole mechanism by a share of how far a measurement is from what was expected."""
    way, speed = 0.0, 0.0
    if not math.isnan(ahead):
        way, speed = trust[0, 0] * ahead, trust[1, 0] * ahead
    if not math.isnan(faster):
        way, speed = way + trust[0, 1] * faster, speed + trust[1, 1] * faster
    state[X] += way
    state[Y] += way
    state[V] += speed
    state[W] += speed


def run(
    time: Array, asked: Array, state: Array, c: Numbers, w: Numbers, on: Numbers, p: Numbers,
    memory: Array, ways: Array, began: float, finest: float, plain: bool, measured: Array,
    trust: Array, out: Array,
) -> None:  # fmt: skip
    """Move through one run and write every sample into ``out``; ``state`` and ``memory`` go on.

    A command holds from its sample until the next, later by what the effects delay it; before the
    first has come, what rests is held where it rests, by a stop or a brake. ``measured`` (n, 2) are
    positions and velocities that correct the motion as it goes, nan where there is none, by the
    gains ``trust`` (2, 2); without rows it goes its way. ``ways`` is room for the tables of
    ``joined.py``: of one model only, and empty at first.
    """
    lag = late(on, p)
    n = time.size
    command = -1  # the last one that has arrived
    rests = state[V] == 0.0 and state[W] == 0.0
    ka = c[KA] + heft(on, p, began)
    for k in range(n):
        now = time[k]
        while command + 1 < n and time[command + 1] + lag <= now + 1e-12:
            command += 1
        record(out, k, state, w, asked[k], began + now - time[0])
        out[k, EXPECTED] = state[X]
        out[k, SEEN] = sees(on, p, k, time, out[:, POSITION], out[:, VELOCITY])
        if measured.shape[0] > 0:
            ahead, faster = measured[k, 0] - state[X], measured[k, 1] - out[k, SEEN]
            correct(state, ahead, faster, trust)
            out[k, POSITION], out[k, VELOCITY] = state[X], state[V]
            out[k, LOAD_POSITION] = state[Y]
        if k == n - 1:
            break
        while now < time[k + 1] - 1e-12:
            after = time[k + 1]
            if command + 1 < n:
                after = min(after, time[command + 1] + lag)
            if command < 0 and rests:
                state[V] = state[W] = 0.0  # whatever a measurement made of it
            else:
                volts = asked[command] if command >= 0 else 0.0
                count = max(math.ceil((after - now) / finest - 1e-9), 1)
                dt = (after - now) / count
                for i in range(count):
                    clock = began + now + (i + 0.5) * dt - time[0]
                    ka = advance(state, c, w, on, p, memory, ways, volts, clock, dt, plain, ka)
            now = after
            while command + 1 < n and time[command + 1] + lag <= now + 1e-12:
                command += 1


def empty(n: int) -> Array:
    """Room for what ``move`` writes about ``n`` samples."""
    return np.zeros((n, 8))
