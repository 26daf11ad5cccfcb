"""Catalogues: packages in which each module is one member, without a registry."""

from importlib import import_module
from pkgutil import iter_modules
from types import ModuleType


def list_members(package: ModuleType) -> dict[str, ModuleType]:
    """The modules of a catalogue by name, with dashes: ``encoder-slip`` for ``encoder_slip``.

    Args:
        package: the package of the catalogue.
    """
    return {
        found.name.replace("_", "-"): import_module(f"{package.__name__}.{found.name}")
        for found in sorted(iter_modules(package.__path__), key=lambda module: module.name)
    }
