"""Run a program in place of this one: it gets keyboard and signals, and returns its exit code.

Uses nothing but Python's own library: it serves before anything is installed.
"""

from __future__ import annotations

import signal
import subprocess
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

INTERRUPTED = 130  # what a shell reports for Ctrl+C


def run_process(
    command: list[str], *, cwd: Path | None = None, env: dict[str, str] | None = None
) -> int:
    """Run a command and return its exit code.

    Args:
        command: program and arguments; no shell reads them.
        cwd: where to run it.
        env: its environment; None is ours.
    """
    running = subprocess.Popen(command, cwd=cwd, env=env)  # noqa: S603 - our own arguments, no shell
    with _forward_signals(running):
        while True:
            try:
                code = running.wait()
            except KeyboardInterrupt:  # it heard that too, and ends as it sees fit
                continue
            return INTERRUPTED if code < 0 else code


@contextmanager
def _forward_signals(running: subprocess.Popen[bytes]) -> Iterator[None]:
    """A context that forwards signals to the running program, so that it ends with us."""
    try:
        before = signal.signal(signal.SIGTERM, lambda *_: running.terminate())
    except ValueError:  # not the main thread: somebody else's program looks after signals
        yield
        return
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)
