"""Item analysis: which question was hard, which one tells learners apart, which misconception."""

import math
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from statistics import fmean, median
from typing import Any

from grader.classroom.grading import MISSING, GradedStudent
from grader.classroom.results import is_graded

MOST = 3  # wrong answers listed of one question
FEWEST = 5  # [students] below, how a question tells them apart is chance


@dataclass(frozen=True)
class ItemStatistics:
    """One question, over everybody whose answer could be graded.

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
        max_score: points there are.
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
    rows: dict[tuple[str, str], list[tuple[float, float, Mapping[str, Any]]]] = {}
    for one in students:
        graded = [record for record in one.records if is_graded(record)]
        total = sum(float(record["score"]) for record in graded)
        for record in graded:
            for check in _list_checks(record):
                key = (str(record["exercise"]), str(check["id"]))
                points = float(check["points"])
                rows.setdefault(key, []).append((points, total - points, check))
    return tuple(_analyze_item(*key, those) for key, those in rows.items())


def summarize_exercises(students: Sequence[GradedStudent]) -> tuple[ExerciseStatistics, ...]:
    """Every exercise, in the order of the course."""
    rows: dict[str, list[Mapping[str, Any]]] = {}
    for one in students:
        for record in one.records:
            rows.setdefault(str(record["exercise"]), []).append(record)
    return tuple(_summarize_exercise(name, those) for name, those in rows.items())


def count_misconceptions(students: Sequence[GradedStudent]) -> tuple[tuple[str, int], ...]:
    """Code -> how many students showed it, most frequent first."""
    return _rank_texts(
        code
        for one in students
        for code in {
            str(check["misconception"])
            for record in one.records
            for check in _list_checks(record)
            if check["misconception"]
        }
    )


def _summarize_exercise(name: str, records: Sequence[Mapping[str, Any]]) -> ExerciseStatistics:
    shares = [float(one["score"]) / float(one["max_score"]) for one in records if is_graded(one)]
    return ExerciseStatistics(
        name,
        max(float(one["max_score"]) for one in records),
        sum(one["status"] != MISSING for one in records),
        sum(one["status"] == "passed" for one in records),
        sum(one["status"] == "ungradable" for one in records),
        fmean(shares) if shares else math.nan,
        median(shares) if shares else math.nan,
    )


def _analyze_item(
    exercise: str, check: str, rows: Sequence[tuple[float, float, Mapping[str, Any]]]
) -> ItemStatistics:
    most = max(float(one["max_points"]) for _, _, one in rows)
    points = [mine for mine, _, _ in rows]
    seen = _rank_texts(str(one["seen"]) for _, _, one in rows if one["status"] == "failed")
    return ItemStatistics(
        exercise,
        check,
        str(rows[0][2]["description"]),
        len(rows),
        sum(one["status"] == "passed" for _, _, one in rows),
        fmean(points) / most if most else math.nan,
        _correlate(points, [rest for _, rest, _ in rows]),
        _rank_texts(str(one["misconception"]) for _, _, one in rows if one["misconception"]),
        tuple((text, count) for text, count in seen[:MOST] if count > 1),
    )


def _correlate(one: Sequence[float], other: Sequence[float]) -> float | None:
    """Pearson's correlation; None if it is undefined."""
    if len(one) < FEWEST:
        return None
    mean_one, mean_other = fmean(one), fmean(other)
    both = sum((a - mean_one) * (b - mean_other) for a, b in zip(one, other, strict=True))
    size = math.sqrt(
        sum((a - mean_one) ** 2 for a in one) * sum((b - mean_other) ** 2 for b in other)
    )
    return both / size if size > 1e-9 else None  # noqa: PLR2004 - all alike, but for rounding


def _list_checks(record: Mapping[str, Any]) -> Sequence[Mapping[str, Any]]:
    found: Sequence[Mapping[str, Any]] = record["checks"]
    return found


def _rank_texts(texts: Iterable[str]) -> tuple[tuple[str, int], ...]:
    found = Counter(text for text in texts if text)
    return tuple(sorted(found.items(), key=lambda one: (-one[1], one[0])))
