"""Catalogues: packages in which each module is one member, without a registry."""

from collections.abc import Callable, Iterable
from importlib import import_module
from pkgutil import iter_modules
from types import ModuleType
from typing import TypeVar

from sim.core.errors import BadRequest

Member = TypeVar("Member")


def import_member(package: ModuleType, name: str) -> ModuleType:
    """One module of a catalogue.

    Raises:
        BadRequest: the file breaks as Python reads it; the message names it.
    """
    try:
        return import_module(f"{package.__name__}.{name}")
    except BadRequest:
        raise
    except Exception as error:
        what = f"cannot be loaded ({type(error).__name__}: {error})"
        raise refuse_member(package, name, what) from error


def refuse_member(package: ModuleType, name: str, what: str) -> BadRequest:
    """The refusal of a file in a catalogue.

    Args:
        package: the package of the catalogue.
        name: of the file, with dashes or underscores.
        what: is wrong with it.
    """
    return BadRequest(
        what,
        where=f"{package.__name__.replace('.', '/')}/{name.replace('-', '_')}.py",
        advice="Correct it, or take it out of the folder.",
    )


def load_catalogue(
    package: ModuleType,
    kind: type[Member],
    find_breaches: Callable[[Member, str], Iterable[str]] = lambda _member, _caption: (),
) -> dict[str, Member]:
    """The members of a catalogue by name: what each module offers as ``EFFECT`` for an ``Effect``.

    A name has dashes where its file has underscores: ``encoder-slip`` in ``encoder_slip.py``.

    Args:
        package: the package of the catalogue.
        kind: the class of its members, which have a ``name``.
        find_breaches: member and text at the top of its file -> what is wrong with them.

    Raises:
        BadRequest: a module offers none, one with another name than its file, or a wrong one.
    """
    members: dict[str, Member] = {}
    for found in sorted(iter_modules(package.__path__), key=lambda module: module.name):
        name, module = found.name.replace("_", "-"), import_member(package, found.name)
        member = getattr(module, kind.__name__.upper(), None)
        if not isinstance(member, kind):
            what = f"offers no {kind.__name__.upper()} = {kind.__name__}(...)"
            raise refuse_member(package, name, what)
        if (said := getattr(member, "name", "")) != name:
            raise refuse_member(package, name, f"has the name {said!r} in it, and not {name!r}")
        if broken := "; ".join(find_breaches(member, module.__doc__ or "")):
            raise refuse_member(package, name, broken)
        members[name] = member
    return members
