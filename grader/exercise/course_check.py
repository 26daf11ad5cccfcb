"""Whether an exercise is sound: its starter fails, its solution passes, each mistake is named.

Beside ``exercises/NAME`` is ``solutions/NAME``: the solved files, or ``solve.py`` whose function
``solve(exercise, data)`` returns file -> text from a student's own files; and ``mistakes.py`` with
``MISTAKES`` (``grader.exercise.mistake``).
"""

import fnmatch
import re
import shutil
import tempfile
import traceback
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

from grader.checks.misconception import MISCONCEPTIONS
from grader.exercise.exercise import HINTS, Exercise, Grade, load_module
from grader.exercise.mistake import LINE, Mistake
from grader.exercise.starter import remove_answers
from grader.student_data.variant import use_class_secret
from sim.support.student_names import make_folder_name

STUDENTS = ("ann", "ben", "zoë")  # between them they get every kind of mechanism of the course
FEWEST_MISTAKES = 5
SHORTEST_HINT = 40  # [characters]
LINK = re.compile(r"\]\((?!https?:|#)([^)#]+)")
NUMBER = re.compile(r"(?<![\d.])\d+\.\d+")
TELLING = 3  # digits from which on a number of the task that is a right answer is no chance


@dataclass(frozen=True)
class SolvedExercise:
    """An exercise in a folder of its own, with a student's files and the right answer.

    Args:
        exercise: the copy.
        student: whose files.
        right: file name -> text of the right answer.
    """

    exercise: Exercise
    student: str
    right: Mapping[str, str]

    def grade(self, file: str, changed: Mapping[str, str] | None = None) -> Grade:
        """Grade the right answer, or a changed copy of it.

        Args:
            file: the one of its files to grade, where the exercise takes several.
            changed: file name -> wrong text.
        """
        one = self.exercise
        file = one.files[0] if file in one.companion_files else file
        texts = {**self.right, **(changed or {})}
        for name in (file, *one.companion_files):
            (one.folder / name).write_text(texts[name], encoding="utf-8")
        return one.grade(one.folder / file, student=self.student)


@cache
def list_mistakes(one: Exercise) -> tuple[Mistake, ...]:
    """The planted mistakes of an exercise; none where its solution has none."""
    path = one.solution / "mistakes.py" if one.solution else None
    if path is None or not path.is_file():
        return ()
    return tuple(getattr(load_module(path), "MISTAKES", ()))


def solve(one: Exercise, data: Path, *, solution: Path | None = None) -> dict[str, str]:
    """File name -> text of the right answer.

    Args:
        one: the exercise, with the files to fill in.
        data: the student's own files.
        solution: the folder with the solution; None is the exercise's own.
    """
    folder = solution or one.solution
    if folder is None:
        raise FileNotFoundError(f"there is no solution of {one.name}")
    if (folder / "solve.py").is_file():
        found: dict[str, str] = load_module(folder / "solve.py").solve(one.folder, data)
        return found
    return {name: (folder / name).read_text(encoding="utf-8") for name in one.starters}


def prepare_solved(one: Exercise, student: str, folder: Path) -> SolvedExercise:
    """Copy an exercise, make a student's files in it, and solve it.

    Args:
        one: the exercise.
        student: whose files.
        folder: an empty folder for the copy.
    """
    moved = _copy_exercise(one, student, folder)
    data = moved.folder / "data" / make_folder_name(student)
    return SolvedExercise(moved, student, solve(moved, data, solution=one.solution))


def _copy_exercise(one: Exercise, student: str, folder: Path) -> Exercise:
    """A copy of an exercise, with a student's files."""
    copy = folder / "exercises" / one.name
    shutil.copytree(one.folder, copy, ignore=shutil.ignore_patterns("data", "__pycache__"))
    moved = replace(one, folder=copy)
    moved.prepare(student, say=lambda _: None)
    return moved


def list_graded_mistakes(one: Exercise, student: str) -> list[Mistake]:
    """The mistakes that are tried on a student: answers that are run take long, so one of each."""
    every = enumerate(list_mistakes(one))
    place = STUDENTS.index(student)
    return [
        mistake
        for number, mistake in every
        if (one.is_personal and mistake.file.endswith(".toml")) or number % len(STUDENTS) == place
    ]


def find_flaws(one: Exercise) -> Iterator[str]:
    """All that is wrong with an exercise, each in a sentence."""
    try:
        flaws = find_task_flaws(one)
        yield from flaws or _find_graded_flaws(one)
    except Exception as error:  # noqa: BLE001 - an author's files may break in any way
        place = traceback.extract_tb(error.__traceback__)[-1]
        yield f"{place.filename}, line {place.lineno}: {type(error).__name__}: {error}"


def _find_graded_flaws(one: Exercise) -> Iterator[str]:
    for student in STUDENTS:
        with tempfile.TemporaryDirectory() as folder:
            solved = prepare_solved(one, student, Path(folder))
            yield from find_solution_flaws(solved)
            for mistake in list_graded_mistakes(one, student):
                yield from find_mistake_flaws(solved, mistake)
    yield from find_draw_flaws(one)


def find_task_flaws(one: Exercise) -> list[str]:
    """Faults in the files that an author writes, found before anything is solved."""
    return [*_find_readme_flaws(one), *_find_check_flaws(one), *_find_starter_flaws(one)]


def _find_readme_flaws(one: Exercise) -> Iterator[str]:
    if not (one.folder / "README.md").is_file():
        yield f"README.md is missing in {one.folder}: write the task there"
        return
    readme = (one.folder / "README.md").read_text(encoding="utf-8")
    if not re.search(r"^# (?:Exercise \d+|Practice): \w", readme, re.MULTILINE):
        yield 'README.md needs a first heading such as "# Exercise 4: Wire the routine"'
    if f"grade {one.name}" not in readme:
        yield f"README.md does not say how to check the answer: write grade {one.name} in it"
    for link in LINK.findall(readme):
        if not (one.folder / link).exists():
            yield f"README.md points to {link}, which is not there"


def _find_check_flaws(one: Exercise) -> Iterator[str]:
    """Faults in hints, checks, and the mistakes that name them."""
    hints = zip(HINTS, one.hints, strict=True)
    if short := [name for name, hint in hints if len(hint) <= SHORTEST_HINT]:
        yield f"hints.toml: {', '.join(short)} needs a whole sentence"
    names = [check.id for check in one.checks]
    if not names or len({*names}) < len(names):
        yield "checks.py needs checks, each with a name of its own"
    mistakes = list_mistakes(one)
    if len(mistakes) < FEWEST_MISTAKES:
        yield f"solutions/{one.name}/mistakes.py needs at least {FEWEST_MISTAKES} mistakes"
    for mistake in mistakes:
        if not fnmatch.filter(names, mistake.check):
            yield f"the mistake {mistake.name!r} names no check of checks.py: {mistake.check!r}"
        if mistake.misconception not in {"", *MISCONCEPTIONS}:
            yield f"the mistake {mistake.name!r} names no misconception: {mistake.misconception!r}"


def _find_starter_flaws(one: Exercise) -> Iterator[str]:
    if one.solution is None:
        yield f"there is no folder solutions/{one.name} with the solution"
        return
    for name in one.starters:
        starter, solved = one.folder / name, one.solution / name
        if not starter.is_file():
            yield f"{name} is missing in {one.folder}: the file to fill in"
            return
        if solved.is_file():
            left = remove_answers(solved.read_text(encoding="utf-8"))
            if starter.read_text(encoding="utf-8") != left or "TODO" not in left:
                yield f"{name} must be its solution without the lines between --- answer and end"
    for name in one.files:
        grade = one.grade(one.folder / name, student=STUDENTS[0])
        if grade.status != "failed" or grade.score >= grade.max_score / 2:
            yield (
                f"the starter {name} is {grade.status} with {grade.score:g} of "
                f"{grade.max_score:g} points; it must be readable, and earn less than half"
            )


def find_solution_flaws(solved: SolvedExercise) -> Iterator[str]:
    """Points that the right answer does not earn, and places where the task reveals it."""
    who = f"with the files of {solved.student}"
    for name in solved.exercise.files:
        grade = solved.grade(name)
        lost = [f"{one.id} ({one.seen})" for one in grade.checks if one.status != "passed"]
        if lost or grade.status != "passed" or grade.warnings:
            why = "; ".join((*lost, *grade.warnings)) or grade.reason
            yield f"the solution {name} does not earn everything {who}: {why}"
    texts = [(solved.exercise.folder / "README.md").read_text("utf-8"), *solved.exercise.hints]
    told = {number for text in texts for number in NUMBER.findall(text)}
    for name, text in solved.right.items():
        right = (
            {found["value"] for found in LINE.finditer(text)} if name.endswith(".toml") else set()
        )
        for number in sorted(told & right):
            if len(number.replace(".", "").strip("0")) >= TELLING:
                yield f"README.md or a hint tells {number}, which is a right answer {who}"


def find_mistake_flaws(solved: SolvedExercise, mistake: Mistake) -> Iterator[str]:
    """Faults of a planted mistake, which must fail its check and be named."""
    says = f"the mistake {mistake.name!r}, with the files of {solved.student}"
    try:
        text = mistake.edit_text(solved.right[mistake.file])
    except ValueError as error:
        yield f"{says}, cannot be made: {error}"
        return
    grade = solved.grade(mistake.file, {mistake.file: text})
    named = [one for one in grade.checks if fnmatch.fnmatchcase(one.id, mistake.check)]
    result = next((one for one in named if one.status == "failed"), named[0])
    said = f"{result.seen} {result.hint}"
    if grade.status != "failed" or result.status != "failed":
        yield f"{says}, must fail {mistake.check}, but that is {result.status} ({said.strip()})"
    elif mistake.says not in said:
        yield f"{says}, must be told {mistake.says!r}, but is told {said!r}"
    elif result.misconception != mistake.misconception:
        yield (
            f"{says}, must name the misconception {mistake.misconception or 'none'}, but "
            f"names {result.misconception or 'none'}; it says {said!r}"
        )


def find_draw_flaws(one: Exercise) -> Iterator[str]:
    """Faults of a student's own files, which must be reproducible and differ between classes."""
    if not one.is_personal:
        return
    made = []
    for secret in (b"east", b"west", b"east"):
        with tempfile.TemporaryDirectory() as folder, use_class_secret(secret):
            copy = _copy_exercise(one, "ann", Path(folder))
            files = sorted((copy.folder / "data").rglob("*.*"))
            made.append({path.name: path.read_bytes() for path in files})
    if made[0] != made[2]:
        yield "the same class and student get other files each time: draw from make_student_rng"
    elif made[0] == made[1]:
        yield "all classes get the same files: draw from make_student_rng"
