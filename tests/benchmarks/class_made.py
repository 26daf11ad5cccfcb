"""A class for the benchmarks: answers of many students, right, half right, mistaken and missing.

Each student's answers are made from their own numbers by the authored ways of ``solutions/``.
Exercise 12 takes its authored way seconds: one student of ten solves it, and the others hand in
what that one did, which is mistaken for their own mechanism.
"""

import shutil
from collections.abc import Mapping
from dataclasses import dataclass
from difflib import SequenceMatcher
from functools import cache
from pathlib import Path

import numpy as np

from grader.exercise.course_check import list_mistakes, solve
from grader.exercise.exercise import Exercise, find_exercise, list_exercises
from grader.student_data.variant import use_class_secret
from sim.support.student_names import make_folder_name
from sim.support.work.executor import run_jobs

ROOT = Path(__file__).resolve().parents[2]
SECRET = b"a benchmark's class that has nothing to hide"
SHARES = {"right": 0.5, "half": 0.1, "mistaken": 0.3, "missing": 0.1}
SLOW = "exercise12"
TOGETHER = 10  # [students] of whom one solves what is slow

Texts = dict[str, str]


@dataclass(frozen=True)
class Some:
    """Students whose answers are made together.

    Args:
        first: the number of the first.
        count: how many.
        course: a copy of the exercises, to draw data in.
        out: the class's folder.
    """

    first: int
    count: int
    course: Path
    out: Path


@dataclass(frozen=True)
class Made:
    """What was made: how many answers of each kind."""

    kinds: Mapping[str, int]


def asked(course: Path) -> tuple[Exercise, ...]:
    """The thirteen exercises; practice has no number, and is none of them."""
    return tuple(one for one in list_exercises(course) if one.name[-1].isdigit())


def make_class(students: int, *, course: Path, out: Path, processes: int) -> Mapping[str, int]:
    """Make a class.

    Args:
        students: how many.
        course: an empty folder to copy the exercises to.
        out: where the students' folders go.
        processes: so many make it.

    Returns:
        How many answers there are of each kind.
    """
    ignored = shutil.ignore_patterns("data", "__pycache__")
    shutil.copytree(ROOT / "exercises", course / "exercises", ignore=ignored)
    (course / "lessons").mkdir()
    jobs = [
        Some(first, min(TOGETHER, students - first), course, out)
        for first in range(0, students, TOGETHER)
    ]
    kinds = dict.fromkeys(SHARES, 0)
    for made in run_jobs(make_some, jobs, processes=processes, worth=1):
        for kind, count in made.kinds.items():
            kinds[kind] += count
    shutil.rmtree(course)
    return kinds


def make_some(job: Some) -> Made:
    """Make the answers of some students; a classmate's of exercise 12 for all but the first."""
    kinds = dict.fromkeys(SHARES, 0)
    slow: Texts = {}
    with use_class_secret(SECRET):
        for number in range(job.first, job.first + job.count):
            who, rng = f"student{number:04}", np.random.default_rng(number)
            for one in _there(job.course):
                kind = str(rng.choice(list(SHARES), p=list(SHARES.values())))
                texts = slow or _right(one, who) if one.name == SLOW else _right(one, who)
                if one.name == SLOW:
                    kind = "missing" if kind == "missing" else "mistaken" if slow else "right"
                    slow = texts
                handed = _spoiled(one, _one_language(one, texts, rng), kind, rng)
                _write(handed, job.out / who / one.name)
                kinds[kind] += 1
    return Made(kinds)


@cache
def _there(course: Path) -> tuple[Exercise, ...]:
    return asked(course)


def _right(one: Exercise, who: str) -> Texts:
    """The authored answer."""
    one.prepare(who, say=lambda _: None)
    data = one.folder / "data" / make_folder_name(who)
    texts = solve(one, data, solution=ROOT / "solutions" / one.name)
    shutil.rmtree(data, ignore_errors=True)  # not every exercise gives files
    return texts


def _one_language(one: Exercise, texts: Texts, rng: np.random.Generator) -> Texts:
    """Of the files of an exercise that may be answered in several, one; and what is beside it."""
    file = str(rng.choice(one.files))
    return {name: texts[name] for name in (file, *one.companion_files)}


def _spoiled(one: Exercise, texts: Texts, kind: str, rng: np.random.Generator) -> Texts:
    if kind == "missing":
        return {}
    if kind == "half":
        file = next(iter(texts))
        starter = (one.folder / file).read_text(encoding="utf-8")
        return {**texts, file: _half(texts[file], starter)}
    mistakes = list_mistakes(find_exercise(one.name, ROOT))
    for index in rng.permutation(len(mistakes)) if kind == "mistaken" else ():
        mistake = mistakes[index]
        if mistake.file not in texts or one.name == SLOW:
            continue
        try:
            return {**texts, mistake.file: mistake.edit_text(texts[mistake.file])}
        except ValueError:  # not every mistake can be made of everybody's numbers
            continue
    return texts


def _half(text: str, starter: str) -> str:
    """Given up halfway: of what the starter lacks, only the first half is filled in."""
    right, blank = text.splitlines(keepends=True), starter.splitlines(keepends=True)
    parts = SequenceMatcher(None, blank, right, autojunk=False).get_opcodes()
    changed = sum(tag != "equal" for tag, *_ in parts)
    lines, seen = [], 0
    for tag, start, end, first, last in parts:
        if tag == "equal":
            lines += blank[start:end]
            continue
        seen += 1
        middle = first + (last - first) // 2
        if changed == 1 and end - start == last - first:  # one block, line for line
            lines += right[first:middle] + blank[start + middle - first : end]
        else:
            lines += right[first:last] if 2 * seen <= changed else blank[start:end]
    return "".join(lines)


def _write(texts: Texts, folder: Path) -> None:
    if not texts:
        return
    folder.mkdir(parents=True)
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")
