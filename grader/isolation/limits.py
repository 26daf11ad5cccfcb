"""Limits a process sets for itself: processor time, memory, size of files, how many of them."""

import contextlib
import ctypes
import importlib
import signal
import sys
from collections.abc import Iterator

OPEN_FILES = 64
PARENT_DEATH_SIGNAL = 1  # prctl's number of it: <linux/prctl.h>


def end_with_parent() -> None:
    """On Linux, end with the parent process, which keeps the time limit."""
    if sys.platform.startswith("linux"):
        ctypes.CDLL(None).prctl(PARENT_DEATH_SIGNAL, int(signal.SIGKILL), 0, 0, 0)


def set_limits(*, seconds: int, memory: int, file: int, processes: bool) -> tuple[str, ...]:
    """Set the limits this system has; there is no way back.

    Args:
        seconds: [s] of processor time.
        memory: [bytes] of address space.
        file: [bytes] of one file.
        processes: whether it may start others.

    Returns:
        What is limited, in words.
    """
    if sys.platform == "win32":
        return ()
    return tuple(
        _set_resource_limits(seconds=seconds, memory=memory, file=file, processes=processes)
    )


def _set_resource_limits(*, seconds: int, memory: int, file: int, processes: bool) -> Iterator[str]:
    resource = importlib.import_module("resource")  # Windows has none
    wanted = [
        ("RLIMIT_CPU", seconds, "processor time"),
        ("RLIMIT_AS", memory, "memory"),
        ("RLIMIT_FSIZE", file, "files"),
        ("RLIMIT_NOFILE", OPEN_FILES, ""),
        ("RLIMIT_CORE", 0, ""),
    ]
    if not processes:
        wanted.append(("RLIMIT_NPROC", 1, ""))  # it counts all of a user's, and not root's
    for name, value, words in wanted:
        which = getattr(resource, name, None)
        if which is None:
            continue
        with contextlib.suppress(ValueError, OSError):  # macOS knows some by name only
            hard = resource.getrlimit(which)[1]
            # The first limit of processor time is a signal that tells why, the second ends it.
            last = value + (name == "RLIMIT_CPU")
            last = last if hard == resource.RLIM_INFINITY else min(last, hard)
            resource.setrlimit(which, (min(value, last), last))
            if words:
                yield words
