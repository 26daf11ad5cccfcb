"""``sysid reconcile``."""

import json
from pathlib import Path
from typing import TYPE_CHECKING

import click

from sim.cli.options import FILE, as_json, read_together, reading
from sim.command import DONE, NOT_RIGHT

if TYPE_CHECKING:
    from sim.log import Log
    from sim.reconcile import Damaged


@click.command()
@click.argument("files", nargs=-1, required=True, type=FILE)
@click.option("--validation", type=FILE, help="Other runs, by which an effect is admitted.")
@click.option("--held-out", type=FILE, help="Runs on which the gap is only shown.")
@click.option("--travel", type=float, help="From stop to stop, in the log's units.")
@reading
@as_json
def reconcile(  # noqa: PLR0917 - click passes options by name
    files: tuple[Path, ...],
    validation: Path | None,
    held_out: Path | None,
    travel: float | None,
    type_: str | None,
    units: str | None,
    motor: str | None,
    as_json: bool,  # noqa: FBT001 - click passes it by name
    **entries: str | None,
) -> int:
    """Find where logs disagree with their model, and name what the model lacks."""
    from sim.reconcile import reconcile as solve  # noqa: PLC0415 - as all here: --help must not wait

    def one(file: Path | None) -> "Log | None":
        if file is None:
            return None
        return read_together((file,), units=units, type=type_, motor=motor, entries=entries)

    log = read_together(files, units=units, type=type_, motor=motor, entries=entries)
    logs = {"log": log, "validation": one(validation), "held_out": one(held_out)}
    story = solve(
        log, validation=logs["validation"], held_out=logs["held_out"],
        type=type_ or log.type or "simple", travel=travel,
        damages={name: damages(some) for name, some in logs.items() if some is not None},
    )  # fmt: skip
    if as_json:
        click.echo(json.dumps(story.to_json(), allow_nan=False))
    else:
        click.echo(story.verdict)
    return NOT_RIGHT if story.verdict in {"unexplained", "ambiguous"} else DONE


def damages(log: "Log") -> "tuple[Damaged, ...]":
    """What an inspection finds, in words that the solver understands."""
    from sim.inspection import inspect  # noqa: PLC0415 - as above
    from sim.reconcile import Damaged  # noqa: PLC0415

    return tuple(
        Damaged(
            one.where.run, one.where.start, one.where.end, one.fault, one.confidence,
            one.evidence, one.advice,
        )
        for one in inspect(log).damages
    )  # fmt: skip
