"""Brackets of a Java text that do not match, and nesting that no person wrote.

The parser repairs what it can and then names a place far from the cause. A bracket that is never
closed is the commonest mistake, and counting finds it exactly.
"""

import re

from grader.robotcode.comments import JAVA_TOKEN
from grader.robotcode.problems import ParseProblem
from sim.core.errors import UnreadableFile

# The parser's memory grows with the square of how deep it is, or of how much it cannot make out.
DEEPEST = 100  # [brackets] robot code stays below 20
MOST_ANGLES = 50  # ['<' without its '>'] in one statement
LONGEST = 2_000  # [words and signs] without a comma, a semicolon or a brace
CLOSES = {"(": ")", "[": "]", "{": "}"}

_Opened = tuple[str, int, bool]  # the sign, its line, whether it holds statements
_LOOP = re.compile(r"\b(for|try)\s*$")  # their round brackets hold semicolons


def refuse_garbage(text: str, *, where: str) -> None:
    """Refuse a text that the parser would choke on.

    Raises:
        UnreadableFile: nested too deep, or a statement too long, for any person's code.
    """
    opened: list[str] = []
    angles = words = 0
    for match in JAVA_TOKEN.finditer(text):
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


def find_unmatched(text: str) -> ParseProblem | None:
    """The first bracket, quote or comment that has no partner, said so that it can be found."""
    opened: list[_Opened] = []
    line, at = 1, 0
    for match in JAVA_TOKEN.finditer(text):
        line, at = line + text.count("\n", at, match.start()), match.start()
        problem = _find_endless_literal(match, line)
        if problem is None and not match["comment"]:
            sign = match.group()
            if sign in CLOSES:
                loop = _LOOP.search(text, max(at - 12, 0), at)
                opened.append((sign, line, sign == "{" or loop is not None))
            else:
                problem = _check_closing_bracket(sign, opened, line)
        if problem is not None:
            return problem
    if not opened:
        return None
    bracket, since, _ = opened[-1]
    return ParseProblem(
        f"a '{CLOSES[bracket]}' is missing: the '{bracket}' here is never closed", since
    )


def _find_endless_literal(match: re.Match[str], line: int) -> ParseProblem | None:
    """The error of a string or a comment without its end; None if it ends."""
    sign = match.group()
    if match["quoted"] and not match["end"]:
        return ParseProblem("the text in quotes that begins here has no closing '\"'", line)
    if sign.startswith("/*") and (not sign.endswith("*/") or len(sign) < len("/**/")):
        return ParseProblem("the comment that begins here is never closed: a '*/' is missing", line)
    return None


def _check_closing_bracket(sign: str, opened: list[_Opened], line: int) -> ParseProblem | None:
    """Take the bracket away that a sign closes, or say why it cannot close one."""
    closing = sign in CLOSES.values()
    if closing and not opened:
        return ParseProblem(f"this '{sign}' closes nothing; it is one too many", line)
    if not opened or not (closing or (sign == ";" and not opened[-1][2])):
        return None
    bracket, since, _ = opened[-1]
    if CLOSES[bracket] == sign:
        opened.pop()
        return None
    if bracket == "{":
        return ParseProblem(
            f"this '{sign}' closes nothing: it is one too many, or a '}}' is missing before it",
            line,
        )
    return ParseProblem(
        f"a '{CLOSES[bracket]}' is missing before this '{sign}': "
        f"count the brackets from line {since} on",
        line,
    )
