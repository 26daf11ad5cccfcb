"""Misconceptions the examiner can name: a code for statistics, and what puts it right."""

import tomllib
from dataclasses import dataclass
from pathlib import Path


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


def _read_misconceptions() -> dict[str, Misconception]:
    text = Path(__file__).with_name("misconceptions.toml").read_text(encoding="utf-8")
    found = tomllib.loads(text).items()
    return {
        code: Misconception(**one | {"says": " ".join(one["says"].split())}) for code, one in found
    }


MISCONCEPTIONS = _read_misconceptions()
