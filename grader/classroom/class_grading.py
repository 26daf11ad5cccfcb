"""Grade a class: known results are reused, and one student's failure never stops the others."""

from collections.abc import Callable, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

from grader.classroom.answer_files import Submission
from grader.classroom.bundle import pack_course
from grader.classroom.grading import GradedStudent, GradingJob, skip_student
from grader.classroom.store import ResultStore, digest_job
from grader.classroom.workers import grade_within_limits
from grader.exercise.exercise import Exercise
from grader.student_data.fingerprint import fingerprint_folders
from sim.support.work.executor import collect_results


@dataclass(frozen=True)
class GradedClass:
    """The submissions of a class, and the course that grades them.

    Args:
        handed_in: by whom, and what.
        exercises: those to grade.
        course: the course folder.
        secret: of the class; None where everybody's numbers are those of self-study.
        run: whether Python of students is run. Java is graded in any case.
    """

    handed_in: tuple[Submission, ...]
    exercises: tuple[Exercise, ...]
    course: Path
    secret: bytes | None = None
    run: bool = False

    def make_jobs(self, *, travel: bool) -> tuple[GradingJob, ...]:
        """One job for each student whose files can be read.

        Args:
            travel: whether another machine does them.
        """
        made_by = fingerprint_folders(self.course / "exercises")
        made_by += ", code was run" if self.run else ""
        names = tuple(one.name for one in self.exercises)
        course = pack_course(self.course) if travel else self.course
        return tuple(
            GradingJob(
                one,
                digest_job(one, names=names, made_by=made_by, secret=self.secret),
                names,
                course,
                self.secret,
                self.run,
            )
            for one in self.handed_in
            if not one.problem
        )


def plan_grading(
    asked: GradedClass, store: ResultStore, *, travel: bool, again: bool
) -> tuple[list[GradedStudent], list[GradingJob]]:
    """Stored results that still hold, and the submissions still to be graded.

    Args:
        asked: the class.
        store: its results.
        travel: whether another machine grades.
        again: grade everything again.
    """
    kept, left = [], []
    for job in asked.make_jobs(travel=travel):
        known = None if again else store.get(job.submission.student, job.digest)
        if known is None:
            left.append(job)
        else:
            kept.append(known)
    return kept, left


def grade_class(
    asked: GradedClass,
    kept: Sequence[GradedStudent],
    left: Sequence[GradingJob],
    store: ResultStore,
    *,
    processes: int,
    cluster: str | None,
    say: Callable[[], None],
    stop_if_asked: Callable[[], None] = lambda: None,
) -> tuple[GradedStudent, ...]:
    """Grade the students without a stored result, and return all results sorted by student.

    Args:
        asked: the class.
        kept: results that still hold.
        left: what is still to be graded.
        store: where results are kept.
        processes: at most so many on this machine.
        cluster: address of a Dask scheduler; None grades on this machine.
        say: called after each student.
        stop_if_asked: called every moment; what it raises stops the run, with all results whole.

    Raises:
        BadRequest: a result cannot be written, or the cluster does not answer.
    """
    found = [*kept]
    grading = collect_results(
        grade_within_limits, left, processes=processes, cluster=cluster, stop_if_asked=stop_if_asked
    )
    with closing(grading):
        for one in grading:
            store.put(one)
            found.append(one)
            say()
    found += [
        skip_student(one.student, asked.exercises, status="ungradable", reason=one.problem)
        for one in asked.handed_in
        if one.problem
    ]
    return tuple(sorted(found, key=lambda one: one.student.casefold()))
