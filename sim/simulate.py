"""Run a mechanism under a routine and record what its sensor says.

    kA·v' = V - kV·v - kS·sgn(v)          at rest it stays at rest while |V| ≤ kS

The voltage is held between two loops, so each stretch has an exact solution, and friction's change
of sign is met at its exact time: no step is too long.
"""

import math
from collections.abc import Mapping

import numpy as np

from sim.errors import BadRequest
from sim.log import Array, Log, Run
from sim.mechanism import Mechanism, Sensor
from sim.routine import LOOPS_BEFORE_DRIVE, Routine

PAUSE = 1.0  # [s] between two tests, in which the mechanism comes to rest
FASTEST, SLOWEST = 0.0005, 0.5  # [s] loop periods that make sense
FEWEST = 10  # [samples] a shorter test has nothing to say


def simulate(
    mechanism: Mechanism, routine: Routine, *, rng: np.random.Generator, period: float = 0.02
) -> Log:
    """Run the tests of a routine one after another.

    Args:
        mechanism: what is tested. A test stops early where its travel ends, as a person at the
            controller would stop it.
        routine: which voltages.
        rng: the source of noise and jitter; the same state gives the same log.
        period: [s] of the robot program's loop.

    Returns:
        The log, in the unit the mechanism's team thinks in.

    Raises:
        BadRequest: a period no robot has, or a test that is over before it has moved.
    """
    if not FASTEST <= period <= SLOWEST:
        raise BadRequest(
            f"a period of {period:g} s",
            advice=f"Choose {FASTEST:g} to {SLOWEST:g} s; a robot program loops every 0.02 s.",
        )
    runs = []
    start, position = PAUSE, 0.0
    for test in routine.tests:
        time = _loops(routine.timeout, period=period, jitter=mechanism.sensor.jitter, rng=rng)
        voltage = np.array([routine.voltage(test, t) for t in time.tolist()])
        moved, velocity = motion(mechanism.gains, time=time, voltage=voltage)
        end = _end_of_travel(moved, travel=mechanism.travel)
        if end < FEWEST:
            raise BadRequest(
                f"{test} lasts {end} loops", advice="Ask for a longer timeout or a shorter period."
            )
        time, voltage, moved, velocity = time[:end], voltage[:end], moved[:end], velocity[:end]
        seen = read(mechanism.sensor, position=position + moved, velocity=velocity, rng=rng)
        runs.append(Run(test, start + time, voltage, *seen))
        start, position = start + float(time[-1]) + PAUSE, position + float(moved[-1])
    return Log(tuple(runs), units=mechanism.units, mechanism=mechanism.name, type=mechanism.type)


def motion(gains: Mapping[str, float], *, time: Array, voltage: Array) -> tuple[Array, Array]:
    """Move from rest at zero.

    Args:
        gains: kS [V], kV [V·s/unit], kA [V·s²/unit].
        time: (n,) [s].
        voltage: (n,) [V], each held until the next time.

    Returns:
        Position (n,) and velocity (n,), before the sensor.
    """
    x = v = 0.0
    positions, velocities = [x], [v]
    for dt, volts in zip(np.diff(time).tolist(), voltage.tolist(), strict=False):
        x, v = _glide(x, v, volts=volts, dt=dt, gains=gains)
        positions.append(x)
        velocities.append(v)
    return np.array(positions), np.array(velocities)


def read(
    sensor: Sensor, *, position: Array, velocity: Array, rng: np.random.Generator
) -> tuple[Array, Array]:
    """What a sensor says of a motion.

    Args:
        sensor: the sensor.
        position: (n,) [m or rad].
        velocity: (n,) [m/s or rad/s].
        rng: the source of noise.

    Returns:
        Position (n,) in steps of the resolution, and velocity (n,) with noise unless at rest.
    """
    noise = sensor.velocity_noise * -np.expm1(-np.abs(velocity) / sensor.noise_speed)
    noisy = velocity + noise * rng.standard_normal(velocity.size)
    return np.round(position / sensor.resolution) * sensor.resolution, noisy


def _loops(timeout: float, *, period: float, jitter: float, rng: np.random.Generator) -> Array:
    """[s] when a test drives: loops from the second on, each a little early or late."""
    count = math.floor(timeout / period + 1e-9) - LOOPS_BEFORE_DRIVE + 1
    if count < FEWEST:
        raise BadRequest(
            f"a timeout of {timeout:g} s has {max(count, 0)} loops of {period:g} s",
            advice="Ask for a longer timeout or a shorter period.",
        )
    late = np.clip(jitter * rng.standard_normal(count), -0.2 * period, 0.2 * period)
    return np.asarray((np.arange(count) + LOOPS_BEFORE_DRIVE) * period + late)


def _end_of_travel(moved: Array, *, travel: float | None) -> int:
    """How many samples are within the travel."""
    beyond = np.abs(moved) > (math.inf if travel is None else travel)
    return int(np.argmax(beyond)) if beyond.any() else int(moved.size)


def _glide(
    x: float, v: float, *, volts: float, dt: float, gains: Mapping[str, float]
) -> tuple[float, float]:
    """Position and velocity after a time under a constant voltage, turning points included."""
    ks, kv, ka = gains["kS"], gains["kV"], gains["kA"]
    rate = kv / ka
    while dt > 0.0:
        if v == 0.0:
            if abs(volts) <= ks:
                return x, v
            sign = math.copysign(1.0, volts)
        else:
            sign = math.copysign(1.0, v)
        toward = (volts - sign * ks) / kv  # the speed at which this stretch would end
        turns = v != 0.0 and toward * sign < 0.0
        until = math.log1p(-v / toward) / rate if turns else math.inf
        step = min(dt, until)
        decay = math.exp(-rate * step)
        x += toward * step + (v - toward) * (1.0 - decay) / rate
        v = 0.0 if until <= dt else toward + (v - toward) * decay
        dt -= step
    return x, v
