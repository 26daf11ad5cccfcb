"""Words about the morning of the tests: which are right, and what to say of a wrong one.

A class's package lacks this module and all that only it imports: see ``grader.answers.answer_key``.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from grader.answers.choice_answer import check_choice, read_choices
from grader.checks.check import WrongAnswer

from .morning import FOLDERS, SEEN, WHY, draw_morning

__all__ = ["CHOICES", "draw_morning", "judge_all", "judge_choice", "judge_steps"]

DECISIONS = ("go", "no-go")
STEPS = ("wire-routine", "run-tests", "inspect-and-fit", "place-gains")
LISTED = tuple(sorted(STEPS))


@dataclass(frozen=True)
class Choice:
    """A question with words to choose from.

    Args:
        words: to choose from.
        why: wrong word -> a hint, and a misconception's code or empty.
        always: the right word where it is the same for everybody.
        also: other spellings.
    """

    words: tuple[str, ...]
    why: Callable[[str], tuple[str, str]]
    always: str = ""
    also: Mapping[str, str] = field(default_factory=dict)


def _make_decision(item: str) -> Choice:
    says = f"{item}: {WHY[item]} Read that line of your morning once more"
    also = {"yes": "go", "no": "no-go", "stop": "no-go"}
    return Choice(DECISIONS, lambda _: (says, ""), also=also)


def _explain_folder_2026(found: str) -> tuple[str, str]:
    if "systemcore" in found:
        return "that is on another controller than the roboRIO", ""
    if found.endswith("deploy"):
        return "your program is there, but not its logs", ""
    return "does your roboRIO have a USB stick? A log goes there first, if there is one", ""


def _explain_folder_2027(found: str) -> tuple[str, str]:
    if found.startswith("/u/"):
        return (
            "that is the folder of a USB stick; the question is about a Systemcore without one"
        ), ""
    return (
        "a Systemcore has another user name than a roboRIO, and its home folder has that name"
    ), ""


def _explain_limit(found: str) -> tuple[str, str]:
    who = "where is this limit set? Does that code still run while the test command has the motor?"
    return who, "M-LIMITS-BYPASSED" if found == "bypassed" else ""


def _explain_season(found: str) -> tuple[str, str]:
    if found == "kickoff-week":
        return "the friction and the weight of the robot will still change", ""
    if found == "after-the-season":
        return "then nobody can use the gains this season", ""
    return (
        "there may be only eight minutes between matches, and a pit is small",
        "",
    )


CHOICES: Mapping[str, Choice] = {
    **{f"check_{item}": _make_decision(item) for item in SEEN},
    "log_2026": Choice(FOLDERS, _explain_folder_2026),
    "log_2027": Choice(FOLDERS, _explain_folder_2027, always="/home/systemcore/logs"),
    "limit_a": Choice(("acts", "bypassed"), _explain_limit),
    "limit_b": Choice(("acts", "bypassed"), _explain_limit),
    "schedule": Choice(
        ("kickoff-week", "last-two-weeks-of-build-season", "first-regional", "after-the-season"),
        _explain_season,
        always="last-two-weeks-of-build-season",
        also={"last-two-weeks": "last-two-weeks-of-build-season"},
    ),
}


def judge_choice(name: str, given: Mapping[str, object], right: str = "") -> None:
    """Compare a word with the right one; where none is named, the one that is always right.

    Raises:
        WrongAnswer: it is another, or none.
    """
    choice = CHOICES[name]
    try:
        check_choice(
            given.get(name), right or choice.always, choice.words, why=choice.why, also=choice.also
        )
    except WrongAnswer as wrong:
        wrong.seen = f"{name}: {wrong.seen}"
        raise


def judge_all(given: Mapping[str, object], right: Mapping[str, str], *, points: float) -> None:
    """Compare several words with the right ones; each wrong word cancels a right one.

    So who writes the same word everywhere, or guesses, earns about nothing.

    Raises:
        WrongAnswer: one of them is another, or none; the first of these is told.
    """
    problems, wrong = [], 0
    for name, expected in right.items():
        try:
            judge_choice(name, given, expected)
        except WrongAnswer as why:
            problems.append(why)
            wrong += given.get(name) not in (None, "")
    if problems:
        hits = len(right) - len(problems)
        problems[0].earned = points * (hits - wrong) / len(right)  # a check earns 0 at least
        raise problems[0]


def judge_steps(raw: object) -> None:
    """Compare an order of the four steps with the one that works.

    Raises:
        WrongAnswer: it is another, or no order of the four.
    """
    ask = f"Write all four, in a list: {', '.join(LISTED)}."
    found = tuple(read_choices(raw, LISTED, ask=ask))
    seen = ", ".join(found)
    if sorted(found) != list(LISTED):
        raise WrongAnswer(seen, hint=f"each of the four once. {ask}")
    late = next((one for one, right in zip(found, STEPS, strict=True) if one != right), "")
    if late:
        raise WrongAnswer(seen, hint=f"{late} comes too early. What must happen before it?")
