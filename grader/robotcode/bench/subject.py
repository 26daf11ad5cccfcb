"""A program on the bench, in either language."""

import enum
from collections.abc import Callable
from typing import Any

from grader.robotcode.comments import find_comments_near, list_comments
from grader.robotcode.library.base import Unknown
from grader.robotcode.library.world import WORLD


class Subject:
    """A program, and its class that is tested.

    A language adds: ``start``, which makes the class; ``explain``, how an error ended the program;
    ``refill``, the steps of one more loop; ``describe``, what is known of its text; the routines
    and factories that it finds; ``find_statement`` and ``owner_at``, where a line belongs.
    """

    language = ""
    name = ""
    text = ""  # of the file in hand
    instance: Any = None

    def find_statement(self, line: int) -> tuple[int, int] | None:
        """The first and the last line of the statement that a line is in; None if in none."""
        raise NotImplementedError

    def text_at(self, line: int) -> str:
        """The code on a line."""
        lines = self.text.split("\n")
        return lines[line - 1].strip() if 0 < line <= len(lines) else ""

    def comment_at(self, line: int) -> str:
        """The comments on a line and above it, or else on its whole statement."""
        comments = list_comments(self.text, self.language)
        near = find_comments_near(comments, line, line)
        whole = self.find_statement(line)
        return near if near or whole is None else find_comments_near(comments, *whole)


def list_made(kind: str, make: Callable[[], Any]) -> list[Any]:
    """The ``routines`` or ``tests`` that something makes."""
    made: list[Any] = getattr(WORLD, kind)
    before = len(made)
    make()
    return made[before:]


def list_choices(kind: Any) -> list[Any]:
    """The possible arguments of a factory's parameter: constants of an enum, or true and false."""
    if isinstance(kind, type) and issubclass(kind, enum.Enum):
        return list(kind)
    return [True, False] if kind is bool else []


def make_library_object(cls: Any) -> Any:
    """An object of a library's class, which may want a number of its own."""
    for args in ((), (1,), (len(WORLD.devices) + 1,)):
        try:
            return cls(*args)
        except (TypeError, ValueError):
            continue
    return Unknown(getattr(cls, "__name__", "a value"))
