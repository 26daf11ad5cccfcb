"""The results of a class, from which the overview and every export are made."""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from grader.classroom.answer_files import Submission
from grader.classroom.grading import MISSING, NOTHING, GradedStudent, skip_student
from grader.classroom.roster import Roster
from grader.exercise.exercise import Exercise
from sim.support.printable import list_first
from sim.support.student_names import normalize_name


@dataclass(frozen=True)
class ClassResults:
    """The results of a class.

    Args:
        name: of the class.
        students: their results, in order of their names.
        exercises: the exercises' names, in order.
        roster: student -> the row of the roster, by its header; empty without one.
        remarks: student, or a name that is not on the roster -> what a person has to look at
            besides what could not be graded, one line each.
        late: student -> what the platform or the roster says of a late submission.
        numbers: whose numbers everybody was graded on, one sentence.
        likenesses: what is alike in the answers of two students, one line each.
    """

    name: str
    students: tuple[GradedStudent, ...]
    exercises: tuple[str, ...]
    roster: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    remarks: Mapping[str, Sequence[str]] = field(default_factory=dict)
    late: Mapping[str, str] = field(default_factory=dict)
    numbers: str = ""
    likenesses: tuple[str, ...] = ()

    @property
    def max_scores(self) -> dict[str, float]:
        """Exercise -> the most points that it gives."""
        found = dict.fromkeys(self.exercises, 0.0)
        for one in self.students:
            found |= {grade.exercise: grade.max_score for grade in one.grades}
        return found


def collect_scores(one: GradedStudent) -> dict[str, float]:
    """Exercise -> points of one student, of the exercises of which an answer was graded."""
    return {grade.exercise: grade.score for grade in one.grades if grade.is_graded}


def find_status(one: GradedStudent) -> dict[str, str]:
    """Exercise -> passed, failed, missing or ungradable."""
    return {grade.exercise: grade.status for grade in one.grades}


def find_total(one: GradedStudent, results: ClassResults) -> float | None:
    """The points of one student; None if something was handed in and not graded, or nothing was.

    What was not handed in counts as nothing in it. A mark that rests on no graded answer, or on
    only a part of what was handed in, would be a wrong one.
    """
    scores = collect_scores(one)
    return sum(scores.values()) if scores and not list_ungraded(one, results) else None


def list_ungraded(one: GradedStudent, results: ClassResults) -> list[str]:
    """Submissions of a student that were not graded: exercises, and other files."""
    found = [name for name, how in find_status(one).items() if how == "ungradable"]
    return [*found, *(["unused files"] if one.student in results.remarks else [])]


def collect_results(
    title: str,
    graded: Sequence[GradedStudent],
    known: Roster,
    *,
    asked: Sequence[Exercise],
    handed_in: Sequence[Submission],
) -> ClassResults:
    """The results of all students, absent ones on the roster included.

    Who handed nothing in and belongs to a group on the roster gets the results of the one in the
    group who did.

    Args:
        title: name of the class.
        graded: the results of everybody who handed something in.
        known: the roster.
        asked: the exercises.
        handed_in: what was handed in.
    """
    rows = known.rows
    strangers = {one.student for one in handed_in if one.problem and one.student not in rows}
    strangers = strangers if rows else set()
    found = {normalize_name(one.student): one for one in graded if one.student not in strangers}
    remarks: dict[str, list[str]] = defaultdict(list)
    for one in handed_in:
        if one.student in strangers:
            remarks[one.student].append(one.problem)
        elif not one.problem:
            remarks[one.student] += one.unused
        for student in one.likely:
            maybe = f"perhaps {one.place.name} is their answer; it was not graded"
            remarks[student].append(maybe)
    present = dict(found)
    for student in rows:
        if normalize_name(student) not in present:
            own, said = _grade_absent(student, present, known, asked)
            found[normalize_name(student)] = own
            remarks[student] += said
    late = {one.student: "late" for one in handed_in if one.late}
    late |= known.late
    return ClassResults(
        title,
        tuple(sorted(found.values(), key=lambda one: one.student.casefold())),
        tuple(one.name for one in asked),
        rows,
        {name: lines for name, lines in remarks.items() if lines},
        late,
    )


def _grade_absent(
    student: str, found: Mapping[str, GradedStudent], known: Roster, asked: Sequence[Exercise]
) -> tuple[GradedStudent, list[str]]:
    """The results of a student without a submission: those of the partner, if there is one."""
    partners = known.partners.get(student, ())
    theirs = [found[key] for one in partners if (key := normalize_name(one)) in found]
    if len(theirs) == 1:
        return replace(theirs[0], student=student), []
    names = list_first([one.student for one in theirs], most=len(theirs), separator="; ")
    said = f"they handed nothing in, but several of their group did: {names}"
    nothing = skip_student(student, asked, status=MISSING, reason=NOTHING)
    return nothing, [said] if theirs else []


def has_handed_in(one: GradedStudent) -> bool:
    """Whether there is anything of a student."""
    return set(find_status(one).values()) != {MISSING}
