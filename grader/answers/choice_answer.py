"""A word for an answer: one out of a list, however it is written."""

import re
from collections.abc import Callable, Mapping, Sequence

from grader.checks.check import WrongAnswer, shorten


def normalize_choice(text: str) -> str:
    """A word in lower case, without blanks, dots and parentheses."""
    return re.sub(r"[^a-z0-9]", "", re.sub(r"\(.*|^.*\.(?=\w)|\bnew\b", "", text.strip().lower()))


def read_choice(
    raw: object, choices: Sequence[str], *, also: Mapping[str, str] | None = None
) -> str:
    """Read one of the choices.

    Args:
        raw: what was given.
        choices: the words there are.
        also: other spellings -> the choice that is meant.

    Raises:
        WrongAnswer: nothing was given, or none of the choices.
    """
    ask = f"Choose one of: {', '.join(choices)}."
    if raw is None or raw == "":
        raise WrongAnswer("nothing yet", hint=ask)
    if not isinstance(raw, str):
        raise WrongAnswer(f"{shorten(raw)}, which is not a word", hint=ask)
    known = {normalize_choice(one): one for one in choices}
    known |= {normalize_choice(other): one for other, one in (also or {}).items()}
    found = known.get(normalize_choice(raw))
    if found is None:
        raise WrongAnswer(f'"{shorten(raw)}", which is not one of the choices', hint=ask)
    return found


def read_choices(raw: object, choices: Sequence[str], *, ask: str) -> list[str]:
    """Read a list of choices, or a text with commas between them.

    Args:
        raw: what was given.
        choices: the words there are.
        ask: what to write, if it is no list.

    Raises:
        WrongAnswer: nothing was given, no list, or a word that is none of the choices.
    """
    if isinstance(raw, str) and raw:
        raw = raw.split(",")
    if raw is None or raw in ("", []):
        raise WrongAnswer("nothing yet", hint=ask)
    if not isinstance(raw, list):
        raise WrongAnswer(f"{shorten(raw)}, which is not a list", hint=ask)
    return [read_choice(one, choices) for one in raw]


def check_choice(
    raw: object,
    right: str,
    choices: Sequence[str],
    *,
    why: Callable[[str], tuple[str, str]],
    also: Mapping[str, str] | None = None,
) -> None:
    """Raise ``WrongAnswer`` unless the answer is the right one of the choices.

    Args:
        raw: what was given.
        right: the right one of the choices.
        choices: the words there are.
        why: what to say of a wrong choice: a hint that does not name the right one, and the
            misconception's code, or empty.
        also: other spellings -> the choice that is meant.

    Raises:
        WrongAnswer: it is not the right one, or none of the choices.
    """
    found = read_choice(raw, choices, also=also)
    if found == right:
        return
    hint, code = why(found)
    raise WrongAnswer(f'"{shorten(raw)}"', hint=hint, misconception=code)
