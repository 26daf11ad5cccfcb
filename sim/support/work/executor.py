"""Run jobs by an executor: threads with child processes on this machine, or a Dask cluster."""

import os
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, ThreadPoolExecutor, wait
from contextlib import contextmanager
from functools import partial
from itertools import islice
from typing import TYPE_CHECKING, TypeVar

from sim.core.errors import BadRequest
from sim.support.work.child import ChildEnded, run_in_child, stop_children
from sim.support.work.cluster import open_cluster

if TYPE_CHECKING:
    from concurrent.futures import Future

AHEAD = 4  # [jobs per worker] submitted at a time, so that no worker waits
LOOK = 0.2  # [s] between two looks at whether somebody wants to stop

Job = TypeVar("Job")
Result = TypeVar("Result")


class WorkerLost(BadRequest):
    """A worker process was ended from outside, or crashed."""


def count_available_cores() -> int:
    """Number of processor cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def run_jobs(
    work: Callable[[Job], Result],
    jobs: Sequence[Job],
    *,
    processes: int,
    worth: int,
    cluster: str | None = None,
) -> Generator[Result, None, None]:
    """Results of jobs that child processes do, in the order in which they finish.

    Args:
        work: does one job; a function of a module. What it raises ends the run.
        jobs: the jobs.
        processes: largest number of processes; with one, the jobs are done in this process.
        worth: jobs per process at least, so that starting it saves time.
        cluster: address of a Dask scheduler; None stays on this machine.

    Raises:
        WorkerLost: a process ended before its work was done.
        BadRequest: the cluster does not answer.
    """
    processes = min(processes, -(-len(jobs) // worth))
    if processes <= 1 and cluster is None:
        yield from map(work, jobs)
        return
    apart = partial(run_in_child, work)
    try:
        yield from collect_results(apart, jobs, processes=processes, cluster=cluster)
    except ChildEnded:
        raise WorkerLost(
            "a worker process was stopped from outside, perhaps because the memory was full",
            advice="Run the same command again to go on; with --processes 1 if it recurs.",
        ) from None


def collect_results(
    work: Callable[[Job], Result],
    jobs: Sequence[Job],
    *,
    processes: int,
    cluster: str | None = None,
    stop_if_asked: Callable[[], None] = lambda: None,
) -> Generator[Result, None, None]:
    """Results in the order in which jobs finish, with a few jobs submitted at a time.

    Args:
        work: does one job with ``run_in_child``, in a thread here or of a cluster's worker.
        jobs: the jobs.
        processes: largest number of threads on this machine.
        cluster: address of a Dask scheduler; None stays on this machine.
        stop_if_asked: called every moment; what it raises ends the run and all children at once.

    Raises:
        BadRequest: the cluster does not answer.
    """
    opened = open_cluster(cluster) if cluster else _open_threads(max(1, min(processes, len(jobs))))
    waiting = iter(jobs)
    running: set[Future[Result]] = set()
    with opened as (executor, workers):
        while True:
            more = islice(waiting, AHEAD * workers - len(running))
            running |= {executor.submit(work, job) for job in more}
            if not running:
                return
            done, running = wait(running, timeout=LOOK, return_when=FIRST_COMPLETED)
            stop_if_asked()
            yield from (future.result() for future in done)


@contextmanager
def _open_threads(count: int) -> Iterator[tuple[Executor, int]]:
    """An executor of threads, and their number; at the end, their children are killed."""
    executor = ThreadPoolExecutor(count)
    try:
        yield executor, count
    finally:
        executor.shutdown(wait=False, cancel_futures=True)
        with stop_children():
            executor.shutdown()
