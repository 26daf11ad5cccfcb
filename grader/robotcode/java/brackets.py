"""Brackets of a Java text that do not match, and nesting that no person wrote.

The parser repairs what it can and then names a place far from the cause. A bracket that is never
closed is the commonest mistake, and counting finds it exactly.
"""

import re

from grader.robotcode.facts import Problem
from sim.errors import UnreadableFile

# The parser's memory grows with the square of how deep it is, or of how much it cannot make out.
DEEPEST = 100  # [brackets] robot code stays below 20
MOST_ANGLES = 50  # ['<' without its '>'] in one statement
LONGEST = 2_000  # [words and signs] without a comma, a semicolon or a brace
CLOSES = {"(": ")", "[": "]", "{": "}"}

_TOKEN = re.compile(
    r"(?P<comment>//[^\n]*|/\*(?:.*?\*/|.*))"
    r'|"""(?:\\.|[^\\])*?(?:"""|\Z)'
    r'|"(?:\\.|[^"\\\n])*"?'
    r"|'(?:\\.|[^'\\\n])*'?"
    r"|->|\w+|[^\s\w]",
    re.DOTALL,
)
_LOOP = re.compile(r"\b(for|try)\s*$")  # their round brackets hold semicolons


def refuse_garbage(text: str, *, where: str) -> None:
    """Refuse a text that the parser would choke on.

    Raises:
        UnreadableFile: nested too deep, or a statement too long, for any person's code.
    """
    opened: list[str] = []
    angles = words = 0
    for match in _TOKEN.finditer(text):
        sign = match.group()
        if match["comment"]:
            continue
        words = 0 if sign in ",;{}" else words + 1
        angles = 0 if sign in ";{}" else max(angles + (sign == "<") - (sign == ">"), 0)
        if sign in CLOSES:
            opened.append(CLOSES[sign])
        elif opened and opened[-1] == sign:
            opened.pop()
        if len(opened) > DEEPEST or angles > MOST_ANGLES or words > LONGEST:
            line = text.count("\n", 0, match.start()) + 1
            raise UnreadableFile(
                f"a statement of more than {LONGEST} words and signs"
                if words > LONGEST
                else "the brackets are nested deeper than in any robot code",
                where=f"{where}, line {line}",
                advice="Is this the right file? Give the source of your subsystem.",
            )


def unmatched(text: str) -> Problem | None:
    """The first bracket that has no partner, said so that it can be found."""
    opened: list[tuple[str, int, bool]] = []  # the sign, its line, whether it holds statements
    line, at = 1, 0
    for match in _TOKEN.finditer(text):
        sign = match.group()
        if match["comment"]:
            continue
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
