"""Reading and writing logs: the format is found by the content of a file and by its suffix.

Every module of ``formats`` is a format; ``format.py`` defines its interface. Only the modules that
are needed are imported.
"""

import os
import stat
import tempfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import replace
from difflib import get_close_matches
from pathlib import Path
from pkgutil import iter_modules
from typing import cast

from sim.core.doubt import Doubt
from sim.core.errors import BadRequest, Refusal, UnreadableFile
from sim.core.log import Log
from sim.io import formats
from sim.io.entries.entry import Entry
from sim.io.foreign import FOREIGN
from sim.io.format import HEAD, LARGEST_FILE, Format, ReadOptions
from sim.io.hoot import SUFFIX, convert_hoot
from sim.io.motion import differentiate_position
from sim.support.atomic_file import atomic_path
from sim.support.catalogue import import_member
from sim.support.os_errors import refuse_os_errors

FORMATS = tuple(sorted(found.name for found in iter_modules(formats.__path__)))


def read(
    path: str | os.PathLike[str],
    *,
    units: str | None = None,
    type: str | None = None,  # noqa: A002 - the word of the command line and of Log
    motor: str | None = None,
    entries: Mapping[str, str] | None = None,
    ignore_velocity: bool = False,
    pick: int | None = None,
) -> Log:
    """Read a log of any format in this folder.

    Args:
        path: the file.
        units: the unit of its positions; None takes what the file says, else the default.
        type: ``simple``, ``elevator`` or ``arm``; None takes what the file says.
        motor: name of the motor to read, if the file has several; None combines them.
        entries: signal -> the entry or column that holds it, if the names are not SysId's.
        ignore_velocity: use the slope of the position as the velocity.
        pick: number of the mechanism to read, counted from 1; None if the file has only one.

    Returns:
        The log; its ``source`` is the path as given, its ``doubts`` are warnings about the file.
        Where the file holds only a position or only a velocity, the other is computed from it.

    Raises:
        UnreadableFile: the file is missing, empty, too large, damaged, or of an unknown format.
        MissingSignal: the file lacks an entry that every fit needs.
        BadSample: the file holds a number that cannot be a measurement.
        BadRequest: an unknown unit, type, motor or mechanism.
    """
    return read_with(
        path,
        ReadOptions(
            units=units, type=type, motor=motor, entries=dict(entries or {}),
            ignore_velocity=ignore_velocity, pick=pick,
        ),
    )  # fmt: skip


def read_with(path: str | os.PathLike[str], options: ReadOptions) -> Log:
    """Read a log as ``read`` does, with its options in one object.

    Raises:
        Refusal: as ``read``.
    """
    (log,) = _read_motor_logs(path, replace(options, each_motor=False)).values()
    return log


def read_motors(path: str | os.PathLike[str], options: ReadOptions | None = None) -> dict[str, Log]:
    """Read a file of any format as a log for each motor of a mechanism or side of a drivetrain.

    Args:
        path: the file.
        options: how it is read; None leaves every choice to the file.

    Returns:
        The name of each motor -> its log; a log with one motor that has no name is under ``""``.

    Raises:
        Refusal: as ``read``.
    """
    return _read_motor_logs(path, replace(options or ReadOptions(), each_motor=True))


def _read_motor_logs(path: str | os.PathLike[str], options: ReadOptions) -> dict[str, Log]:
    """The name of each motor -> its log, as ``read`` and ``read_motors`` return them."""
    given = os.fspath(path)
    with _open_format(given) as (module, file):
        logs = module.read(file, options)
        logs = {name: _name_source(log, file, given) for name, log in logs.items()}
    return {name: _apply_options(log, options) for name, log in logs.items()}


def list_entries(path: str | os.PathLike[str]) -> list[Entry]:
    """The entries of a log file, for choosing signals.

    Args:
        path: the file.

    Raises:
        UnreadableFile: the file is missing, empty, too large, damaged, or of an unknown format.
        BadRequest: files of this format have no named entries.
    """
    given = os.fspath(path)
    with _open_format(given) as (module, file):
        list_of_file = getattr(module, "entries", None)
        if list_of_file is None:
            raise BadRequest(
                "a log of this format has fixed signals and no entries",
                advice="Read it with `sysid fit` or `sysid inspect`.",
            )
        return list(list_of_file(file))


@contextmanager
def _open_format(given: str) -> Iterator[tuple[Format, Path]]:
    """A context with the format and the path to read: the file, or the one it was converted to.

    Raises:
        Refusal: the file cannot be read; every refusal names it as it was given.
    """
    path = Path(given)
    with _name_file_in_refusals(given):
        head = _read_head(given)
        if path.suffix.lower() != SUFFIX or head.startswith(b"WPILOG"):
            yield _find_format(path, head), path
            return
        with tempfile.TemporaryDirectory(prefix="sysid-hoot-") as folder:
            made = convert_hoot(path, Path(folder))
            try:
                yield _find_format(made, _read_head(str(made))), made
            except Refusal as refusal:
                raise refusal.move(refusal.where.replace(str(made), given)) from None


def _name_source(log: Log, file: Path, given: str) -> Log:
    """The log with the file's name, as it was given, in its source and doubts."""
    doubts = tuple(
        replace(doubt, message=doubt.message.replace(str(file), given)) for doubt in log.doubts
    )
    return replace(log, source=given, doubts=doubts)


@contextmanager
def _name_file_in_refusals(given: str) -> Iterator[None]:
    """A context in which every refusal names the file as it was given."""
    try:
        yield
    except Refusal as refusal:
        if refusal.where.startswith((given, str(Path(given)))):
            raise
        raise refusal.move(f"{given}, {refusal.where}" if refusal.where else given) from None
    except OSError as error:
        raise UnreadableFile(
            f"cannot be read ({error.strerror or error})", where=given, advice="Copy it again."
        ) from None


def write(log: Log, path: str | os.PathLike[str]) -> None:
    """Write a log in the format of the suffix of ``path``.

    If that fails, an existing file stays as it was.

    Args:
        log: the log to write.
        path: the file; an existing one is replaced.

    Raises:
        BadRequest: no format with this suffix can be written, the file cannot be written, or the
            log has no runs, or a run without samples.

    Examples:
        >>> import tempfile
        >>> from sim.core.log import Log, Run
        >>> folder = tempfile.TemporaryDirectory()
        >>> run = Run("dynamic-forward", [0.0, 0.02], [7.0, 7.0], [0.0, 0.0], [0.0, 1.0])
        >>> write(Log((run,)), f"{folder.name}/log.csv")
        >>> read(f"{folder.name}/log.csv").runs[0].velocity
        array([0., 1.])
        >>> folder.cleanup()
    """
    given = os.fspath(path)
    if "\0" in given:
        raise BadRequest("a path cannot hold a zero byte", advice="Give another path.")
    write_file = _find_writer(given)
    if not log.runs or not all(len(run) for run in log.runs):
        raise BadRequest(
            "a run of the log has no samples" if log.runs else "the log has no runs",
            advice="Write a log in which every run has samples.",
        )
    target = Path(os.path.realpath(given))
    advice = (
        "Choose a folder that exists and that you may write to, and close the file if another "
        "program has it open."
    )
    with refuse_os_errors("cannot be written", Path(given), advice=advice):
        if target.exists() and not (target.is_file() and os.access(target, os.W_OK)):
            raise BadRequest(
                "is there already and cannot be replaced", where=given, advice="Choose another."
            )
        with atomic_path(target) as part:
            write_file(log, part)


def _apply_options(log: Log, options: ReadOptions) -> Log:
    """The log with the type that the user chose, and its velocity replaced if that was asked for.

    There is a doubt if the file names another type.
    """
    log = differentiate_position(log) if options.ignore_velocity else log
    wanted = options.type
    if wanted is None or wanted == log.type:
        return log
    if not log.type:
        return replace(log, type=wanted)
    doubt = Doubt(
        "contradicting-type",
        f"{log.source} says it is of type {log.type}; it is taken as {wanted}, as you asked. "
        "Leave out the type to follow the file.",
    )
    return replace(log, type=wanted).add_doubts(doubt)


def _order_formats(path: str) -> Iterator[tuple[str, Format]]:
    """All formats with their names; those whose name matches the suffix come first."""
    ending = Path(path).suffix.lower().lstrip(".")
    for name in sorted(FORMATS, key=lambda name: not (ending and name.endswith(ending))):
        yield name, cast("Format", import_member(formats, name))


def _find_format(path: Path, head: bytes) -> Format:
    """The format of a file that starts with ``head``.

    Raises:
        UnreadableFile: the format is not supported.
    """
    modules = _order_formats(path.name)
    tried = []
    for _, module in modules:
        if module.recognizes(head):
            return module
        tried.append(module)
    suffix = path.suffix.lower()
    opening = head.lstrip().lower()
    for foreign in FOREIGN:
        if (
            suffix in foreign.suffixes
            or head.startswith(foreign.starts)
            or opening.startswith(foreign.starts)
        ):
            raise UnreadableFile(f"this is {foreign.what}", advice=foreign.advice)
    for module in tried:
        if suffix in module.SUFFIXES:
            return module  # its error messages say what is missing
    suffixes = ", ".join(suffix for module in tried for suffix in module.SUFFIXES)
    looks = "some binary format" if b"\x00" in head else "plain text without a log's first line"
    raise UnreadableFile(
        f"not a log that can be read here; it looks like {looks}",
        advice=f"Logs are {suffixes}; a CSV log begins with test,time_s,voltage,position,velocity.",
    )


def _find_writer(given: str) -> Callable[[Log, Path], None]:
    """The function that writes a file with the suffix of a path.

    Raises:
        BadRequest: no format with this suffix can be written.
    """
    writable: list[str] = []
    for _, module in _order_formats(given):
        write_file: Callable[[Log, Path], None] | None = getattr(module, "write", None)
        if write_file is not None:
            if given.lower().endswith(module.SUFFIXES):
                return write_file
            writable.extend(module.SUFFIXES)
    raise BadRequest(
        f"a log whose name ends in {Path(given).suffix or 'nothing'!r} cannot be written",
        where=given,
        advice=f"End its name in one of: {', '.join(sorted(writable))}.",
    )


def _read_head(given: str) -> bytes:
    """The first bytes of a file.

    Raises:
        UnreadableFile: there is no such file, or it is empty, too large or not readable.
    """
    path = Path(given)
    try:
        state = path.stat()
        if not stat.S_ISREG(state.st_mode):
            kind = "a folder" if stat.S_ISDIR(state.st_mode) else "not a file on a disk"
            raise UnreadableFile(f"this is {kind}", advice="Give the path of a log file.")
        if state.st_size == 0:
            raise UnreadableFile("the file is empty", advice="Copy it from the robot again.")
        if state.st_size > LARGEST_FILE:
            raise UnreadableFile(
                f"the size of the file is {state.st_size / 2**30:.1f} GiB, but files larger than "
                f"{LARGEST_FILE / 2**30:.0f} GiB cannot be read",
                advice="Export only the four tests from it, with AdvantageScope for example.",
            )
        with path.open("rb") as stream:
            return stream.read(HEAD)
    except (FileNotFoundError, NotADirectoryError):
        raise UnreadableFile("there is no such file", advice=_advise_similar_path(path)) from None
    except PermissionError:
        raise UnreadableFile(
            "you may not read this file", advice="Change its permissions, or copy it."
        ) from None
    except ValueError as error:  # an invalid path, with a zero byte
        raise UnreadableFile(
            f"this is not a path ({error})", advice="Give the path of a log file."
        ) from None


def _advise_similar_path(path: Path) -> str:
    """Advice for a path without a file: a similar name, if there is one."""
    with suppress(OSError):
        names = [entry.name for entry in path.parent.iterdir() if entry.is_file()]
        for name in get_close_matches(path.name, names, n=1):
            return f"Did you mean {path.with_name(name)}?"
        return "Check the spelling, and the folder you are in."
    return f"There is no folder {path.parent} either: check the path."
