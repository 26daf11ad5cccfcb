"""What is alike in the answers of two students: told to the instructor, and never a verdict.

A line that two answers share says the more, the fewer others wrote it: it counts for -log2 of the
share of the class that has it, in bits (the self-information of Shannon, 1948). Lines of the
starter, and right answers that most students give, therefore count for next to nothing.
"""

import hashlib
import math
import zipfile
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations
from pathlib import Path

from grader.classroom.submissions import Submission
from grader.exercise import Exercise
from grader.variant import make_folder_name
from sim.core.errors import BadRequest

MIN_BITS = 24.0  # of what two answers share: one pair of 4,000 in ten classes would have 2^-12
MIN_SHARE = 0.8  # of the bits of the longer one
COMMENTS = ("#", "//", "/*", "*")


def find_likenesses(
    handed_in: Sequence[Submission], exercises: Sequence[Exercise]
) -> tuple[str, ...]:
    """Pairs of students whose answers to an exercise share what hardly anybody else wrote.

    Args:
        handed_in: by everybody.
        exercises: those that are graded.

    Returns:
        A line for each pair, with the exercises.
    """
    found: dict[tuple[str, str], list[str]] = {}
    for exercise in exercises:
        lines = {
            one.student: _list_lines(one.files[exercise.name])
            for one in handed_in
            if exercise.name in one.files and not one.problem
        }
        for pair in _find_pairs(lines, starter=_list_starter_lines(exercise)):
            found.setdefault(pair, []).append(exercise.name)
    return tuple(
        f"{one} and {other}: their answers to {', '.join(names)} share lines that hardly anybody "
        "else wrote"
        for (one, other), names in sorted(found.items())
    )


def _find_pairs(
    lines: Mapping[str, frozenset[str]], *, starter: frozenset[str]
) -> Iterator[tuple[str, str]]:
    count = Counter(line for those in lines.values() for line in those)
    others = max(len(lines) - 2, 1)

    def bits(those: frozenset[str], *, writers: int) -> float:
        """The self-information of lines, by how many others wrote them; two if nobody did."""
        return sum(
            -math.log2((count[line] - writers + 1) / (others + 2)) for line in those - starter
        )

    for one, other in combinations(sorted(lines), 2):
        shared = lines[one] & lines[other]
        told = bits(shared, writers=2)
        alone = max(bits(lines[one] - shared, writers=1), bits(lines[other] - shared, writers=1))
        if told >= MIN_BITS and told >= MIN_SHARE * (told + alone):
            yield one, other


def _list_lines(files: Mapping[str, bytes]) -> frozenset[str]:
    """The lines of code and answers, without their spaces; a log counts as one line."""
    found = set()
    for content in files.values():
        if b"\0" in content:
            found.add(hashlib.sha256(content).hexdigest())
            continue
        for line in content.decode("utf-8", "replace").splitlines():
            plain = "".join(line.split())
            if len(plain) > 1 and not plain.startswith(COMMENTS):
                found.add(plain)
    return frozenset(found)


def _list_starter_lines(exercise: Exercise) -> frozenset[str]:
    names = (*exercise.files, *exercise.companion_files)
    paths = [exercise.folder / name for name in names]
    return _list_lines({path.name: path.read_bytes() for path in paths if path.is_file()})


def find_foreign_logs(handed_in: Sequence[Submission], packages: Path) -> tuple[str, ...]:
    """Logs that a class made for one student and another handed in, one line each.

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
    """The digests of what a package holds."""
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
