"""Plausibility of a fit: its gains against physics, and forward against reverse runs."""

from dataclasses import replace

import click
import numpy as np

from sim.core.doubt import Doubt
from sim.core.log import Log
from sim.core.vocabulary import METHODS
from sim.fit import Fit
from sim.fit.physics import Parts, check_plausibility, compare_directions, compare_with_theory
from sim.physics.engine import engine_can_compile
from sim.physics.motors import find_motor
from sim.support.extras import format_install_command

LONG = 20_000  # [samples] comparing the directions of a longer log takes seconds


def read_motor_parts(
    name: str | None, *, count: int, ratio: float | None, radius: float, load: float | None
) -> Parts | None:
    """The motor, gearing and load that the options name; None without ``--driven-by``.

    Args:
        name: of the motor, or None.
        count: number of motors.
        ratio: motor turns per turn of the output.
        radius: of wheel or drum [m].
        load: moved mass [kg] or moment of inertia [kg·m²].

    Raises:
        BadRequest: the motor is unknown.
        UsageError: the ratio is missing.
    """
    if name is None:
        return None

    found = find_motor(name)
    if ratio is None:
        raise click.UsageError("Missing option '--ratio': motor turns per turn of the output.")
    return Parts(found, count, ratio, radius=radius, load=load)


def check_against_physics(
    found: Fit, log: Log, *, parts: Parts | None, notes: tuple[str, ...] = ()
) -> tuple[Fit, tuple[str, ...]]:
    """The fit with the doubts of the plausibility checks added first, and all notes.

    Args:
        found: the fit, in any unit.
        log: what it was fitted to.
        parts: motors, gearing and load of the mechanism, or None; with them, the theoretical gains
            are the first note.
        notes: sentences about checks that passed; they come last.
    """
    period = float(np.median(np.concatenate([np.diff(run.time) for run in log.runs])))
    doubts = check_plausibility(found, parts=parts, period=period)
    return _add_doubts(found, *doubts, first=True), (*compare_with_theory(found, parts), *notes)


def compare_directions_alone(
    found: Fit, log: Log, notes: tuple[str, ...] = (), *, include_long: bool
) -> tuple[Fit, tuple[str, ...]]:
    """The fit, with a doubt if forward and reverse runs disagree when fitted alone; and notes.

    Args:
        found: the fit; only fits by simulation are compared.
        log: what it was fitted to.
        notes: sentences about other checks.
        include_long: compare the directions also where that takes long: of a log of more than
            20 000 samples, or without Numba.
    """
    if found.method != METHODS[0]:
        return found, notes
    if not (include_long or engine_can_compile()):
        slow = (
            "Forward and reverse were not compared, because that takes long without Numba. To make "
            f"it quick: {format_install_command('fast')}"
        )
        return found, (slow, *notes)
    if include_long or sum(map(len, log.runs)) <= LONG:
        return _add_doubts(found, *compare_directions(log, found.type)), notes
    return found, ("Forward and reverse were not compared, because this log is long.", *notes)


def _add_doubts(found: Fit, *doubts: Doubt, first: bool = False) -> Fit:
    both = (doubts, found.doubts) if first else (found.doubts, doubts)
    return replace(found, doubts=tuple(doubt for part in both for doubt in part))
