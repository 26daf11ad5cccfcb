"""Options and arguments that several commands share."""

import json
from collections.abc import Callable, Iterable, Mapping
from functools import reduce
from pathlib import Path
from typing import Any, TypeAlias

import click

from sim.core.errors import BadRequest
from sim.support.completion import complete_members

Option: TypeAlias = Callable[[Callable[..., Any]], Callable[..., Any]]

FILE = click.Path(path_type=Path)
SIM = Path(__file__).resolve().parents[1]
MECHANISM_NAMES = complete_members(SIM / "bench" / "mechanisms")
EFFECT_NAMES = complete_members(SIM / "physics" / "effects")
FAULT_NAMES = complete_members(SIM / "inspect" / "faults")


output_option = click.option(
    "-o",
    "--output",
    type=FILE,
    required=True,
    help="Log to write; the ending says the format: .wpilog, .csv …",
)
as_json = click.option("--json", "as_json", is_flag=True, help="Print JSON for other programs.")


def combine_options(*options: Option) -> Option:
    """Decorator that adds several options to a command, in their order."""
    return lambda command: reduce(lambda made, option: option(made), reversed(options), command)


def list_catalogue(rows: Iterable[Mapping[str, Any]], *, as_json: bool) -> None:
    """Print a catalogue: name and summary, one line each, or everything as JSON.

    Args:
        rows: one mapping for each member, with ``name``, ``summary`` and other keys for JSON.
        as_json: print JSON.
    """
    rows = list(rows)
    if as_json:
        click.echo(json.dumps(rows, allow_nan=False))
    else:
        width = max(len(row["name"]) for row in rows)
        click.echo("\n".join(f"{row['name']:{width}}  {row['summary']}" for row in rows))


def refuse_overwriting(*outputs: Path | None, inputs: Iterable[Path | None] = ()) -> None:
    """Refuse an output that would replace an input or another output.

    Args:
        outputs: the files that the command writes; None for an option that was not given.
        inputs: the files that it reads; None for an option that was not given.

    Raises:
        BadRequest: two of them are the same file.
    """
    read = [path for path in inputs if path is not None]
    written: list[Path] = []
    for path in outputs:
        if path is None:
            continue
        for others, what in ((read, "the log that is read"), (written, "another output")):
            if any(is_same_file(path, other) for other in others):
                raise BadRequest(
                    f"this would overwrite {what}",
                    where=str(path),
                    advice="Give the output another name.",
                )
        written.append(path)


def is_same_file(one: Path, other: Path) -> bool:
    """Whether two paths lead to one file, also through links."""
    try:
        return one.samefile(other)
    except OSError:  # one of them does not exist yet
        return one.resolve() == other.resolve()
