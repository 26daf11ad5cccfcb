"""``sysid fit``."""

import json
from pathlib import Path

import click

from sim.cli.options import FILE, as_json, read_together, reading
from sim.command import DONE, NOT_RIGHT
from sim.feedback import PRESETS
from sim.vocabulary import METHODS


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
@as_json
def fit(  # noqa: PLR0917 - click passes options by name
    files: tuple[Path, ...],
    type_: str | None,
    units: str | None,
    method: str,
    median: int,
    motor: str | None,
    preset: str,
    as_json: bool,  # noqa: FBT001 - click passes it by name
    **entries: str | None,
) -> int:
    """Find kS, kV, kA (and kG) in the logs of one mechanism: .wpilog, .csv, or SysId's old .json.

    For example: sysid fit drive.wpilog
    """
    from sim.fit import fit as find_gains  # noqa: PLC0415 - as all here: --help must not wait
    from sim.terminal import show_fit  # noqa: PLC0415

    log = read_together(files, units=units, type=type_, motor=motor, entries=entries)
    found = find_gains(log, type=type_ or "", method=method, median=median)
    found = found.in_log_units()
    if as_json:
        click.echo(json.dumps(found.to_json(PRESETS[preset]), allow_nan=False))
    else:
        show_fit(found, preset=PRESETS[preset], title=", ".join(str(file) for file in files))
    return NOT_RIGHT if any(doubt.grave for doubt in found.doubts) else DONE
