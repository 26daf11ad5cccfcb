"""``grade class``: everything a class handed in, graded at one go."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from types import ModuleType

import click

from grader.classroom.answer_files import Submission
from grader.classroom.class_grading import GradedClass, grade_class, plan_grading
from grader.classroom.container import grade_in_container
from grader.classroom.exports import choose_exports
from grader.classroom.grading import GradedStudent
from grader.classroom.identity import check_identities
from grader.classroom.likeness import find_foreign_logs, find_likenesses
from grader.classroom.overrides import apply_overrides, read_overrides
from grader.classroom.result_pages import summarize_class, write_pages
from grader.classroom.results import ClassResults, collect_results, list_ungraded
from grader.classroom.roster import Roster, read_class_roster
from grader.classroom.secret import describe_numbers
from grader.classroom.store import ResultStore
from grader.classroom.submissions import find_stray_files, find_submissions, read_submission
from grader.cli.course_here import choose_exercises, find_course_here
from grader.course.progress import NOBODY
from grader.exercise.exercise import Exercise, list_exercises
from grader.feedback.terminal import print_error, print_lines, style_line, wrap_text
from grader.isolation import find_isolation_level
from sim.support.command_line import DONE, INTERRUPTED, NOT_RIGHT
from sim.support.os_errors import refuse_os_errors
from sim.support.printable import list_first
from sim.support.secret import find_secret
from sim.support.work.executor import count_available_cores
from sim.support.work.interrupt import deferred_interrupt
from sim.support.work.progress_bar import progress_bar


def grade_folder(  # noqa: PLR0917 - click passes options by name
    folder: Path,
    output: Path | None,
    secret: Path | None,
    roster: Path | None,
    packages: Path | None,
    overrides: Path | None,
    student: str | None,
    only: tuple[str, ...],
    wanted: tuple[str, ...],
    name: str | None,
    processes: int | None,
    cluster: str | None,
    engine: str | None,
    image: str,  # noqa: ARG001 - the container takes it from the context, with all others
    *,
    self_study: bool,
    run: bool | None,
    again: bool,
) -> int:
    """Grade the submissions of a class with the options of ``grade class``; returns the exit code.

    Raises:
        Refusal: the folder, or a file that an option names, cannot be used.
    """
    known = read_class_roster(roster) if roster else Roster()
    formats = choose_exports(wanted, known)
    course = find_course_here()
    out = output or folder.with_name(f"{folder.resolve().name.removesuffix('.zip')}-graded")
    if engine:
        return grade_in_container(click.get_current_context(), course=course, output=out)
    value = kept.value if (kept := find_secret(secret, make=False)) else None
    asked = choose_exercises(only, course)
    found = _find_submissions(folder, course, asked, known, student=student)
    there = check_identities(
        found, asked, secret=value, self_study=self_study, partners=known.partners
    )
    _tell_problems(there)
    known_names = [one.student for one in there if not (known.rows and one.problem)]
    everybody = [*known_names, *known.rows]
    # before an hour of grading
    marks = read_overrides(overrides, students=everybody, exercises=asked) if overrides else ()
    work = GradedClass(there, asked, course, value, _decide_running(asked, run, cluster))
    graded = _grade_students(work, out, processes=processes, cluster=cluster, again=again)
    if graded is None:
        return INTERRUPTED
    title = name or folder.resolve().stem
    results = collect_results(title, graded, known, asked=asked, handed_in=there)
    foreign = find_foreign_logs(there, packages) if packages else ()
    alike = (*foreign, *find_likenesses(there, asked, graded))
    changed = apply_overrides(results.students, marks)
    results = replace(results, students=changed, numbers=describe_numbers(value), likenesses=alike)
    return _write_results(results, out, formats)


def _find_submissions(
    folder: Path,
    course: Path,
    asked: Sequence[Exercise],
    known: Roster,
    *,
    student: str | None,
) -> tuple[Submission, ...]:
    """The submissions of one student, or of all students in the folder."""
    everything = list_exercises(course)
    if student:
        named = folder.resolve()  # whoever names a link means what it leads to
        return (read_submission(named, everything, asked=asked, student=student),)
    roster = known.identities
    advice = "Give yourself the right to open it, then run the same command again."
    with refuse_os_errors("what the class handed in cannot be opened", folder, advice=advice):
        there = find_submissions(folder, everything, asked=asked, roster=roster)
        stray = find_stray_files(folder, roster)
    if stray:
        print_error(f"left out, because no student has such a name: {', '.join(stray)}")
    return there


def _tell_problems(there: Sequence[Submission]) -> None:
    """Print, before the grading, which students do not have the name of their folder."""
    for one in there:
        if one.problem:
            print_error(f"{one.student}: {one.problem}")
        elif one.unused:
            print_error(f"{one.student}: {list_first(one.unused, separator='; ')}")
    nameless = [one.student for one in there if one.worked_as == NOBODY]
    if nameless:
        print_error(
            "these students worked without a name, so they are graded on the numbers for no name: "
            f"{list_first(nameless, separator='; ')}"
        )
    matched = [
        f"{one.place.name} as {one.student}"
        for one in there
        if not one.problem and one.student.casefold() not in one.place.name.casefold()
    ]
    if matched:
        print_error(f"found on the roster: {list_first(matched, separator='; ')}")


def _decide_running(asked: Sequence[Exercise], run: bool | None, cluster: str | None) -> bool:  # noqa: FBT001 - as the option
    """Whether to run students' code: as the option says, else if it is safe; prints which."""
    if run is False or not any(one.runs_code for one in asked):
        return False
    found = "one of a cluster, and the others are not known" if cluster else find_isolation_level()
    if found.startswith("isolated"):
        return True
    if run:
        print_error(
            f"students' code is run although this machine is {found}. It can read what you can "
            "read: the class's secret, other students' answers. Safer: grade class --in docker."
        )
        return True
    print_error(
        f"students' code is not run: this machine is {found}. Robot code is only read, and a "
        "fit.py waits for you as ungradable. --in docker runs both in a container; --run runs "
        "them here all the same."
    )
    return False


def _grade_students(
    work: GradedClass, out: Path, *, processes: int | None, cluster: str | None, again: bool
) -> tuple[GradedStudent, ...] | None:
    """Grade the students without a result; None if the user stopped it."""
    store = ResultStore(out)
    kept, left = plan_grading(work, store, travel=cluster is not None, again=again)
    total = len(kept) + len(left)
    with (
        progress_bar("students", total, done=len(kept)) as (step, done),
        deferred_interrupt() as stop_if_noted,
    ):
        try:  # one more than there are cores, for while one waits for a learner's code
            return grade_class(
                work, kept, left, store, cluster=cluster,
                processes=processes or count_available_cores() + 1,
                say=step, stop_if_asked=stop_if_noted,
            )  # fmt: skip
        except KeyboardInterrupt:
            count = done()
    print_error(
        f"stopped with {count} of {total} students graded. Run the same command to continue."
    )
    return None


def _write_results(results: ClassResults, out: Path, formats: Mapping[str, ModuleType]) -> int:
    pages = write_pages(results, out)
    files = [path for one in formats.values() for path in one.write(results, out)]
    ResultStore(out).remove_outdated(
        [*pages, *files], students=[one.student for one in results.students]
    )
    unread = {one.student for one in results.students if list_ungraded(one, results)}
    unread |= results.remarks.keys()
    print_lines(wrap_text(results.numbers, lead=""))
    print_lines(wrap_text(summarize_class(results), lead=""))
    print_lines([style_line(f"Overview: {pages[0]}")])
    tops = dict.fromkeys(path.relative_to(out).parts[0] for path in files)
    print_lines([style_line(f"In the same folder: {', '.join([*tops, 'students', 'results'])}")])
    warnings = (one.warn(results) for one in formats.values() if hasattr(one, "warn"))
    for said in (*filter(None, warnings), *results.likenesses):
        print_error(said)
    if unread:
        count = f"{len(unread)} student{'s' if len(unread) > 1 else ''}"
        print_error(f"some work of {count} could not be graded; the overview begins with it")
    return NOT_RIGHT if unread else DONE
