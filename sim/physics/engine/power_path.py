"""Battery, wiring and controller limits: the voltage that reaches the motor.

    I = (u - Ke·G/r·v) / R                  current of one motor at the voltage u
    bus = rest - Rb·n·I·u/bus               a controller draws the power u·I from the bus

so that bus = rest/2 + √(rest²/4 - Rb·n·u·I). u cannot exceed the bus voltage; the stator limit
bounds I, the supply limit I·u/bus. A program that commands a duty cycle D gets

    D·bus = D·(rest + Rb·n/R·D·Ke·G/r·v) / (1 + Rb·n/R·D²)

Below the brownout voltage the robot controller switches the motors off for ``CUT``, the time that
it takes to enable them again.
"""

import math

from sim.physics.engine.hooks import Numbers

REST, RB, MOTORS, OHM, EMF, STATOR, SUPPLY, STOP, DUTY = range(9)
"""Places in ``w``: battery at rest [V], its resistance [Ω], number of motors, resistance of one
[Ω], back-EMF constant [V·s/unit], stator and supply limit [A], brownout voltage [V], and whether
the command is a duty cycle. Without a battery, REST is 0."""

NOMINAL = 12.0  # [V] command of a duty cycle of 1

CUT = 0.02  # [s] the motors stay off: without them the battery recovers at once, and the enable
# signal comes every 20 ms


def compute_bus_voltage(w: Numbers, u: float, current: float) -> float:
    """[V] battery voltage while every motor draws ``current`` [A] at ``u`` [V]."""
    square = 0.25 * w[REST] * w[REST] - w[RB] * w[MOTORS] * u * current
    return float(0.5 * w[REST] + math.sqrt(max(square, 0.0)))


def limit_voltage(w: Numbers, commanded: float, v: float) -> float:
    """[V] voltage at the motors for a command [V] at a speed [unit/s], after all limits."""
    if w[REST] == 0.0:
        return commanded
    emf = w[EMF] * v
    if w[DUTY] != 0.0:
        duty = min(max(commanded / NOMINAL, -1.0), 1.0)
        load = w[RB] * w[MOTORS] / w[OHM] * duty
        commanded = duty * (w[REST] + load * emf) / (1.0 + load * duty)
    room = w[OHM] * w[STATOR]
    u = min(max(commanded, emf - room), emf + room)
    current = (u - emf) / w[OHM]
    if u * current <= 0.0:  # the motors brake, and charge the battery
        return float(min(max(u, -w[REST]), w[REST]))
    way = math.copysign(1.0, u)
    bus = compute_bus_voltage(w, u, current)
    if abs(u) > bus:  # the whole bus voltage is applied: bus = rest - Rb·n·(bus - emf)/R
        load = w[RB] * w[MOTORS] / w[OHM]
        bus = (w[REST] + load * way * emf) / (1.0 + load)
        u = way * bus
        current = (u - emf) / w[OHM]
    if u * current > w[SUPPLY] * bus:
        bus = w[REST] - w[RB] * w[MOTORS] * w[SUPPLY]
        if bus > 0.5 * w[REST]:  # else the battery is at its largest power below the limit
            u = 0.5 * (emf + way * math.sqrt(emf * emf + 4.0 * w[OHM] * w[SUPPLY] * bus))
    return float(u)
