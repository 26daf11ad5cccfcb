"""Logs of CTRE's SignalLogger (``.hoot``), converted to WPILOG by CTRE's own program ``owlet``.

The format is not published. AdvantageScope, too, calls ``owlet IN OUT -f wpilog``
(``owletInterface.ts``). If it is not installed, the log is refused.
"""

import os
import shutil
import subprocess
from pathlib import Path

from sim.core.errors import UnreadableFile

SUFFIX = ".hoot"
VARIABLE = "SYSID_OWLET"  # environment variable with the path of owlet
TIMEOUT = 300  # [s] for the conversion of a log


def convert_hoot(path: Path, folder: Path) -> Path:
    """Convert a log to WPILOG.

    Args:
        path: the log.
        folder: folder of the WPILOG file, which has the name of the log.

    Returns:
        The path of the WPILOG file.

    Raises:
        UnreadableFile: owlet is not installed, or cannot convert the log.
    """
    owlet = _find_owlet()
    target = folder / f"{path.stem}.wpilog"
    command = [owlet, str(path.resolve()), str(target), "-f", "wpilog"]
    try:
        ended = subprocess.run(  # noqa: S603 - a program that the user installed
            command, capture_output=True, check=False, stdin=subprocess.DEVNULL, timeout=TIMEOUT
        )
    except subprocess.TimeoutExpired:
        raise _make_failure(f"took longer than {TIMEOUT} s") from None
    except OSError as error:
        raise _make_failure(f"cannot be started: {error.strerror or error}") from None
    if ended.returncode or not target.is_file():
        output = (ended.stderr or ended.stdout).decode("utf-8", "replace").split("\n")
        last = next((line.strip() for line in reversed(output) if line.strip()), "")
        raise _make_failure(f"cannot convert it{f': {last}' if last else ''}")
    return target


def _find_owlet() -> str:
    """The path of owlet.

    Raises:
        UnreadableFile: owlet is not installed.
    """
    named = os.environ.get(VARIABLE, "")
    found = shutil.which(named or "owlet")
    if found is None:
        raise UnreadableFile(
            f"there is no program {named}, which {VARIABLE} names"
            if named
            else "a log of CTRE's SignalLogger (.hoot) is read with CTRE's program owlet, which is "
            "not installed",
            advice="Convert the log to WPILOG with Phoenix Tuner X (Log Extractor) and give that, "
            f"or put owlet on PATH or its path into {VARIABLE}.",
        )
    return found


def _make_failure(how: str) -> UnreadableFile:
    return UnreadableFile(
        f"CTRE's owlet {how}",
        advice="Convert the log to WPILOG with Phoenix Tuner X (Log Extractor), and give that; a "
        "newer log needs a newer owlet.",
    )
