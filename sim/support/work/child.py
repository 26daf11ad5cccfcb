"""Do a job in a child process, which may hang, crash or fill the memory without harm to this one.

Each thread has one child that does its jobs, so a child starts only once. One that ends or takes
too long is replaced with the next job.
"""

import importlib
import multiprocessing
import os
import signal
import sys
import threading
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from multiprocessing.connection import Connection
from multiprocessing.connection import wait as wait_for_end
from multiprocessing.resource_tracker import ensure_running as start_tracker
from typing import Any, TypeVar

Job = TypeVar("Job")
Result = TypeVar("Result")

CONTEXT = multiprocessing.get_context("spawn")  # the same on every system, and safe with threads
NAME = "child that does jobs"
_THREAD = threading.local()  # with the child of each thread
_STOPPED = threading.Event()


class ChildEnded(Exception):  # noqa: N818 - not an error of the program
    """A child process ended before its job was done: it crashed, or was killed."""


def run_in_child(
    work: Callable[[Job], Result],
    job: Job,
    *,
    seconds: float | None = None,
    memory: int | None = None,
) -> Result:
    """The result of a job that the child process of this thread does.

    Args:
        work: does one job; a function of a module.
        job: the job.
        seconds: [s] time limit; None sets none.
        memory: [bytes] limit of the child's address space, where a system supports it.

    Raises:
        TimeoutError: the job took too long; the child was killed.
        ChildEnded: the child ended before the job was done, or ``stop_children`` was called.
    """
    child: _Child | None = getattr(_THREAD, "child", None)
    _THREAD.child = None  # it does the next job, too, only if it ends this one well
    if child is None or child.does != (work, memory) or not child.process.is_alive():
        child = _Child(work, memory)
    if _STOPPED.is_set():
        raise ChildEnded
    child.start_job(job)
    done, outcome = child.receive(seconds)
    _THREAD.child = child
    if not done:
        raise outcome
    return outcome  # type: ignore[no-any-return]  # what comes out of a pipe has no type


@contextmanager
def stop_children() -> Iterator[None]:
    """A context that begins by killing all children, and in which no thread starts another."""
    _STOPPED.set()
    try:
        for process in multiprocessing.active_children():
            if process.name == NAME:
                process.kill()
                process.join()
        yield
    finally:
        _STOPPED.clear()


class _Child:
    """A child process and the connection to it; without the connection, the child ends.

    Args:
        work: does one job.
        memory: [bytes] limit of its address space; None sets none.

    Raises:
        ChildEnded: it ended while it started.
    """

    def __init__(self, work: Callable[[Any], Any], memory: int | None) -> None:
        self.does = work, memory
        self.connection, other_end = CONTEXT.Pipe()
        # A Dask worker is a daemon, which may have no children unless it says that it is none.
        multiprocessing.current_process().daemon = False
        self.process = CONTEXT.Process(
            target=_serve_jobs, args=(work, other_end, memory), name=NAME, daemon=True
        )
        with _block_interrupt():
            self.process.start()
        other_end.close()
        self.receive()  # it has started: the time of the start is not that of the first job

    def start_job(self, job: object) -> None:
        """Send a job.

        Raises:
            ChildEnded: the child has ended.
        """
        try:
            self.connection.send(job)
        except OSError:
            raise ChildEnded from None

    def receive(self, seconds: float | None = None) -> tuple[bool, Any]:
        """Whether the job was done, and its result or exception.

        Raises:
            TimeoutError: it took longer; the child was killed.
            ChildEnded: the child has ended.
        """
        try:
            in_time = self.connection.poll(seconds)
            answer: tuple[bool, Any] = self.connection.recv() if in_time else (False, None)
        except (EOFError, OSError):
            raise ChildEnded from None
        if not in_time:
            self.process.kill()
            raise TimeoutError
        return answer


@contextmanager
def _block_interrupt() -> Iterator[None]:
    """A context in which a new process begins with Ctrl+C blocked, until it ignores it itself.

    The mask is that of this thread alone, and a new process inherits it. Windows has none.
    """
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    start_tracker()  # else the first new process starts it, and that unblocks Ctrl+C again
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _serve_jobs(work: Callable[[Any], Any], connection: Connection, memory: int | None) -> None:
    """Do jobs until the connection is closed."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_exit_with, args=(parent.sentinel,), daemon=True).start()
    _limit_memory(memory)
    connection.send((True, None))
    with suppress(EOFError, OSError):
        while True:
            connection.send(_do_job(work, connection.recv()))


def _do_job(work: Callable[[Any], Any], job: object) -> tuple[bool, object]:
    """Whether a job was done, and its result or exception."""
    try:
        return True, work(job)
    except Exception as error:  # noqa: BLE001 - the parent raises it
        error.add_note(traceback.format_exc())
        return False, error


def _exit_with(sentinel: int) -> None:
    """End this process when its parent ends."""
    wait_for_end([sentinel])
    os._exit(1)


def _limit_memory(memory: int | None) -> None:
    """Limit the address space of this process, where a system supports it."""
    if memory is None or sys.platform == "win32":
        return
    resource = importlib.import_module("resource")  # Windows has none
    hard = resource.getrlimit(resource.RLIMIT_AS)[1]
    most = memory if hard == resource.RLIM_INFINITY else min(memory, hard)
    with suppress(OSError, ValueError):  # macOS knows the limit by name only
        resource.setrlimit(resource.RLIMIT_AS, (most, hard))
