"""Item analysis: which question was hard, which one tells learners apart, which misconception."""

import math
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from statistics import correlation, fmean, median

from grader.checks.check import Result
from grader.classroom.grading import MISSING, GradedStudent
from grader.exercise.exercise import Grade

MOST = 3  # wrong answers listed of one question
FEWEST = 5  # [students] below, how a question tells them apart is chance
DECIMALS = 6  # of sums of points that are compared


@dataclass(frozen=True)
class ItemStatistics:
    """Statistics of one question over all students with a graded answer.

    Args:
        exercise, check: which.
        description: what it asks, as the learner reads it.
        tried: how many answers there are.
        full: how many earned full points.
        share: mean share of the points; NaN if nobody tried.
        discrimination: correlation of its points with those of everything else; None where it says
            nothing: too few students, or all alike.
        misconceptions: code -> how many students showed it, most frequent first.
        wrong: a wrong answer as it was given -> how often, only what occurred more than once.
    """

    exercise: str
    check: str
    description: str
    tried: int
    full: int
    share: float
    discrimination: float | None
    misconceptions: tuple[tuple[str, int], ...]
    wrong: tuple[tuple[str, int], ...]


@dataclass(frozen=True)
class ExerciseStatistics:
    """One exercise, over the class.

    Args:
        exercise: its name.
        max_score: the most points that it gives.
        handed_in: by how many.
        full: how many earned all points.
        ungradable: how many could not be graded.
        mean, median: share of the points of those that could; NaN where there is none.
    """

    exercise: str
    max_score: float
    handed_in: int
    full: int
    ungradable: int
    mean: float
    median: float


def analyze_items(students: Sequence[GradedStudent]) -> tuple[ItemStatistics, ...]:
    """Every question, in the order of the course."""
    rows: dict[tuple[str, str], list[tuple[float, Result]]] = {}
    for one in students:
        graded = [grade for grade in one.grades if grade.is_graded]
        total = sum(grade.score for grade in graded)
        for grade in graded:
            for check in grade.checks:
                key = (grade.exercise, check.id)
                rows.setdefault(key, []).append((total - check.points, check))
    return tuple(_analyze_item(*key, those) for key, those in rows.items())


def summarize_exercises(students: Sequence[GradedStudent]) -> tuple[ExerciseStatistics, ...]:
    """Every exercise, in the order of the course."""
    rows: dict[str, list[Grade]] = {}
    for one in students:
        for grade in one.grades:
            rows.setdefault(grade.exercise, []).append(grade)
    return tuple(_summarize_exercise(name, those) for name, those in rows.items())


def count_misconceptions(students: Sequence[GradedStudent]) -> tuple[tuple[str, int], ...]:
    """Code -> how many students showed it, most frequent first."""
    return _rank_texts(
        code
        for one in students
        for code in {check.misconception for grade in one.grades for check in grade.checks}
    )


def _summarize_exercise(name: str, grades: Sequence[Grade]) -> ExerciseStatistics:
    shares = [one.score / one.max_score for one in grades if one.is_graded]
    return ExerciseStatistics(
        name,
        max(one.max_score for one in grades),
        sum(one.status != MISSING for one in grades),
        sum(one.status == "passed" for one in grades),
        sum(one.status == "ungradable" for one in grades),
        fmean(shares) if shares else math.nan,
        median(shares) if shares else math.nan,
    )


def _analyze_item(
    exercise: str, check: str, rows: Sequence[tuple[float, Result]]
) -> ItemStatistics:
    """One question, from each student's points of everything else and result of this question."""
    found = [one for _, one in rows]
    most = max(one.max_points for one in found)
    points = [one.points for one in found]
    seen = _rank_texts(one.seen for one in found if one.status == "failed")
    return ItemStatistics(
        exercise,
        check,
        found[0].description,
        len(rows),
        sum(one.status == "passed" for one in found),
        fmean(points) / most if most else math.nan,
        _correlate(points, [round(rest, DECIMALS) for rest, _ in rows]),
        _rank_texts(one.misconception for one in found),
        tuple((text, count) for text, count in seen[:MOST] if count > 1),
    )


def _correlate(one: Sequence[float], other: Sequence[float]) -> float | None:
    """Pearson's correlation; None if there are too few, or all are alike."""
    told = len(one) >= FEWEST and len({*one}) > 1 and len({*other}) > 1
    return correlation(one, other) if told else None


def _rank_texts(texts: Iterable[str]) -> tuple[tuple[str, int], ...]:
    found = Counter(text for text in texts if text)
    return tuple(sorted(found.items(), key=lambda one: (-one[1], one[0])))
