"""Simulate a mechanism under a routine and record what its sensor reports.

    kA·v' = u - kV·v - kS·sgn(v) - gravity - hidden effects

A test begins at rest: where there are stops, a forward test at the lower one and a reverse test
near the upper one, as someone who drives it back between tests would have it. Someone at the
controller also ends a test shortly before the end of the travel.
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
FASTEST, SLOWEST = 0.0005, 0.5  # [s] loop periods that make sense
FEWEST = 10  # [samples] a shorter test has nothing to say
BETWEEN = (
    8  # steps of a loop for a sensor that reads between loops: a line from loop to loop is late
)
MARGIN = 0.04  # [share of the travel] before a stop at which someone ends the test


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
        mechanism: what is tested.
        routine: which voltages.
        rng: the source of noise and jitter; the same state gives the same log.
        period: [s] of the robot program's loop.
        duty_cycle: the program asks for a share of the battery, ``set(volts / 12)``, and nothing
            makes up for what the battery has; without, for a voltage.
        electrical: record one motor's current and the battery's voltage, too.

    Returns:
        The log, in its team's unit, with the voltage that reached the motors.

    Raises:
        BadRequest: a period no robot has, or a test that is over before it has moved.

    Examples:
        >>> from sim.bench.mechanisms import MECHANISMS
        >>> log = simulate(MECHANISMS["elevator"], Routine(), rng=np.random.default_rng(0))
        >>> [run.test for run in log.runs][:2]
        ['quasistatic-forward', 'quasistatic-reverse']
    """
    _check_period(period)
    model, slips = mechanism.model, make_slip_effect(mechanism)
    wires = make_power_path_array(mechanism, duty_cycle=duty_cycle)
    parts = _steps_per_loop(mechanism)
    runs: list[Run] = []
    state, start, last, cut, gripped = State(), PAUSE, 0.0, False, False
    for test in routine.tests:
        time = _loop_times(mechanism, routine, test, period=period, rng=rng)
        voltage = np.array([routine.command_voltage(test, t) for t in time.tolist()])
        cut = cut or _is_cut(state)
        state.clock = float(start + time[0] - runs[0].time[0]) if runs else 0.0  # as the log says
        begun, moves = _at_rest(state, _begin(mechanism, test, last)), model
        time, voltage = _divide_loops(time, voltage, parts)
        track, state = _move(moves, time, voltage, begun=begun, wires=wires)
        if wheels_slip(mechanism, track):
            moves, gripped = (model + slips, gripped) if slips else (model, True)
            track, state = _move(moves, time, voltage, begun=begun, wires=wires)
        end = (_end(track.take_every(parts), mechanism, test=test) - 1) * parts + 1
        time, voltage = time[:end], voltage[:end]
        if end < track.position.size and state.memory.any():  # what was ended warms no motor
            track, state = _move(moves, time, voltage, begun=begun, wires=wires)
        loops, seen = time[::parts], track.truncate(end)
        run = _record_run(mechanism, test, time, seen, loops=loops, rng=rng, electrical=electrical)
        runs.append(replace(run, time=start + loops))
        cool_down(state, model, PAUSE)
        start, last = start + float(time[-1]) + PAUSE, float(track.position[end - 1])
    log = Log(tuple(runs), units=mechanism.units, mechanism=mechanism.name, type=mechanism.type)
    return log.add_doubts(*_doubts(mechanism, cut=cut or _is_cut(state), gripped=gripped))


def _at_rest(state: State, position: float) -> State:
    """The state at rest somewhere, with what a motor remembers."""
    return replace(_copy_state(state), body=State.cold_at(position).body)


def _move(
    model: Model, time: Array, voltage: Array, *, begun: State, wires: Array
) -> tuple[Track, State]:
    """The motion from a state, which stays as it is, and the state after it."""
    state = _copy_state(begun)
    track = simulate_run(model, time=time, voltage=voltage, state=state, wires=wires)
    return track, state


def _copy_state(state: State) -> State:
    """The same state, which may go on by itself."""
    return replace(state, body=state.body.copy(), memory=state.memory.copy())


def _is_cut(state: State) -> bool:
    """Whether the robot controller has taken the motors off."""
    return bool(state.body[OFF_UNTIL] > 0.0)


def _record_run(
    mechanism: Mechanism, test: str, time: Array, track: Track,
    *, loops: Array, rng: np.random.Generator, electrical: bool,
) -> Run:  # fmt: skip
    """The run as the robot program logs it, at the times ``loops``."""
    seen = read_sensor(
        mechanism.sensor, position=track.position, velocity=track.seen, time=time, read_at=loops,
        rng=rng,
    )  # fmt: skip
    logged = track.take_every((time.size - 1) // (loops.size - 1))
    extra = {"current": logged.current, "bus_voltage": logged.bus} if electrical else {}
    return Run(test, loops, logged.applied, *seen, **extra)


def _steps_per_loop(mechanism: Mechanism) -> int:
    """How many steps of a loop are simulated for what the sensor reads."""
    return BETWEEN if mechanism.sensor.latency or mechanism.sensor.frame else 1


def _divide_loops(time: Array, voltage: Array, parts: int) -> tuple[Array, Array]:
    """Times of equal parts of each loop, and the voltages that are held through them."""
    if parts == 1:
        return time, voltage
    share = np.arange(parts) / parts
    inner = (time[:-1, None] + share * np.diff(time)[:, None]).ravel()
    held = np.repeat(voltage[:-1], parts)
    return np.append(inner, time[-1]), np.append(held, voltage[-1])


def _check_period(period: float) -> None:
    if not FASTEST <= period <= SLOWEST:
        raise BadRequest(
            f"a period of {period:g} s",
            advice=f"Choose {FASTEST:g} to {SLOWEST:g} s; a robot program loops every 0.02 s.",
        )


def _doubts(mechanism: Mechanism, *, cut: bool, gripped: bool) -> Iterator[Doubt]:
    """What is odd about a log: motors that were cut off, and slip that was left out."""
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


def _loop_times(
    mechanism: Mechanism, routine: Routine, test: str, *, period: float, rng: np.random.Generator
) -> Array:
    """[s] when a test drives: loops from the second on, each a little early or late."""
    timeout, jitter = routine.find_longest_duration(test), mechanism.sensor.jitter
    count = math.floor(timeout / period + 1e-9) - LOOPS_BEFORE_DRIVE + 1
    if count < FEWEST:
        raise BadRequest(
            f"a timeout of {timeout:g} s has {max(count, 0)} loops of {period:g} s",
            advice="Ask for a longer timeout or a shorter period.",
        )
    late = np.clip(jitter * rng.standard_normal(count), -0.2 * period, 0.2 * period)
    return np.asarray((np.arange(count) + LOOPS_BEFORE_DRIVE) * period + late)


def _begin(mechanism: Mechanism, test: str, last: float) -> float:
    """[m or rad] where a test begins: at its end of the travel, or where the last one ended."""
    if mechanism.stops is None:
        return last
    low, high = mechanism.stops
    return low if test.endswith("forward") else high - 0.5 * MARGIN * (high - low)


def _end(track: Track, mechanism: Mechanism, *, test: str) -> int:
    """How many samples there are before someone ends the test.

    Raises:
        BadRequest: too few to see it move.
    """
    end = int(track.position.size)
    if mechanism.travel is not None:
        beyond = _beyond(track, mechanism, test=test)
        end = int(np.argmax(beyond)) if beyond.any() else end
    if end < FEWEST:
        raise BadRequest(
            f"{test} lasts {end} loops",
            advice="Ask for a longer timeout, a shorter period or a smaller step.",
        )
    return end


def _beyond(track: Track, mechanism: Mechanism, *, test: str) -> NDArray[np.bool_]:
    """(n,) where it has come to the end of its travel."""
    if mechanism.stops is None:
        travel = math.inf if mechanism.travel is None else mechanism.travel
        return np.asarray(np.abs(track.position - track.position[0]) > travel)
    low, high = mechanism.stops
    margin = MARGIN * (high - low)
    far, near = (track.position > high - margin), (track.position < low + margin)
    if test.endswith("reverse"):
        far, near = near, far
    left = np.maximum.accumulate(~near)  # back where it began, after it had left
    return np.asarray(far | (near & left))
