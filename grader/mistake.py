"""A mistake: a wrong answer made from the right one, and what the examiner must say about it.

They stand in ``solutions/exerciseN/mistakes.py`` as ``MISTAKES``. A check without a mistake that
it catches has no teeth.
"""

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Mistake:
    """One wrong answer.

    Args:
        name: what the learner did, in words.
        file: the solution's file it is made from.
        make: the right text -> the wrong text.
        check: id of the check that has to fail.
        says: part of what the learner is told.
        misconception: its code, or empty.
    """

    name: str
    file: str
    make: Callable[[str], str]
    check: str
    says: str
    misconception: str = ""


def replacing(*changes: tuple[str, str]) -> Callable[[str], str]:
    """Make a wrong text by replacing parts of the right one, each everywhere it stands."""

    def make(text: str) -> str:
        for old, new in changes:
            if old not in text:
                raise ValueError(f"the solution no longer contains {old!r}")
            text = text.replace(old, new)
        return text

    return make
