"""Delay Ctrl+C where it must not interrupt."""

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType


@contextmanager
def interrupts_blocked_for_children() -> Iterator[None]:
    """A context whose child processes never hear Ctrl+C: it is for the parent."""
    if not _is_heard():
        yield
        return
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


@contextmanager
def deferred_interrupt() -> Iterator[Callable[[], None]]:
    """A context in which the first Ctrl+C is only noted; a second one acts at once.

    Yields:
        What to call where stopping is safe: it raises KeyboardInterrupt if one was noted.
    """
    found: list[int] = []

    def note(number: int, _frame: FrameType | None) -> None:
        found.append(number)
        if len(found) > 1:
            raise KeyboardInterrupt

    def stop_if_noted() -> None:
        if found:
            raise KeyboardInterrupt

    if not _is_heard():
        yield stop_if_noted
        return
    before = signal.signal(signal.SIGINT, note)
    try:
        yield stop_if_noted
    finally:
        signal.signal(signal.SIGINT, before)


def _is_heard() -> bool:
    """Whether Ctrl+C means anything here: not in a thread, nor in what a shell runs behind."""
    main = threading.current_thread() is threading.main_thread()
    return main and signal.getsignal(signal.SIGINT) is not signal.SIG_IGN
