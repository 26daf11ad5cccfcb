"""``sysid fit``."""

import json
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from sim.cli.options import FILE, as_json, read_together, reading
from sim.command import DONE, NOT_RIGHT
from sim.feedback import PRESETS
from sim.vocabulary import METHODS

if TYPE_CHECKING:
    from sim.fit.physics import Parts


@click.command()
@click.argument("files", nargs=-1, required=True, type=FILE)
@reading
@click.option(
    "--method",
    type=click.Choice(METHODS),
    default=METHODS[0],
    show_default=True,
    help="Ours, by simulating; or WPILib SysId's own recipe.",
)
@click.option(
    "--median",
    default=1,
    show_default=True,
    help="Median filter window of SysId's recipe [samples].",
)
@click.option(
    "--preset",
    type=click.Choice(tuple(PRESETS)),
    default="default",
    show_default=True,
    help="Motor controller that the feedback gains are for.",
)
@click.option("--driven-by", metavar="MOTOR", help="Check against theory: krakenX60, neo, …")
@click.option("--count", type=click.IntRange(min=1), default=1, help="How many motors, for that.")
@click.option("--ratio", type=float, help="Motor turns per turn of the output, for that.")
@click.option("--radius", type=float, default=1.0, help="Of wheel or drum [m], for that.")
@click.option("--load", type=float, help="Moved mass [kg] or inertia [kg·m²], for that.")
@click.option(
    "--paste",
    type=click.Choice(("java", "python")),
    help="Only the constants and feedforward to paste into robot code.",
)
@click.option(
    "--season",
    type=click.Choice(("2026", "2027")),
    default="2026",
    show_default=True,
    help="Whose names, for --paste.",
)
@as_json
def fit(  # noqa: PLR0917 - click passes options by name
    files: tuple[Path, ...],
    type_: str | None,
    units: str | None,
    method: str,
    median: int,
    motor: str | None,
    preset: str,
    driven_by: str | None,
    count: int,
    ratio: float | None,
    radius: float,
    load: float | None,
    paste: str | None,
    season: str,
    as_json: bool,  # noqa: FBT001 - click passes it by name
    **entries: str | None,
) -> int:
    """Find kS, kV, kA (and kG) in the logs of one mechanism: .wpilog, .csv, or SysId's old .json.

    For example: sysid fit drive.wpilog
    """
    import numpy as np  # noqa: PLC0415 - as all here: --help must not wait for it

    from sim.fit import fit as find_gains  # noqa: PLC0415
    from sim.fit.physics import physical_doubts  # noqa: PLC0415
    from sim.terminal import show_fit  # noqa: PLC0415

    log = read_together(files, units=units, type=type_, motor=motor, entries=entries)
    found = find_gains(log, type=type_ or "", method=method, median=median)
    parts = _parts(driven_by, count=count, ratio=ratio, radius=radius, load=load)
    period = float(np.median(np.concatenate([np.diff(run.time) for run in log.runs])))
    said = (*physical_doubts(found, parts=parts, period=period), *found.doubts)
    found = replace(found, doubts=said).in_log_units()
    if paste:
        from sim.paste import snippet  # noqa: PLC0415 - only with --paste

        click.echo(snippet(found, language=paste, season=int(season)), nl=False)
        return NOT_RIGHT if any(doubt.grave for doubt in found.doubts) else DONE
    if as_json:
        click.echo(json.dumps(found.to_json(PRESETS[preset]), allow_nan=False))
    else:
        show_fit(found, preset=PRESETS[preset], title=", ".join(str(file) for file in files))
    return NOT_RIGHT if any(doubt.grave for doubt in found.doubts) else DONE


def _parts(
    name: str | None, *, count: int, ratio: float | None, radius: float, load: float | None
) -> "Parts | None":
    """What drives it, if that was said."""
    if name is None:
        return None
    from sim.fit.physics import Parts  # noqa: PLC0415 - only with --driven-by
    from sim.motors import motor  # noqa: PLC0415

    found = motor(name)
    if ratio is None:
        raise click.UsageError("Missing option '--ratio': motor turns per turn of the output.")
    return Parts(found, count, ratio, radius=radius, load=load)
