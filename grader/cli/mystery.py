"""``grade mystery``."""

from pathlib import Path

import click

from grader.cli import locate_learner
from grader.cli.course_here import PLAIN, STUDENT
from grader.exercise.mystery import (
    HIGHEST,
    Mystery,
    MysteryState,
    draw_mystery,
    find_mystery_folder,
    grade_mystery_answer,
    load_state,
    open_mystery,
    save_state,
)
from grader.feedback.report import format_checks
from grader.feedback.terminal import Line, print_lines, style_line, wrap_text
from sim.core.errors import BadRequest
from sim.support.command_line import DONE, NOT_RIGHT


@click.command()
@click.argument("answer", nargs=-1)
@click.option("--give-up", is_flag=True, help="Show the answer; the next one is easier.")
@STUDENT
@PLAIN
def mystery(answer: tuple[str, ...], student: str | None, *, give_up: bool, plain: bool) -> int:
    """Make a log with a hidden problem, or grade your ANSWER to it.

    The problem is a fault or an effect. Each mystery that you solve makes the next one harder.

    For example: grade mystery "hard-stop, dynamic-forward, 1.20 to 1.66, trim"
    """
    learner = locate_learner(student)
    course, who = learner.course, learner.name
    folder = find_mystery_folder(course, who)
    state = load_state(folder)
    place = folder.relative_to(course)
    if state.seed is None:
        if answer or give_up:
            raise BadRequest("you have no mystery yet", advice="Draw one: grade mystery")
        print_lines(_format_task(*open_mystery(course, folder, state), place))
        return DONE
    one = draw_mystery(course, state)
    if give_up:
        save_state(folder, state.close(solved=False))
        print_lines(wrap_text(one.solution, lead="The answer was: ", style="bold"))
        print_lines([style_line("Next: grade mystery", "cyan")])
        return DONE
    if not answer:
        print_lines(_format_task(state, one, place))
        return DONE
    result = grade_mystery_answer(one, " ".join(answer), student=who)
    print_lines(format_checks(result, plain=plain))
    solved = result.status == "passed"
    if solved:
        save_state(folder, state.close(solved=True))
    then = "grade mystery" if solved else "look again, or give up: grade mystery --give-up"
    print_lines([(), style_line(f"Next: {then}", "cyan")])
    return DONE if solved else NOT_RIGHT


def _format_task(state: MysteryState, one: Mystery, place: Path) -> list[Line]:
    """The task, where its logs are, how to look at them, and how to answer."""
    names = ", ".join(f"{name}.wpilog" for name in one.logs)
    head = (
        f"Mystery {state.number}, level {state.level} of {HIGHEST}: {names} in {place.as_posix()}"
    )
    return [
        style_line(head, "bold"),
        *wrap_text(one.task, lead="  "),
        style_line(f"  To look at it: {one.tool.format(folder=place.as_posix())}"),
        style_line(f'Next: grade mystery "{one.example}"  (with your own answer)', "cyan"),
    ]
