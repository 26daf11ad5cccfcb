"""The command ``sysid``: make, read and fit logs."""

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from sim.command import DONE, NOT_RIGHT, run
from sim.errors import Refusal
from sim.feedback import PRESETS
from sim.units import UNITS
from sim.vocabulary import METHODS, TYPES

if TYPE_CHECKING:
    from sim.log import Log

FILE = click.Path(path_type=Path)


def main() -> None:
    """Start ``sysid``."""
    sys.exit(run(sysid, name="sysid"))


@click.group(context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(package_name="sysid-course")
def sysid() -> None:
    """System identification for FRC mechanisms: simulate them, read their logs, fit their gains.

    Exit codes: 0 done, 1 done but something is not right, 2 could not do it.
    """


@sysid.command()
@click.argument("mechanism")
@click.option("-o", "--output", type=FILE, required=True, help="Log to write: .wpilog or .csv.")
@click.option("--ramp", default=0.5, show_default=True, help="Quasistatic ramp [V/s].")
@click.option("--step", default=3.5, show_default=True, help="Dynamic step [V].")
@click.option("--timeout", default=10.0, show_default=True, help="End of a test [s].")
@click.option("--period", default=0.02, show_default=True, help="Loop of the robot program [s].")
@click.option("--seed", type=int, help="Same seed, same log; a new log every time without.")
@click.option("--truth", type=FILE, help="Also write the true gains to this JSON file.")
def simulate(  # noqa: PLR0917 - click passes options by name
    mechanism: str,
    output: Path,
    ramp: float,
    step: float,
    timeout: float,
    period: float,
    seed: int | None,
    truth: Path | None,
) -> None:
    """Run the four tests on a simulated MECHANISM and write the log a robot would.

    For example: sysid simulate drivetrain --seed 1 -o drive.wpilog
    """
    import numpy as np  # noqa: PLC0415 - as all below: --help must not wait for it

    from sim.formats import write  # noqa: PLC0415
    from sim.mechanisms import mechanism as find  # noqa: PLC0415
    from sim.routine import Routine  # noqa: PLC0415
    from sim.simulate import simulate as record  # noqa: PLC0415
    from sim.truth import write_truth  # noqa: PLC0415

    if seed is not None and seed < 0:
        raise click.BadParameter("a seed is zero or more.", param_hint="'--seed'")
    built = find(mechanism)
    routine = Routine(ramp=ramp, step=step, timeout=timeout)
    log = record(built, routine, rng=np.random.default_rng(seed), period=period)
    if truth:
        write_truth(built, routine, path=truth)
    try:
        write(log, output)
    except Refusal:
        if truth:  # the truth of a log that is not there would only mislead
            truth.unlink()
        raise
    samples = sum(len(part) for part in log.runs)
    click.echo(f"{output}: {len(log.runs)} tests, {samples} samples. Next: sysid fit {output}")


@sysid.command()
@click.argument("files", nargs=-1, required=True, type=FILE)
@click.option("--type", "type_", type=click.Choice(TYPES), help="What kind of mechanism it is.")
@click.option(
    "--units", type=click.Choice(tuple(UNITS)), help="Units of the positions in the file."
)
@click.option(
    "--method",
    type=click.Choice(METHODS),
    default=METHODS[0],
    show_default=True,
    help="WPILib SysId's own recipe.",
)
@click.option("--median", default=1, show_default=True, help="Median filter window [samples].")
@click.option("--motor", help="Which motor, where the log has several: left, right, …")
@click.option(
    "--preset",
    type=click.Choice(tuple(PRESETS)),
    default="default",
    show_default=True,
    help="Motor controller that the feedback gains are for.",
)
@click.option("--voltage", metavar="ENTRY", help="Log entry with the applied voltage.")
@click.option("--position", metavar="ENTRY", help="Log entry with the position.")
@click.option("--velocity", metavar="ENTRY", help="Log entry with the velocity.")
@click.option("--state", metavar="ENTRY", help="Log entry with the name of the running test.")
@click.option("--json", "as_json", is_flag=True, help="Plain data for other programs.")
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
    from sim.formats import read  # noqa: PLC0415
    from sim.terminal import show_fit  # noqa: PLC0415

    named = {signal: entry for signal, entry in entries.items() if entry}
    logs = [read(file, units=units, type=type_, motor=motor, entries=named) for file in files]
    found = find_gains(_together(logs), type=type_ or "", method=method, median=median)
    found = found.in_log_units()
    if as_json:
        click.echo(json.dumps(found.to_json(PRESETS[preset]), allow_nan=False))
    else:
        show_fit(found, preset=PRESETS[preset], title=", ".join(str(file) for file in files))
    return NOT_RIGHT if any(doubt.grave for doubt in found.doubts) else DONE


@sysid.command()
@click.option("--json", "as_json", is_flag=True, help="Plain data for other programs.")
def mechanisms(*, as_json: bool) -> None:
    """List the mechanisms that can be simulated."""
    from sim.mechanisms import MECHANISMS  # noqa: PLC0415 - --help must not wait for it

    rows = {name: found.summary for name, found in MECHANISMS.items()}
    if as_json:
        click.echo(json.dumps([{"name": n, "summary": s} for n, s in rows.items()]))
    else:
        width = max(map(len, rows))
        click.echo("\n".join(f"{name:{width}}  {summary}" for name, summary in rows.items()))


def _together(logs: "list[Log]") -> "Log":
    """The runs of several files as one log."""
    first, *more = logs
    for log in more:
        first = first.and_also(log)
    return first
