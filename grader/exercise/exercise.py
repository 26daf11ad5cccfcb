"""An exercise: a folder with a task, files to fill in, checks and hints; and grading one answer.

An exercise is its task, its numbers and its mistakes. A folder ``exercises/exerciseN`` holds
``README.md`` with the task, ``hints.toml`` with the hints ``concept``, ``pointer``, ``step`` (one
worked in part), and ``checks.py``, which offers

    FILES : tuple[str, ...]                    the files to fill in, the preferred one first
    its checks                                 functions under @check, or tuples of checks from
                                               ``make_check``, in the order they are shown
    def draw(student) -> Variant               optional: the learner's own numbers, always the same;
                                               ``draw_until`` draws again what is no good
    def make_files(student) -> dict            optional: what the learner works on: file -> what
                                               makes it (``grader.student_data.student_files``)
    class Answers(StudentAnswers)              optional: what the checks look at, with more than the
                                               answers and the variant
    def read(path, *, student) -> Subject      optional: the same, where it is no file of answers;
                                               a Refusal if unreadable; one that runs the learner's
                                               code also takes ``run: bool``
    BESIDE : tuple[str, ...]                   optional: files to fill in that belong to the one
                                               graded; ``read`` finds them beside its path
    ANSWER_NAMES : tuple[str, ...]             optional: the names that a file of answers may have;
                                               any other gets a warning
    def list_answer_table_names() -> tuple          optional: names of tables that it may have, too
    LOG_ENDINGS : tuple[str, ...]              optional: endings of logs of a learner's own robot,
                                               which an answer may name and ``read`` finds there
    def consequence(subject)                   optional: what a wrong answer would do on the robot,
                                               a Consequence; None where there is nothing to see

What does not fit there stands in modules beside it: ``from .drawn import draw``. What is said of a
mistake that a number shows stands in ``slips.toml``: see ``grader.answers.wrong_number.Slips``.
Answers that can be looked up stand in ``answer_key.py``: see ``grader.answers.answer_key``.
"""

import hashlib
import importlib.util
import inspect
import re
import sys
import tomllib
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from types import ModuleType
from typing import Any

from grader.answers.answer_names import find_unknown_names
from grader.answers.submission import (
    NamedAnswers,
    StudentAnswers,
    find_files,
    read_answers,
    read_text,
)
from grader.checks.check import (
    Check,
    NotReachedError,
    NotRunError,
    Result,
    Status,
    run_checks,
    skip_check,
)
from grader.checks.consequence import Consequence
from grader.student_data.student_files import write_student_files
from sim.core.errors import BadRequest, Refusal
from sim.support.os_errors import refuse_os_errors

HINTS = ("concept", "pointer", "step")  # from far to near


@dataclass(frozen=True)
class Grade:
    """The result of grading one answer.

    Args:
        exercise: ``exercise4``.
        student: whose answer it is.
        score, max_score: points earned, and the most that one can earn.
        status: ``passed`` (full marks), ``failed`` or ``ungradable``; of a class also ``missing``.
        checks: one result for each check, in the order they are shown.
        file: what was graded.
        reason: why it was ungradable, one line; empty otherwise.
        warnings: one line for each name in the file that does not count. They cost no points.
    """

    exercise: str
    student: str
    score: float
    max_score: float
    status: str
    checks: tuple[Result, ...]
    file: Path | None = None
    reason: str = ""
    warnings: tuple[str, ...] = ()

    @property
    def is_graded(self) -> bool:
        """Whether there was an answer, and it could be graded."""
        return self.status in {"passed", "failed"}

    @property
    def is_readable(self) -> bool:
        """Whether the answer could be read, so that there is something to tell about it."""
        return any(result.status is not Status.NOT_REACHED for result in self.checks)


@dataclass(frozen=True)
class Exercise:
    """One exercise of the course.

    Args:
        name: its folder's name: ``exercise4``.
        folder: where it is.
    """

    name: str
    folder: Path

    @cached_property
    def module(self) -> ModuleType:
        """The exercise's checks.py, loaded by path under a name of its own."""
        return load_module(self.folder / "checks.py")

    @property
    def checks(self) -> tuple[Check[Any], ...]:
        """The exercise's checks, in the order in which they are written."""
        return find_checks(self.module)

    @property
    def hints(self) -> tuple[str, ...]:
        """The exercise's three hints."""
        text = (self.folder / "hints.toml").read_text(encoding="utf-8")
        return tuple(tomllib.loads(text)[name].strip() for name in HINTS)

    @property
    def files(self) -> tuple[str, ...]:
        """The files to fill in, the preferred one first."""
        return tuple(self.module.FILES)

    @property
    def companion_files(self) -> tuple[str, ...]:
        """The files to fill in that stand beside the graded file."""
        return tuple(getattr(self.module, "BESIDE", ()))

    @property
    def starters(self) -> tuple[str, ...]:
        """All files to fill in."""
        return (*self.files, *self.companion_files)

    @property
    def answer_endings(self) -> frozenset[str]:
        """The endings of the names of the graded files."""
        return frozenset(Path(name).suffix for name in self.files)

    @property
    def answer_names(self) -> tuple[str, ...]:
        """The names that the file of answers may have; empty if the exercise does not say."""
        return (*getattr(self.module, "ANSWER_NAMES", ()), *self.answer_tables)

    @property
    def answer_tables(self) -> tuple[str, ...]:
        """Those of them that may have answers of their own below them."""
        return tuple(getattr(self.module, "list_answer_table_names", tuple)())

    @property
    def log_endings(self) -> tuple[str, ...]:
        """File name endings of robot logs that a learner may hand in with the answer."""
        return tuple(getattr(self.module, "LOG_ENDINGS", ()))

    @property
    def title(self) -> str:
        """The first heading of its README, without its number."""
        text = (self.folder / "README.md").read_text(encoding="utf-8")
        heading = re.search(r"^#\s+(?:Exercise \d+\s*[:.]?\s*)?(.+?)\s*$", text, re.MULTILINE)
        return heading[1] if heading else self.name

    @property
    def is_personal(self) -> bool:
        """Whether each learner works on numbers or data of their own."""
        return hasattr(self.module, "make_files")

    @property
    def runs_code(self) -> bool:
        """Whether it can run the learner's code, besides reading it."""
        reader = getattr(self.module, "read", None)
        return reader is not None and "run" in inspect.signature(reader).parameters

    @property
    def solution(self) -> Path | None:
        """The folder with its solution, where there is one: a class's package has none."""
        folder = self.folder.parents[1] / "solutions" / self.name
        return folder if folder.is_dir() else None

    def prepare(self, student: str, *, say: Callable[[str], None]) -> None:
        """Make the files that the learner works on, if they are missing.

        Nothing is made where all of it needs an answer key that a class's package lacks.

        Args:
            student: for whom.
            say: shows a line about what is going on.
        """
        if self.is_personal:
            with suppress(NotReachedError):
                files = self.module.make_files(student)
                write_student_files(files, exercise=self.folder, student=student, say=say)

    def read(self, file: Path, *, student: str, run: bool) -> Any:  # noqa: ANN401 - each has its own
        """Read a submission into the object that the checks read.

        Args:
            file: of the answer.
            student: whose it is.
            run: whether the learner's code may be run.

        Raises:
            Refusal: the file cannot be read.
            NotReachedError: what it is compared with is in no class's package.
            NotRunError: only running the learner's code could tell anything.
        """
        reader = getattr(self.module, "read", None)
        if reader is not None:
            return reader(file, student=student, **({"run": run} if self.runs_code else {}))
        make = getattr(self.module, "Answers", StudentAnswers)
        return make(NamedAnswers(read_answers(file)), self.module.draw(student), student)

    def grade(self, given: Path | None, *, student: str, run: bool = True) -> Grade:
        """Grade an answer; of several files, the one that earns most.

        Args:
            given: a file or a folder; None takes the exercise's own files.
            student: whose answer it is.
            run: whether the learner's code may be run. If not, an exercise that needs a run is not
                graded. Java robot code is graded in any case: the grader interprets it itself.
        """
        try:
            files = self.find_answer_files(given)
        except Refusal as refusal:
            return self.skip(str(refusal), student=student)
        return choose_best_grade(
            [self._grade_file(file, student=student, run=run) for file in files]
        )

    def find_answer_files(self, given: Path | None) -> tuple[Path, ...]:
        """The files of an answer.

        Args:
            given: a file or a folder; None takes the exercise's own files.

        Raises:
            Refusal: there are none, too many, or they cannot be opened.
        """
        advice = "Give yourself the right to read it, then run the same command again."
        with refuse_os_errors("it cannot be opened", given or self.folder, advice=advice):
            return find_files(
                given, folder=self.folder, names=self.files, companion_files=self.companion_files
            )

    def find_consequence(self, grade: Grade) -> Consequence | None:
        """The consequence of an answer on the robot; None if it is right or has no visible effect.

        Args:
            grade: what became of the answer; its file is read once more, and nothing of it is run.
        """
        tell = getattr(self.module, "consequence", None)
        if tell is None or grade.file is None or grade.status != "failed":
            return None
        try:
            found = tell(self.read(grade.file, student=grade.student, run=False))
        except (Refusal, NotRunError):  # somebody is saving it, or only a run could tell
            return None
        return found if isinstance(found, Consequence) else None

    def _grade_file(self, file: Path, *, student: str, run: bool) -> Grade:
        try:
            subject = self.read(file, student=student, run=run)
        except (Refusal, NotRunError, NotReachedError) as refusal:
            return replace(self.skip(str(refusal), student=student), file=file)
        results = run_checks(self.checks, subject)
        score, most = sum_points(results)
        broken = next((one for one in results if one.status is Status.ERROR), None)
        status = "passed" if score == most else "failed"
        reason = ""
        unrun = next((one for one in results if one.status is Status.NOT_RUN), None)
        if unrun:
            status, reason = "ungradable", f"the check {unrun.id} was {unrun.seen}"
        if broken:
            status = "ungradable"
            reason = (
                f"the check {broken.id} broke ({broken.seen}). That is a fault of the course, not "
                "yours: please report it, with your file"
            )
        warnings = self.find_unknown_names(file)
        return Grade(self.name, student, score, most, status, results, file, reason, warnings)

    def find_unknown_names(self, file: Path) -> tuple[str, ...]:
        """A warning for each name in a file of answers that the exercise does not ask for."""
        known = self.answer_names
        if not known or file.suffix.lower() != ".toml":
            return ()
        try:
            answers, text = read_answers(file), read_text(file)
        except Refusal:  # it was readable a moment ago: somebody is saving it
            return ()
        return find_unknown_names(
            answers,
            known,
            tables=self.answer_tables,
            text=text,
            file=file.name,
            exercise=self.name,
        )

    def skip(self, reason: str, *, student: str, status: str = "ungradable") -> Grade:
        """The grade of an answer that is not graded, for a reason of one line."""
        results = tuple(skip_check(one, reason) for one in self.checks)
        most = sum(one.points for one in self.checks)
        return Grade(self.name, student, 0.0, most, status, results, reason=reason)


def load_module(path: Path) -> ModuleType:
    """A file of an exercise or a solution as a module, under a name of its own."""
    own = hashlib.sha256(str(path).encode("utf-8", "surrogatepass")).hexdigest()[:12]
    # the same in each process, for the cache of draws
    name = f"_{path.stem}_of_{path.parent.name}_{own}"
    spec = importlib.util.spec_from_file_location(
        name, path, submodule_search_locations=[str(path.parent)]
    )
    if spec is None or spec.loader is None:
        raise ImportError(f"{path} cannot be loaded")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module  # dataclasses look themselves up there
    spec.loader.exec_module(module)
    return module


def find_checks(module: ModuleType) -> tuple[Check[Any], ...]:
    """The checks of a module, and those in its tuples of checks, as they are written."""
    values = (value if isinstance(value, tuple) else (value,) for value in vars(module).values())
    return tuple(one for several in values for one in several if isinstance(one, Check))


def sum_points(results: Iterable[Result]) -> tuple[float, float]:
    """The points that checks earned, and the most that one can earn."""
    pairs = [(one.points, one.max_points) for one in results]
    return sum(points for points, _ in pairs), sum(most for _, most in pairs)


def choose_best_grade(grades: Sequence[Grade]) -> Grade:
    """The grade with the highest score; if no answer scored, first an unreadable one.

    A file with a syntax error is more likely the one being worked on than an untouched starter.
    """
    return max(grades, key=lambda one: (one.score, one.status == "ungradable"))


def list_exercises(course: Path) -> tuple[Exercise, ...]:
    """The exercises of a course, in order of their numbers."""
    found = [
        Exercise(checks.parent.name, checks.parent)
        for checks in (course / "exercises").glob("*/checks.py")
    ]
    return tuple(sorted(found, key=lambda one: (_read_number(one.name), one.name)))


def _read_number(name: str) -> int:
    digits = re.search(r"\d+$", name)
    return int(digits[0]) if digits else sys.maxsize


def find_exercise(asked: str, course: Path) -> Exercise:
    """Look up an exercise by a name as people type it: ``exercise4``, ``ex4`` or ``4``.

    Raises:
        BadRequest: there is none; the message lists those there are.
    """
    there = list_exercises(course)
    short = re.fullmatch(r"(?:exercise|ex|e)?[ _-]?0*(\d+)", asked.strip().lower().rstrip("/\\"))
    name = f"exercise{short[1]}" if short else asked.strip()
    for one in there:
        if one.name == name:
            return one
    import difflib  # noqa: PLC0415 - only needed for a name that is wrong

    near = difflib.get_close_matches(name.lower(), [one.name for one in there], n=1)
    listed = ", ".join(one.name for one in there) or "none yet"
    raise BadRequest(
        f"there is no exercise {asked!r}",
        advice=f"{f'Did you mean {near[0]}? ' if near else ''}There are: {listed}.",
    )
