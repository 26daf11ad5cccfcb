"""Brackets of a Java text that do not match, and nesting that no person wrote.

The parser repairs what it can and then names a place far from the cause. A bracket that is never
closed is the commonest mistake, and counting finds it exactly.
"""

import re

from grader.robotcode.facts import Problem
from sim.errors import UnreadableFile

DEEPEST = 200  # [brackets] Python's own limit; robot code stays below 20
LONGEST_RUN = 50  # [signs] '<' in a row without a ';' or bracket: the parser's memory grows as n²
CLOSES = {"(": ")", "[": "]", "{": "}"}

_TOKEN = re.compile(
    r"//[^\n]*"
    r"|/\*(?:.*?\*/|.*)"
    r'|"""(?:\\.|[^\\])*?(?:"""|\Z)'
    r'|"(?:\\.|[^"\\\n])*"?'
    r"|'(?:\\.|[^'\\\n])*'?"
    r"|[()\[\]{}<;]",
    re.DOTALL,
)


def refuse_deep_nesting(text: str, *, where: str) -> None:
    """Refuse a text that a parser could choke on.

    Raises:
        UnreadableFile: brackets nested deeper than DEEPEST, or LONGEST_RUN type arguments.
    """
    depth = run = 0
    for match in _TOKEN.finditer(text):
        sign = match.group()
        run = run + 1 if sign == "<" else 0
        depth += (sign in CLOSES) - (sign in CLOSES.values())
        if depth > DEEPEST or run > LONGEST_RUN:
            line = text.count("\n", 0, match.start()) + 1
            raise UnreadableFile(
                f"the brackets are nested more than {DEEPEST if run == 0 else LONGEST_RUN} deep",
                where=f"{where}, line {line}",
                advice="Is this the right file? Give the source of your subsystem.",
            )


def unmatched(text: str) -> Problem | None:
    """The first bracket that has no partner, said so that it can be found."""
    opened: list[tuple[str, int]] = []
    at = line = 1
    for match in _TOKEN.finditer(text):
        sign = match.group()
        line += text.count("\n", at - 1, match.start())
        at = match.start() + 1
        if sign in CLOSES:
            opened.append((sign, line))
        elif sign in CLOSES.values():
            if not opened:
                return Problem(
                    f"this '{sign}' closes nothing: one too many, or its opening is gone", line
                )
            bracket, since = opened.pop()
            if CLOSES[bracket] != sign:
                return Problem(
                    f"a '{CLOSES[bracket]}' is missing before this '{sign}': "
                    f"the '{bracket}' of line {since} is not closed",
                    line,
                )
    if not opened:
        return None
    bracket, since = opened[-1]
    return Problem(f"a '{CLOSES[bracket]}' is missing: the '{bracket}' here is never closed", since)
