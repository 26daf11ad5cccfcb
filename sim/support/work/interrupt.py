"""Delay Ctrl+C where it must not interrupt."""

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType


@contextmanager
def deferred_interrupt() -> Iterator[Callable[[], None]]:
    """A context in which the first Ctrl+C is only stored; a second one interrupts at once.

    Yields:
        A function to call where stopping is safe; it raises KeyboardInterrupt after a Ctrl+C.
    """
    found: list[int] = []

    def note(number: int, _frame: FrameType | None) -> None:
        found.append(number)
        if len(found) > 1:
            raise KeyboardInterrupt

    def stop_if_noted() -> None:
        if found:
            raise KeyboardInterrupt

    if not _handles_interrupts():
        yield stop_if_noted
        return
    before = signal.signal(signal.SIGINT, note)
    try:
        yield stop_if_noted
    finally:
        signal.signal(signal.SIGINT, before)


def _handles_interrupts() -> bool:
    """Whether this code handles Ctrl+C: not in a thread, nor in the background of a shell."""
    main = threading.current_thread() is threading.main_thread()
    return main and signal.getsignal(signal.SIGINT) is not signal.SIG_IGN
