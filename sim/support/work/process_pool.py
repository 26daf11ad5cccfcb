"""Run jobs in worker processes of this machine."""

import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from itertools import islice
from multiprocessing.connection import wait as wait_for_end
from typing import TYPE_CHECKING, TypeVar

from sim.core.errors import BadRequest
from sim.support.work.interrupt import interrupts_blocked_for_children

if TYPE_CHECKING:
    from concurrent.futures import Executor, Future

AHEAD = 4  # [jobs per worker] submitted at a time, so that no worker waits

Job = TypeVar("Job")
Result = TypeVar("Result")


class WorkerLost(BadRequest):
    """A worker process was ended from outside, or crashed."""


def count_available_cores() -> int:
    """Number of processor cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def run_jobs_locally(
    work: Callable[[Job], Result], jobs: Sequence[Job], *, processes: int, worth: int
) -> Iterator[Result]:
    """Results of jobs done on this machine, in the order in which they finish.

    Args:
        work: does one job; a function of a module.
        jobs: the jobs.
        processes: largest number of processes; with one, the jobs are done in this process.
        worth: jobs per process at least, so that starting it saves time.

    Raises:
        WorkerLost: a process ended before its work was done.
    """
    processes = min(processes, -(-len(jobs) // worth))
    if processes <= 1:
        yield from map(work, jobs)
        return
    executor = make_worker_pool(processes)
    try:
        yield from collect_results(executor, work, jobs, ahead=AHEAD * processes)
    except BrokenProcessPool:
        raise WorkerLost(
            "a worker process was stopped from outside, perhaps because the memory was full",
            advice="Run the same command again to go on; with --processes 1 if it recurs.",
        ) from None
    finally:
        executor.shutdown(cancel_futures=True)


def make_worker_pool(processes: int) -> ProcessPoolExecutor:
    """A pool of worker processes, which end when this process ends."""
    return ProcessPoolExecutor(
        processes,
        # Spawned, not forked: the same on every system, and safe with threads.
        mp_context=multiprocessing.get_context("spawn"),
        initializer=serve_quietly,
    )


def collect_results(
    executor: "Executor", work: Callable[[Job], Result], jobs: Sequence[Job], *, ahead: int
) -> Iterator[Result]:
    """Results in the order in which jobs finish, with ``ahead`` jobs submitted at a time."""
    waiting = iter(jobs)
    running: set[Future[Result]] = set()
    try:
        with interrupts_blocked_for_children():
            running |= {executor.submit(work, job) for job in islice(waiting, ahead)}
        while running:
            done, running = wait(running, return_when=FIRST_COMPLETED)
            for future in done:
                yield future.result()
                running |= {executor.submit(work, job) for job in islice(waiting, 1)}
    finally:
        for future in running:
            future.cancel()


def serve_quietly() -> None:
    """Initialize a worker: ignore Ctrl+C, and end when the parent process ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_exit_with, args=(parent.sentinel,), daemon=True).start()


def _exit_with(sentinel: int) -> None:
    wait_for_end([sentinel])
    os._exit(1)
