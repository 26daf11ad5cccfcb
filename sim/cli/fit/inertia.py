"""``sysid fit --straight``: the moment of inertia, from turning on the spot and going straight."""

from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import click

from sim.cli.fit.parts import fit_parts
from sim.cli.log_reader import LogReader
from sim.core.errors import BadRequest
from sim.core.log import Log
from sim.fit import Fit
from sim.fit import fit as find_gains
from sim.fit.physics.inertia import MomentOfInertia, compute_moment_of_inertia

FINEST = 0.005  # [1] smaller relative errors are not printed: no scale weighs a robot better


@dataclass(frozen=True)
class Turning:
    """The options about a robot that turns on the spot.

    Args:
        straight: path of a log of the same robot going straight.
        mass: mass of the robot [kg].
        lever: distance from the middle of the robot to the line along which a wheel pushes [m];
            None computes it from the speeds.
    """

    straight: Path
    mass: float
    lever: float | None


def read_turning(
    straight: Path | None, *, mass: float | None, lever: float | None
) -> Turning | None:
    """The three options as one object; None without --straight.

    Raises:
        UsageError: an option would be ignored, or --mass is missing.
    """
    if straight is None:
        if mass is None and lever is None:
            return None
        raise click.UsageError(
            "Missing option '--straight': --mass and --lever are for the moment of inertia, which "
            "needs a log of the robot going straight, too."
        )
    if mass is None:
        raise click.UsageError("Missing option '--mass': the mass of the robot [kg].")
    return Turning(straight, mass, lever)


def add_inertia(
    found: Fit, notes: tuple[str, ...], log: Log, turning: Turning | None, *, method: str
) -> tuple[Fit, tuple[str, ...], MomentOfInertia | None]:
    """A fit with the doubts about its moment of inertia, its notes, and that moment or None.

    Raises:
        Refusal: the log of going straight cannot be read or fitted, or no inertia follows from the
            two.
    """
    if turning is None:
        return found, notes, None
    if any(doubt.code == "rate-as-voltage" for doubt in log.doubts):
        raise BadRequest(
            "the log of turning has a rate where its voltage should be",
            where=log.source,
            advice="Name the MotorVoltage of a drive motor with --voltage.",
        )
    parts = LogReader(type="simple").read_parts((turning.straight,))
    find = partial(find_gains, type="simple", method=method)
    straight = fit_parts(parts, find).found
    wheels = any(doubt.code == "turning-drivetrain" for doubt in log.doubts)
    turned = compute_moment_of_inertia(
        found, straight, mass=turning.mass, lever=turning.lever, by_wheels=wheels
    )
    doubted = replace(found, doubts=(*turned.doubts, *found.doubts))
    return doubted, (describe_inertia(turned), *notes), turned


def describe_inertia(turned: MomentOfInertia) -> str:
    """The moment of inertia in a sentence, with the share of rotors and wheels."""
    least, most = turned.without_rotors
    share = turned.error / turned.value
    error = f"± {turned.error:.2g} kg·m²" if share > FINEST else f"kg·m² (± less than {FINEST:.1%})"
    remark = " (computed from the speeds)" if turned.lever == turned.lever_seen else ""
    if turned.lever_seen is None:
        remark = ", which cannot be checked, as the log of going straight is not in meters"
    return (
        f"Moment of inertia {turned.value:.3g} {error}: mass · lever · kA turning / kA "
        f"straight, with a lever of {turned.lever:.3g} m{remark}. This includes wheels and "
        "rotors. They usually count like 3 to 10 % of the mass; without them the robot has "
        f"{least:.3g} to {most:.3g} kg·m²."
    )
