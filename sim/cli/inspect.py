"""``sysid inspect``."""

import json
from pathlib import Path
from typing import TYPE_CHECKING

import click

from sim.cli.options import FILE, as_json, read_logs_together, reading_options
from sim.support.command_line import DONE, NOT_RIGHT

if TYPE_CHECKING:
    from sim.inspect.detect_faults import Inspection

SURE, LIKELY = 0.9, 0.7  # [1] confidence from which a person would say so


@click.command()
@click.argument("files", nargs=-1, required=True, type=FILE)
@reading_options
@as_json
def inspect(
    files: tuple[Path, ...],
    *,
    type_: str | None,
    units: str | None,
    motor: str | None,
    as_json: bool,
    **entries: str | None,
) -> int:
    """Say what is wrong with the record of one mechanism: which fault, where, and what to do.

    For example: sysid inspect drive.wpilog

    Exit code 0 means that no fault was found, 1 that there is one, or that none could be.
    """
    from sim.inspect.detect_faults import inspect as look  # noqa: PLC0415 - --help must not wait for it

    log = read_logs_together(files, units=units, type=type_, motor=motor, entries=entries)
    found = look(log)
    if as_json:
        click.echo(json.dumps(found.to_json(), allow_nan=False))
    else:
        _show(found, title=", ".join(str(file) for file in files), runs=len(log.runs))
    return DONE if found.is_clean else NOT_RIGHT


def _show(found: "Inspection", *, title: str, runs: int) -> None:
    """Every fault with its place, its evidence and its cure, then the doubts."""
    count = len(found.damages)
    said = f"{count} fault{'s' * (count > 1)} found" if count else "no fault found"
    click.echo(f"{title}: {runs} run{'s' * (runs != 1)}, {said}.")
    for damage in found.damages:
        where = damage.where
        place = "the whole log"
        if where.test:
            place = f"run {where.run}, {where.test}" if where.run is not None else where.test
            if where.run is not None:
                place += f", {where.start:.2f} to {where.end:.2f} s"
        click.echo("")
        click.secho(f"{damage.fault}: {place} ({_sure(damage.confidence)})", bold=True)
        for text in (damage.evidence, damage.advice):
            click.echo(click.wrap_text(text, width=78, initial_indent="  ", subsequent_indent="  "))
    if found.doubts:
        click.echo("")
    for doubt in found.doubts:
        click.echo(click.wrap_text(f"look: {doubt.message}", width=78, subsequent_indent="      "))


def _sure(confidence: float) -> str:
    word = "sure" if confidence >= SURE else "likely" if confidence >= LIKELY else "perhaps"
    return f"{word}, {confidence:.2f}"
