"""The grade of an answer as text for a terminal (verdict, checks, next step) and as JSON."""

import json
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path

from grader.answers.submission import read_answers, read_text
from grader.checks.check import Result, Status
from grader.checks.misconception import MISCONCEPTIONS
from grader.course.learner import Learner
from grader.course.progress import Progress, Standing
from grader.exercise.exercise import HINTS, Exercise, Grade, list_exercises
from grader.feedback.terminal import Line, StyledText, find_width, style_line, wrap_text
from sim.support.printable import make_printable

MARKS = {
    Status.PASSED: ("✓", "green"),
    Status.FAILED: ("✗", "red"),
    Status.NOT_REACHED: ("–", "dim"),
    Status.NOT_RUN: ("–", "dim"),
    Status.ERROR: ("!", "magenta"),
}
UNANSWERED = ("○", "dim")
SPOKEN = {
    "○": "not answered yet",
    "✓": "right",
    "✗": "not right yet",
    "–": "not looked at yet",
    "!": "our mistake",
}
# Of the line that leads a check on a page; legible on light and on dark ones
COLORS = {"green": "#1f9d61", "red": "#d1495b", "dim": "#808080", "magenta": "#b060b0"}
INDENT = "    "
GRADED = re.compile(r'["`]grade (\w+)(?:\\n)?["`]')  # how a notebook's JSON has such a line
ONCE = {"", "why", "see"}  # labels of what is said once, however many checks it stands under


def grade_to_json(grade: Grade) -> str:
    """The grade as one line of JSON, in ASCII so that every terminal keeps it whole."""
    names = ("exercise", "student", "score", "max_score", "status")
    told = {name: getattr(grade, name) for name in names}
    if grade.warnings:
        told["warnings"] = grade.warnings
    return json.dumps({**told, "checks": [asdict(result) for result in grade.checks]})


def format_grade(
    grade: Grade,
    *,
    hints_shown: int = 0,
    solution: Path | None = None,
    plain: bool = False,
    then: str = "",
) -> list[Line]:
    """The grade for a terminal.

    Args:
        grade: what became of the answer.
        hints_shown: how many hints the learner has seen.
        solution: the folder with the solution, to be compared with once all is right.
        plain: words for signs and nothing in columns, as a screen reader reads it best.
        then: what the answer would do on the robot, in words; empty where that is not known.
    """
    lines = format_checks(grade, plain=plain)
    if then:
        lines += [style_line(), *wrap_text(then, lead="then  ")]
        lines.append(style_line(f"See it: grade {grade.exercise} --picture what.svg", "cyan"))
    if grade.status != "passed":
        lines += [style_line(), style_line(_format_next_hint(grade.exercise, hints_shown), "cyan")]
    elif solution is not None:
        place = f"{solution.parent.name}/{solution.name}"
        lines += [style_line(), style_line(f"A solution, for comparison: {place}", "cyan")]
    return _replace_signs(lines) if plain else lines


def format_checks(grade: Grade, *, plain: bool = False) -> list[Line]:
    """The verdict, and what each check found.

    Args:
        grade: what became of the answer.
        plain: as for ``format_grade``.
    """
    lines = [_format_verdict(grade), *_format_warnings(grade.warnings), style_line()]
    said: set[str] = set()  # what has been said once is not said again
    shown, more = fold_unanswered(grade.checks)
    for result in shown:
        lines += _format_result(result, said, plain=plain)
    if more:
        mark, style = UNANSWERED
        lines.append(style_line(f"{mark} {more} more not answered yet", style))
    return _replace_signs(lines) if plain else lines


def fold_unanswered(checks: Sequence[Result]) -> tuple[list[Result], int]:
    """The results to show, of those without an answer only the first; and how many are left out."""
    unanswered = [result for result in checks if result.is_unanswered]
    return [one for one in checks if one not in unanswered[1:]], len(unanswered[1:])


def find_mark(result: Result) -> tuple[str, str]:
    """The sign that leads a result, and its style."""
    return UNANSWERED if result.is_unanswered else MARKS[result.status]


def judge_grade(grade: Grade) -> tuple[tuple[str, str], str]:
    """The symbol of a whole grade with its style, and the verdict in words."""
    if grade.status == "passed":
        return MARKS[Status.PASSED], "all right"
    unanswered = sum(result.is_unanswered for result in grade.checks)
    marks = {find_mark(result) for result in grade.checks}
    rest = f", {unanswered} not answered" if unanswered else " yet"
    if not unanswered or marks & {MARKS[Status.FAILED], MARKS[Status.ERROR]}:
        return MARKS[Status.FAILED], f"not all right{rest}"
    if MARKS[Status.PASSED] in marks:
        return MARKS[Status.PASSED], f"all right so far{rest}"
    return UNANSWERED, "nothing answered yet"


def _format_warnings(warnings: Sequence[str]) -> list[Line]:
    """What in the file does not count, as lines below the verdict."""
    return [row for one in warnings for row in wrap_text(one, lead="  note  ", style="yellow")]


def _replace_signs(lines: list[Line]) -> list[Line]:
    """The text with a word in place of each sign that leads a line."""
    return [
        (StyledText(f"{SPOKEN[row[0].text[0]]}:{row[0].text[1:]}", row[0].style), *row[1:])
        if row and row[0].text[:2].rstrip() in SPOKEN
        else row
        for row in lines
    ]


def format_receipt(exercise: Exercise, file: Path | None) -> list[Line]:
    """What can be read of an answer that somebody else will grade.

    Raises:
        Refusal: nothing can.
    """
    lines = []
    for path in exercise.find_answer_files(file):
        if path.suffix.lower() != ".toml":
            count = len(read_text(path).splitlines())
            lines.append(style_line(f"{path.name}: {count} line{'s' if count != 1 else ''}"))
            continue
        answers = read_answers(path)
        there = [name for name, value in answers.items() if value != ""]
        lines.append(style_line(f"{path.name}: {len(there)} of {len(answers)} answered"))
        lines += [style_line(f"  {name} = {answers[name]}") for name in there]
        lines += _format_warnings(exercise.find_unknown_names(path))
    return lines


def _format_verdict(grade: Grade) -> Line:
    (mark, style), said = judge_grade(grade)
    score = f"{grade.exercise}: {format_points(grade.score, grade.max_score)} points"
    file = f"  ({grade.file.name})" if grade.file else ""
    return (StyledText(f"{mark} {score}, {said}", f"bold {style}"), StyledText(file, "dim"))


def _format_result(result: Result, said: set[str], *, plain: bool) -> list[Line]:
    mark, style = find_mark(result)
    points = format_points(result.points, result.max_points)
    if plain:
        rows = [style_line(f"{mark} {result.description}, {points} points", style)]
    else:
        rows = _format_row(result.description, points, mark, style)
    for label, text in list_feedback(result):
        if text not in said:
            rows += wrap_text(text, lead=f"{INDENT}{label:<5}" if label else INDENT)
        if label in ONCE:
            said.add(text)
    return rows


def format_points(earned: float, most: float) -> str:
    """Points to two decimals at most, as in ``1.08 of 10``."""
    return f"{round(earned, 2):g} of {round(most, 2):g}"


def _format_row(description: str, points: str, mark: str, style: str) -> list[Line]:
    rows = wrap_text(description, lead="  ", spare=len(points) + 1)
    _, first = rows[0]
    room = find_width() - len(points) - 2
    rows[0] = (
        StyledText(f"{mark} ", style),
        StyledText(first.text.ljust(room)),
        StyledText(points, style),
    )
    return rows


def list_feedback(result: Result) -> list[tuple[str, str]]:
    """The feedback to a check, each text with its label: given answer, next step, reason."""
    known = MISCONCEPTIONS.get(result.misconception)
    if result.status is Status.PASSED:
        told = [("note", result.hint)]
    elif result.status is not Status.FAILED:
        told = [("", result.seen)]
    else:
        told = [("got", "" if result.is_unanswered else result.seen), ("try", result.hint)]
        told += [("why", known.says), ("see", known.reference)] if known else []
    return [(label, text) for label, text in told if text]


def compose_feedback(result: Result) -> str:
    """The feedback to a check as one text, for Gradescope, GitHub and JUnit."""
    unanswered = [("got", result.seen)] if result.is_unanswered else []
    return _join_feedback([*unanswered, *list_feedback(result)])


def _join_feedback(told: Iterable[tuple[str, str]]) -> str:
    lines = (f"{label} {text}" if label in {"got", "see"} else text for label, text in told)
    return make_printable("\n".join(lines))


def render_checks(grade: Grade) -> str:
    """What each check found, as HTML for a page or a notebook's cell."""
    from sim.report.page_file import load_templates  # noqa: PLC0415 - only who shows pages needs them

    shown, more = fold_unanswered(grade.checks)
    rows = [(*find_mark(one), one, _join_feedback(list_feedback(one))) for one in shown]
    template = load_templates(Path(__file__).parent).get_template("checks.html.jinja")
    return template.render(
        rows=rows, more=more, warnings=grade.warnings, spoken=SPOKEN, colors=COLORS,
        format_points=format_points,
    )  # fmt: skip


def _format_next_hint(exercise: str, shown: int) -> str:
    if shown >= len(HINTS):
        return f"To see all {len(HINTS)} hints again: grade {exercise} --hint"
    return f"Hint {shown + 1} of {len(HINTS)}: grade {exercise} --hint"


def format_hints(exercise: Exercise, *, shown: int) -> list[Line]:
    """The next hint, or all of them once all have been shown.

    Args:
        exercise: whose hints.
        shown: how many have been shown before.
    """
    if shown < len(exercise.hints):
        return wrap_text(exercise.hints[shown], lead=f"Hint {shown + 1} of {len(HINTS)}: ")
    lines = [style_line(f"There are no more hints for {exercise.name}. All {len(HINTS)} again:")]
    for number, hint in enumerate(exercise.hints, start=1):
        lines += wrap_text(hint, lead=f"  {number}. ")
    return lines


def format_overview(learner: Learner, *, plain: bool = False) -> list[Line]:
    """Where a learner stands: lessons and exercises."""
    done = sum(standing.is_done for standing in learner.standings.values())
    name = f" ({learner.name})" if learner.name != Progress().student else ""
    head = f"{done} of {len(learner.standings)} exercises done{name}"
    lines = [style_line(head, "bold"), style_line()]
    lessons = sorted((learner.course / "lessons").glob("*.ipynb"))
    lines += [style_line(f"  {lesson.parent.name}/{lesson.name}") for lesson in lessons]
    lines += [style_line()] if lessons else []
    for one in list_exercises(learner.course):
        standing = learner.standings[one.name]
        tried = standing.max_score > 0
        status = (
            Status.PASSED if standing.is_done else Status.FAILED if tried else Status.NOT_REACHED
        )
        score = format_points(standing.score, standing.max_score) if tried else "not tried yet"
        if plain:
            lines.append(style_line(f"{one.name}, {one.title}: {score}"))
        else:
            lines += _format_row(f"{one.name}  {one.title}", score, *MARKS[status])
    return lines


def format_next_step(learner: Learner) -> list[Line]:
    """The one thing to do next, in a line that begins with ``Next``."""
    lesson, exercise = find_next_step(learner.course, learner.standings)
    if lesson:
        return [style_line(f"Next: open {lesson}", "cyan")]
    if exercise:
        word = "go on with" if learner.standings[exercise].max_score > 0 else "do"
        return [style_line(f"Next: {word} exercises/{exercise}/README.md", "cyan")]
    return [style_line("Everything here is done.", "bold green")]


def find_next_step(course: Path, standings: Mapping[str, Standing]) -> tuple[str, str]:
    """The lesson to read next, or the exercise to do next.

    The learner has reached the last lesson of which an exercise has been tried. What is left of the
    lessons before it is due first. An exercise that two lessons name, one for each of its parts, is
    due with the first until a later lesson is reached or it has been tried, and then with the last.

    Args:
        course: the course folder.
        standings: exercise -> how far the learner is with it, in the order of the course.

    Returns:
        A lesson's path in the course folder and nothing, or nothing and an exercise's name; nothing
        twice if all is done.
    """
    lessons = sorted((course / "lessons").glob("*.ipynb"))
    named = {one: [name for name in read_exercises(one) if name in standings] for one in lessons}
    seen: set[str] = set()
    reached = -1
    for place, lesson in enumerate(lessons):
        if any(standings[name].max_score > 0 for name in {*named[lesson]} - seen):
            reached = place
        seen.update(named[lesson])
    for place, lesson in enumerate(lessons):
        later = {name for other in lessons[place + 1 :] for name in named[other]}
        for name in named[lesson]:
            how = standings[name]
            if how.is_done or (name in later and (how.max_score > 0 or place < reached)):
                continue
            return ("", name) if place <= reached else (lesson.relative_to(course).as_posix(), "")
    return "", next((name for name, how in standings.items() if not how.is_done), "")


def read_exercises(lesson: Path) -> list[str]:
    """The exercises that a notebook says how to grade, in its order."""
    return list(dict.fromkeys(GRADED.findall(lesson.read_text(encoding="utf-8", errors="replace"))))
