"""``grade watch``."""

import click

from grader.cli import complete_exercise, grade_file, locate_learner, show_next_step
from grader.cli.course_here import PLAIN, STUDENT
from grader.exercise.exercise import find_exercise
from grader.exercise.watch import watch_exercise
from grader.feedback.terminal import print_lines, style_line
from sim.core.errors import Refusal
from sim.support.command_line import COULD_NOT, DONE, print_error


@click.command()
@click.argument("exercise", required=False, shell_complete=complete_exercise)
@STUDENT
@PLAIN
def watch(exercise: str | None, student: str | None, *, plain: bool) -> int:
    """Grade an exercise each time you save its file.

    The command ends when all is right. Without EXERCISE, it takes the first exercise that is not
    done yet.
    """
    learner = locate_learner(student)
    left = (name for name, standing in learner.standings.items() if not standing.is_done)
    name = exercise or next(left, None)
    if name is None:
        show_next_step(learner)
        return DONE
    watched = find_exercise(name, learner.course)
    place = (watched.folder / watched.files[0]).relative_to(learner.course).as_posix()

    def grade() -> int:
        try:
            code = grade_file(watched, None, locate_learner(student), plain=plain)
        except Refusal as refusal:  # the next time it is saved, it may be readable
            print_error(str(refusal), name="grade")
            code = COULD_NOT
        if code != DONE:
            print_lines([(), style_line(f"Waiting for {place} to be saved; Ctrl-C ends.")])
        return code

    try:
        watch_exercise(watched, grade=grade)
    except KeyboardInterrupt:
        return DONE
    show_next_step(learner)
    return DONE
