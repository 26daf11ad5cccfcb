"""Who makes the jobs on this machine: this process, or as many as there are cores.

What is made comes back as soon as it is, in no order, and only a few logs are held at a time.
"""

import multiprocessing
import os
import signal
import threading
from collections.abc import Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from itertools import islice
from multiprocessing.connection import wait as wait_for_end
from typing import TYPE_CHECKING

from sim.dataset.interrupt import unheard
from sim.dataset.making import make
from sim.errors import BadRequest

if TYPE_CHECKING:
    from concurrent.futures import Executor, Future

    from sim.dataset.making import Failed, Made
    from sim.dataset.plan import Job

AHEAD = 4  # [jobs a worker] that are handed out at a time: enough that none waits for work
WORTH = 50  # [jobs] that a further process has to save, to be worth its start


def cores() -> int:
    """How many this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def made_here(jobs: Sequence["Job"], *, processes: int) -> Iterator["Made | Failed"]:
    """Make jobs on this machine.

    Args:
        jobs: what to make.
        processes: at most so many; one makes them in this process.

    Raises:
        BadRequest: a process was ended from outside.
    """
    processes = min(processes, -(-len(jobs) // WORTH))
    if processes <= 1:
        yield from map(make, jobs)
        return
    executor = ProcessPoolExecutor(
        processes,
        # Started afresh, not copied: the same on every system, and no threads are copied halfway.
        mp_context=multiprocessing.get_context("spawn"),
        initializer=_serve,
    )
    try:
        yield from made_by(executor, jobs, ahead=AHEAD * processes)
    except BrokenProcessPool:
        raise BadRequest(
            "a process that made logs was ended from outside, perhaps for want of memory",
            advice="Run the same command again to go on; with --processes 1 if it recurs.",
        ) from None
    finally:
        executor.shutdown(cancel_futures=True)


def made_by(
    executor: "Executor", jobs: Sequence["Job"], *, ahead: int
) -> Iterator["Made | Failed"]:
    """Results as they come, with only so many jobs handed out at a time."""
    waiting = iter(jobs)
    running: set[Future[Made | Failed]] = set()
    try:
        with unheard():
            running |= {executor.submit(make, job) for job in islice(waiting, ahead)}
        while running:
            done, running = wait(running, return_when=FIRST_COMPLETED)
            for future in done:
                yield future.result()
                running |= {executor.submit(make, job) for job in islice(waiting, 1)}
    finally:
        for future in running:
            future.cancel()


def _serve() -> None:
    """Begin as a worker: Ctrl+C is not for it, and it ends when the one it works for has."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_end_with, args=(parent.sentinel,), daemon=True).start()


def _end_with(sentinel: int) -> None:
    wait_for_end([sentinel])
    os._exit(1)
