"""``grade watch``."""

import click
from click.shell_completion import CompletionItem

from grader.cli import complete_exercise, grade_file, locate_course
from grader.exercise import find_exercise, list_exercises
from grader.terminal import print_lines, style_line
from grader.watch import find_first_unfinished, format_path
from grader.watch import watch_exercise as keep_watching
from sim.core.errors import Refusal
from sim.support.command_line import COULD_NOT, DONE, print_error


def _complete(
    context: click.Context, parameter: click.Parameter, begun: str
) -> list[CompletionItem]:
    """Names of exercises."""
    return complete_exercise(context, parameter, begun)


@click.command()
@click.argument("exercise", required=False, shell_complete=_complete)
@click.option("--student", metavar="NAME", help="Who you are; your numbers depend on it.")
@click.option(
    "--plain", is_flag=True, help="For screen readers: words instead of symbols, no columns."
)
def watch(exercise: str | None, student: str | None, *, plain: bool) -> int:
    """Grade an exercise each time you save its file.

    The command ends when all is right. Without EXERCISE, it takes the first exercise that is not
    done yet.
    """
    folder, progress, who = locate_course(student)
    found = list_exercises(folder)
    one = (
        find_exercise(exercise, folder)
        if exercise
        else find_first_unfinished(found, lambda name: progress.find_standing(who, name).is_done)
    )
    if one is None:
        print_lines([style_line("Everything here is done.", "bold green")])
        return DONE

    def grade() -> int:
        _, now, _ = locate_course(student)
        try:
            code = grade_file(one, None, folder, now, who, plain=plain)
        except Refusal as refusal:  # the next time it is saved, it may be readable
            print_error(str(refusal), name="grade")
            code = COULD_NOT
        if code != DONE:
            print_lines(
                [
                    style_line(),
                    style_line(f"Waiting for {format_path(one, folder)} to be saved; Ctrl-C ends."),
                ]
            )
        return code

    try:
        keep_watching(one, grade=grade)
    except KeyboardInterrupt:
        return DONE
    _, after, _ = locate_course(student)
    rest = find_first_unfinished(found, lambda name: after.find_standing(who, name).is_done)
    print_lines(
        [style_line(f"Next: grade watch {rest.name}" if rest else "Everything here is done.")]
    )
    return DONE


COMMAND = watch
