"""Simulate a program that commands a duty cycle instead of a voltage.

    D = V/12                          duty cycle of ``set(volts / 12)``
    Vbat = V0 - Rb·D·n·I              battery voltage under the current of n motors
    I = (D·Vbat - Ke·G/r·v) / R       current of one motor at speed v

The motors get D·Vbat, not V.
"""

import math
from dataclasses import replace

import numpy as np

from sim.bench.mechanism import Mechanism
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.doubt import Doubt
from sim.core.log import Log
from sim.physics.battery import CONTROLLERS, Battery

__all__ = ["Battery", "simulate_duty_cycle"]

HEALTHY = Battery()
LOWEST = CONTROLLERS["roborio2"].brownout  # [V]


def simulate_duty_cycle(
    mechanism: Mechanism,
    routine: Routine,
    *,
    rng: np.random.Generator,
    battery: Battery = HEALTHY,
) -> Log:
    """Run a routine that sets a duty cycle, ``motor.set(volts / 12)``; no current limit.

    Args:
        mechanism: the mechanism.
        routine: the commanded voltages.
        rng: random generator of noise and jitter.
        battery: the battery.

    Returns:
        The log with the motor voltage, and the battery voltage as ``bus_voltage``. The command was
        12 V times motor voltage over bus voltage. If the battery voltage falls below ``LOWEST``,
        the log has a warning, and the simulation continues.

    Raises:
        BadRequest: as ``simulate``.
    """
    unlimited = replace(mechanism, battery=battery, stator=math.inf, supply=math.inf, brownout=0.0)
    log = simulate(unlimited, routine, rng=rng, duty_cycle=True, electrical=True)
    lowest = min(float(np.min(run.bus_voltage)) for run in log.runs if run.bus_voltage is not None)
    return log.add_doubts(_warn_of_brownout(lowest)) if lowest < LOWEST else log


def _warn_of_brownout(lowest: float) -> Doubt:
    """A warning about a battery voltage [V] at which a robot controller disables the motors."""
    return Doubt(
        "brownout",
        f"The battery falls to {lowest:.1f} V. Below {LOWEST} V a real robot stops its motors, "
        "and here it does not. Use a smaller step or a better battery.",
    )
