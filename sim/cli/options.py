"""Options and arguments that several commands share."""

import json
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import reduce
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import click

from sim.core.errors import BadRequest
from sim.core.units import UNITS
from sim.core.vocabulary import TYPES
from sim.support.completion import complete_members

if TYPE_CHECKING:
    from sim.core.log import Log

Option: TypeAlias = Callable[[Callable[..., Any]], Callable[..., Any]]

FILE = click.Path(path_type=Path)
SIM = Path(__file__).resolve().parents[1]
MECHANISM_NAMES = complete_members(SIM / "bench" / "mechanisms")
EFFECT_NAMES = complete_members(SIM / "physics" / "effects")
FAULT_NAMES = complete_members(SIM / "inspect" / "faults")


def _factor(_: click.Context, __: click.Parameter, value: float) -> float:
    """The value, if it is finite and not zero.

    Raises:
        BadParameter: it is not.
    """
    if not (math.isfinite(value) and value):
        raise click.BadParameter(f"{value:g} is not a finite number other than zero.")
    return value


as_json = click.option("--json", "as_json", is_flag=True, help="Print JSON for other programs.")


def combine_options(*options: Option) -> Option:
    """Decorator that adds several options to a command, in their order."""
    return lambda command: reduce(lambda made, option: option(made), reversed(options), command)


# Options for reading a log.
reading_options = combine_options(
    click.option("--type", "type_", type=click.Choice(TYPES), help="What kind of mechanism."),
    click.option(
        "--units", type=click.Choice(tuple(UNITS)), help="Units of the positions in the file."
    ),
    click.option("--motor", help="Which motor, if the log has several: left, right, …"),
    click.option("--voltage", metavar="ENTRY", help="Log entry with the applied voltage."),
    click.option("--position", metavar="ENTRY", help="Log entry with the position."),
    click.option("--velocity", metavar="ENTRY", help="Log entry with the velocity."),
    click.option("--state", metavar="ENTRY", help="Log entry with the running test's name."),
)
# Which mechanism, and how to correct a velocity that was logged wrongly.
velocity_options = combine_options(
    click.option(
        "--pick",
        type=click.IntRange(min=1),
        metavar="N",
        help="Which mechanism, if the log has several: its number in the message.",
    ),
    click.option(
        "--velocity-scale",
        metavar="X",
        type=float,
        callback=_factor,
        default=1.0,
        help="Multiply the velocity by X, if its factor in the robot's code is wrong.",
    ),
    click.option(
        "--ignore-velocity",
        is_flag=True,
        help="Use the slope of the position as the velocity.",
    ),
)


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
            if any(_is_same_file(path, other) for other in others):
                raise BadRequest(
                    f"this would overwrite {what}",
                    where=str(path),
                    advice="Give the output another name.",
                )
        written.append(path)


def refuse_duplicates(files: Sequence[Path]) -> None:
    """Refuse a file that is given twice: its samples would count twice.

    Raises:
        BadRequest: two of them are the same file.
    """
    for index, file in enumerate(files):
        if any(_is_same_file(file, other) for other in files[:index]):
            raise BadRequest(
                "this file is given twice", where=str(file), advice="Name each file once."
            )


def _is_same_file(one: Path, other: Path) -> bool:
    """Whether two paths lead to one file, also through links."""
    try:
        return one.samefile(other)
    except OSError:  # one of them does not exist yet
        return one.resolve() == other.resolve()


def read_logs_together(files: Iterable[Path], **how: Any) -> "Log":  # noqa: ANN401 - passed on
    """Read the files of one mechanism as one log.

    Args:
        files: paths of logs in any format.
        how: the keyword arguments of ``read_each_log``.

    Raises:
        Refusal: as ``read_each_log``, or one file measures a length and another an angle.
    """
    first, *more = read_each_log(files, **how)
    for log in more:
        first = first.join(log)
    return first


def read_each_log(
    files: Iterable[Path],
    *,
    units: str | None,
    type: str | None,  # noqa: A002 - the field's own word
    motor: str | None,
    entries: Mapping[str, str | None],
) -> "list[Log]":
    """Read the files of one mechanism, each as a log.

    Args:
        files: paths of logs in any format.
        units: unit of the positions in them; None takes the one in each file.
        type: type of the mechanism; None takes the one in each file.
        motor: name of the motor to read, if a file has several.
        entries: signal -> name of its entry; None finds it by name.

    Raises:
        Refusal: a file cannot be read, or is given twice.
    """
    from sim.io import read  # noqa: PLC0415 - --help must not wait for it
    from sim.io.voltage import check_voltage  # noqa: PLC0415 - the same

    named = {signal: entry for signal, entry in entries.items() if entry}
    refuse_duplicates(files := tuple(files))
    logs = [read(file, units=units, type=type, motor=motor, entries=named) for file in files]
    return [check_voltage(log) for log in logs]


@dataclass(frozen=True)
class PartReader:
    """Reads the files of a robot, one log for each mechanism, side or motor.

    Args:
        units: unit of the positions in them; None takes the one in each file.
        type: type of the mechanism; None takes the one in each file.
        motor: name of the only motor to read; None reads all.
        entries: signal -> name of its entry; None finds it by name.
        velocity: factor of the velocity; None uses the slope of the position as the velocity.
        pick: number of the mechanism to read, counted from 1; None if the log has only one.
    """

    units: str | None = None
    type: str | None = None
    motor: str | None = None
    entries: Mapping[str, str | None] = field(default_factory=dict)
    velocity: float | None = 1.0
    pick: int | None = None

    def read(self, files: Sequence[Path]) -> "Mapping[str, Log]":
        """The logs in all files, by the name of the mechanism, side or motor.

        Raises:
            Refusal: a file cannot be read or is given twice, or one measures a length and another
                an angle.
        """
        from sim.cli.fit.parts import list_parts  # noqa: PLC0415 - only for a fit

        refuse_duplicates(files)
        return list_parts([(file, self.read_file(file)) for file in files])

    def read_file(self, file: Path) -> "dict[str, Log]":
        """The logs in one file, by the name of the mechanism, side or motor.

        Raises:
            Refusal: the file cannot be read.
        """
        from sim.io import read_motors  # noqa: PLC0415 - --help must not wait for it
        from sim.io.velocity import check_velocity, scale_velocity  # noqa: PLC0415 - the same
        from sim.io.voltage import check_voltage  # noqa: PLC0415 - the same

        named = {signal: entry for signal, entry in self.entries.items() if entry}
        logs = read_motors(
            file, units=self.units, type=self.type, motor=self.motor, entries=named,
            ignore_velocity=self.velocity is None, pick=self.pick,
        )  # fmt: skip
        logs = {name: check_voltage(log) for name, log in logs.items()}
        factor = self.velocity
        if factor is None:
            return logs
        return {
            name: check_velocity(log if factor == 1.0 else scale_velocity(log, factor))
            for name, log in logs.items()
        }
