"""``grade``: check an answer, see a hint, see how far you are, and start.

Exit codes: 0 full marks, 1 not all right yet, 2 could not do it (one line says why, and what next).
"""

import importlib.util
import os
import sys
from dataclasses import replace
from difflib import get_close_matches
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

import click
from click.shell_completion import CompletionItem

from grader.cli.course_here import PATH, PLAIN, STUDENT, find_course_here
from grader.feedback.terminal import print_error, print_lines
from sim.core.errors import BadRequest
from sim.support import command_line
from sim.support.command_line import COULD_NOT, DONE, NOT_RIGHT
from sim.support.completion import explain_completion
from sim.support.extras import format_install_command
from sim.support.lazy_package import lazy_modules

if TYPE_CHECKING:
    from grader.checks.consequence import Consequence
    from grader.course.learner import Learner
    from grader.exercise.exercise import Exercise

__getattr__ = lazy_modules(__name__)

OWN_MODULE = {  # each is imported when it is asked for; the list of commands imports none of them
    "check-course": "Check exercises that you wrote or changed.",
    "class": "Grade what a class handed in.",
    "doctor": "Check what is installed on this computer, and what is missing.",
    "edition": "Run all lessons, and write each as a page and as slides.",
    "export": "Make an autograder, or a configuration of JupyterHub.",
    "mystery": "Make a log with a hidden problem, or grade your ANSWER to it.",
    "release": "Make the students' package.",
    "watch": "Grade an exercise each time you save its file.",
}
SIMILAR = 0.75  # [1] a word as similar to a command is a typing error, and no exercise
COURSE_PACKAGES = ("tomlkit", "tree_sitter", "tree_sitter_java")  # of the extra `course`


class ExerciseOrCommand(click.Group):
    """A group whose first word may be the name of an exercise; commands are imported when asked."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """The names of all commands: those of this file, and those in modules of their own."""
        return sorted([*super().list_commands(ctx), *OWN_MODULE])

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """The command of this name, or None."""
        if cmd_name not in OWN_MODULE:
            return super().get_command(ctx, cmd_name)
        name = {"class": "classroom"}.get(cmd_name, cmd_name.replace("-", "_"))
        found = vars(import_module(f"{__name__}.{name}")).values()
        commands = (one for one in found if isinstance(one, click.Command))
        return next(one for one in commands if one.name == cmd_name)

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Take everything that does not begin with a command as a request to grade."""
        if not {*args[:1]} & {"-h", "--help", "--version", *self.list_commands(ctx)}:
            names = [name for name in self.list_commands(ctx) if name != "exercise"]
            if args and get_close_matches(args[0], names, n=1, cutoff=SIMILAR):
                raise click.UsageError(f"No such command {args[0]!r}", ctx)
            args = ["exercise", *args]
        return super().parse_args(ctx, args)

    def format_help(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Show the help: first the options for grading, then the other commands."""
        formatter.write_usage("grade", "[EXERCISE [FILE]] [--student NAME] [--json] [--hint]")
        formatter.write_usage("grade", "start [FOLDER] [--no-lab] [--student NAME]")
        formatter.write_usage(
            "grade",
            "watch | mystery | doctor | class FOLDER | release | export | check-course  [--help]",
        )
        self.format_help_text(ctx, formatter)
        self.commands["exercise"].format_options(ctx, formatter)
        with formatter.section("Commands"):
            own = {"start": self.commands["start"].get_short_help_str(limit=80), **OWN_MODULE}
            formatter.write_dl(sorted(own.items()))
        self.format_epilog(ctx, formatter)


@click.group(
    cls=ExerciseOrCommand,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 80},
    epilog="Exit codes: 0 full marks, 1 something is not right yet, 2 could not grade.\n\n"
    + explain_completion("grade"),
)
@click.version_option(package_name="sysid-course")
def grade() -> None:
    """Grade an exercise. Without EXERCISE, show your progress and the next step.

    EXERCISE is a name such as exercise4, or its number. FILE is your answer; without it, the
    exercise's own file is graded.
    """
    _refuse_bare_installation()


def _refuse_bare_installation() -> None:
    """Refuse to grade where only ``sysid`` was installed.

    Raises:
        BadRequest: a package of the extra ``course`` is missing.
    """
    missing = [name for name in COURSE_PACKAGES if importlib.util.find_spec(name) is None]
    if missing:
        cloned = (Path(__file__).resolve().parents[2] / "pyproject.toml").is_file()
        install = format_install_command("course")
        raise BadRequest(
            f"lessons and grading are not installed ({', '.join(missing)} missing)",
            advice=f"Install them: {'python -m grader start' if cloned else install}",
        )


def complete_exercise(
    context: click.Context, _parameter: click.Parameter, begun: str
) -> list[CompletionItem]:
    """Exercise names of the current course, and command names where one may stand."""
    from grader.course.progress import find_course  # noqa: PLC0415 - --help has to start at once

    try:
        folder = find_course(Path.cwd()) / "exercises"
    except BadRequest:
        names = []
    else:
        names = sorted(path.parent.name for path in folder.glob("*/checks.py"))
    if context.info_name == "exercise":
        names += grade.list_commands(context)
    return [CompletionItem(name) for name in names if name.startswith(begun) and name != "exercise"]


@grade.command(hidden=True)
@click.argument("exercise", required=False, shell_complete=complete_exercise)
@click.argument("file", required=False, type=PATH)
@STUDENT
@click.option("--json", "as_json", is_flag=True, help="Write the result as JSON.")
@click.option("--hint", is_flag=True, help="Show the next of three hints. You lose no points.")
@click.option(
    "--picture", metavar="FILE", type=PATH, help="Draw what a wrong answer would do: .svg, .png."
)
@PLAIN
def exercise(
    exercise: str | None,
    file: Path | None,
    student: str | None,
    *,
    as_json: bool,
    hint: bool,
    picture: Path | None,
    plain: bool,
) -> int:
    """Grade an exercise, or show your progress."""
    from grader.exercise.exercise import find_exercise  # noqa: PLC0415 - --help has to start at once

    learner = locate_learner(student)
    if exercise is not None:
        one = find_exercise(exercise, learner.course)
        if hint:
            return _show_hint(one, learner)
        code = grade_file(one, file, learner, as_json=as_json, plain=plain, picture=picture)
        if code == DONE and not as_json:
            show_next_step(learner)
        return code
    if as_json or hint or picture:
        option = "json" if as_json else "hint" if hint else f"picture {picture}"
        advice = f"Say which: grade exercise4 --{option}"
        raise BadRequest("no exercise was named", advice=advice)
    from grader.feedback.report import format_overview  # noqa: PLC0415 - the same

    print_lines(format_overview(learner, plain=plain))
    show_next_step(learner)
    return 0


def show_next_step(learner: "Learner") -> None:
    """End with the one thing to do next."""
    from grader.course.learner import find_learner  # noqa: PLC0415 - --help has to start at once
    from grader.feedback.report import format_next_step  # noqa: PLC0415 - the same

    now = find_learner(learner.course, student=learner.name, say=print_error)
    print_lines([(), *format_next_step(now)])


@grade.command()
@click.argument("folder", required=False, type=PATH)
@click.option("--no-lab", is_flag=True, help="Do not open JupyterLab.")
@click.option("--student", metavar="NAME", help="Who you are, from now on.")
def start(folder: Path | None, student: str | None, *, no_lab: bool) -> int:
    """Show your progress, make your data, and open the first lesson.

    With FOLDER, lessons and exercises are first unpacked into it, if they are not there yet.

    For example: grade start my-course
    """
    from grader.course.progress import Progress, update_progress  # noqa: PLC0415 - --help has to start at once
    from grader.setup.start import start as begin  # noqa: PLC0415 - the same
    from grader.student_data.class_package import read_class_package  # noqa: PLC0415 - the same

    if folder is not None:
        from grader.course.course_folder import unpack_course  # noqa: PLC0415 - the same

        if unpack_course(folder):
            _print_message(f"lessons and exercises are in {folder}. Grade inside it: cd {folder}")
    learner = locate_learner(student, inside=folder)
    who, before = learner.name, learner.progress
    of_class = read_class_package(learner.course)
    if student is None and not no_lab and of_class is None and before == Progress():
        who = _ask_name(who)
    if who != before.student and (of_class is None or of_class.is_for(who)):
        _print_message(update_progress(learner.course, lambda now: replace(now, student=who)))
    return begin(replace(learner, name=who), lab=not no_lab)


def _ask_name(known: str) -> str:
    """The learner's name, typed on the terminal; ``known`` if the input is no terminal."""
    from sim.support.student_names import check_student_name  # noqa: PLC0415 - the same

    if not sys.stdin.isatty() or "JPY_PARENT_PID" in os.environ:  # a notebook cell takes no typing
        return known

    def read_name(typed: str) -> str:
        try:
            return check_student_name(typed.strip())
        except BadRequest as refusal:
            raise click.UsageError(str(refusal)) from None

    question = "Your name, which decides your numbers (in a class, as your teacher writes it)"
    return click.prompt(question, default=known, value_proc=read_name)


def locate_learner(student: str | None, *, inside: Path | None = None) -> "Learner":
    """Who is learning, and in which course folder.

    Args:
        student: who was named on the command line.
        inside: a folder in the course; None takes the one that one stands in.

    Raises:
        BadRequest: there is no course here, or the name is none.
    """
    from grader.course.learner import find_learner  # noqa: PLC0415 - --help must not wait

    return find_learner(find_course_here(inside), student=student, say=print_error)


def grade_file(
    one: "Exercise",
    file: Path | None,
    learner: "Learner",
    *,
    as_json: bool = False,
    plain: bool = False,
    picture: Path | None = None,
) -> int:
    """Grade an answer, note the score, and show the result; the exit code."""
    from grader.feedback.report import format_grade, format_receipt, grade_to_json  # noqa: PLC0415 - --help has to start at once
    from grader.student_data.draw_cache import enable_draw_cache  # noqa: PLC0415 - the same

    if refusal := learner.find_refusal(one):
        print_lines(format_receipt(one, file))
        raise refusal
    with enable_draw_cache():
        one.prepare(learner.name, say=print_error)
        result = one.grade(file, student=learner.name)
    gradable = result.status != "ungradable"
    if gradable:  # kept before anything is shown: a reader may stop reading
        _print_message(learner.keep_score(result))
    then = None if as_json and picture is None else one.find_consequence(result)
    if as_json:
        click.echo(grade_to_json(result))
    elif result.is_readable:
        shown, words = learner.standings[one.name].hints, then.words if then else ""
        print_lines(
            format_grade(result, hints_shown=shown, solution=one.solution, plain=plain, then=words)
        )
    _print_message(result.reason)
    if picture is not None:
        _draw_consequence(then, picture)
    return (DONE if result.status == "passed" else NOT_RIGHT) if gradable else COULD_NOT


def _draw_consequence(then: "Consequence | None", picture: Path) -> None:
    """Write the consequence of an answer as a picture, and print where it is.

    Raises:
        BadRequest: the name ends in no kind of picture, or the file cannot be written.
    """
    if then is None:
        _print_message(f"{picture} was not written. Nothing to draw: your answers cause no error")
        return
    then.draw().save(picture)
    _print_message(f"what your answer would do: {picture}")


def _show_hint(one: "Exercise", learner: "Learner") -> int:
    from grader.course.progress import update_progress  # noqa: PLC0415 - --help has to start at once
    from grader.feedback.report import format_hints  # noqa: PLC0415 - the same

    shown, who = learner.standings[one.name].hints, learner.name
    print_lines(format_hints(one, shown=shown))
    if shown < len(one.hints):
        said = update_progress(learner.course, lambda now: now.add_hints(who, one.name, shown + 1))
        _print_message(said)
    return 0


def _print_message(said: str) -> None:
    if said:
        print_error(said)


def run_command(arguments: list[str] | None = None) -> int:
    """Run the command and return its exit code; nothing gets out as a traceback."""
    return command_line.run_command(grade, name="grade", arguments=arguments)


def main() -> None:
    """Start as a command."""
    sys.exit(run_command())
