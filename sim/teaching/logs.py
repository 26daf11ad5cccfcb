"""Logs for the lessons: with a mistake of the program, without some rows, or a student's own."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.log import Log, Run
from sim.core.units import BATTERY
from sim.io import read

OWN = Path("..", "exercises", "exercise9", "data")  # from the folder of the lessons


def apply_mistake(log: Log, *, factor: float = 1.0, commanded: bool = False) -> Log:
    """The log as a robot program with a mistake would have written it.

    Args:
        log: what happened.
        factor: by which the encoder's numbers are wrong: a unit, a ratio, or −1.
        commanded: whether the voltage is the commanded one, of a share of the battery.
    """

    def change(run: Run) -> Run:
        volts = BATTERY * run.voltage / np.asarray(run.bus_voltage) if commanded else run.voltage
        position, velocity = factor * run.position, factor * run.velocity
        return replace(run, voltage=volts, position=position, velocity=velocity)

    return replace(log, runs=tuple(map(change, log.runs)))


def select_rows(log: Log, keep: Callable[[Run], NDArray[np.bool_]]) -> Log:
    """The log with some rows of each run.

    Args:
        log: all rows.
        keep: run -> (n,) whether each of its rows stays.
    """
    return replace(log, runs=tuple(run.select(keep(run)) for run in log.runs))


def read_own_log() -> tuple[Log, str]:
    """The student's log of exercise 9 and where it is; a simulated shooter's before it was made."""
    made = sorted(OWN.glob("*/log.wpilog"))
    if made:
        log = read(made[0])
        return log, f"Read {made[0]}: a log of a {log.mechanism or 'mechanism'}, in {log.units}."
    rng = np.random.default_rng(9)
    log = simulate(MECHANISMS["shooter"].draw(rng), Routine(ramp=0.5, step=3.5), rng=rng)
    return log, (
        "No log of your own yet. Make it in a terminal, in the course's folder:  grade start\n"
        "Until then, here is a simulated shooter."
    )
