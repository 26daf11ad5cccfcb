"""Problems of a program's text that are found before it runs."""

from dataclasses import dataclass


@dataclass(frozen=True)
class ParseProblem:
    """Something that Java or Python would stop at.

    Args:
        message: what it is, in words.
        line: where, from 1.
        file: the name of another file than the one in hand; empty if it is that one.
    """

    message: str
    line: int
    file: str = ""
