"""Runs a learner's robot code and returns facts; twice if a condition is unknown.

What cannot be known (a class in a file that was not handed in, a vendor's class without a fake) is
assumed once to be false and once to be true. A verdict that is the same both ways stands; else the
learner is asked.
"""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from grader.answers.submission import read_text
from grader.checks.check import NotReachedError, NotRunError, WrongAnswer
from grader.robotcode.bench import find_bench
from grader.robotcode.bench.simulation import Mount
from grader.robotcode.checks.causes import check_compiles
from grader.robotcode.library.world import WORLD
from grader.robotcode.source import detect_language

Runs = tuple[Any, ...]
Mounts = Mapping[str, Mapping[Any, Mount]]


def run_routine(path: Path, *, mounts: Mounts, task: str, run: bool = True) -> Runs:
    """Run the SysIdRoutine of a file.

    Args:
        path: the learner's file.
        mounts: how the motors of the task's own class are built in, by language and port.
        task: the name of that class.
        run: whether Python may be run.

    Raises:
        UnreadableFile: it cannot be read, or does not parse.
        NotRunError: it is Python, which may not be run.
    """
    read_text(path)
    own = task in path.read_text("utf-8", "replace")
    return _run(path, "routine", dict(mounts[detect_language(path)]) if own else {}, run=run)


def run_buttons(path: Path, *, run: bool = True) -> Runs:
    """Press every button of a robot's container; all else is as in ``run_routine``."""
    return _run(path, "buttons", {}, run=run)


def run_gains(path: Path, *, run: bool = True) -> Runs:
    """Run the constructor of a file's class and read its gains; all else as in ``run_routine``."""
    return _run(path, "gains", {}, run=run)


def _run(path: Path, kind: str, mounts: dict[Any, Mount], *, run: bool) -> Runs:
    read_text(path)
    if detect_language(path) == "python":
        if not run:
            raise NotRunError("Python robot code is graded by running it")
        from grader.robotcode.python import run_python  # noqa: PLC0415 - only for Python

        return run_python(path, kind, mounts)
    from grader.robotcode.bench.java_subject import JavaSubject  # noqa: PLC0415 - tree-sitter

    found = []
    for assume in (False, True):
        WORLD.reset("java", assume=assume)
        stored = {port: {"inverted": mount.inverted} for port, mount in mounts.items()}
        WORLD.stored = stored
        subject = JavaSubject(path, "SysIdRoutine" if kind == "routine" else "")
        found.append(find_bench(kind)(subject, mounts).run())
        if not WORLD.undecided:
            break
    return tuple(found)


def judge_runs(runs: Runs, judge: Callable[[Any], str | None]) -> str | None:
    """Judge a program by each of its runs.

    Returns:
        A note.

    Raises:
        WrongAnswer: it is wrong in each; or right in one only, and then the learner is asked.
        NotReachedError: there is nothing to look at yet.
    """
    notes: list[str | None] = []
    wrong: dict[str, WrongAnswer | NotReachedError] = {}
    for assumed, one in zip(("false", "true"), runs, strict=False):  # as ``_run`` assumes them
        try:
            notes.append(judge(one))
        except (WrongAnswer, NotReachedError) as error:
            wrong[assumed] = error
    if not wrong:
        return notes[0]
    assumed, why = next(iter(wrong.items()))
    if notes and isinstance(why, WrongAnswer):
        check_compiles(runs[0], earned=why.earned)  # an error may be why it is not known
        text, line = next(iter(runs[0].unknown.items()), ("a condition", 0))
        raise WrongAnswer(
            f"the grader cannot know whether {text} is true (line {line}), and it matters here",
            hint=f"If it is {assumed}, this is wrong: {why.seen}. Hand in the file that "
            "decides it, or write the code so that it does not depend on it.",
            earned=why.earned,
        )
    raise why
