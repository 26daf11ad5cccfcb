"""Who makes the jobs: this process, as many as there are cores, or the machines of a cluster.

All three hand back what is made as soon as it is, in no order, and hold only a few logs at a time.
A cluster is Dask's: its workers need this package, and neither the spec nor a disk in common.
"""

import multiprocessing
import os
import signal
import threading
from collections.abc import Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from importlib import import_module
from itertools import islice
from multiprocessing.connection import wait as wait_for_end
from typing import TYPE_CHECKING

from sim.dataset.making import make
from sim.errors import BadRequest

if TYPE_CHECKING:
    from concurrent.futures import Executor, Future

    from sim.dataset.making import Failed, Made
    from sim.dataset.plan import Job

AHEAD = 4  # [jobs a worker] that are handed out at a time: enough that none waits for work
WORTH = 25  # [jobs] that a further process has to save, to be worth its start
PATIENCE = 10.0  # [s] until a scheduler has to answer


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
        yield from _made_by(executor, jobs, ahead=AHEAD * processes)
    except BrokenProcessPool:
        raise BadRequest(
            "a process that made logs was ended from outside, perhaps for want of memory",
            advice="Run the same command again to go on; with --processes 1 if it recurs.",
        ) from None
    finally:
        executor.shutdown(cancel_futures=True)


def made_on_cluster(jobs: Sequence["Job"], *, address: str) -> Iterator["Made | Failed"]:
    """Make jobs on a Dask cluster.

    Args:
        jobs: what to make.
        address: of its scheduler: ``tcp://10.0.0.5:8786``.

    Raises:
        BadRequest: Dask is not installed here, nobody answers, or the workers cannot do it.
    """
    try:
        client_of = import_module("distributed").Client  # an extra; nothing else needs it
    except ImportError:
        raise BadRequest(
            "a cluster needs Dask, which is not installed",
            advice='Install the extra "cluster": pip install "sysid-course[cluster]"',
        ) from None
    try:
        client = client_of(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError, TimeoutError) as error:
        raise BadRequest(
            f"no Dask scheduler answers at {address} ({type(error).__name__})",
            advice="Start one with: dask scheduler; and give the address it prints.",
        ) from None
    with client:
        workers = len(client.scheduler_info(n_workers=-1)["workers"])
        if not workers:
            raise BadRequest(
                f"the scheduler at {address} has no workers",
                advice=f"Start some with: dask worker {address}",
            )
        yield from _made_by(client.get_executor(pure=False), jobs, ahead=AHEAD * workers)


def _made_by(
    executor: "Executor", jobs: Sequence["Job"], *, ahead: int
) -> Iterator["Made | Failed"]:
    """Results as they come, with only so many jobs handed out at a time."""
    waiting = iter(jobs)
    running: set[Future[Made | Failed]] = set()
    try:
        with _interrupts_held():
            running |= {executor.submit(make, job) for job in islice(waiting, ahead)}
        while running:
            done, running = wait(running, return_when=FIRST_COMPLETED)
            for future in done:
                yield future.result()
                running |= {executor.submit(make, job) for job in islice(waiting, 1)}
    finally:
        for future in running:
            future.cancel()


@contextmanager
def _interrupts_held() -> Iterator[None]:
    """Processes that start in here never hear Ctrl+C: it is for the one that started them."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def _serve() -> None:
    """Begin as a worker: Ctrl+C is not for it, and it ends when the one it works for has."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_end_with, args=(parent.sentinel,), daemon=True).start()


def _end_with(sentinel: int) -> None:
    wait_for_end([sentinel])
    os._exit(1)
