"""Similar answers of two students: a report to the instructor, and never a verdict.

A line that two answers share says the more, the fewer others wrote it: it counts for -log2 of the
share of the class that has it, in bits (the self-information of Shannon, 1948). Lines of the
starter do not count, nor do answers that are right for both. A copied answer in an exercise with
numbers of one's own is right for the one and wrong for the other, and counts.
"""

import hashlib
import math
import zipfile
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path

from grader.checks.check import Result
from grader.classroom.answer_files import Submission
from grader.classroom.grading import GradedStudent
from grader.exercise.exercise import Exercise
from sim.core.errors import BadRequest
from sim.support.student_names import make_folder_name

MIN_BITS = 24.0  # of what two answers share: far beyond chance in the pairs of any class
MIN_SHARE = 0.8  # of the bits of the longer one
MIN_LENGTH = 2  # [characters] of a line that says something
COMMENTS = ("#", "//", "/*", "*")


@dataclass(frozen=True)
class _Answer:
    """What one student wrote for one exercise.

    Args:
        lines: lines of code and answers, without their spaces; a log counts as one line.
        right: those of them that answer a check which was passed.
    """

    lines: frozenset[str]
    right: frozenset[str]


def find_likenesses(
    handed_in: Sequence[Submission], exercises: Sequence[Exercise], graded: Sequence[GradedStudent]
) -> tuple[str, ...]:
    """Find pairs of students whose answers share lines that few others wrote.

    Args:
        handed_in: by everybody.
        exercises: those that are graded.
        graded: their results: what is right for both may be alike.

    Returns:
        A line for each pair, with the exercises.
    """
    checks = {(one.student, grade.exercise): grade.checks for one in graded for grade in one.grades}
    found: dict[tuple[str, str], list[str]] = {}
    for exercise in exercises:
        answers = {
            one.student: _read_answer(
                one.files[exercise.name], checks.get((one.student, exercise.name), ())
            )
            for one in handed_in
            if exercise.name in one.files and not one.problem
        }
        for pair in _find_pairs(answers, starter=_list_starter_lines(exercise)):
            found.setdefault(pair, []).append(exercise.name)
    return tuple(
        f"{one} and {other}: their answers to {', '.join(names)} share lines that hardly anybody "
        "else wrote"
        for (one, other), names in sorted(found.items())
    )


def _find_pairs(
    answers: Mapping[str, _Answer], *, starter: frozenset[str]
) -> Iterator[tuple[str, str]]:
    count = Counter(line for one in answers.values() for line in one.lines)
    others = max(len(answers) - 2, 1)

    def bits(those: frozenset[str], *, writers: int) -> float:
        """[bit] self-information of lines, from the number of students who wrote them."""
        return sum(
            -math.log2((count[line] - writers + 1) / (others + 2)) for line in those - starter
        )

    for name, other_name in combinations(sorted(answers), 2):
        one, other = answers[name], answers[other_name]
        both_right = one.right & other.right
        shared = (one.lines & other.lines) - both_right
        told = bits(shared, writers=2)
        alone = max(bits(each.lines - shared - both_right, writers=1) for each in (one, other))
        if told >= MIN_BITS and told >= MIN_SHARE * (told + alone):
            yield name, other_name


def _read_answer(files: Mapping[str, bytes], checks: Sequence[Result]) -> _Answer:
    passed = {one.id for one in checks if one.status == "passed"}
    lines: set[str] = set()
    right: set[str] = set()
    for name, content in files.items():
        if b"\0" in content:
            lines.add(hashlib.sha256(content).hexdigest())
            continue
        table = ""
        for line in content.decode("utf-8", "replace").splitlines():
            plain = "".join(line.split())
            if len(plain) < MIN_LENGTH or plain.startswith(COMMENTS):
                continue
            table = plain.strip("[]") if plain.startswith("[") else table
            key = (table or plain.partition("=")[0]).casefold().replace("_", "-")
            lines.add(plain)
            if name.endswith(".toml") and any(f"{key}-".startswith(f"{one}-") for one in passed):
                right.add(plain)
    return _Answer(frozenset(lines), frozenset(right))


def _list_starter_lines(exercise: Exercise) -> frozenset[str]:
    paths = [exercise.folder / name for name in exercise.starters]
    files = {path.name: path.read_bytes() for path in paths if path.is_file()}
    return _read_answer(files, ()).lines


def find_foreign_logs(handed_in: Sequence[Submission], packages: Path) -> tuple[str, ...]:
    """Logs made for one student and handed in by another, one line each.

    Args:
        handed_in: by everybody.
        packages: the folder that ``grade release`` wrote.

    Raises:
        BadRequest: there are no packages of students.
    """
    owners = {
        digest: path.stem
        for path in sorted(packages.glob("students/*.zip"))
        for digest in _list_digests(path)
    }
    if not owners:
        raise BadRequest(
            "there are no packages of students",
            where=str(packages),
            advice="Name the folder that grade release wrote: it has a folder students.",
        )
    return tuple(
        f"{one.student}, {exercise}: {name} is a file that this class made for {owner}"
        for one in handed_in
        for exercise, files in one.files.items()
        for name, content in files.items()
        if (owner := owners.get(hashlib.sha256(content).hexdigest()))
        and owner != make_folder_name(one.numbers_owner)
    )


def _list_digests(package: Path) -> Iterator[str]:
    """The digests of the files in a package."""
    try:
        with zipfile.ZipFile(package) as archive:
            for info in archive.infolist():
                yield hashlib.sha256(archive.read(info)).hexdigest()
    except (OSError, zipfile.BadZipFile):
        raise BadRequest(
            "this package cannot be read",
            where=str(package),
            advice="Make the packages again: grade release with the same secret writes the same.",
        ) from None
