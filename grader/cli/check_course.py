"""``grade check-course``."""

import click

from grader.cli.course_here import choose_exercises, find_course_here
from grader.exercise.course_check import find_flaws, list_mistakes
from grader.feedback.terminal import print_lines, style_line, wrap_text
from sim.support.command_line import DONE, NOT_RIGHT


@click.command("check-course")
@click.argument("exercises", nargs=-1)
def check_course(exercises: tuple[str, ...]) -> int:
    """Check exercises that you wrote or changed.

    The starter must fail, the solution earn everything for several students, and each mistake of
    solutions/EXERCISE/mistakes.py be caught and named. Without EXERCISES, all are checked, which
    takes minutes.

    Exit codes: 0 all in order, 1 something is not.
    """
    bad = False
    for one in choose_exercises(exercises, find_course_here()):
        flaws = list(find_flaws(one))
        bad = bad or bool(flaws)
        said = (
            "not in order" if flaws else f"in order, {len(list_mistakes(one))} mistakes are named"
        )
        print_lines([style_line(f"{one.name}: {said}")])
        for flaw in flaws:
            print_lines(wrap_text(flaw, lead="  "))
    return NOT_RIGHT if bad else DONE
