"""Datasets that the tests of ``sysid dataset`` make."""

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from sim.cli import sysid as command
from sim.support.command_line import run_command

PLAIN = """
name = "week3"
seed = 1
[routine]
timeout = 1.0
step = 3.0
[[logs]]
mechanisms = ["drivetrain", "shooter"]
count = 2
"""
"""Four short logs, of nobody, with nothing wrong."""

DAMAGED = """
name = "week3"
secret = "class.secret"
students = ["ann", "Bo"]
formats = ["wpilog", "csv"]
[routine]
timeout = 1.0
step = 3.0
[[logs]]
mechanisms = ["drivetrain", "shooter"]
[[logs]]
mechanisms = "drivetrain"
count = 2
[[logs.faults]]
name = "loop-overrun"
severity = [0.5, 1.5]
test = "quasistatic-forward"
at = [0.2, 0.6]
[[logs.faults]]
name = ["missing-test", "sign-flip"]
"""
"""Eight short logs of two students, four of them damaged twice."""

IN_FRONT = """
import signal
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell takes it from what runs behind
from sim.cli import main
main()
"""

SECRET = "a secret of more than sixteen letters"  # noqa: S105 - long enough, and no one's


def spec(folder: Path, text: str = PLAIN, *, secret: str = SECRET) -> Path:
    """A spec in a folder, with its secret beside it."""
    path = folder / "spec.toml"
    path.write_text(text, encoding="utf-8")
    if "class.secret" in text and secret:
        (folder / "class.secret").write_text(secret + "\n", encoding="utf-8")
    return path


def sysid(*arguments: object) -> int:
    """The command, in this process; its exit code."""
    return run_command(command, name="sysid", arguments=[str(one) for one in arguments])


def make_dataset(path: Path, name: str = "data", *more: object) -> Path:
    """A dataset, made to its end beside its spec; its folder."""
    folder = path.parent / name
    assert sysid("dataset", path, "-o", folder, *more) == 0
    return folder


def key(folder: Path) -> dict:
    """The key beside a folder."""
    return json.loads(folder.with_name(f"{folder.name}.key.json").read_bytes())


@contextmanager
def process(
    *arguments: object, folder: Path, stderr: int = subprocess.PIPE
) -> Iterator[subprocess.Popen]:
    """The command as a process of its own, in a group of its own; it ends with the test."""
    with subprocess.Popen(
        [sys.executable, "-c", IN_FRONT, *map(str, arguments)],
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=stderr,
        encoding="utf-8",
        start_new_session=True,
        env=os.environ | {"SYSID_SECRET": "", "TERM": "xterm"},
    ) as running:
        try:
            yield running
        finally:
            running.kill()  # one that has ended is past caring
