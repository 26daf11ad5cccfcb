"""Simulate a mechanism under a routine and record the readings of its sensor.

    kA·v' = u - kV·v - kS·sgn(v) - gravity - hidden effects

A test begins at rest. If there are stops, a forward test begins at the lower and a reverse test
near the upper one, as if the driver had moved it back between tests. The driver also ends a test
shortly before the end of the travel.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from sim.bench.mechanism import Mechanism
from sim.bench.routine import LOOPS_BEFORE_DRIVE, Routine
from sim.bench.sensor_model import read_sensor
from sim.bench.slip import compute_slip_voltage, make_slip_effect, wheels_slip
from sim.core.doubt import Doubt
from sim.core.errors import BadRequest
from sim.core.log import Array, Log, Run
from sim.physics.engine import State, Track, simulate_run
from sim.physics.engine.one_body import OFF_UNTIL
from sim.physics.model import Model
from sim.physics.replay import cool_down

__all__ = ["move_gains_only", "read_sensor", "simulate"]

PAUSE = 1.0  # [s] between two tests, in which the mechanism comes to rest
FASTEST, SLOWEST = 0.0005, 0.5  # [s] limits of the loop period
DIGITS = 6  # of a time [s]: a roboRIO counts microseconds
MIN_SAMPLES = 10  # [samples] of a test
STEPS_PER_LOOP = 8  # recorded steps of a loop, for a sensor that measures between loops
MARGIN = 0.04  # [share of the travel] distance to a stop at which a test ends


def simulate(
    mechanism: Mechanism,
    routine: Routine,
    *,
    rng: np.random.Generator,
    period: float = 0.02,
    duty_cycle: bool = False,
    electrical: bool = False,
) -> Log:
    """Run the tests of a routine one after another.

    Args:
        mechanism: the mechanism.
        routine: the tests.
        rng: random generator of noise and jitter; the same state gives the same log.
        period: [s] loop period of the robot program.
        duty_cycle: whether the program commands a duty cycle, ``set(volts / 12)``, without voltage
            compensation, instead of a voltage.
        electrical: whether to record the current of one motor and the battery voltage, too.

    Returns:
        The log, with the voltage at the motors.

    Raises:
        BadRequest: a period out of range, or a test that is too short.

    Examples:
        >>> from sim.bench.mechanisms import MECHANISMS
        >>> log = simulate(MECHANISMS["elevator"], Routine(), rng=np.random.default_rng(0))
        >>> [run.test for run in log.runs][:2]
        ['quasistatic-forward', 'quasistatic-reverse']
    """
    _check_period(period)
    model, slips = mechanism.model, make_slip_effect(mechanism)
    wires = make_power_path_array(mechanism, duty_cycle=duty_cycle)
    parts = STEPS_PER_LOOP if mechanism.sensor.latency or mechanism.sensor.frame else 1
    runs, coarse = list[Run](), slice(None, None, parts)
    state, start, last, cut, gripped = State(), PAUSE, 0.0, False, False
    for test in routine.tests:
        time = _make_loop_times(mechanism, routine, test, period=period, rng=rng)
        voltage = np.array([routine.command_voltage(test, t) for t in time.tolist()])
        cut = cut or _is_cut(state)
        state.clock = float(start + time[0] - runs[0].time[0]) if runs else 0.0  # as in the log
        begin, active = _at_rest(state, _find_start(mechanism, test, last)), model
        time, voltage = _divide_loops(time, voltage, parts)
        track, state = _simulate_motion(active, time, voltage, begin=begin, wires=wires)
        if wheels_slip(mechanism, track):
            active, gripped = (model + slips, gripped) if slips else (model, True)
            track, state = _simulate_motion(active, time, voltage, begin=begin, wires=wires)
        end = (_find_end(track.select(coarse), mechanism, test=test) - 1) * parts + 1
        time, voltage = time[:end], voltage[:end]
        if end < track.position.size and state.memory.any():  # without heating after the end
            track, state = _simulate_motion(active, time, voltage, begin=begin, wires=wires)
        loops, seen = time[coarse], _delay_limits(track.select(slice(end)), voltage, time, model)
        run = _record_run(mechanism, test, time, seen, loops=loops, rng=rng, electrical=electrical)
        runs.append(replace(run, time=np.round(start + loops, DIGITS)))
        cool_down(state, model, PAUSE)
        start, last = start + float(time[-1]) + PAUSE, float(track.position[end - 1])
    log = Log(tuple(runs), units=mechanism.units, mechanism=mechanism.name, type=mechanism.type)
    return log.add_doubts(*_make_doubts(mechanism, cut=cut or _is_cut(state), gripped=gripped))


def _at_rest(state: State, position: float) -> State:
    """The state at rest at a position [m or rad], with the memory of effects."""
    return replace(_copy_state(state), body=State.cold_at(position).body)


def _simulate_motion(
    model: Model, time: Array, voltage: Array, *, begin: State, wires: Array
) -> tuple[Track, State]:
    """The motion from a state, which is not changed, and the state after it."""
    state = _copy_state(begin)
    track = simulate_run(model, time=time, voltage=voltage, state=state, wires=wires)
    return track, state


def _copy_state(state: State) -> State:
    """An independent copy of a state."""
    return replace(state, body=state.body.copy(), memory=state.memory.copy())


def _is_cut(state: State) -> bool:
    """Whether the robot controller has disabled the motors in a brownout."""
    return bool(state.body[OFF_UNTIL] > 0.0)


def _delay_limits(track: Track, voltage: Array, time: Array, model: Model) -> Track:
    """The motion with battery and limits acting after a hidden delay, as the motors do.

    The delay lies between the log and the motion, so battery and limits reduce the voltage of one
    sample by what the motors lose when it acts, a delay later.
    """
    lag = sum(part.parameters["lag"] for part in model.parts if part.effect == "delay")
    lost = np.interp(time + lag, time, track.applied - voltage)
    return replace(track, applied=voltage + lost)


def _record_run(
    mechanism: Mechanism, test: str, time: Array, track: Track,
    *, loops: Array, rng: np.random.Generator, electrical: bool,
) -> Run:  # fmt: skip
    """The run as the robot program logs it, at the times ``loops``."""
    seen = read_sensor(
        mechanism.sensor, position=track.position, velocity=track.seen, time=time, read_at=loops,
        rng=rng,
    )  # fmt: skip
    logged = track.select(slice(None, None, (time.size - 1) // (loops.size - 1)))
    extra = {"current": logged.current, "bus_voltage": logged.bus} if electrical else {}
    return Run(test, loops, logged.applied, *seen, **extra)


def _divide_loops(time: Array, voltage: Array, parts: int) -> tuple[Array, Array]:
    """Times of equal parts of each loop, and the voltages, which are held in a loop."""
    if parts == 1:
        return time, voltage
    share = np.arange(parts) / parts
    inner = (time[:-1, None] + share * np.diff(time)[:, None]).ravel()
    held = np.repeat(voltage[:-1], parts)
    return np.append(inner, time[-1]), np.append(held, voltage[-1])


def _check_period(period: float) -> None:
    """Refuse a loop period out of range."""
    if not FASTEST <= period <= SLOWEST:
        raise BadRequest(
            f"a loop period of {period:g} s is out of range",
            advice=f"Choose {FASTEST:g} to {SLOWEST:g} s; a robot program loops every 0.02 s.",
        )


def _make_doubts(mechanism: Mechanism, *, cut: bool, gripped: bool) -> Iterator[Doubt]:
    """Warnings about a simulated log: a brownout, and wheel slip that was left out."""
    if gripped:
        yield Doubt(
            "slip-left-out",
            f"Here the wheels would slip above {compute_slip_voltage(mechanism):.1f} V from "
            "standstill. Beside a hidden joint (backlash, compliance), the simulation leaves out "
            "the slip. Use a smaller step, or hide no joint.",
        )
    if cut:
        yield Doubt(
            "brownout",
            f"The battery falls below {mechanism.brownout:g} V, and the robot controller "
            "turns the motors off again and again. Use a smaller step or a better battery.",
        )


def make_power_path_array(mechanism: Mechanism, *, duty_cycle: bool = False) -> Array:
    """(9,) battery, wiring and limits, in the order of ``sim.physics.engine.power_path``."""
    return np.array(
        [
            mechanism.battery.rest,
            mechanism.battery.resistance,
            mechanism.motor_count,
            mechanism.motor.resistance,
            mechanism.motor.back_emf * mechanism.ratio / mechanism.radius,
            mechanism.stator,
            mechanism.supply,
            mechanism.brownout,
            float(duty_cycle),
        ]
    )


def move_gains_only(
    gains: Mapping[str, float], *, time: Array, voltage: Array
) -> tuple[Array, Array]:
    """Position and velocity under a voltage from rest at zero, with kS, kV and kA alone.

    Args:
        gains: kS [V], kV [V·s/unit], kA [V·s²/unit].
        time: (n,) [s].
        voltage: (n,) [V], each held until the next time.

    Returns:
        Position (n,) and velocity (n,), before the sensor.
    """
    track = simulate_run(Model("simple", gains), time=time, voltage=voltage, state=State())
    return track.position, track.velocity


def _make_loop_times(
    mechanism: Mechanism, routine: Routine, test: str, *, period: float, rng: np.random.Generator
) -> Array:
    """[s] times of the loops with a voltage, from the second on, with jitter."""
    timeout, jitter = routine.find_longest_duration(test), mechanism.sensor.jitter
    count = math.floor(timeout / period + 1e-9) - LOOPS_BEFORE_DRIVE + 1
    if count < MIN_SAMPLES:
        raise BadRequest(
            f"a timeout of {timeout:g} s is too short: {max(count, 0)} loops of {period:g} s",
            advice="Ask for a longer timeout or a shorter period.",
        )
    late = np.clip(jitter * rng.standard_normal(count), -0.2 * period, 0.2 * period)
    times = (np.arange(count) + LOOPS_BEFORE_DRIVE) * period + late
    return np.asarray(np.round(times, DIGITS))


def _find_start(mechanism: Mechanism, test: str, last: float) -> float:
    """[m or rad] position at which a test begins: a stop, or the end of the last test."""
    if mechanism.stops is None:
        return last
    low, high = mechanism.stops
    return low if test.endswith("forward") else high - 0.5 * MARGIN * (high - low)


def _find_end(track: Track, mechanism: Mechanism, *, test: str) -> int:
    """Number of samples until the end of the test.

    Raises:
        BadRequest: there are too few.
    """
    end = int(track.position.size)
    if mechanism.travel is not None:
        beyond = _mark_beyond(track, mechanism, test=test)
        end = int(np.argmax(beyond)) if beyond.any() else end
    if end < MIN_SAMPLES:
        raise BadRequest(
            f"{test} is too short: it lasts only {end} loops",
            advice="Ask for a longer timeout, a shorter period or a smaller step.",
        )
    return end


def _mark_beyond(track: Track, mechanism: Mechanism, *, test: str) -> NDArray[np.bool_]:
    """(n,) whether it has reached an end of its travel."""
    if mechanism.stops is None:
        travel = math.inf if mechanism.travel is None else mechanism.travel
        return np.asarray(np.abs(track.position - track.position[0]) > travel)
    low, high = mechanism.stops
    margin = MARGIN * (high - low)
    far, near = (track.position > high - margin), (track.position < low + margin)
    if test.endswith("reverse"):
        far, near = near, far
    left = np.maximum.accumulate(~near)  # an end near the start counts after leaving it
    return np.asarray(far | (near & left))
