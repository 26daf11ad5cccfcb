"""The scripts of the folder ``.ci``, as modules."""

import importlib.util
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[1] / ".ci"


def load_script(name):
    """A script as a module."""
    spec = importlib.util.spec_from_file_location(name, FOLDER / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
