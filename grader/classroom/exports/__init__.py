"""Formats of gradebooks and of other people's systems, found by looking into this folder.

Each module offers ``SUMMARY``, one line for people, and ``write(results, folder)``, which writes
its files into the folder and returns their paths.
"""

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules

from grader.classroom.results import Results


@dataclass(frozen=True)
class Export:
    """One format.

    Args:
        name: as typed after ``--export``.
        summary: one line for people.
        write: results and a folder -> the files written there.
    """

    name: str
    summary: str
    write: Callable[[Results, Path], tuple[Path, ...]]


def exports() -> dict[str, Export]:
    """Name -> format, of all there are."""
    found = sorted(one.name for one in iter_modules(__path__))
    modules = {name: import_module(f"{__name__}.{name}") for name in found}
    return {name: Export(name, one.SUMMARY, one.write) for name, one in modules.items()}
