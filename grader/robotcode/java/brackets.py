"""Brackets of a Java text that do not match, and nesting that no person wrote.

The parser repairs what it can and then names a place far from the cause. A bracket that is never
closed is the commonest mistake, and counting finds it exactly.
"""

import re

from grader.robotcode.facts import Problem
from sim.errors import UnreadableFile

DEEPEST = 100  # [brackets] robot code stays below 20
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

_LOOP = re.compile(r"\b(for|try)\s*$")  # their round brackets hold semicolons


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
    opened: list[tuple[str, int, bool]] = []  # the sign, its line, whether it holds statements
    line, at = 1, 0
    for match in _TOKEN.finditer(text):
        sign = match.group()
        line, at = line + text.count("\n", at, match.start()), match.start()
        if sign in CLOSES:
            loop = _LOOP.search(text, max(at - 12, 0), at)
            opened.append((sign, line, sign == "{" or loop is not None))
        elif sign in CLOSES.values() and not opened:
            return Problem(f"this '{sign}' closes nothing; it is one too many", line)
        elif sign in CLOSES.values() and CLOSES[opened[-1][0]] == sign:
            opened.pop()
        elif sign in CLOSES.values() and opened[-1][0] == "{":
            return Problem(
                f"this '{sign}' closes nothing: it is one too many, or a '}}' is missing before it",
                line,
            )
        elif sign in CLOSES.values() or (sign == ";" and opened and not opened[-1][2]):
            bracket, since, _ = opened[-1]
            return Problem(
                f"a '{CLOSES[bracket]}' is missing before this '{sign}': "
                f"count the brackets from line {since} on",
                line,
            )
    if not opened:
        return None
    bracket, since, _ = opened[-1]
    return Problem(f"a '{CLOSES[bracket]}' is missing: the '{bracket}' here is never closed", since)
