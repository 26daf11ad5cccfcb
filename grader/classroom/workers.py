"""Grade students one exercise at a time, each in a child process within limits.

Whatever an answer does to the process that grades it, only that answer bears it: the child is
replaced, and the exercise is reported as not graded.
"""

from dataclasses import replace

from grader.classroom.grading import GradedStudent, GradingJob, grade_student
from grader.exercise.exercise import Grade
from sim.support.work.child import ChildEnded, run_in_child

SECONDS = 50.0  # [s] for one exercise of one student; an honest one takes 0.1 to 4 s
MEMORY = 4 * 1024**3  # [bytes] of address space; an honest worker uses a quarter of it
TOO_LONG = (
    f"grading it took more than {SECONDS:g} s and was stopped. It is not tried again by itself. If "
    "this computer was very busy, add --again"
)
ENDED = "the process that graded it stopped, perhaps because the memory was full"


def grade_within_limits(job: GradingJob) -> GradedStudent:
    """Grade all exercises of a student, each with a time limit, in the child of this thread."""
    grades = tuple(_grade_exercise(job, name) for name in job.names)
    return GradedStudent(job.submission.student, job.digest, grades)


def _grade_exercise(job: GradingJob, name: str) -> Grade:
    """The result of one exercise, or why there is none."""
    given = job.submission
    files = {one: content for one, content in given.files.items() if one == name}
    part = replace(job, names=(name,), submission=replace(given, files=files))
    try:
        return run_in_child(grade_student, part, seconds=SECONDS, memory=MEMORY).grades[0]
    except TimeoutError:
        reason = TOO_LONG
    except ChildEnded:
        reason = ENDED
    return job.find_exercise(name).skip(reason, student=given.student)
