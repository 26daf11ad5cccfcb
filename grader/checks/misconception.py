"""Misconceptions that the examiner can name: a code for statistics, and a correction."""

from dataclasses import dataclass
from pathlib import Path

from grader.checks.texts import read_texts


@dataclass(frozen=True)
class Misconception:
    """A wrong idea.

    Args:
        says: the sentence that puts it right.
        lesson: the name of the lesson's file that shows it, without its ending.
        section: a heading in that lesson, without its number.
    """

    says: str
    lesson: str
    section: str

    @property
    def reference(self) -> str:
        """Where to read on: ``lesson 3, "Why reverse? Three reasons"``."""
        return f'lesson {int(self.lesson.partition("_")[0])}, "{self.section}"'


MISCONCEPTIONS = {
    code: Misconception(**one)
    for code, one in read_texts(Path(__file__).with_name("misconceptions.toml")).items()
}
