"""What reaches the motors when a program asks for a share of the battery instead of a voltage.

    D = V/12                          the duty cycle that ``set(volts / 12)`` asks for
    Vbat = V0 - Rb·D·n·I              what the battery gives while the motors draw from it
    I = (D·Vbat - Ke·G/r·v) / R       the current of one motor at speed v

so that, with k = n/R and the back-EMF e = Ke·G/r·v,

    Vbat = (V0 + Rb·k·D·e) / (1 + Rb·k·D²)        and the motors get D·Vbat, not V
"""

from dataclasses import dataclass, replace

import numpy as np

from sim.doubt import Doubt
from sim.errors import BadRequest
from sim.log import Array, Log, Run
from sim.mechanism import Mechanism
from sim.motors import NOMINAL
from sim.routine import Routine
from sim.simulate import motion, read, simulate

FLATTEST, FULLEST = 9.0, 14.0  # [V] at rest: outside of this a robot does not start a test
WORST = 0.1  # [Ω] of a battery that still turns a motor
BROWNOUT = 6.75  # [V] below which a roboRIO 2 stops the motors unless told otherwise
SETTLED = 1e-6  # [V] change of the battery's voltage below which speed and current agree
ROUNDS = 300  # the worst battery at full voltage needs about 170


@dataclass(frozen=True)
class Battery:
    """A battery under load.

    Args:
        rest: [V] with nothing drawn from it.
        resistance: [Ω] of battery and wires together.

    Raises:
        BadRequest: no battery a robot would start with.
    """

    rest: float = 12.6
    resistance: float = 0.020

    def __post_init__(self) -> None:
        if not (FLATTEST <= self.rest <= FULLEST and 0.0 <= self.resistance <= WORST):
            raise BadRequest(
                f"a battery of {self.rest:g} V with {self.resistance:g} Ω",
                advice=f"Choose {FLATTEST:g} to {FULLEST:g} V, and 0 to {WORST:g} Ω. "
                "A good one has 12.6 V and 0.02 Ω.",
            )


def by_duty_cycle(
    mechanism: Mechanism,
    routine: Routine,
    *,
    rng: np.random.Generator,
    battery: Battery = Battery(),
    period: float = 0.02,
) -> Log:
    """Run a routine whose drive callback says ``motor.set(volts / 12)``.

    Args:
        mechanism: what is tested.
        routine: which voltages are asked for.
        rng: the source of noise and jitter.
        battery: what feeds it.
        period: [s] of the robot program's loop.

    Returns:
        The log with the voltage that really reached the motors, and the battery's as
        ``bus_voltage``. What was asked for is 12 V times the first over the second. A battery
        that falls below ``BROWNOUT`` is a doubt: here it goes on.

    Raises:
        BadRequest: as for ``simulate``.
    """
    asked = simulate(mechanism, routine, rng=rng, period=period)
    runs, start = [], 0.0
    for run in asked.runs:
        bus, moved, velocity = _sag(run, mechanism, battery)
        end = run.time.size
        if mechanism.travel is not None and np.any(np.abs(moved) > mechanism.travel):
            end = int(np.argmax(np.abs(moved) > mechanism.travel))
        position, seen = read(
            mechanism.sensor, position=start + moved[:end], velocity=velocity[:end], rng=rng
        )
        duty = run.voltage[:end] / NOMINAL
        runs.append(
            Run(run.test, run.time[:end], duty * bus[:end], position, seen, bus_voltage=bus[:end])
        )
        start += float(moved[end - 1])
    log = replace(asked, runs=tuple(runs))
    lowest = min(float(np.min(bus)) for bus in (run.bus_voltage for run in runs) if bus is not None)
    return log.with_doubts(_brownout(lowest)) if lowest < BROWNOUT else log


def _brownout(lowest: float) -> Doubt:
    return Doubt(
        "brownout",
        f"The battery falls to {lowest:.1f} V. Below {BROWNOUT} V a real robot stops its motors, "
        "and here it does not. Use a smaller step or a better battery.",
    )


def _sag(run: Run, mechanism: Mechanism, battery: Battery) -> tuple[Array, Array, Array]:
    """Battery voltage (n,) [V], distance (n,) and velocity (n,), each true to the others.

    The battery's voltage needs the speed, and the speed the voltage: each is computed from the
    other in turn until they stay. Every round brings them closer, because a motor that is faster
    draws less.
    """
    motors = mechanism.motor_count / mechanism.motor.resistance
    per_speed = mechanism.motor.back_emf * mechanism.ratio / mechanism.radius
    duty = run.voltage / NOMINAL
    bus = np.full_like(duty, battery.rest)
    for _ in range(ROUNDS):
        moved, velocity = motion(mechanism.gains, time=run.time, voltage=duty * bus)
        load = battery.resistance * motors * duty
        after = (battery.rest + load * per_speed * velocity) / (1.0 + load * duty)
        change = float(np.max(np.abs(after - bus)))
        bus = after
        if change < SETTLED:
            break
    return bus, moved, velocity
