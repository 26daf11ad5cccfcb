"""Battery, wiring and controller limits: the voltage that reaches the motor.

    I = (u - Ke·G/r·v) / R                  current of one motor at the voltage u
    bus = rest - Rb·n·I·u/bus               a controller turns u and I into the battery's

so that bus = rest/2 + √(rest²/4 - Rb·n·u·I). More than the bus has cannot be applied; the stator
limit bounds I, the supply limit I·u/bus. A program that asks for a share D of the battery gets

    D·bus = D·(rest + Rb·n/R·D·Ke·G/r·v) / (1 + Rb·n/R·D²)

And below the brownout voltage the robot controller takes the motors off for ``CUT``, as long as it
takes to enable them again.
"""

import math

from sim.physics.engine.hooks import Numbers

REST, RB, MOTORS, OHM, EMF, STATOR, SUPPLY, STOP, DUTY = range(9)
"""Places in ``w``: [V], [Ω], [1], [Ω], [V·s/unit], [A], [A], [V], and
whether a share of the battery is asked for. No battery: REST is 0."""

NOMINAL = 12.0  # [V] that a whole share of the battery stands for

CUT = 0.02  # [s] the motors stay off: with none of them running the battery recovers at once, and
# the enable signal comes every 20 ms


def compute_bus_voltage(w: Numbers, u: float, current: float) -> float:
    """[V] battery voltage while every motor draws ``current`` [A] at ``u`` [V]."""
    square = 0.25 * w[REST] * w[REST] - w[RB] * w[MOTORS] * u * current
    return float(0.5 * w[REST] + math.sqrt(max(square, 0.0)))


def limit_voltage(w: Numbers, asked: float, v: float) -> float:
    """[V] voltage at the motors for a command at a speed, after all limits."""
    if w[REST] == 0.0:
        return asked
    emf = w[EMF] * v
    if w[DUTY] != 0.0:
        duty = min(max(asked / NOMINAL, -1.0), 1.0)
        load = w[RB] * w[MOTORS] / w[OHM] * duty
        asked = duty * (w[REST] + load * emf) / (1.0 + load * duty)
    room = w[OHM] * w[STATOR]
    u = min(max(asked, emf - room), emf + room)
    current = (u - emf) / w[OHM]
    if u * current <= 0.0:  # the motors brake, and give: the battery can always take it
        return float(min(max(u, -w[REST]), w[REST]))
    way = math.copysign(1.0, u)
    bus = compute_bus_voltage(w, u, current)
    if abs(u) > bus:  # all there is: bus = rest - Rb·n·(bus - emf)/R
        load = w[RB] * w[MOTORS] / w[OHM]
        bus = (w[REST] + load * way * emf) / (1.0 + load)
        u = way * bus
        current = (u - emf) / w[OHM]
    if u * current > w[SUPPLY] * bus:
        bus = w[REST] - w[RB] * w[MOTORS] * w[SUPPLY]
        if bus > 0.5 * w[REST]:  # else the battery gives in before the limit does
            u = 0.5 * (emf + way * math.sqrt(emf * emf + 4.0 * w[OHM] * w[SUPPLY] * bus))
    return float(u)
