"""The integrator: move a model along a voltage, sample by sample.

One body (``one_body.py``), a motor and its load (``two_bodies.py``) or a robot on wheels that slip
(``slipping_wheels.py``), step by step, with what changes on the way, what the sensor sees, and what
a measurement corrects.

Plain functions of numbers: ``compose.py`` compiles them together with the effects'.
"""

import math

import numpy as np

from sim.core.log import Array
from sim.physics.engine.hooks import (
    Numbers,
    added_inertia,
    command_delay,
    grip_limit,
    impact,
    motor_inertia_share,
    next_change,
    transform_velocity,
    update_memory,
)
from sim.physics.engine.one_body import KA, KV, OFF_UNTIL, V, W, X, Y, bound_travel, step_one_body
from sim.physics.engine.power_path import (
    CUT,
    EMF,
    OHM,
    REST,
    STOP,
    compute_bus_voltage,
    limit_voltage,
)
from sim.physics.engine.slipping_wheels import step_slipping_wheels
from sim.physics.engine.two_bodies import step_two_bodies

POSITION, VELOCITY, LOAD_POSITION, APPLIED, BUS, CURRENT, EXPECTED, SEEN = range(8)
"""Columns of what is recorded. Where a measurement corrects the motion, the first three are after
it; the position that was expected and the velocity that the sensor would see are before."""


NONE = 1e-9  # [s] a step that is none
SLIDING = 4.0  # steps of a sample in which the voltage slides: its mean leaves a sixteenth of error
LONGEST, ALONG, LEAST, FASTER = range(4)  # places in ``steps``: [s], [unit] of way, [s], [unit/s]


def advance_step(
    state: Array, c: Numbers, w: Numbers, on: Numbers, p: Numbers, memory: Array, ways: Array,
    asked: float, clock: float, dt: float, plain: bool, ka: float,
) -> float:  # fmt: skip
    """One step; returns the inertia [V·s²/unit] after it.

    Inertia that joins on the way and was at rest shares the momentum. Inertia that leaves takes its
    own momentum along.
    """
    heavy = c[KA] + added_inertia(on, p, clock)
    if heavy > ka:
        kept = 1.0 - impact(on, p) * (1.0 - ka / heavy)
        state[V] *= kept
        state[W] *= kept
    off = clock < state[OFF_UNTIL]
    if w[REST] != 0.0 and not off:
        u = limit_voltage(w, asked, state[V])
        bus = compute_bus_voltage(w, u, (u - w[EMF] * state[V]) / w[OHM])
        if bus < w[STOP]:  # noticed now, acted on from the next step on
            state[OFF_UNTIL] = clock + 0.5 * dt + CUT
    if grip_limit(on, p) < math.inf:
        u = step_slipping_wheels(state, c, w, on, p, memory, asked, off, heavy, dt)
    elif motor_inertia_share(on, p) > 0.0:
        u = step_two_bodies(state, c, w, on, p, memory, ways, asked, off, heavy, dt)
    else:
        u = step_one_body(state, c, w, on, p, memory, asked, off, heavy, dt, plain)
    update_memory(on, p, memory, dt, u, state[V], c[KV])
    return float(heavy)


def record_sample(out: Array, k: int, state: Array, w: Numbers, asked: float, clock: float) -> None:
    """Write the true state at sample ``k`` into the output; sensor readings follow later."""
    out[k, POSITION], out[k, VELOCITY] = state[X], state[V]
    out[k, LOAD_POSITION] = state[Y]
    off = clock < state[OFF_UNTIL]
    u = limit_voltage(w, 0.0 if off else asked, state[V])
    current, bus = 0.0, 0.0
    if w[REST] != 0.0:
        current = (u - w[EMF] * state[V]) / w[OHM]
        bus = compute_bus_voltage(w, u, current)
    out[k, APPLIED], out[k, BUS], out[k, CURRENT] = u, bus, current


def correct_state(state: Array, ahead: float, faster: float, trust: Array) -> None:
    """Kalman correction: move the state by the gain times the innovation.

    ``trust`` (4,) is the share of ``ahead``, then of ``faster``, for the position, then the same
    for the velocity.
    """
    way, speed = 0.0, 0.0
    if not math.isnan(ahead):
        way, speed = trust[0] * ahead, trust[2] * ahead
    if not math.isnan(faster):
        way, speed = way + trust[1] * faster, speed + trust[3] * faster
    state[X] += way
    state[Y] += way
    state[V] += speed
    state[W] += speed


def find_step_end(on: Numbers, p: Numbers, now: float, after: float, clock: float) -> float:
    """[s] time at which steps must end: ``after``, or the next change of an effect."""
    when = now + next_change(on, p, clock) - clock
    return when if now + NONE < when < after else after


def count_steps(span: float, steps: Array, v: float, volts: float, c: Numbers) -> float:
    """Number of steps of a time span [s].

    More where it moves fast and positions matter, or where its speed changes fast and speeds do.
    """
    longest = steps[LONGEST]
    if steps[ALONG] < math.inf:
        most = max(abs(v), abs(volts) / c[KV])
        fast = min(abs(v) + span * abs(volts) / c[KA], most)
        if fast * longest > steps[ALONG]:
            longest = max(steps[ALONG] / fast, steps[LEAST])
    if steps[FASTER] < math.inf:
        rate = abs(volts - c[KV] * v) / c[KA]
        if rate * longest > steps[FASTER]:
            longest = max(steps[FASTER] / rate, steps[LEAST])
    return float(max(math.ceil(span / longest - 1e-9), 1))


def compute_voltage_slope(time: Array, slides: Array, command: int) -> float:
    """[V/s] slope of a command's voltage; 0 where it is held."""
    if command < 0 or command + 1 >= time.size or slides[command] == 0.0:
        return 0.0
    return float(slides[command] / (time[command + 1] - time[command]))


def step_run(
    time: Array, asked: Array, slides: Array, state: Array, c: Numbers, w: Numbers, on: Numbers,
    p: Numbers, memory: Array, ways: Array, began: float, late: float, steps: Array, plain: bool,
    measured: Array, trust: Array, errors: Array, out: Array,
) -> None:  # fmt: skip
    """Simulate one run into ``out``; ``state`` and ``memory`` hold its end.

    A command holds from its sample until the next, or changes linearly by ``slides`` [V]. It comes
    ``late`` [s] later than the effects delay it; until the first has come, a mechanism at rest is
    held there, by a stop or a brake. ``measured`` (n, 2) are positions and velocities that correct
    the motion by the Kalman gains ``trust`` (n, 4), or (1, 4) for all, nan where there is none;
    the innovations go into ``errors`` (n, 2). Without rows the simulation is open loop. ``steps``
    limits a step: longest [s], longest way [unit], shortest [s], and largest change of speed
    [unit/s]. ``ways`` is room for the tables of ``two_body_modes.py``: of one model only, and empty
    at first.
    """
    lag = command_delay(on, p) + late
    n = time.size
    command = -1  # the last one that has arrived
    rests = state[V] == 0.0 and state[W] == 0.0
    ka = c[KA] + added_inertia(on, p, began)
    for k in range(n):
        now = time[k]
        while command + 1 < n and time[command + 1] + lag <= now + 1e-12:
            command += 1
        record_sample(out, k, state, w, asked[k], began + now - time[0])
        out[k, EXPECTED] = state[X]
        out[k, SEEN] = transform_velocity(on, p, k, time, out[:, POSITION], out[:, VELOCITY])
        if measured.shape[0] > 0:
            ahead, faster = measured[k, 0] - state[X], measured[k, 1] - out[k, SEEN]
            errors[k, 0], errors[k, 1] = ahead, faster
            correct_state(state, ahead, faster, trust[min(k, trust.shape[0] - 1)])
            out[k, POSITION], out[k, VELOCITY] = state[X], state[V]
            out[k, LOAD_POSITION] = state[Y]
        if k == n - 1:
            break
        while now < time[k + 1] - 1e-12:
            arrives = time[command + 1] + lag if command + 1 < n else math.inf
            after = find_step_end(on, p, now, min(time[k + 1], arrives), began + now - time[0])
            if command < 0 and rests:
                state[V] = state[W] = 0.0  # whatever a measurement made of it
            else:
                volts = asked[command] if command >= 0 else 0.0
                slope = compute_voltage_slope(time, slides, command)
                if slope != 0.0:
                    volts += slope * (now - time[command] - lag)
                count = count_steps(after - now, steps, state[V], volts, c)
                count = max(count, SLIDING) if slope != 0.0 else count
                dt = (after - now) / count
                for i in range(int(count)):
                    mean = volts + (i + 0.5) * slope * dt
                    clock = began + now + (i + 0.5) * dt - time[0]
                    ka = advance_step(state, c, w, on, p, memory, ways, mean, clock, dt, plain, ka)
            now = after
            while command + 1 < n and time[command + 1] + lag <= now + 1e-12:
                command += 1


def step_runs(
    edges: Array, time: Array, asked: Array, slides: Array, bodies: Array, low: Array,
    high: Array, frictions: Array, run_lags: Array, memory_groups: Array, c: Numbers, w: Numbers,
    on: Numbers, p: Numbers, memory: Array, ways: Array, began: Array, steps: Array, plain: bool,
    measured: Array, trust: Array, errors: Array, out: Array,
) -> None:  # fmt: skip
    """Simulate runs that are stored one after another.

    Run k has the samples from ``edges[k]`` to ``edges[k + 1]``. It begins in the state
    ``bodies[k]``, at ``began[k]`` [s] of the clock, and its travel ends at ``low[k]`` and
    ``high[k]``. Its dry friction is ``frictions[k]`` [V] larger than kS, and its commands are
    ``run_lags[k]`` [s] later than the effects delay them. The memory of effects is kept between
    runs with the same number in ``memory_groups``.
    """
    for k in range(began.size):
        first, last = int(edges[k]), int(edges[k + 1])
        if k > 0 and memory_groups[k] != memory_groups[k - 1]:
            for i in range(memory.size):
                memory[i] = 0.0
        lead, left = measured, errors
        if measured.shape[0] > 0:
            lead, left = measured[first:last], errors[first:last]
        gains = trust[first:last] if trust.shape[0] > 1 else trust
        step_run(
            time[first:last], asked[first:last], slides[first:last], bodies[k],
            bound_travel(c, low[k], high[k], frictions[k]), w, on, p, memory, ways, began[k],
            run_lags[k], steps, plain, lead, gains, left, out[first:last],
        )  # fmt: skip


def allocate_output(n: int) -> Array:
    """Allocate the output array of ``move`` for ``n`` samples."""
    return np.empty((n, 8))
