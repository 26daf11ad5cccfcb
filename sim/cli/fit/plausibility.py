"""Plausibility of a fit: its gains against physics, and forward against reverse runs."""

from dataclasses import replace
from typing import TYPE_CHECKING

import click

from sim.core.vocabulary import METHODS

if TYPE_CHECKING:
    from sim.core.doubt import Doubt
    from sim.core.log import Log
    from sim.fit import Fit
    from sim.fit.physics import Parts

MANY = 20_000  # samples: of a longer log the directions take seconds; only a page waits for them


def read_motor_parts(
    name: str | None, *, count: int, ratio: float | None, radius: float, load: float | None
) -> "Parts | None":
    """The motor, gearing and load that the options name; None without them."""
    if name is None:
        return None
    from sim.fit.physics import Parts  # noqa: PLC0415 - only with --driven-by
    from sim.physics.motors import find_motor  # noqa: PLC0415

    found = find_motor(name)
    if ratio is None:
        raise click.UsageError("Missing option '--ratio': motor turns per turn of the output.")
    return Parts(found, count, ratio, radius=radius, load=load)


def check_against_physics(
    found: "Fit", log: "Log", *, parts: "Parts | None", notes: tuple[str, ...] = ()
) -> "tuple[Fit, tuple[str, ...]]":
    """The fit with the doubts of the plausibility checks before its own, and its notes.

    Args:
        found: the gains, in any unit.
        log: where they come from.
        parts: what the mechanism was built from; the gains of theory are then the first note.
        notes: what is well, a sentence each.
    """
    import numpy as np  # noqa: PLC0415 - --help must not wait for it

    from sim.fit.physics import check_plausibility, compare_with_theory  # noqa: PLC0415

    period = float(np.median(np.concatenate([np.diff(run.time) for run in log.runs])))
    doubts = check_plausibility(found, parts=parts, period=period)
    return _doubted(found, *doubts, first=True), (*compare_with_theory(found, parts), *notes)


def compare_directions_alone(
    found: "Fit", log: "Log", *, patient: bool
) -> "tuple[Fit, tuple[str, ...]]":
    """The fit with a doubt where forward and reverse runs, fitted alone, disagree."""
    from sim.fit.physics import compare_directions  # noqa: PLC0415 - --help must not wait for it

    if found.method != METHODS[0]:
        return found, ()
    if patient or sum(map(len, log.runs)) <= MANY:
        return _doubted(found, *compare_directions(log, found.type)), ()
    return found, ("Forward and reverse were not compared: this log is long. --html does it.",)


def _doubted(found: "Fit", *doubts: "Doubt", first: bool = False) -> "Fit":
    both = (doubts, found.doubts) if first else (found.doubts, doubts)
    return replace(found, doubts=tuple(doubt for part in both for doubt in part))
