"""Options and arguments that several commands share."""

import json
import math
from collections.abc import Callable, Iterable, Mapping
from functools import reduce, wraps
from pathlib import Path
from typing import Any, TypeAlias

import click

from sim import cli
from sim.core.errors import BadRequest
from sim.core.units import UNITS
from sim.core.vocabulary import TYPES
from sim.support.completion import complete_members

Option: TypeAlias = Callable[[Callable[..., Any]], Callable[..., Any]]

READING = ("units", "motor", "pick", "velocity_scale", "ignore_velocity")  # options of LogReader
SEASONS = ("2026", "2027")
FILE = click.Path(path_type=Path)
SIM = Path(__file__).resolve().parents[1]
TARGETS = sorted(path.stem for path in (SIM / "report" / "robot_code").glob("[!_]*.jinja"))
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


def _check_factor(_: click.Context, __: click.Parameter, value: float) -> float:
    """The value, if it is finite and not zero.

    Raises:
        BadParameter: it is not.
    """
    if not (math.isfinite(value) and value):
        raise click.BadParameter(f"{value:g} is not a finite number other than zero.")
    return value


_add_reading_options = combine_options(
    click.option("--type", "type_", type=click.Choice(TYPES), help="What kind of mechanism."),
    click.option(
        "--units", type=click.Choice(tuple(UNITS)), help="Units of the positions in the file."
    ),
    click.option("--motor", help="Which motor, if the log has several: left, right, …"),
    click.option(
        "--pick",
        type=click.IntRange(min=1),
        metavar="N",
        help="Which mechanism, if the log has several: its number in the message.",
    ),
    click.option("--voltage", metavar="ENTRY", help="Log entry with the applied voltage."),
    click.option("--position", metavar="ENTRY", help="Log entry with the position."),
    click.option("--velocity", metavar="ENTRY", help="Log entry with the velocity."),
    click.option("--state", metavar="ENTRY", help="Log entry with the running test's name."),
    click.option(
        "--velocity-scale",
        metavar="X",
        type=float,
        callback=_check_factor,
        default=1.0,
        help="Multiply the velocity by X, if its factor in the robot's code is wrong.",
    ),
    click.option(
        "--ignore-velocity",
        is_flag=True,
        help="Use the slope of the position as the velocity.",
    ),
)


def reading_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """Decorator that adds the options for reading a log; the command gets a ``LogReader``."""

    @wraps(command)
    def call_with_reader(*args: Any, **options: Any) -> Any:  # noqa: ANN401 - passed on
        named = {name: options.pop(name) for name in ("voltage", "position", "velocity", "state")}
        entries = {name: entry for name, entry in named.items() if entry}
        how = {name: options.pop(name) for name in READING}
        reader = cli.log_reader.LogReader(**how, type=options.pop("type_"), entries=entries)
        return command(*args, reader=reader, **options)

    return _add_reading_options(call_with_reader)


paste_options = combine_options(
    click.option(
        "--paste",
        type=click.Choice(TARGETS),
        help="Print only code: WPILib's feedforward, or the settings of a motor controller.",
    ),
    click.option(
        "--season",
        type=click.Choice(SEASONS),
        default="2026",
        show_default=True,
        help="WPILib season, for --paste.",
    ),
)


def list_catalogue(
    members: Mapping[str, Any],
    *keys: str,
    describe: Callable[[Any], Mapping[str, Any]] = lambda _: {},
    as_json: bool,
) -> None:
    """Print a catalogue: name and summary, one line each, or everything as JSON.

    Args:
        members: the members by their names, each with a ``summary``.
        keys: further attributes of a member that JSON has.
        describe: what else JSON has about a member.
        as_json: print JSON.
    """
    if as_json:
        rows = [
            {
                "name": name,
                **{key: getattr(one, key) for key in ("summary", *keys)},
                **describe(one),
            }
            for name, one in members.items()
        ]
        click.echo(json.dumps(rows, allow_nan=False))
    else:
        width = max(map(len, members))
        click.echo("\n".join(f"{name:{width}}  {one.summary}" for name, one in members.items()))


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
