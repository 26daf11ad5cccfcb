"""A question with options under letters, which stand in another order for every learner."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from grader.checks.check import WrongAnswer, shorten

LETTERS = "abcdefghijklmnop"
SHORTEST = 4  # [characters] of an option's beginning that may stand for it
LONGEST = 60  # [characters] of an answer shown back


@dataclass(frozen=True)
class Option:
    """One thing to choose.

    Args:
        text: what the learner reads.
        says: why it is wrong, without naming the right one; a note where it is right.
        code: the misconception behind it, or empty.
        share: [1] of the points it earns: 1 is right.
        needs_reason: whether it earns them only together with the right reason.
    """

    text: str
    says: str = ""
    code: str = ""
    share: float = 0.0
    needs_reason: bool = False


@dataclass(frozen=True)
class Question:
    """Something that is asked, with its options.

    Args:
        name: as in the answer file, ``KC1_answer``.
        asks: the question, with ``{}`` fields for the learner's own numbers.
        options: in the order they were written, which nobody sees.
    """

    name: str
    asks: str
    options: tuple[Option, ...]

    def find_option(self, raw: object, letters: Mapping[str, Option]) -> Option:
        """The option a learner means: by its letter, or by its first words.

        Args:
            raw: as it stands in the answer file.
            letters: this learner's letter -> option.

        Raises:
            WrongAnswer: nothing was given, or nothing that means one of them.
        """
        ask = f"Write one letter of your questions.md: {', '.join(letters)}."
        if raw is None or raw == "":
            raise WrongAnswer("nothing yet", hint=ask)
        if not isinstance(raw, str):
            raise WrongAnswer(f"{shorten(raw)}, which is not a letter", hint=ask)
        given = normalize(raw)
        if given in letters:
            return letters[given]
        same = [one for one in self.options if normalize(one.text) == given]
        like = same or [one for one in self.options if normalize(one.text).startswith(given)]
        if (len(given) < SHORTEST and not same) or len(like) != 1:
            raise WrongAnswer(f'"{shorten(raw)}", which is not one of the choices', hint=ask)
        return like[0]


def normalize(text: str) -> str:
    """A text without differences of case, blanks and full stops."""
    return re.sub(r"[^a-z0-9+-]+", " ", text.lower()).strip()


def letter_options(options: Sequence[Option], order: Sequence[int]) -> dict[str, Option]:
    """Letter -> option, in a learner's own order."""
    return {LETTERS[place]: options[index] for place, index in enumerate(order)}


def judge_choice(chosen: Option, *, points: float, backed: bool) -> str | None:
    """Compare the chosen option with the right one.

    Args:
        chosen: the option.
        points: for a right answer.
        backed: whether the right reason goes with it.

    Returns:
        A note, if there is something to say about it all the same.

    Raises:
        WrongAnswer: it is not right, or only in part.
    """
    counts = backed or not chosen.needs_reason
    if chosen.share == 1.0 and counts:
        return chosen.says or None
    raise WrongAnswer(
        f'"{_shorten(chosen.text)}"',
        hint=chosen.says if counts else f"{chosen.says}. It counts only with the right reason",
        misconception=chosen.code,
        earned=chosen.share * points if counts else 0.0,
    )


def _shorten(text: str) -> str:
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 1].rsplit(' ', 1)[0]} …"
