"""The questions, their right answers, and the feedback on wrong ones.

A class's package lacks this module and all that only it imports: see ``grader.answers.answer_key``.
"""

from collections.abc import Mapping

from grader.answers.choice_answer import check_choice, read_choice
from grader.answers.number_answer import judge_number, read_answer_number
from grader.answers.wrong_number import AnswerKey
from grader.checks.check import NotReachedError, WrongAnswer, shorten

from .drawn import Variant, draw
from .question import SHORTEST, judge_choice, normalize
from .questions import DECISIONS, QUESTIONS, REASONS, ROWS, STORIES, WRONG_REASONS, Row

__all__ = ["QUESTIONS", "ROWS", "draw", "format_questions", "judge_answer"]

ROUNDED = 0.0015  # [share] a slip is named for who writes three digits, too
ALSO = {"usually not needed": "usually not", "not": "usually not", "no": "usually not"}


def format_questions(variant: Variant) -> str:
    """All questions, their options under the learner's own letters."""
    parts = ["# Your own questions for exercise 11\n\nWrite your letters into answers.toml.\n"]
    for name, one in QUESTIONS.items():
        story, _, tier = name.partition("_")
        if story in STORIES and tier == "answer":
            parts.append(f"## {story}\n\n{STORIES[story].format(**variant.numbers)}\n")
            if story == "KC2":
                parts.append(
                    "### KC2_volts\n\nWhich voltage does the feedforward give at the target "
                    "speed?\nOne minute has 60 seconds.\n"
                )
        parts.append(_write_question(name, one.asks.format(**variant.numbers), variant))
    rows = "".join(f"- {row.name}: {row.told}\n" for row in ROWS)
    reasons = "".join(f"- **{one}** {REASONS[name]}\n" for one, name in variant.reasons.items())
    parts.append(
        f"## Seven mechanisms\n\n{rows}\n"
        f"Should a team characterize this mechanism? {', '.join(DECISIONS)}.\n"
    )
    parts.append(f"### Reasons\n\n{reasons}")
    return "\n".join(parts)


def _write_question(name: str, asks: str, variant: Variant) -> str:
    letters = variant.letters[name].items()
    return f"### {name}\n\n{asks}\n\n" + "".join(f"- **{one}** {o.text}\n" for one, o in letters)


def judge_answer(
    name: str, given: Mapping[str, object], variant: Variant, *, points: float
) -> str | None:
    """Judge one answer.

    Args:
        name: of the answer.
        given: the answers.
        variant: the learner's own numbers and letters.
        points: for a right answer.

    Returns:
        A note, if there is something to say about a right answer.

    Raises:
        WrongAnswer: it is not right.
        NotReachedError: it is a reason, and its decision is not right.
    """
    raw = given.get(name)
    if name in QUESTIONS:
        chosen = QUESTIONS[name].find_option(raw, variant.letters[name])
        return judge_choice(chosen, points=points, backed=_is_backed(name, given, variant))
    if name == "KC2_volts":
        return _judge_volts(raw, variant, points=points)
    row = next(one for one in ROWS if one.name == name.removesuffix("_reason"))
    judge = _judge_decision if name == row.name else _judge_reason
    return judge(row, given, variant)


def _is_backed(name: str, given: Mapping[str, object], variant: Variant) -> bool:
    """Whether the right reason was given for the answer of a knowledge check."""
    reason = name.replace("_answer", "_reason")
    if reason == name or reason not in QUESTIONS:
        return False
    try:
        chosen = QUESTIONS[reason].find_option(given.get(reason), variant.letters[reason])
    except WrongAnswer:
        return False
    return chosen.share == 1.0


def _judge_volts(raw: object, variant: Variant, *, points: float) -> str | None:
    """Judge the voltage that the feedforward gives."""
    asked = variant.volts
    value = read_answer_number(raw, asked)
    if not asked.is_right(value):
        for one in variant.slips:
            if abs(value - one.value) <= ROUNDED * one.value:
                slip = one.slip
                raise WrongAnswer(
                    f"{value:.4g} V", hint=slip.says, misconception=slip.misconception
                )
    return judge_number(
        asked.name, {asked.name: raw}, AnswerKey({asked.name: asked}), points=points
    )


def _judge_decision(row: Row, given: Mapping[str, object], variant: Variant) -> str | None:
    """Judge whether to characterize a mechanism."""
    raw = given.get(row.name)
    found = read_choice(raw, DECISIONS, also=ALSO)
    if row.is_justified_exception(found, _read_reason(row, given, variant)):
        return "Accepted: with that reason, your choice may be the better one."

    def explain_wrong_choice(_: str) -> tuple[str, str]:
        return f"{row.ask} Choose one of: {', '.join(DECISIONS)}.", ""

    check_choice(raw, row.decision, DECISIONS, why=explain_wrong_choice, also=ALSO)
    return None


def _judge_reason(row: Row, given: Mapping[str, object], variant: Variant) -> None:
    """Judge a reason, which counts only with a decision that is right."""
    chosen = _read_reason(row, given, variant, asked=True)
    try:
        decided = read_choice(given.get(row.name), DECISIONS, also=ALSO)
    except WrongAnswer:
        raise NotReachedError("checked together with the decision") from None
    if row.is_justified_exception(decided, chosen):
        return
    if chosen not in row.reasons:
        other = {"says": f"this is no reason for '{decided}' here: {row.told}. {row.ask}"}
        said = WRONG_REASONS.get(chosen, other)
        raise WrongAnswer(
            f'"{REASONS[chosen]}"',
            hint=said["says"],
            misconception=said.get("misconception", ""),
        )
    if decided != row.decision:
        raise NotReachedError("a reason counts only together with a decision that is right")


def _read_reason(
    row: Row, given: Mapping[str, object], variant: Variant, *, asked: bool = False
) -> str:
    """The reason that was given, a key of ``REASONS``; empty if none was, unless it is asked."""
    raw = given.get(f"{row.name}_reason")
    letters = variant.reasons
    text = normalize(raw) if isinstance(raw, str) else ""
    if text in letters:
        return letters[text]
    like = [one for one in letters.values() if normalize(REASONS[one]).startswith(text)]
    if len(text) >= SHORTEST and len(like) == 1:
        return like[0]
    if not asked:
        return ""
    seen = (
        "nothing yet"
        if raw is None or raw == ""
        else f"{shorten(raw)}, which is not one of the choices"
    )
    ask = "Write the letter of a reason: the list is at the end of your questions.md."
    raise WrongAnswer(seen, hint=ask)
