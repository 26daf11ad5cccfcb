"""Authored answers and further right ones: what is mutated, and how a mutant is graded."""

import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from places import ROOT

from grader.checks.check import Status
from grader.exercise.course_check import prepare_solved
from grader.exercise.exercise import Exercise, Grade
from mutation.mutant import Mutant
from sim.core.errors import Refusal

BASES = Path(__file__).parent / "bases"
STUDENT = "ann"
GENERIC = ("something is wrong", "try again", "look at the answer again")


@dataclass(frozen=True)
class Verdict:
    """What became of a mutant.

    Args:
        killed: whether it lost points and its author is told why.
        score: the points it earned.
        said: what its author is told first, or why it is a survivor.
    """

    killed: bool
    score: float
    said: str


@cache
def exercise(name: str) -> Exercise:
    """An exercise of the course."""
    return Exercise(name, ROOT / "exercises" / name)


@cache
def answer(name: str) -> Mapping[str, str]:
    """The authored answer to an exercise: file name and text."""
    with tempfile.TemporaryDirectory() as place:
        return prepare_solved(exercise(name), STUDENT, Path(place)).right


def graded(name: str, file: str, text: str, folder: Path) -> Grade:
    """Grade an answer of which one file has another text.

    Raises:
        Refusal: it cannot be read.
    """
    one = exercise(name)
    first = one.files[0] if file in one.companion_files else file
    for part, right in answer(name).items():
        if part == first or part in one.companion_files:
            (folder / part).write_text(right, encoding="utf-8")
    (folder / file).write_text(text, encoding="utf-8")
    return one.grade(folder / first, student=STUDENT)


def judge(mutant: Mutant, folder: Path) -> Verdict:
    """Grade a mutant: it is killed by a loss of points with advice of its own."""
    file = Path(mutant.file).name
    try:
        grade = graded(mutant.exercise, file, mutant.text, folder)
    except Refusal as refusal:
        return Verdict(bool(refusal.advice), 0.0, str(refusal))
    if grade.status == "ungradable" and not grade.is_readable:
        return Verdict(killed=bool(grade.reason), score=0.0, said=grade.reason)
    failed = [one for one in grade.checks if one.status is Status.FAILED]
    broken = [one for one in grade.checks if one.status is Status.ERROR]
    if broken:
        return Verdict(killed=False, score=grade.score, said=f"broken: {broken[0].seen}")
    if grade.score >= grade.max_score:
        return Verdict(killed=False, score=grade.score, said="full marks")
    for one in failed:
        if one.hint.strip() and one.hint.strip().lower() not in GENERIC:
            said = f"{one.id}: {one.seen} | {one.hint}"
            return Verdict(killed=True, score=grade.score, said=said)
    return Verdict(killed=False, score=grade.score, said="it lost points without a word")
