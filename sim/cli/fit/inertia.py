"""``sysid fit --straight``: the moment of inertia, from turning on the spot and going straight."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from sim.cli.fit.parts import fit_parts, kind_of_parts
from sim.cli.options import FILE, read_parts
from sim.core.errors import BadRequest

if TYPE_CHECKING:
    from sim.core.log import Log
    from sim.fit import Fit
    from sim.fit.physics.inertia import MomentOfInertia


def turning_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """The options for a robot that turns on the spot."""
    options = (
        click.option(
            "--straight",
            type=FILE,
            help="Log of the same robot going straight; FILES are of turning on the spot …",
        ),
        click.option("--mass", type=float, help="… the mass of the robot [kg] …"),
        click.option(
            "--lever",
            type=float,
            help="… and how far a wheel's push passes from the middle [m]: trackwidth/√2 of a "
            "square swerve, half of it of a tank.  [default: what the speeds tell]",
        ),
    )
    for option in reversed(options):
        command = option(command)
    return command


def check_turning_options(
    straight: Path | None, *, mass: float | None, lever: float | None
) -> None:
    """Refuse options that would be ignored, or a log without a mass."""
    if straight is None and (mass is not None or lever is not None):
        raise click.UsageError(
            "Missing option '--straight': --mass and --lever are for the moment of inertia, which "
            "needs a log of the robot going straight, too."
        )
    if straight is not None and mass is None:
        raise click.UsageError("Missing option '--mass': the mass of the robot [kg].")


def find_inertia(
    found: "Fit",
    log: "Log",
    *,
    straight: Path | None,
    mass: float | None,
    lever: float | None,
    method: str,
) -> "MomentOfInertia | None":
    """The moment of inertia, from a fit of turning and the log of going straight; None without.

    Raises:
        Refusal: the log of going straight cannot be read or fitted, or no inertia follows from the
            two.
    """
    if straight is None or mass is None:
        return None
    from sim.fit import fit as find_gains  # noqa: PLC0415 - as below: --help must not wait for it
    from sim.fit.physics.inertia import moment_of_inertia  # noqa: PLC0415

    if any(doubt.code == "rate-as-voltage" for doubt in log.doubts):
        raise BadRequest(
            "the log of turning has a rate where its voltage should be",
            where=log.source,
            advice="Name the MotorVoltage of a drive motor with --voltage.",
        )
    parts = read_parts(
        (straight,), units=None, type="simple", motor=None, entries={}, velocity=1.0, pick=None
    )
    find = partial(find_gains, type="simple", method=method)
    gone = fit_parts(parts, find, kind=kind_of_parts(parts, 1)).found
    wheels = any(doubt.code == "turning-drivetrain" for doubt in log.doubts)
    return moment_of_inertia(found, gone, mass=mass, lever=lever, by_wheels=wheels)


def add_inertia(
    found: "Fit", notes: tuple[str, ...], turned: "MomentOfInertia | None"
) -> "tuple[Fit, tuple[str, ...]]":
    """A fit with what speaks against the moment of inertia, and the notes with the inertia first."""
    if turned is None:
        return found, notes
    doubted = replace(found, doubts=(*turned.doubts, *found.doubts))
    return doubted, (describe_inertia(turned), *notes)


def describe_inertia(turned: "MomentOfInertia") -> str:
    """The moment of inertia in a sentence, and what rotors and wheels have to do with it."""
    least, most = turned.without_rotors
    said = " as the speeds tell it" if turned.lever == turned.lever_seen else ""
    return (
        f"Moment of inertia {turned.value:.3g} ± {turned.error:.2g} kg·m²: mass · lever · kA "
        f"turning / kA straight, with a lever of {turned.lever:.3g} m{said}. Wheels and rotors are "
        "in it: if they are worth 3 to 10 % of the mass, as usual, the robot's own is "
        f"{least:.3g} to {most:.3g} kg·m²."
    )
