"""Logs of CTRE's SignalLogger (``.hoot``), converted to WPILOG by CTRE's own program ``owlet``.

The format is CTRE's secret. AdvantageScope, too, calls ``owlet IN OUT -f wpilog``
(``owletInterface.ts``); where it is not installed, the log is refused.
"""

import os
import shutil
import subprocess
from pathlib import Path

from sim.core.errors import UnreadableFile

SUFFIX = ".hoot"
VARIABLE = "SYSID_OWLET"  # the environment's word for where owlet is
PATIENCE = 300  # [s] for a log of an hour


def convert_hoot(path: Path, folder: Path) -> Path:
    """Convert a log to WPILOG.

    Args:
        path: the log.
        folder: where the WPILOG is written, under the name of the log.

    Returns:
        The WPILOG.

    Raises:
        UnreadableFile: owlet is not installed, or cannot convert it.
    """
    owlet = _find_owlet()
    target = folder / f"{path.stem}.wpilog"
    command = [owlet, str(path.resolve()), str(target), "-f", "wpilog"]
    try:
        ended = subprocess.run(  # noqa: S603 - the program that its owner installed
            command, capture_output=True, check=False, stdin=subprocess.DEVNULL, timeout=PATIENCE
        )
    except subprocess.TimeoutExpired:
        raise _failed(f"took longer than {PATIENCE} s") from None
    except OSError as error:
        raise _failed(f"cannot be started: {error.strerror or error}") from None
    if ended.returncode or not target.is_file():
        said = (ended.stderr or ended.stdout).decode("utf-8", "replace").split("\n")
        last = next((line.strip() for line in reversed(said) if line.strip()), "")
        raise _failed(f"cannot convert it{f': {last}' if last else ''}")
    return target


def _find_owlet() -> str:
    """The program.

    Raises:
        UnreadableFile: it is not installed.
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


def _failed(how: str) -> UnreadableFile:
    return UnreadableFile(
        f"CTRE's owlet {how}",
        advice="Convert the log to WPILOG with Phoenix Tuner X (Log Extractor), and give that; a "
        "newer log needs a newer owlet.",
    )
