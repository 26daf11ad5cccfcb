"""Workers that grade one exercise of one student at a time, within limits, and can be ended.

Whatever an answer does to the process that grades it, only that answer bears it: a worker that
does not finish, or comes to an end, is replaced, and the exercise is reported as not graded.
"""

import importlib
import multiprocessing
import sys
from collections import deque
from collections.abc import Callable, Generator, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from concurrent.futures import TimeoutError as TimedOut
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, field, replace

from pebble import ProcessExpired, ProcessPool

from grader.classroom.answer_files import Files
from grader.classroom.grading import (
    GradedStudent,
    GradingJob,
    Record,
    grade_student,
    make_ungraded_record,
)
from sim.support.work.interrupt import interrupts_blocked_for_children
from sim.support.work.process_pool import serve_quietly

SECONDS = 50.0  # [s] for one exercise of one student; an honest one takes 0.1 to 4 s
MEMORY = 4 * 1024**3  # [bytes] of address space; an honest worker uses a quarter of it
WORTH = 8  # [exercises] that a further process has to save, to be worth its start
AHEAD = 4  # [exercises for each worker] handed out at a time: enough that none waits
POOLS = 3  # started in turn, if one breaks
LOOK = 0.2  # [s] between two looks at whether somebody wants to stop
TOO_LONG = f"grading it took more than {SECONDS:g} s and was stopped"
ENDED = "the process that graded it stopped, perhaps because the memory was full"

Task = tuple[GradingJob, str]  # a student, and one of their exercises


@dataclass
class _OpenStudent:
    """A student of whom some exercises are graded."""

    job: GradingJob
    records: dict[str, Record] = field(default_factory=dict)

    def results_if_complete(self) -> GradedStudent | None:
        """Their results, once there are all."""
        if len(self.records) < len(self.job.names):
            return None
        records = tuple(self.records[name] for name in self.job.names)
        return GradedStudent(self.job.student, self.job.digest, records)


def grade_in_workers(
    jobs: Sequence[GradingJob],
    *,
    processes: int,
    stop_if_asked: Callable[[], None] = lambda: None,
    seconds: float = SECONDS,
) -> Iterator[GradedStudent]:
    """Grade students on this machine, each as soon as all their exercises are graded.

    Args:
        jobs: the students.
        processes: at most so many workers.
        stop_if_asked: called every moment; what it raises ends the workers at once.
        seconds: [s] for one exercise of one student.
    """
    tasks: Sequence[Task] = [(job, name) for job in jobs for name in job.names]
    students = {job.student: _OpenStudent(job) for job, _ in tasks}
    for _ in range(POOLS):
        if not tasks:
            return
        workers = max(1, min(processes, -(-len(tasks) // WORTH)))
        pool = ProcessPool(
            workers,
            # Started afresh, not copied: the same on every system, and no threads are copied
            # halfway.
            context=multiprocessing.get_context("spawn"),
            initializer=_start_worker,
        )
        try:
            tasks = yield from _grade(
                pool, tasks, students,
                workers=workers, stop_if_asked=stop_if_asked, seconds=seconds,
            )  # fmt: skip
        finally:
            pool.stop()  # type: ignore[no-untyped-call]  # pebble types its calls in part
            pool.join()
    for job, name in tasks:
        yield from _add_record(students, job, name, make_ungraded_record(job, name, ENDED))


def _grade(
    pool: ProcessPool,
    tasks: Sequence[Task],
    students: dict[str, _OpenStudent],
    *,
    workers: int,
    stop_if_asked: Callable[[], None],
    seconds: float,
) -> Generator[GradedStudent, None, Sequence[Task]]:
    """Grade in one pool.

    Returns:
        The tasks that are left because the pool broke: a worker that ends in the moment between
        two tasks can break all of it.
    """
    waiting, running = deque(tasks), dict[Future[GradedStudent], Task]()

    def start_tasks() -> None:
        with interrupts_blocked_for_children():
            while waiting and len(running) < AHEAD * workers:
                job, name = waiting[0]
                part = replace(job, names=(name,), files=_select_exercise(job, name))
                try:
                    future = pool.schedule(grade_student, args=(part,), timeout=seconds)
                except RuntimeError:  # the pool broke; its running tasks say so, too
                    return
                running[future] = waiting.popleft()

    start_tasks()
    while running:
        done, _ = wait(running, timeout=LOOK, return_when=FIRST_COMPLETED)
        stop_if_asked()
        for future in done:
            job, name = running[future]
            try:
                record = _make_record(future, job, name)
            except BrokenProcessPool:
                return [*running.values(), *waiting]
            del running[future]
            yield from _add_record(students, job, name, record)
        start_tasks()
    return tuple(waiting)


def _add_record(
    students: dict[str, _OpenStudent], job: GradingJob, name: str, record: Record
) -> Iterator[GradedStudent]:
    """Add the result of one exercise; yields the student if it was the last one."""
    students[job.student].records[name] = record
    if (graded := students[job.student].results_if_complete()) is not None:
        del students[job.student]
        yield graded


def _make_record(future: Future[GradedStudent], job: GradingJob, name: str) -> Record:
    """The result of one exercise, or why there is none."""
    try:
        (record,) = future.result().records
    except TimedOut:
        return make_ungraded_record(job, name, TOO_LONG)
    except ProcessExpired:
        return make_ungraded_record(job, name, ENDED)
    return record


def _select_exercise(job: GradingJob, name: str) -> Mapping[str, Files]:
    """What was handed in for one exercise."""
    return {name: job.files[name]} if name in job.files else {}


def _start_worker() -> None:
    """Begin as a worker: quiet at Ctrl-C, ended with its parent, and with so much memory."""
    serve_quietly()
    if sys.platform == "win32":
        return
    resource = importlib.import_module("resource")  # Windows has none
    hard = resource.getrlimit(resource.RLIMIT_AS)[1]
    most = MEMORY if hard == resource.RLIM_INFINITY else min(MEMORY, hard)
    try:
        resource.setrlimit(resource.RLIMIT_AS, (most, hard))
    except (OSError, ValueError):  # macOS knows the limit by name only
        return
