"""The learner in a course folder: the owner of their numbers, and their progress."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from grader.course.progress import Progress, Standing, load_progress, update_progress
from grader.exercise.exercise import Exercise, Grade, list_exercises
from grader.student_data.class_package import explain_no_grading, read_class_package
from sim.core.errors import BadRequest
from sim.support.student_names import check_student_name


@dataclass(frozen=True)
class Learner:
    """Who is learning in a course folder.

    Args:
        course: the course folder.
        name: who.
        progress: everybody's, as it was when a command began.
    """

    course: Path
    name: str
    progress: Progress

    @cached_property
    def standings(self) -> dict[str, Standing]:
        """Exercise -> how far the learner is with it, in the order of the course."""
        names = [one.name for one in list_exercises(self.course)]
        return {name: self.progress.find_standing(self.name, name) for name in names}

    def find_refusal(self, one: Exercise) -> BadRequest | None:
        """Why only the instructor can grade an exercise; None where it can be graded here."""
        of_class = read_class_package(self.course)
        if of_class and one.is_personal and of_class.is_for(self.name):
            return explain_no_grading(one.name, of_class)
        return None

    def keep_score(self, grade: Grade) -> str:
        """Store the score of an answer; the messages about it, as from ``update_progress``."""
        points = {"score": grade.score, "max_score": grade.max_score}
        return update_progress(
            self.course, lambda now: now.add_score(self.name, grade.exercise, **points)
        )


def find_learner(course: Path, *, student: str | None, say: Callable[[str], None]) -> Learner:
    """Who is learning in a course folder.

    Args:
        course: the course folder.
        student: who a command says it is; None in a class's package is whom it was issued to, and
            elsewhere who it was before.
        say: shows a line, if the progress kept there was damaged.

    Raises:
        BadRequest: the name is none, the class's file cannot be read, or the name that was known is
            lost.
    """
    progress, said = load_progress(course)
    if said:
        say(said)
    if student is not None:
        return Learner(course, check_student_name(student), progress)
    of_class = read_class_package(course)
    if of_class is None and not progress.student:
        raise BadRequest(
            "your progress was damaged, and with it your name, which decides your numbers",
            advice="Say your name once more, as before: grade start --student NAME. If you never "
            "gave a name: grade start --student me",
        )
    return Learner(course, of_class.student if of_class else progress.student, progress)
