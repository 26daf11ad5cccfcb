"""Options and arguments that several commands share."""

import json
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import reduce, wraps
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import click

from sim.core.errors import BadRequest
from sim.core.units import UNITS
from sim.core.vocabulary import TYPES
from sim.support.completion import complete_members

if TYPE_CHECKING:
    from sim.core.log import Log

READING = ("units", "motor", "pick", "velocity_scale", "ignore_velocity")  # options of LogReader
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


def reading_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """Decorator that adds the options for reading a log; the command gets a ``LogReader``."""

    @wraps(command)
    def call_with_reader(*args: Any, **options: Any) -> Any:  # noqa: ANN401 - passed on
        entries = {name: options.pop(name) for name in ("voltage", "position", "velocity", "state")}
        how = {name: options.pop(name) for name in READING}
        reader = LogReader(**how, type=options.pop("type_"), entries=entries)
        return command(*args, reader=reader, **options)

    return _add_reading_options(call_with_reader)


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


@dataclass(frozen=True)
class LogReader:
    """Reads the logs of a mechanism, as the options of the command line say.

    Args:
        units: unit of the positions in them; None takes the one in each file.
        type: type of the mechanism; None takes the one in each file.
        motor: name of the only motor to read; None reads all.
        entries: signal -> name of its entry; None finds it by name.
        velocity_scale: factor of the velocity.
        ignore_velocity: use the slope of the position as the velocity.
        pick: number of the mechanism to read, counted from 1; None if the log has only one.
    """

    units: str | None = None
    type: str | None = None
    motor: str | None = None
    entries: Mapping[str, str | None] = field(default_factory=dict)
    velocity_scale: float = 1.0
    ignore_velocity: bool = False
    pick: int | None = None

    def read_recorded(self, file: Path) -> "Log":
        """The log in one file as it was recorded; several motors count as their mean.

        Raises:
            Refusal: the file cannot be read.
        """
        from sim.io import read  # noqa: PLC0415 - --help must not wait for it

        return self._scale(read(file, **self._choices))

    def read_joined(self, files: Sequence[Path]) -> "Log":
        """The logs in all files as one, with what can be mended in it mended.

        Raises:
            Refusal: a file cannot be read or is given twice, or one measures a length and another
                an angle.
        """
        refuse_duplicates(files)
        return reduce(
            lambda log, other: log.join(other),
            (_check_signals(self.read_recorded(file)) for file in files),
        )

    def read_parts(self, files: Sequence[Path]) -> "Mapping[str, Log]":
        """The logs in all files, by the name of the mechanism, side or motor.

        Raises:
            Refusal: as ``read_joined``.
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

        logs = read_motors(file, **self._choices)
        return {name: _check_signals(self._scale(log)) for name, log in logs.items()}

    @property
    def _choices(self) -> dict[str, Any]:
        """The keyword arguments of ``sim.io.read``."""
        entries = {signal: entry for signal, entry in self.entries.items() if entry}
        return {
            "units": self.units, "type": self.type, "motor": self.motor, "entries": entries,
            "ignore_velocity": self.ignore_velocity, "pick": self.pick,
        }  # fmt: skip

    def _scale(self, log: "Log") -> "Log":
        """The log with the velocity times the factor that the user gave."""
        if self.velocity_scale == 1.0:
            return log
        from sim.io.motion import scale_velocity  # noqa: PLC0415 - --help must not wait for it

        return scale_velocity(log, self.velocity_scale)


def _check_signals(log: "Log") -> "Log":
    """The log with its motion mended where that is possible, and doubts about wrong units."""
    from sim.inspect.log_units import doubt_units  # noqa: PLC0415 - --help must not wait for it
    from sim.io.motion import leave_out_falls, mend_motion  # noqa: PLC0415 - the same

    mended = leave_out_falls(mend_motion(log))
    return mended.add_doubts(*doubt_units(mended))
