"""Mutation operators as text rules: a pattern, what replaces one of its matches, and a name."""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass

Replacement = str | Callable[[re.Match[str]], str]
Change = tuple[int, str]  # the first changed line, from 1, and the whole changed text


@dataclass(frozen=True)
class Rule:
    """One kind of mistake: every match of a pattern is replaced once, one at a time.

    Args:
        operator: the name of the mistake.
        pattern: a regular expression; matches in comments do not count unless ``comments``.
        new: what replaces a match, as ``re.Match.expand`` reads it, or a function that makes it.
        comments: whether comments are what is mutated.
    """

    operator: str
    pattern: str
    new: Replacement
    comments: bool = False


def changes(rule: Rule, text: str, *, comment: re.Pattern[str]) -> Iterator[Change]:
    """Every text that one use of a rule makes of another text."""
    said = [(found.start(), found.end()) for found in comment.finditer(text)]
    for match in re.finditer(rule.pattern, text, re.MULTILINE):
        inside = any(start <= match.start() < end for start, end in said)
        if inside is not rule.comments:
            continue
        new = match.expand(rule.new) if isinstance(rule.new, str) else rule.new(match)
        changed = text[: match.start()] + new + text[match.end() :]
        if changed != text:
            yield text.count("\n", 0, match.start()) + 1, changed


def all_changes(
    rules: tuple[Rule, ...], text: str, *, comment: re.Pattern[str]
) -> Iterator[tuple[str, int, str]]:
    """Operator, line and text of every mutant of a text, each text once."""
    seen = {text}
    for rule in rules:
        for line, changed in changes(rule, text, comment=comment):
            if changed not in seen:
                seen.add(changed)
                yield rule.operator, line, changed


def either(one: str, other: str) -> Callable[[re.Match[str]], str]:
    """Replace each of two words by the other."""
    return lambda match: match[0].replace(one, "\0").replace(other, one).replace("\0", other)


def without_a_letter(match: re.Match[str]) -> str:
    """A misspelled word: its third letter from the end is missing."""
    return match[0][:-3] + match[0][-2:]


def times(factor: float) -> Callable[[re.Match[str]], str]:
    """Multiply a number."""
    return lambda match: f"{float(match[0]) * factor:.8g}"


NUMBER = r"(?<![\w.])\d+(?:\.\d+)?(?![\w.])"
COMMON = (
    Rule("on-true", r"whileTrue", "onTrue"),
    Rule("toggle", r"whileTrue", "toggleOnTrue"),
    Rule("while-false", r"whileTrue", "whileFalse"),
    Rule("on-false", r"whileTrue", "onFalse"),
    Rule("other-direction", r"kForward|kReverse", either("kForward", "kReverse")),
    Rule("wrong-comment", r"kS and kV", "kA", comments=True),
    Rule("wrong-comment", r"\bkA\b", "kV", comments=True),
    Rule("drop-seconds", r" / 60(?:\.0)?", ""),
    Rule("times-seconds", r" / 60(?:\.0)?", " * 60.0"),
    Rule("flip-sign", r"(?<=setVoltage\()(?=\w)", "-"),
    Rule("other-constant", NUMBER, times(2.0)),
    Rule("other-constant", NUMBER, times(0.5)),
    Rule("other-constant", NUMBER, times(10.0)),
    Rule("other-constant", NUMBER, times(1 / 12)),
    Rule("zero-constant", NUMBER, "0"),
    Rule("negative-constant", NUMBER, r"-\g<0>"),
    Rule("swap-arguments", r"(\w+Constants\.k\w), (\w+Constants\.k\w)", r"\2, \1"),
    Rule("other-gain", r"(?<=Constants\.)k[SVAG](?=[,)])", "kS"),
    Rule("other-gain", r"(?<=Constants\.)k[SVAG](?=[,)])", "kV"),
    Rule("other-gain", r"(?<=Constants\.)k[SVAG](?=[,)])", "kP"),
    Rule("drop-argument", r", \w+Constants\.k\w(?=\))", ""),
    Rule("drop-converted", r" \* CONVERSION", ""),
    Rule("double-converted", r" \* CONVERSION", r"\g<0>\g<0>"),
    Rule("invert-converted", r" \* CONVERSION", " / CONVERSION"),
    Rule("duty-gain", r"(?<== )\d[\d.e-]*(?= \* CONVERSION)", r"\g<0> / 12"),
    Rule("misspell-class", r"\bSysIdRoutine\b", "SysidRoutine"),
    Rule("misspell-method", r"(?<=\.)[a-z]\w{6,}(?=\()", without_a_letter),
)  # fmt: skip
"""Mistakes that look alike in Java and in Python."""
