"""Nothing that a learner reads holds a right number: task, hints, own numbers and feedback."""

import re
import shutil
from pathlib import Path

import pytest

from grader.course_check import list_mistakes, solve
from grader.exercise import Exercise

ROOT = Path(__file__).resolve().parents[1]
ANSWERS = {  # exercise -> the numbers that are right for a variant
    "exercise1": lambda variant: [variant.asked(name).expected for name in variant.moments],
    "exercise2": lambda variant: [
        variant.parts.theoretical_kv,
        variant.percent(variant.parts.theoretical_kv),
    ],
    "exercise3": lambda variant: [
        *(one.expected for name, one in variant.asked.items() if name.endswith("kG")),
        variant.offset.expected,
    ],
    "exercise8": lambda variant: [one.expected for one in variant.asked.values()],
    "exercise9": lambda variant: [one.expected for one in variant.asked.values()],
    "exercise10": lambda variant: [variant.needed(gain) for gain in ("kV", "kA", "kP")],
    "exercise13": lambda variant: [one.expected for one in variant.asked.values()],
}
MISTAKES = 12  # of an exercise's planted ones; an answer that is run takes a second


@pytest.fixture(params=ANSWERS)
def one(request, tmp_path):
    """A copy of the exercise in a course of its own."""
    folder = tmp_path / "exercises" / request.param
    ignored = shutil.ignore_patterns("data", "__pycache__")
    shutil.copytree(ROOT / "exercises" / request.param, folder, ignore=ignored)
    return Exercise(request.param, folder)


def test_no_right_number_is_told(one):
    one.prepare("ann", say=lambda _: None)
    (data,) = (one.folder / "data").iterdir()
    right = solve(one, data, solution=ROOT / "solutions" / one.name)
    mistakes = [
        mistake
        for mistake in list_mistakes(Exercise(one.name, ROOT / "exercises" / one.name))
        if mistake.file == one.files[0]
    ]
    told = [*one.hints, *(file.read_text("utf-8") for file in data.glob("*.toml"))]
    for mistake in mistakes[:: -(-len(mistakes) // MISTAKES)]:
        for name in right:
            text = mistake.edit_text(right[name]) if name == mistake.file else right[name]
            (one.folder / name).write_text(text, "utf-8")
        told += [check.hint for check in one.grade(None, student="ann").checks]
    told += [(one.folder / "README.md").read_text("utf-8")]
    numbers = [abs(float(text)) for text in re.findall(r"\d+\.\d+", " ".join(told))]

    assert len(numbers) > 10
    for answer in map(abs, ANSWERS[one.name](one.module.draw("ann"))):
        assert [number for number in numbers if abs(number - answer) < 0.001 * answer] == []
