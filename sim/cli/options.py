"""Options and arguments that several commands share."""

import json
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from sim.core.units import UNITS
from sim.core.vocabulary import TYPES

if TYPE_CHECKING:
    from sim.core.log import Log

FILE = click.Path(path_type=Path)

as_json = click.option("--json", "as_json", is_flag=True, help="Plain data for other programs.")


def reading_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """The options that say how to read a log."""
    options = (
        click.option("--type", "type_", type=click.Choice(TYPES), help="What kind of mechanism."),
        click.option(
            "--units", type=click.Choice(tuple(UNITS)), help="Units of the positions in the file."
        ),
        click.option("--motor", help="Which motor, where the log has several: left, right, …"),
        click.option("--voltage", metavar="ENTRY", help="Log entry with the applied voltage."),
        click.option("--position", metavar="ENTRY", help="Log entry with the position."),
        click.option("--velocity", metavar="ENTRY", help="Log entry with the velocity."),
        click.option("--state", metavar="ENTRY", help="Log entry with the running test's name."),
    )
    for option in reversed(options):
        command = option(command)
    return command


def list_catalogue(rows: Iterable[Mapping[str, Any]], *, as_json: bool) -> None:
    """Print a catalogue: name and summary, one line each, or everything as JSON.

    Args:
        rows: each with ``name`` and ``summary``, and what else JSON should carry.
        as_json: as JSON.
    """
    rows = list(rows)
    if as_json:
        click.echo(json.dumps(rows, allow_nan=False))
    else:
        width = max(len(row["name"]) for row in rows)
        click.echo("\n".join(f"{row['name']:{width}}  {row['summary']}" for row in rows))


def read_logs_together(
    files: Iterable[Path],
    *,
    units: str | None,
    type: str | None,  # noqa: A002 - the field's own word
    motor: str | None,
    entries: Mapping[str, str | None],
) -> "Log":
    """Read the files of one mechanism as one log.

    Args:
        files: in any format.
        units: of the positions in them; None believes the files.
        type: of the mechanism; None believes the files.
        motor: which one, where a file has several.
        entries: signal -> name of its entry; None looks for it.

    Raises:
        Refusal: a file cannot be read, or one measures a length and another an angle.
    """
    from sim.io import read  # noqa: PLC0415 - --help must not wait for it

    named = {signal: entry for signal, entry in entries.items() if entry}
    first, *more = [
        read(file, units=units, type=type, motor=motor, entries=named) for file in files
    ]
    for log in more:
        first = first.join(log)
    return first
