"""Whether an error of Python's is about a name of another season than the one installed."""

import re
from importlib.metadata import PackageNotFoundError, version

from grader.robotcode.vocabulary import find_season_of

ABOUT = re.compile(
    r"AttributeError: .* has no attribute '(\w+)'"
    r"|TypeError: .* got an unexpected keyword argument '(\w+)'"
    r"|ImportError: cannot import name '(\w+)'"
)
IMPORTS = re.compile(r"(ImportError|ModuleNotFoundError): ")


def explain_other_season(error: str, code: str) -> str:
    """An explanation if an error comes from a name of another WPILib season; else empty.

    Args:
        error: Python's own line: ``AttributeError: ... has no attribute 'set_voltage'``.
        code: the learner's. What it imports may have moved, too: there its other names tell.
    """
    found = ABOUT.match(error)
    names = [name for name in found.groups() if name] if found else []
    if IMPORTS.match(error):
        names += re.findall(r"\w+", code)
    try:
        here = version("wpilib")
    except PackageNotFoundError:
        return ""
    for name in names:
        season = find_season_of(name)
        if season and not here.startswith(season):
            return f"{name} is a name of {season}, and the RobotPy installed here is {here}"
    return ""
