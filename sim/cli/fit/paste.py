"""``--paste``: the code to paste, for robot programs and for motor controllers."""

import click

from sim.cli.options import LANGUAGES
from sim.fit import Fit
from sim.report.controller_snippet import write_controller_code
from sim.report.robot_code_snippet import write_robot_code


def make_paste_text(found: Fit, target: str, *, season: int) -> str:
    """The text to print for ``--paste``.

    The radius is read from the current command's ``--radius``; its default value is not used.

    Args:
        found: the fit, in the unit of its log.
        target: one of ``LANGUAGES`` or ``CONTROLLERS``.
        season: 2026 or 2027.

    Raises:
        BadRequest: no code can be written for these gains.
    """
    ctx = click.get_current_context()
    given = ctx.get_parameter_source("radius") is not click.core.ParameterSource.DEFAULT
    return write_snippet(
        found, target, season=season, radius=ctx.params["radius"] if given else None
    )


def write_snippet(found: Fit, target: str, *, season: int, radius: float | None) -> str:
    """The code for one of ``LANGUAGES`` or ``CONTROLLERS``.

    Args:
        found: the fit, in the unit of its log.
        target: one of ``LANGUAGES`` or ``CONTROLLERS``.
        season: 2026 or 2027.
        radius: radius of wheel or drum [m], which some controllers need.

    Raises:
        BadRequest: no code can be written for these gains.
    """
    if target in LANGUAGES:
        return write_robot_code(found, language=target, season=season)

    return write_controller_code(found, target=target, radius=radius, season=season)
