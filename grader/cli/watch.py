"""``grade watch``."""

import click

from grader.cli import complete_exercise, grade_file, locate_course, show_next_step
from grader.cli.course_here import PLAIN, STUDENT
from grader.exercise import find_exercise, list_exercises
from grader.terminal import print_lines, style_line
from grader.watch import watch_exercise
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
    folder, progress, who = locate_course(student)
    left = (
        one for one in list_exercises(folder) if not progress.find_standing(who, one.name).is_done
    )
    watched = find_exercise(exercise, folder) if exercise else next(left, None)
    if watched is None:
        show_next_step(folder, who)
        return DONE
    place = (watched.folder / watched.files[0]).relative_to(folder).as_posix()

    def grade() -> int:
        _, now, _ = locate_course(student)
        try:
            code = grade_file(watched, None, folder, now, who, plain=plain)
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
    show_next_step(folder, who)
    return DONE
