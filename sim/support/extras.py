"""The command that installs the packages of an extra, for each way to install the course."""

import re
from importlib.metadata import PackageNotFoundError, requires

DISTRIBUTION = "sysid-course"


def format_install_command(extra: str) -> str:
    """``python -m pip install`` with the packages that an extra of the course asks for.

    The packages stand there by their own names, so that the command does the same in a clone, in a
    course folder and beside an installed wheel, and asks no registry for the course itself.

    Args:
        extra: as pyproject.toml names it: ``robot``.
    """
    found = " ".join(f'"{one}"' for one in _list_requirements(extra))
    return f"python -m pip install {found}" if found else "install the course again"


def _list_requirements(extra: str) -> list[str]:
    """The requirements of an extra, and of the extras that it asks for."""
    try:
        every = requires(DISTRIBUTION) or []
    except PackageNotFoundError:
        return []
    found: list[str] = []
    for line in every:
        requirement, _, marker = (part.strip() for part in line.partition(";"))
        if not re.search(rf"""\bextra\s*==\s*['"]{re.escape(extra)}['"]""", marker):
            continue
        own = re.fullmatch(rf"{DISTRIBUTION}\[([\w-]+)\]", requirement)
        found += _list_requirements(own[1]) if own else [requirement]
    return list(dict.fromkeys(found))
