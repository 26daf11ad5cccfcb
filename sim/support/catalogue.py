"""A catalogue is a folder: each module in it is one member, and nothing is registered."""

from importlib import import_module
from pkgutil import iter_modules
from types import ModuleType


def list_members(package: ModuleType) -> dict[str, ModuleType]:
    """The modules of a catalogue, by the name a person types: ``encoder_slip`` -> ``encoder-slip``.

    Args:
        package: the catalogue's own package.
    """
    return {
        found.name.replace("_", "-"): import_module(f"{package.__name__}.{found.name}")
        for found in sorted(iter_modules(package.__path__), key=lambda module: module.name)
    }
