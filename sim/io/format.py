"""The interface of a log format: a module in ``sim/io/formats`` that reads a file into a Log.

A module defines

    SUFFIXES : tuple[str, ...]                 endings of its files, lower case: (".wpilog",)
    def recognizes(head: bytes) -> bool             whether a file that starts like this is its own
    def read(path: Path, options: ReadOptions) -> dict[str, Log]    name of each motor -> its log
    def write(log: Log, path: Path) -> None    optional: some formats are only read
    def entries(path: Path) -> list[Entry]     optional: where a log has entries with names

and is found by its place in the folder. Formats do not import one another.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

import numpy as np

from sim.core.advice import Action
from sim.core.doubt import Doubt
from sim.core.errors import BadRequest, BadSample, MissingSignal, refuse_unknown
from sim.core.log import LARGEST, Array, Log, Run, integrate_velocity
from sim.core.units import find_unit
from sim.core.vocabulary import TYPES
from sim.io.motion import MADE_FROM, compute_position_slope

HEAD = 4096  # [bytes] length of the beginning of a file that `recognizes` gets
LARGEST_FILE = 2**30  # [bytes] hours of logging


@dataclass(frozen=True)
class ReadOptions:
    """Options for reading a file; None leaves the choice to the file.

    Args:
        units: unit of the positions in the file.
        type: ``simple``, ``elevator`` or ``arm``.
        motor: name of the motor to read (``left``), if the file has several; None combines them.
        entries: signal (``voltage``, ``position``, ``velocity``) -> the entry that holds it,
            for logs that do not use SysId's names.
        ignore_velocity: the velocity is the slope of the position, and the file needs none.
        pick: number of the mechanism to read, counted from 1 as in the message that lists them.
        each_motor: whether each motor gets a log of its own, instead of one log for their mean.

    Raises:
        BadRequest: an unknown unit or type.
    """

    units: str | None = None
    type: str | None = None
    motor: str | None = None
    entries: Mapping[str, str] = field(default_factory=dict)
    ignore_velocity: bool = False
    pick: int | None = None
    each_motor: bool = False

    def __post_init__(self) -> None:
        if self.type is not None:
            refuse_unknown("type", self.type, TYPES)
        if self.units is not None:
            object.__setattr__(self, "units", find_unit(self.units).name)

    @property
    def units_or_default(self) -> str:
        """The chosen unit, else radians for an arm and meters for other types."""
        return self.units or ("radians" if self.type == "arm" else "meters")


class Format(Protocol):
    """The protocol of a module in ``sim/io/formats``."""

    SUFFIXES: tuple[str, ...]

    def recognizes(self, head: bytes) -> bool:
        """Whether a file whose first bytes are ``head`` is of this format."""

    def read(self, path: Path, options: ReadOptions) -> dict[str, Log]:
        """Read a file: the name of each motor -> its log; ``""`` -> the log of all together."""


def refuse_pick(pick: int | None, *, where: str) -> None:
    """Refuse the number of a mechanism in a file that holds only one.

    Raises:
        BadRequest: the number is not 1.
    """
    if pick not in {None, 1}:
        raise BadRequest(
            f"it holds one mechanism, so there is no number {pick}",
            where=where,
            advice="Leave out --pick.",
        )


def warn_of_motor_choice(motor: str | None, *, where: str) -> tuple[Doubt, ...]:
    """A warning if a motor is chosen in a file that holds only one."""
    if motor is None:
        return ()
    return (
        Doubt(
            "one-motor",
            f"{where} holds one motor's signals and does not name it, so {motor!r} made no "
            "difference.",
        ),
    )


def warn_of_missing_signal(
    missing: str | None, options: ReadOptions, *, where: str
) -> tuple[Doubt, ...]:
    """A warning if a file lacks the position or the velocity (``missing``), unless it was ignored.

    Raises:
        MissingSignal: the file lacks the position of an arm.
    """
    if missing is None or (missing == "velocity" and options.ignore_velocity):
        return ()
    if missing == "position" and options.type == "arm":
        raise MissingSignal(
            "it holds no position, and the angle of an arm decides what gravity does",
            where=where,
            advice=Action("arm-position"),
        )
    return (
        Doubt(
            f"no-{missing}",
            f"{where}: it holds no {missing}, so {MADE_FROM[missing]} was taken for it. Log both: "
            "each is checked against the other.",
        ),
    )


def make_run(
    test: str, signals: Mapping[str, Array], *, si: float, where: str
) -> tuple[Run, tuple[Doubt, ...]]:
    """Make a Run from raw columns: check values, drop repeated times, convert to SI.

    Args:
        test: one of ``sim.core.log.TESTS``.
        signals: ``time``, ``voltage``, ``position`` and ``velocity`` or one of them, and optionally
            ``current`` and ``bus_voltage``; each (n,), position and velocity in the file's unit. A
            missing position or velocity is computed from the other one.
        si: the file's unit of position in meters or radians.
        where: the file and the run, for messages.

    Returns:
        The run, and a doubt if samples with a repeated time were dropped.

    Raises:
        BadSample: a value is nan, infinite or absurd; the message names signal, sample and time.
    """
    time = signals["time"]
    for name, values in signals.items():
        bad = np.flatnonzero(~(np.abs(values) < LARGEST))
        if bad.size:
            at = f" (t = {time[bad[0]]:.6g} s)" if name != "time" else ""
            raise BadSample(
                f"{name} is {values[bad[0]]:.6g} at sample {bad[0]}{at}",
                where=f"{where}, {test}" if where else test,
                advice="Remove that sample, or record the run again.",
            )
    keep = np.concatenate(([True], np.diff(time) > 0)) if time.size else np.ones(0, dtype=bool)
    kept = {name: values[keep] for name, values in signals.items()}
    if "velocity" not in kept:
        kept["velocity"] = compute_position_slope(kept["time"], kept["position"])
    elif "position" not in kept:
        kept["position"] = integrate_velocity(kept["time"], kept["velocity"])
    for name in ("position", "velocity"):
        kept[name] = kept[name] * si
    dropped = int(time.size - np.count_nonzero(keep))
    doubts = (
        Doubt(
            "repeated-time",
            f"{where}, {test}: {dropped} of {time.size} samples have the same time as the "
            "sample before "
            "and were left out. Look at how the log was recorded or exported.",
        ),
    )
    return Run(test, **kept), doubts if dropped else ()
