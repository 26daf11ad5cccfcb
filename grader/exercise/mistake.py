"""A planted mistake: a wrong answer made from the right one, and the feedback it must get.

They stand in ``solutions/exerciseN/mistakes.py`` as ``MISTAKES``. A check without a mistake that
it catches has no teeth.
"""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass

LINE = re.compile(r"^(?P<name>\w+) = (?P<value>[-+\d.e]+)", re.MULTILINE)  # of an answers.toml
Numbers = Mapping[str, float]


@dataclass(frozen=True)
class Mistake:
    """One wrong answer.

    Args:
        name: what the learner did, in words.
        file: the solution's file it is made from.
        edit_text: the right text -> the wrong text.
        check: id of the check that has to fail; ``*`` stands for what depends on the student.
        says: part of the feedback to the learner.
        misconception: its code, or empty.
    """

    name: str
    file: str
    edit_text: Callable[[str], str]
    check: str
    says: str
    misconception: str = ""


def replace_text(*changes: tuple[str, str]) -> Callable[[str], str]:
    """Make a wrong text by replacing parts of the right one, each everywhere it stands."""

    def edit_text(text: str) -> str:
        for old, new in changes:
            if old not in text:
                raise ValueError(f"the solution no longer contains {old!r}")
            text = text.replace(old, new)
        return text

    return edit_text


def change_numbers(change: Callable[[Numbers], Numbers]) -> Callable[[str], str]:
    """Make a wrong text by changing some of the numbers in the right answers.toml."""

    def edit_text(text: str) -> str:
        right = {found["name"]: float(found["value"]) for found in LINE.finditer(text)}
        wrong = {**right, **change(right)}
        if wrong == right:
            raise ValueError("the solution has none of the numbers to change")
        return LINE.sub(lambda found: f"{found['name']} = {wrong[found['name']]:.6g}", text)

    return edit_text


def change_number(name: str, change: Callable[[Numbers], float]) -> Callable[[str], str]:
    """Make a wrong text by changing one number, which may depend on all of them."""
    return change_numbers(lambda right: {name: change(right)})


def scale_numbers(factor: float, *names: str) -> Callable[[str], str]:
    """Make a wrong text by multiplying some of the numbers."""
    return change_numbers(lambda right: {name: right[name] * factor for name in names})


def exchange_numbers(one: str, other: str) -> Callable[[str], str]:
    """Make a wrong text by exchanging two numbers."""
    return change_numbers(lambda right: {one: right[other], other: right[one]})


def make_wrong_answer(name: str, value: str) -> Callable[[str], str]:
    """Make a wrong answer by changing the value of one line of answers.toml."""

    def edit_text(text: str) -> str:
        line = re.compile(rf"^{re.escape(name)} = .*$", re.MULTILINE)
        if not line.search(text):
            raise ValueError(f"the solution has no {name}")
        return line.sub(lambda _: f"{name} = {value}", text, count=1)

    return edit_text
