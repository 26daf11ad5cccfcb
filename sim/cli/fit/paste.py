"""``--paste``: the code to paste, for robot programs and for motor controllers."""

import click

from sim.core.leave_out import LeftOutPart
from sim.fit import Fit
from sim.report.robot_code_snippet import write_robot_code


def make_paste_text(found: Fit, target: str, *, season: int) -> str:
    """The text to print for ``--paste``.

    The parts left out and the radius are read from the current command's options; the radius's
    default value is not used.

    Args:
        found: the fit, in the unit of its log.
        target: one of ``TARGETS``.
        season: 2026 or 2027.

    Raises:
        BadRequest: no code can be written for these gains.
    """
    ctx = click.get_current_context()
    given = ctx.get_parameter_source("radius") is not click.core.ParameterSource.DEFAULT
    radius = ctx.params["radius"] if given else None
    left_out = tuple(map(LeftOutPart.parse, ctx.params.get("left_out", ())))
    return write_robot_code(found, target=target, season=season, radius=radius, left_out=left_out)
