"""Grade students one exercise at a time, each in a child process within limits.

Whatever an answer does to the process that grades it, only that answer bears it: the child is
replaced, and the exercise is reported as not graded.
"""

from collections.abc import Callable, Generator, Sequence
from dataclasses import replace
from functools import partial

from grader.classroom.grading import (
    GradedStudent,
    GradingJob,
    Record,
    grade_student,
    make_ungraded_record,
)
from sim.support.work.child import ChildEnded, run_in_child
from sim.support.work.executor import collect_results

SECONDS = 50.0  # [s] for one exercise of one student; an honest one takes 0.1 to 4 s
MEMORY = 4 * 1024**3  # [bytes] of address space; an honest worker uses a quarter of it
TOO_LONG = (
    f"grading it took more than {SECONDS:g} s and was stopped. It is not tried again by itself. If "
    "this computer was very busy, add --again"
)
ENDED = "the process that graded it stopped, perhaps because the memory was full"


def grade_in_workers(
    jobs: Sequence[GradingJob],
    *,
    processes: int,
    cluster: str | None = None,
    stop_if_asked: Callable[[], None] = lambda: None,
    seconds: float = SECONDS,
) -> Generator[GradedStudent, None, None]:
    """Grade students, each as soon as all their exercises are graded.

    Args:
        jobs: the students.
        processes: at most so many workers on this machine.
        cluster: address of a Dask scheduler; None grades on this machine.
        stop_if_asked: called every moment; what it raises ends the workers at once.
        seconds: [s] for one exercise of one student.
    """
    return collect_results(
        partial(grade_within_limits, seconds=seconds),
        jobs,
        processes=processes,
        cluster=cluster,
        stop_if_asked=stop_if_asked,
    )


def grade_within_limits(job: GradingJob, *, seconds: float) -> GradedStudent:
    """Grade all exercises of a student, each with a time limit, in the child of this thread."""
    records = tuple(_grade_exercise(job, name, seconds) for name in job.names)
    return GradedStudent(job.student, job.digest, records)


def _grade_exercise(job: GradingJob, name: str, seconds: float) -> Record:
    """The result of one exercise, or why there is none."""
    files = {name: job.files[name]} if name in job.files else {}
    part = replace(job, names=(name,), files=files)
    try:
        (record,) = run_in_child(grade_student, part, seconds=seconds, memory=MEMORY).records
    except TimeoutError:
        return make_ungraded_record(job, name, TOO_LONG)
    except ChildEnded:
        return make_ungraded_record(job, name, ENDED)
    return record
