"""Fakes of the libraries that robot code uses: WPILib, Phoenix 6 and 5, REVLib, AdvantageKit.

Every module of this folder registers its classes; nothing is listed here.
"""

import importlib
import pkgutil
import tomllib
from pathlib import Path

from grader.robotcode.library.base import JAVA, PYTHON, add_named_classes

__all__ = ["JAVA", "PYTHON"]

for _one in pkgutil.iter_modules(__path__):
    importlib.import_module(f"{__name__}.{_one.name}")
add_named_classes(
    tomllib.loads(Path(__file__).with_name("names.toml").read_text("utf-8"))["classes"]
)
