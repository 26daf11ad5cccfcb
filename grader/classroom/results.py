"""The results of a class: what the overview and every export are made of."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from grader.classroom.grading import GradedStudent


@dataclass(frozen=True)
class ClassResults:
    """The results of a class.

    Args:
        name: of the class.
        students: their results, in order of their names.
        exercises: the exercises' names, in order.
        roster: student -> the row of the roster, by its header; empty without one.
        header: the roster's header.
        remarks: student, or a name that is not on the roster -> what a person has to look at
            besides what could not be graded, one line each.
    """

    name: str
    students: tuple[GradedStudent, ...]
    exercises: tuple[str, ...]
    roster: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    header: tuple[str, ...] = ()
    remarks: Mapping[str, Sequence[str]] = field(default_factory=dict)

    @property
    def max_scores(self) -> dict[str, float]:
        """Exercise -> points there are."""
        found = dict.fromkeys(self.exercises, 0.0)
        for one in self.students:
            for record in one.records:
                most: Any = record["max_score"]
                found[str(record["exercise"])] = float(most)
        return found


def collect_scores(one: GradedStudent) -> dict[str, float]:
    """Exercise -> points of one student."""
    found = {}
    for record in one.records:
        points: Any = record["score"]
        found[str(record["exercise"])] = float(points)
    return found


def find_status(one: GradedStudent) -> dict[str, str]:
    """Exercise -> passed, failed, missing or ungradable."""
    return {str(record["exercise"]): str(record["status"]) for record in one.records}


def is_fully_graded(one: GradedStudent, results: ClassResults) -> bool:
    """Whether everything that a student handed in was graded, so that the total counts."""
    return one.student not in results.remarks and "ungradable" not in find_status(one).values()
