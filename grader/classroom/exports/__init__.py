"""Formats of gradebooks and of other people's systems, found by looking into this folder.

Each module offers ``write(results, folder)``, which writes its files into the folder and returns
their paths. One that needs to know more of the students than their names offers ``ROSTER``, columns
of a roster of which one has to be there. One that leaves something out offers ``warn(results)``:
what, in one line, or nothing.
"""

from collections.abc import Sequence
from importlib import import_module
from pkgutil import iter_modules
from types import ModuleType

from grader.classroom.roster import Roster
from sim.core.errors import BadRequest


def list_exports() -> dict[str, ModuleType]:
    """Name -> the module that writes this format, of all there are."""
    found = sorted(one.name for one in iter_modules(__path__))
    return {name: import_module(f"{__name__}.{name}") for name in found}


def choose_exports(wanted: Sequence[str], roster: Roster) -> dict[str, ModuleType]:
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
    found = {name: formats[name] for name in ("gradebook", *wanted)}
    header = {name.strip().casefold() for name in roster.header}
    for name, one in found.items():
        needed = getattr(one, "ROSTER", ())
        if needed and header.isdisjoint(column.casefold() for column in needed):
            raise BadRequest(
                f"--export {name} needs a roster with a column {' or '.join(needed)}",
                advice=f"Export the gradebook from {name.title()}, and give its file as --roster.",
            )
    return found
