"""The integrator: simulate a model under a voltage, sample by sample.

The state of one body (``one_body.py``), of a motor and its load (``two_bodies.py``) or of a robot
on slipping wheels (``slipping_wheels.py``) is advanced in steps. Between steps it handles changes
of inertia, brownouts, the sensor's velocity and the corrections of the Kalman filter.

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
"""Columns of the output. With a Kalman filter, position, velocity and load position are after the
correction; the expected position and the velocity that the sensor reports are before it."""


SHORTEST_STEP = 1e-9  # [s] a shorter step is not taken
RAMP_STEPS = 4.0  # steps of a sample in which the voltage changes: a sixteenth of one step's error
LONGEST, ALONG, LEAST, FASTER = range(4)  # places in ``steps``: [s], [unit] of way, [s], [unit/s]


def advance_step(
    state: Array, c: Numbers, w: Numbers, on: Numbers, p: Numbers, memory: Array, tables: Array,
    commanded: float, clock: float, dt: float, base_only: bool, ka: float,
) -> float:  # fmt: skip
    """Advance the state by one step; returns the inertia [V·s²/unit] during it.

    Added inertia that was at rest shares the momentum. Removed inertia takes its own along.
    """
    heavy = c[KA] + added_inertia(on, p, clock)
    if heavy > ka:
        kept = 1.0 - impact(on, p) * (1.0 - ka / heavy)
        state[V] *= kept
        state[W] *= kept
    off = clock < state[OFF_UNTIL]
    if w[REST] != 0.0 and not off:
        u = limit_voltage(w, commanded, state[V])
        bus = compute_bus_voltage(w, u, (u - w[EMF] * state[V]) / w[OHM])
        if bus < w[STOP]:  # from the next step on
            state[OFF_UNTIL] = clock + 0.5 * dt + CUT
    if grip_limit(on, p) < math.inf:
        u = step_slipping_wheels(state, c, w, on, p, memory, commanded, off, heavy, dt)
    elif motor_inertia_share(on, p) > 0.0:
        u = step_two_bodies(state, c, w, on, p, memory, tables, commanded, off, heavy, dt)
    else:
        u = step_one_body(state, c, w, on, p, memory, commanded, off, heavy, dt, base_only)
    update_memory(on, p, memory, dt, u, state[V], c[KV])
    return float(heavy)


def record_sample(
    out: Array, k: int, state: Array, w: Numbers, commanded: float, clock: float
) -> None:
    """Write the true state at sample ``k`` into the output; sensor readings follow later."""
    out[k, POSITION], out[k, VELOCITY] = state[X], state[V]
    out[k, LOAD_POSITION] = state[Y]
    off = clock < state[OFF_UNTIL]
    u = limit_voltage(w, 0.0 if off else commanded, state[V])
    current, bus = 0.0, 0.0
    if w[REST] != 0.0:
        current = (u - w[EMF] * state[V]) / w[OHM]
        bus = compute_bus_voltage(w, u, current)
    out[k, APPLIED], out[k, BUS], out[k, CURRENT] = u, bus, current


def correct_state(state: Array, error_x: float, error_v: float, gain: Array) -> None:
    """Kalman correction: add the gain times the innovation to the state, motor and load alike.

    ``gain`` (4,) is the (2, 2) Kalman gain, row by row, for the innovations of position and
    velocity; an innovation that is nan corrects nothing.
    """
    dx, dv = 0.0, 0.0
    if not math.isnan(error_x):
        dx, dv = gain[0] * error_x, gain[2] * error_x
    if not math.isnan(error_v):
        dx, dv = dx + gain[1] * error_v, dv + gain[3] * error_v
    state[X] += dx
    state[Y] += dx
    state[V] += dv
    state[W] += dv


def find_step_end(on: Numbers, p: Numbers, now: float, after: float, clock: float) -> float:
    """[s] time at which a step must end: ``after``, or the next change of inertia before it."""
    when = now + next_change(on, p, clock) - clock
    return when if now + SHORTEST_STEP < when < after else after


def count_steps(span: float, steps: Array, v: float, volts: float, c: Numbers) -> float:
    """Number of steps into which a time span [s] is divided.

    There are more where it moves fast through an effect that depends on position, or where its
    speed changes fast through one that depends on speed.
    """
    longest = steps[LONGEST]
    if steps[ALONG] < math.inf:
        limit = max(abs(v), abs(volts) / c[KV])
        fast = min(abs(v) + span * abs(volts) / c[KA], limit)
        if fast * longest > steps[ALONG]:
            longest = max(steps[ALONG] / fast, steps[LEAST])
    if steps[FASTER] < math.inf:
        rate = abs(volts - c[KV] * v) / c[KA]
        if rate * longest > steps[FASTER]:
            longest = max(steps[FASTER] / rate, steps[LEAST])
    return float(max(math.ceil(span / longest - 1e-9), 1))


def compute_voltage_slope(time: Array, slides: Array, command: int) -> float:
    """[V/s] slope of the voltage after sample ``command``; 0 if it is held."""
    if command < 0 or command + 1 >= time.size or slides[command] == 0.0:
        return 0.0
    return float(slides[command] / (time[command + 1] - time[command]))


def step_run(
    time: Array, commanded: Array, slides: Array, state: Array, c: Numbers, w: Numbers, on: Numbers,
    p: Numbers, memory: Array, tables: Array, start_time: float, extra_lag: float, steps: Array,
    base_only: bool, measured: Array, kalman_gains: Array, errors: Array, out: Array,
) -> None:  # fmt: skip
    """Simulate one run into ``out`` (n, 8); ``state`` and ``memory`` become those at its end.

    The voltage ``commanded`` (n,) [V] is held from each sample to the next, or changes linearly by
    ``slides`` (n,) [V]. It arrives ``extra_lag`` [s] later than the effects delay it; until the
    first command arrives, a mechanism at rest is held there, by a stop or a brake. ``measured``
    (n, 2) are positions and velocities for the Kalman filter, nan where there is none, with the
    gains ``kalman_gains`` (n, 4), or (1, 4) for all; the innovations go into ``errors`` (n, 2).
    With (0, 2) the simulation is open loop. ``steps`` (4,) limits a step: longest [s], longest way
    [unit], shortest [s], and largest change of speed [unit/s]. ``tables`` is the cache of
    ``two_body_modes.py`` for one model, zeros at first.
    """
    lag = command_delay(on, p) + extra_lag
    n = time.size
    command = -1  # index of the last command that has arrived
    rests = state[V] == 0.0 and state[W] == 0.0
    ka = c[KA] + added_inertia(on, p, start_time)
    for k in range(n):
        now = time[k]
        while command + 1 < n and time[command + 1] + lag <= now + 1e-12:
            command += 1
        record_sample(out, k, state, w, commanded[k], start_time + now - time[0])
        out[k, EXPECTED] = state[X]
        out[k, SEEN] = transform_velocity(on, p, k, time, out[:, POSITION], out[:, VELOCITY])
        if measured.shape[0] > 0:
            error_x, error_v = measured[k, 0] - state[X], measured[k, 1] - out[k, SEEN]
            errors[k, 0], errors[k, 1] = error_x, error_v
            gain = kalman_gains[min(k, kalman_gains.shape[0] - 1)]
            correct_state(state, error_x, error_v, gain)
            out[k, POSITION], out[k, VELOCITY] = state[X], state[V]
            out[k, LOAD_POSITION] = state[Y]
        if k == n - 1:
            break
        while now < time[k + 1] - 1e-12:
            arrives = time[command + 1] + lag if command + 1 < n else math.inf
            clock = start_time + now - time[0]
            after = find_step_end(on, p, now, min(time[k + 1], arrives), clock)
            if command < 0 and rests:
                state[V] = state[W] = 0.0  # undo a correction of the filter
            else:
                volts = commanded[command] if command >= 0 else 0.0
                slope = compute_voltage_slope(time, slides, command)
                if slope != 0.0:
                    volts += slope * (now - time[command] - lag)
                count = count_steps(after - now, steps, state[V], volts, c)
                count = max(count, RAMP_STEPS) if slope != 0.0 else count
                dt = (after - now) / count
                for i in range(int(count)):
                    mean = volts + (i + 0.5) * slope * dt
                    clock = start_time + now + (i + 0.5) * dt - time[0]
                    ka = advance_step(
                        state, c, w, on, p, memory, tables, mean, clock, dt, base_only, ka
                    )
            now = after
            while command + 1 < n and time[command + 1] + lag <= now + 1e-12:
                command += 1


def step_runs(
    edges: Array, time: Array, commanded: Array, slides: Array, bodies: Array, low: Array,
    high: Array, frictions: Array, run_lags: Array, memory_groups: Array, c: Numbers, w: Numbers,
    on: Numbers, p: Numbers, memory: Array, tables: Array, start_times: Array, steps: Array,
    base_only: bool, measured: Array, kalman_gains: Array, errors: Array, out: Array,
) -> None:  # fmt: skip
    """Simulate runs that are stored one after another.

    Run k has the samples from ``edges[k]`` to ``edges[k + 1]``. It begins in the state
    ``bodies[k]``, at ``start_times[k]`` [s] of the clock, and its travel ends at ``low[k]`` and
    ``high[k]``. Its dry friction is ``frictions[k]`` [V] larger than kS, and its commands are
    ``run_lags[k]`` [s] later than the effects delay them. The memory of effects is kept between
    consecutive runs with the same number in ``memory_groups``. The other arguments are those of
    ``step_run``, for all runs together.
    """
    for k in range(start_times.size):
        first, last = int(edges[k]), int(edges[k + 1])
        if k > 0 and memory_groups[k] != memory_groups[k - 1]:
            for i in range(memory.size):
                memory[i] = 0.0
        own_measured, own_errors = measured, errors
        if measured.shape[0] > 0:
            own_measured, own_errors = measured[first:last], errors[first:last]
        gains = kalman_gains[first:last] if kalman_gains.shape[0] > 1 else kalman_gains
        step_run(
            time[first:last], commanded[first:last], slides[first:last], bodies[k],
            bound_travel(c, low[k], high[k], frictions[k]), w, on, p, memory, tables,
            start_times[k], run_lags[k], steps, base_only, own_measured, gains, own_errors,
            out[first:last],
        )  # fmt: skip


def allocate_output(n: int) -> Array:
    """(n, 8) uninitialized output array for ``n`` samples, with the columns above."""
    return np.empty((n, 8))
