"""The child: the one place that starts a learner's code, in a process and a folder of its own."""

import contextlib
import os
import secrets
import stat
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

from grader.isolation import Limits, run_program
from grader.robotcode.bench import run_routine_child

# Starts a program in a folder, for at most so many seconds; whether it ended by itself.
Start = Callable[[Sequence[str], Path, float], bool]

BENCH = Path(run_routine_child.__file__).resolve()
BUTTONS = BENCH.with_name("run_buttons_child.py")
LARGEST = 4 * 1024**2  # [bytes] of one file a run leaves; an ordinary log has a fortieth of it
GIVEN = "given"  # the folder that may be read, beside the one that may be written
PACKAGES = (  # wpilib and commands2, and what they are made of
    *("wpilib", "commands2", "hal", "ntcore", "wpimath", "wpinet", "wpiutil", "native"),
    *("numpy", "typing_extensions"),
)
KEPT = ("PATH", "SYSTEMROOT", "SYSTEMDRIVE", "TEMP", "TMP", "HOME", "USERPROFILE", "LANG")
GRACE = 2.0  # [s] the child gives up by itself, and says where it was; after that it is ended


def make_child_command(
    file: Path, name: str, folder: Path, *, seconds: float, script: Path = BENCH
) -> list[str]:
    """The child's command line; it writes ``seen.json`` and ``robot.wpilog`` into the folder.

    Args:
        file: the learner's.
        name: the class that is run: its subsystem, or its container.
        folder: where the results go.
        seconds: after which it gives up by itself.
        script: ``BENCH`` or ``BUTTONS``.
    """
    return [
        *(sys.executable, "-B", "-P", str(script)),
        *(str(file.resolve()), name, str(folder.resolve()), f"{seconds:g}"),
    ]


def run_limited(program: Sequence[str], folder: Path, seconds: float) -> bool:
    """Start a program in a process of its own: a limit of time, no words, few variables."""
    nonce, ended = secrets.token_hex(16), True
    with tempfile.TemporaryFile() as stdout:
        try:
            subprocess.run(  # noqa: S603 - our own interpreter and script, no shell
                program,
                cwd=folder,
                env={name: os.environ[name] for name in KEPT if name in os.environ},
                input=nonce.encode(),
                stdout=stdout,
                stderr=subprocess.DEVNULL,
                timeout=seconds,
                check=False,
            )
        except subprocess.TimeoutExpired:
            ended = False
        stdout.seek(0)
        _discard_unfinished(folder, nonce, stdout.read(LARGEST))
    return ended


def run_confined(program: Sequence[str], folder: Path, seconds: float) -> bool:
    """Start a program that reaches nothing but Python, WPILib, its folder and ``GIVEN`` beside it.

    WPILib's simulation needs no network, so there is none. Where the system has no confinement,
    there are limits of time, memory and files; on Windows of time only.
    """
    if sys.platform == "win32":
        return run_limited(program, folder, seconds)
    nonce = secrets.token_hex(16)
    script = next(at for at, word in enumerate(program) if at and not word.startswith("-"))
    ended, said = run_program(
        Path(program[script]),
        program[script + 1 :],
        folder=folder,
        given=folder.with_name(GIVEN),
        packages=PACKAGES,
        beside=(BENCH,),
        limits=Limits(seconds=seconds, file=LARGEST),
        stdin=nonce,
    )
    _discard_unfinished(folder, nonce, said)
    return ended


def _discard_unfinished(folder: Path, nonce: str, said: bytes) -> None:
    """Remove ``seen.json`` if the bench did not come to its end, or if others wrote the file.

    Without that, code could write the file itself and leave early.
    """
    seen = folder / "seen.json"
    with contextlib.suppress(OSError):
        about = seen.lstat()
        ours = stat.S_ISREG(about.st_mode) and about.st_size <= LARGEST
        if ours and said == run_routine_child.sign_result(nonce, seen.read_bytes()):
            return
        if not stat.S_ISDIR(about.st_mode):
            seen.unlink()
