"""Answers from a notebook: written into the exercise's file, and graded as the command does it."""

import html
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from grader.answers.answer_names import find_similar_name
from grader.answers.submission import read_answers, read_text
from grader.checks.consequence import Consequence
from grader.course.learner import find_learner
from grader.course.progress import find_course
from grader.exercise.exercise import Exercise, Grade, find_exercise
from grader.feedback.report import (
    format_grade,
    format_points,
    format_receipt,
    judge_grade,
    render_checks,
)
from grader.feedback.terminal import Line, print_error, style_line
from sim.core.errors import BadRequest, Refusal
from sim.support.atomic_file import write_atomically
from sim.support.printable import make_printable
from sim.support.student_names import make_folder_name


def escape_html(text: str) -> str:
    """A text as HTML shows it, with nothing in it that commands."""
    return html.escape(make_printable(text))


QUESTION = re.compile(r"^### (\w+)\n\n(.+)\n\n((?:- \*\*.+\n?)+)", re.MULTILINE)
OPTION = re.compile(r"- \*\*(\w)\*\* (.+)")
WIDE = {"width": "max-content"}


@dataclass(frozen=True)
class ShownGrade:
    """A grade as a notebook cell shows it.

    Args:
        lines: the same as on a terminal.
        grade: the result itself; None where nothing could be graded here.
        page: the same as HTML; empty where it is but lines.
    """

    lines: tuple[Line, ...]
    grade: Grade | None = None
    page: str = ""

    @property
    def html(self) -> str:
        """The report as HTML, for a notebook's cell."""
        return self.page or f"<pre style='white-space:pre-wrap'>{escape_html(str(self))}</pre>"

    def __str__(self) -> str:
        """The report as text, as on a terminal."""
        rows = ("".join(span.text for span in row).rstrip() for row in self.lines)
        return make_printable("\n".join(rows))

    def _repr_mimebundle_(self, **_: object) -> dict[str, str]:
        return {"text/plain": str(self), "text/html": self.html}


def submit(
    exercise: str | int,
    /,
    student: str | None = None,
    *,
    course: Path | None = None,
    **answers: object,
) -> ShownGrade:
    """Write answers into an exercise's file and grade it, as ``grade`` does on a terminal.

    Args:
        exercise: which: ``"exercise9"`` or ``9``.
        student: whose answer; None takes who is learning on this machine.
        course: the course folder; None looks for it from here upwards.
        answers: by name, as in the file; a unit makes a text of a number: ``kV="2.4 V·s/m"``.
            Numbers below a name stand in braces: ``delay={"lag": 0.03}`` is the file's line
            ``delay.lag = 0.03``. Without any, the file is graded as it is.

    Returns:
        The result, which a cell shows. What cannot be graded is shown in one line, too.
    """
    folder = find_course(Path.cwd()) if course is None else course
    try:
        learner = find_learner(folder, student=student, say=print_error)
        one = find_exercise(str(exercise), folder)
        if answers:
            write_answers(one, answers)
        if refusal := learner.find_refusal(one):
            return ShownGrade((*format_receipt(one, None), style_line(str(refusal))))
        one.prepare(learner.name, say=lambda _: None)
        grade = one.grade(None, student=learner.name)
    except Refusal as refusal:
        return ShownGrade((style_line(f"! {refusal}"),))
    if grade.status == "ungradable":
        return ShownGrade((style_line(f"! {grade.reason}"),))
    if said := learner.keep_score(grade):
        print_error(said)
    then = one.find_consequence(grade)
    lines = format_grade(
        grade,
        hints_shown=learner.standings[one.name].hints,
        solution=one.solution,
        then=then.words if then else "",
    )
    return ShownGrade(tuple(lines), grade, _render_grade(grade) + _render_consequence(then))


class ExerciseQuestions:
    """Questions of an exercise as buttons, and one button that submits the choices.

    Without buttons, ``submit`` does the same.

    Args:
        exercise: whose questions, as ``submit`` takes it.
        names: of the questions, as in the learner's ``questions.md``.
        course: the course folder; None looks for it from here upwards.
    """

    def __init__(self, exercise: str, /, *names: str, course: Path | None = None) -> None:
        import ipywidgets  # type: ignore[import-untyped]  # noqa: PLC0415 - no types; for notebooks

        self._exercise, self._course = exercise, course
        self._graded = ipywidgets.HTML()
        try:
            asked = _read_questions(exercise, course)
        except Refusal as refusal:  # a lesson that was opened alone
            asked, names = {}, ()
            self._graded.value = ShownGrade((style_line(f"! {refusal}"),)).html
        self._asked = {name: asked[name] for name in names}
        self._chosen = {
            name: ipywidgets.RadioButtons(options=options, value=None, layout=WIDE)
            for name, (_, options) in self._asked.items()
        }
        button = ipywidgets.Button(description="Grade my answers", disabled=not names)
        button.on_click(self._submit_choice)
        rows = [
            row
            for name, (question, _) in self._asked.items()
            for row in (ipywidgets.HTML(html.escape(question)), self._chosen[name])
        ]
        self._box = ipywidgets.VBox([*rows, button, self._graded])

    def _submit_choice(self, _: object) -> None:
        letters = {name: one.value for name, one in self._chosen.items() if one.value}
        self._graded.value = submit(self._exercise, course=self._course, **letters).html

    def _repr_mimebundle_(self, **how: object) -> Any:  # noqa: ANN401 - ipywidgets has no types
        rows = []
        for question, options in self._asked.values():
            rows += [question, *(f"  \N{WHITE CIRCLE} {text}" for text, _ in options)]
        return self._box._repr_mimebundle_(**how) | {"text/plain": "\n".join(rows)}


def _read_questions(
    exercise: str, course: Path | None
) -> dict[str, tuple[str, list[tuple[str, str]]]]:
    """The learner's own questions: name -> the question, and each option with its letter.

    Raises:
        Refusal: there is no course here, or its questions cannot be made or read.
    """
    folder = find_course(Path.cwd()) if course is None else course
    one = find_exercise(exercise, folder)
    who = find_learner(folder, student=None, say=print_error).name
    one.prepare(who, say=lambda _: None)
    text = read_text(one.folder / "data" / make_folder_name(who) / "questions.md")
    return {
        name: (question, [(option, letter) for letter, option in OPTION.findall(options)])
        for name, question, options in QUESTION.findall(text)
    }


def write_answers(exercise: Exercise, answers: Mapping[str, object]) -> None:
    """Write answers into the exercise's file; what else stands there stays, comments and all.

    Raises:
        BadRequest: the exercise has no file of answers, or none with such a name in it.
        UnreadableFile: the file cannot be read.
    """
    import tomlkit  # noqa: PLC0415 - only who writes needs it
    from tomlkit.exceptions import TOMLKitError  # noqa: PLC0415 - the same

    path = exercise.folder / exercise.files[0]
    if path.suffix != ".toml":
        raise BadRequest(
            f"{exercise.name} is answered in {' or '.join(exercise.files)}",
            advice=f"Write your answer there, then: submit({exercise.name!r})",
        )
    there = read_answers(path)  # says what is wrong with it in our own words
    names = _find_names(exercise, [*there], answers)
    document = tomlkit.parse(path.read_text(encoding="utf-8-sig"))
    for name, value in answers.items():
        own = names[name]
        try:
            if not isinstance(value, Mapping):
                document[own] = _make_plain(value)
                continue
            for inner, number in value.items():
                if own in document:
                    document[own][inner] = _make_plain(number)
                else:
                    document.append(tomlkit.key([own, inner]), tomlkit.item(_make_plain(number)))
        except (TOMLKitError, ValueError, TypeError) as error:
            raise BadRequest(
                f"{name} = {value!r} cannot be written down ({error})",
                advice="Give a number, or a text in quotes.",
            ) from None
    write_atomically(path, tomlkit.dumps(document))


def _find_names(
    exercise: Exercise, there: list[str], answers: Mapping[str, object]
) -> dict[str, str]:
    """The name of each answer as the file has it.

    Raises:
        BadRequest: the exercise asks for no such name, or for another form of answer.
    """
    tables = {_fold_name(name): name for name in reversed(exercise.answer_tables)}
    known = tables | {_fold_name(name): name for name in there}
    for name, value in answers.items():
        if _fold_name(name) not in known:
            near = find_similar_name(name, [*known.values()])
            listed = ", ".join(there) or "none"
            raise BadRequest(
                f"{exercise.name} asks for no {name!r}",
                advice=f"{f'Did you mean {near}? ' if near else ''}It asks for: {listed}.",
            )
        if isinstance(value, Mapping) != (_fold_name(name) in tables):
            example = "0.03" if isinstance(value, Mapping) else '{"lag": 0.03}'
            raise BadRequest(
                f"{name} = {value!r} cannot be an answer of {exercise.name}",
                advice=f"Write it in this form: {name}={example}",
            )
    return {name: known[_fold_name(name)] for name in answers}


def _fold_name(name: str) -> str:
    """A name as any spelling of it gives it: Python's own names have no dashes."""
    return name.lower().replace("-", "_")


def _make_plain(value: object) -> Any:  # noqa: ANN401 - whatever a learner gives
    """A value as a file holds it: NumPy's numbers become plain numbers."""
    if value is None:
        return ""
    single = getattr(value, "item", None)
    if callable(single) and getattr(value, "size", None) == 1:
        return single()
    return value


def _render_grade(grade: Grade) -> str:
    _, verdict = judge_grade(grade)
    points = format_points(grade.score, grade.max_score)
    head = escape_html(f"{grade.exercise}: {points} points, {verdict}")
    return f"<p><strong>{head}</strong></p>{render_checks(grade)}"


def _render_consequence(consequence: Consequence | None) -> str:
    """The consequence of the answer, below the checks."""
    if consequence is None:
        return ""
    says = f"<p><strong>On the robot</strong>: {escape_html(consequence.words)}</p>"
    return says + consequence.draw().html
