"""Formats of gradebooks and of other people's systems, found by looking into this folder.

Each module offers ``SUMMARY``, one line for people, and ``write(results, folder)``, which writes
its files into the folder and returns their paths. One that needs to know more of the students than
their names offers ``ROSTER``, columns of a roster of which one has to be there. One that leaves
something out offers ``warn(results)``: what, in one line, or nothing.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules

from grader.classroom.results import ClassResults
from grader.classroom.roster import Roster
from sim.core.errors import BadRequest


@dataclass(frozen=True)
class ExportFormat:
    """One format.

    Args:
        name: as typed after ``--export``.
        summary: one line for people.
        write: results and a folder -> the files written there.
        roster: columns of a roster of which it needs one; empty where names are enough.
        warn: what its files leave out, in one line; empty if nothing.
    """

    name: str
    summary: str
    write: Callable[[ClassResults, Path], tuple[Path, ...]]
    roster: tuple[str, ...] = ()
    warn: Callable[[ClassResults], str] = lambda _: ""


def list_exports() -> dict[str, ExportFormat]:
    """Name -> format, of all there are."""
    found = sorted(one.name for one in iter_modules(__path__))
    modules = {name: import_module(f"{__name__}.{name}") for name in found}
    return {
        name: ExportFormat(
            name, one.SUMMARY, one.write, getattr(one, "ROSTER", ()),
            getattr(one, "warn", lambda _: ""),
        )
        for name, one in modules.items()
    }  # fmt: skip


def choose_exports(wanted: Sequence[str], *, roster: Roster | None) -> tuple[ExportFormat, ...]:
    """The export formats to write: the gradebook, and the chosen ones.

    Args:
        wanted: names of formats.
        roster: who is in the class.

    Raises:
        BadRequest: there is no such format, or the roster lacks what it needs.
    """
    formats = list_exports()
    unknown = [one for one in wanted if one not in formats]
    if unknown:
        raise BadRequest(
            f"there is no format {unknown[0]!r}", advice=f"Choose one of: {', '.join(formats)}."
        )
    found = tuple(formats[one] for one in dict.fromkeys(("gradebook", *wanted)))
    header = {name.strip().casefold() for name in roster.header} if roster else set()
    for one in found:
        if one.roster and header.isdisjoint(name.casefold() for name in one.roster):
            raise BadRequest(
                f"--export {one.name} needs a roster with a column {' or '.join(one.roster)}",
                advice=f"Give the gradebook that {one.name.title()} exports as --roster.",
            )
    return found
