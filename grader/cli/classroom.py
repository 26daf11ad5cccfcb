"""``grade class``: everything a class handed in, graded at one go."""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from grader.terminal import complain, line, show, wrapped
from sim.command import DONE, INTERRUPTED, NOT_RIGHT
from sim.errors import BadRequest

if TYPE_CHECKING:
    from collections.abc import Sequence

    from grader.classroom.exports import Export
    from grader.classroom.grading import Graded
    from grader.classroom.handed_in import HandedIn
    from grader.classroom.results import Results
    from grader.classroom.roster import Members
    from grader.classroom.run import Class
    from grader.exercise import Exercise

PATH = click.Path(path_type=Path)


@click.command("class")
@click.argument("folder", type=PATH)
@click.option("-o", "--output", type=PATH, help="Folder for results.  [default: FOLDER-graded]")
@click.option("--secret", type=PATH, help="File of the class's secret, made by grade release.")
@click.option("--roster", type=PATH, help="CSV file with a column student; or Canvas's export.")
@click.option("--student", metavar="NAME", help="FOLDER is what this one student handed in.")
@click.option("--exercise", "only", multiple=True, help="Only this exercise; may be repeated.")
@click.option("--export", "wanted", multiple=True, metavar="FORMAT", help="canvas, github, "
              "gradescope, junit; may be repeated.")  # fmt: skip
@click.option("--name", help="Of the class, for the overview.  [default: the folder's]")
@click.option(
    "--processes",
    type=click.IntRange(min=1),
    help="How many grade.  [default: cores, and one]",
)
@click.option("--cluster", metavar="ADDRESS", help="Grade on a Dask cluster: tcp://host:8786.")
@click.option("--run/--no-run", default=None, help="Run robot code, besides reading it.  [default: "
              "where this machine can shut it in]")  # fmt: skip
@click.option("--again", is_flag=True, help="Grade everything again.")
def class_(  # noqa: PLR0917 - click passes options by name
    folder: Path,
    output: Path | None,
    secret: Path | None,
    roster: Path | None,
    student: str | None,
    only: tuple[str, ...],
    wanted: tuple[str, ...],
    name: str | None,
    processes: int | None,
    cluster: str | None,
    *,
    run: bool | None,
    again: bool,
) -> int:
    """Grade what a class handed in: FOLDER holds a folder or zip file for each student.

    In each of them, an answer lies in a folder named as its exercise (exercise4/answers.toml).
    Writes an overview (index.html), a page for each student, gradebook.csv and what --export asks.
    What is graded is kept: the same command goes on where it was stopped.

    Exit codes: 0 all graded, 1 some could not be, 2 could not do it.
    """
    from grader.classroom.exports import exports  # noqa: PLC0415 - --help must not wait for it
    from grader.classroom.handed_in import find_all, find_one  # noqa: PLC0415 - the same
    from grader.classroom.results import Results  # noqa: PLC0415 - the same
    from grader.classroom.roster import members  # noqa: PLC0415 - the same
    from grader.classroom.run import Class  # noqa: PLC0415 - the same
    from grader.classroom.secret import find_secret  # noqa: PLC0415 - the same
    from grader.course import find_course, other_code  # noqa: PLC0415 - the same

    formats = exports()
    unknown = [one for one in wanted if one not in formats]
    if unknown:
        raise BadRequest(
            f"there is no format {unknown[0]!r}", advice=f"Choose of: {', '.join(formats)}."
        )
    course = find_course(Path.cwd())
    if said := other_code(course):
        complain(said)
    asked = _asked(only, course)
    known = members(roster) if roster else None
    found = find_one(folder, asked, student=student) if student else None
    there = (found,) if found else find_all(folder, asked)
    kept = find_secret(secret, make=False)
    out = output or folder.with_name(f"{folder.resolve().name.removesuffix('.zip')}-graded")
    if run is None:
        run = _shut_in(asked, cluster=cluster)
    work = Class(there, asked, course, kept.value if kept else None, run)
    graded = _run(work, out, processes=processes, cluster=cluster, again=again)
    if graded is None:
        return INTERRUPTED
    title = name or folder.resolve().stem
    everybody = _with_absent(graded, there, known, asked)
    rows, header = (known.rows, known.header) if known else ({}, ())
    results = Results(title, everybody, tuple(one.name for one in asked), rows, header)
    return _written(results, out, [formats[one] for one in dict.fromkeys(("gradebook", *wanted))])


COMMAND = class_


def _asked(only: tuple[str, ...], course: Path) -> "tuple[Exercise, ...]":
    from grader.exercise import exercises, find  # noqa: PLC0415 - --help must not wait for it

    if not only:
        return exercises(course)
    names = {find(one, course).name for one in only}
    return tuple(one for one in exercises(course) if one.name in names)


def _shut_in(asked: "Sequence[Exercise]", *, cluster: str | None) -> bool:
    """Whether robot code is run unless somebody says: where strangers' code does no harm."""
    from grader.isolation import level  # noqa: PLC0415 - --help must not wait for it

    if not any(one.runs for one in asked):
        return False
    found = "one of a cluster, and nobody knows of all" if cluster else level()
    if found.startswith("isolated"):
        return True
    complain(f"robot code is read, not run: this machine is {found}. --run runs it all the same.")
    return False


def _run(
    work: "Class", out: Path, *, processes: int | None, cluster: str | None, again: bool
) -> "tuple[Graded, ...] | None":
    """Grade what is left; None where it was stopped."""
    from grader.classroom.run import grade_all, plan  # noqa: PLC0415 - --help must not wait
    from grader.classroom.store import Store  # noqa: PLC0415 - the same
    from sim.work.bar import bar  # noqa: PLC0415 - the same
    from sim.work.here import cores  # noqa: PLC0415 - the same
    from sim.work.interrupt import noted  # noqa: PLC0415 - the same

    store = Store(out)
    left = plan(work, store, travel=cluster is not None, again=again)
    total = len(left.kept) + len(left.todo)
    with bar("students", total, done=len(left.kept)) as (step, done), noted() as stop_if_noted:

        def say() -> None:
            step()
            stop_if_noted()

        try:  # one more than there are cores, for while one waits for a learner's code
            return grade_all(
                work, left, store, processes=processes or cores() + 1, cluster=cluster, say=say
            )
        except KeyboardInterrupt:
            count = done()
    complain(f"stopped with {count} of {total} students graded. The same command goes on.")
    return None


def _with_absent(
    graded: "tuple[Graded, ...]",
    there: "Sequence[HandedIn]",
    known: "Members | None",
    asked: "Sequence[Exercise]",
) -> "tuple[Graded, ...]":
    """Everybody of the roster, named as there; who is not on it is said."""
    from dataclasses import replace  # noqa: PLC0415 - --help must not wait for it

    from grader.classroom.grading import ungraded  # noqa: PLC0415 - the same
    from grader.variant import same  # noqa: PLC0415 - the same

    if known is None:
        return graded
    rows = {same(name): name for name in known.rows}
    strangers = [one.student for one in there if same(one.student) not in rows]
    if strangers:
        complain(f"not on the roster, graded all the same: {', '.join(strangers)}")
    found = [replace(one, student=rows.get(same(one.student), one.student)) for one in graded]
    present = {same(one.student) for one in found}
    absent = [name for plain, name in rows.items() if plain not in present]
    found += [ungraded(name, asked, handed_in=(), reason="") for name in absent]
    return tuple(sorted(found, key=lambda one: one.student.casefold()))


def _written(results: "Results", out: Path, formats: "Sequence[Export]") -> int:
    from grader.classroom.page import summary, write_pages  # noqa: PLC0415 - --help must not wait
    from grader.classroom.results import status_of  # noqa: PLC0415 - the same

    page = write_pages(results, out)
    files = [path for one in formats for path in one.write(results, out)]
    unread = [one.student for one in results.students if "ungradable" in status_of(one).values()]
    show(wrapped(summary(results), lead=""))
    show([line(f"Overview: {page}")])
    tops = dict.fromkeys(path.relative_to(out).parts[0] for path in files)
    show([line(f"Beside it: {', '.join([*tops, 'students', 'results'])}")])
    if unread:
        count = f"{len(unread)} student{'s' if len(unread) > 1 else ''}"
        complain(f"something of {count} could not be graded; the overview begins with it")
    return NOT_RIGHT if unread else DONE
