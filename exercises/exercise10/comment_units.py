"""Units in comments and in names: ``V·s/rad``, ``volts for 1 m/s``, ``kVVoltSecondsPerMeter``."""

import math
import re
from collections.abc import Iterator

from grader.answers.quantity import NotAUnitError, Quantity, read_unit

MOST_WORDS = 6  # of one unit: volts times seconds squared per meter
_PER = re.compile(r"\b(for|per|each|every)\b(\s+(an?|the|each|every|one|1)\b)*(?=\s+[a-z°])")
_OF = re.compile(r"\b(an?\s+)?(velocity|speed|acceleration|change|error)\s+of(\s+1\b)?")


def find_commented_units(comment: str, name: str = "") -> Iterator[Quantity]:
    """Every unit that a comment, or a name, can be read to tell."""
    text = _OF.sub("", comment.lower())
    text = re.sub(r"\s+", " ", _PER.sub("per", text))
    words = text.split()
    for start in range(len(words)):
        for end in range(start + 1, min(start + MOST_WORDS, len(words)) + 1):
            yield from _read_units(" ".join(words[start:end]))
    camel = re.findall(r"[A-Z][a-z]+", re.sub(r"^k_?[A-Za-z](?=[A-Z])", "", name))
    yield from _read_units(" ".join(camel))


def _read_units(text: str) -> Iterator[Quantity]:
    bare = text.strip(" ,;:.![]")
    for one in dict.fromkeys((bare, bare.strip("()"))):
        try:
            found = read_unit(one)
        except NotAUnitError:
            continue
        if any(found.powers):
            yield found


def judge_comment(comment: str, unit: str, *, name: str = "") -> bool | None:
    """Whether a comment names a unit; None if it names another unit of the same kind."""
    wanted = read_unit(unit)
    alike = [one for one in find_commented_units(comment, name) if one.powers == wanted.powers]
    if any(math.isclose(one.factor, wanted.factor, rel_tol=1e-6) for one in alike):
        return True
    return None if alike else False
