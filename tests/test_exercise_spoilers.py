"""Nothing that a learner reads holds a right number: task, hints, own numbers and feedback."""

import re

import pytest
from places import ROOT

from grader.exercise.course_check import list_mistakes, prepare_solved
from grader.exercise.exercise import find_exercise

ANSWERS = {  # exercise -> the numbers that are right for a variant
    "exercise1": lambda variant: [variant.asked(name).expected for name in variant.moments],
    "exercise2": lambda variant: [
        variant.parts.theoretical_kv,
        variant.compute_percent_above(variant.parts.theoretical_kv),
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


@pytest.mark.parametrize("name", ANSWERS)
def test_texts_for_the_learner_contain_no_right_number(name, tmp_path):
    own = find_exercise(name, ROOT)
    solved = prepare_solved(own, "ann", tmp_path)
    files = [own.folder / "README.md", *solved.exercise.folder.glob("data/*/*.toml")]
    told = [*own.hints, *(file.read_text("utf-8") for file in files)]
    mistakes = [one for one in list_mistakes(own) if one.file == own.files[0]]
    for mistake in mistakes[:: -(-len(mistakes) // MISTAKES)]:
        changed = {mistake.file: mistake.edit_text(solved.right[mistake.file])}
        told += [check.hint for check in solved.grade(mistake.file, changed).checks]
    numbers = [abs(float(text)) for text in re.findall(r"\d+\.\d+", " ".join(told))]

    assert len(numbers) > 10
    for answer in map(abs, ANSWERS[name](own.module.draw("ann"))):
        assert [number for number in numbers if abs(number - answer) < 0.001 * answer] == []
