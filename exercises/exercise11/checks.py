"""Exercise 11: what a team should know about measuring gains, and for which mechanism it pays."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from grader.answer import AnswerKey, judge_number, read_answer_number
from grader.check import Check, NotReachedError, WrongAnswer, check, shorten
from grader.choice_answer import check_choice, read_choice
from grader.student_files import write_student_files
from grader.submission import read_answers

from .drawn import QUESTIONS, Variant, draw
from .knowledge import STORIES
from .question import Option, judged
from .table import DECISIONS, REASONS, ROWS, WRONG, Row

FILES = ("answers.toml",)
ANSWER_NAMES = (
    *QUESTIONS, "KC2_volts",
    *(f"{row.name}{part}" for row in ROWS for part in ("", "_reason")),
)  # fmt: skip
HERE = Path(__file__).resolve().parent
GIVEN = "questions.md"
ROUNDED = 0.0015  # [share] a slip is named for who writes three digits, too
TIER, SINGLE = 2.0, 1.0  # points of a tier of a knowledge check, of every other question
ALSO = {"usually not needed": "usually not", "not": "usually not", "no": "usually not"}


@dataclass(frozen=True)
class Answers:
    """What the checks look at."""

    given: Mapping[str, object]
    variant: Variant


def prepare(student: str, *, say: Callable[[str], None]) -> None:
    """Write down the learner's questions, where they are not there as they were made."""
    made = {GIVEN: _told(draw(student))}
    write_student_files(made, exercise=HERE, student=student, what="questions", say=say)


def _told(variant: Variant) -> str:
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
        parts.append(_asked(name, one.asks.format(**variant.numbers), variant))
    rows = "".join(f"- {row.name}: {row.told}\n" for row in ROWS)
    reasons = "".join(f"- **{one}** {REASONS[name]}\n" for one, name in variant.reasons.items())
    parts.append(
        f"## Seven mechanisms\n\n{rows}\n"
        f"Should a team characterize this mechanism? {', '.join(DECISIONS)}.\n"
    )
    parts.append(f"### Reasons\n\n{reasons}")
    return "\n".join(parts)


def _asked(name: str, asks: str, variant: Variant) -> str:
    letters = variant.letters[name].items()
    return f"### {name}\n\n{asks}\n\n" + "".join(f"- **{one}** {o.text}\n" for one, o in letters)


def read(path: Path, *, student: str) -> Answers:
    """The answers, and what they are held against.

    Raises:
        UnreadableFile: the file cannot be read.
    """
    given = {name.lower(): value for name, value in read_answers(path).items()}
    return Answers(given, draw(student))


def _question(name: str, describes: str, *, points: float) -> Check[Answers]:
    """A check of one question with letters."""

    def look(answers: Answers) -> str | None:
        return judged(_chosen(name, answers), points=points)

    look.__name__, look.__doc__ = name.lower(), describes
    return check(points=points)(look)


def _chosen(name: str, answers: Answers) -> Option:
    raw = answers.given.get(name.lower())
    return QUESTIONS[name].chosen(raw, answers.variant.letters[name])


q0_guess = _question("Q0_guess", "The question of somebody who guesses gains.", points=SINGLE)
q0_sysid = _question("Q0_sysid", "The question of somebody who runs SysId.", points=SINGLE)
q0_brace = _question("Q0_brace", "The gain that a brace changes.", points=SINGLE)
ka_use = _question("kA_use", "What else a drivetrain's kA tells.", points=SINGLE)
ks_flag = _question("kS_flag", "What to do when kS has grown.", points=SINGLE)
step_shape = _question("step_shape", "What a long steady acceleration means.", points=SINGLE)
step_length = _question("step_length", "What a longer dynamic test gives.", points=SINGLE)
null_consumer = _question("null_consumer", "Where null sends the test's name.", points=SINGLE)
status_frames = _question("status_frames", "What repeated readings do to kA.", points=SINGLE)
three_logs = _question("three_logs", "What the spread of three recordings says.", points=SINGLE)
match_heat = _question("match_heat", "Which gains a match's heat changes.", points=SINGLE)
schedule = _question("schedule", "When a team characterizes.", points=SINGLE)
kc1_answer = _question("KC1_answer", "KC1: what happened when the mechanism jumped.", points=TIER)
kc1_reason = _question("KC1_reason", "KC1: what that does to the gains.", points=TIER)


@check(points=SINGLE)
def kc2_volts(answers: Answers) -> str | None:
    """KC2: the voltage that the feedforward gives."""
    asked, raw = answers.variant.volts, answers.given.get("kc2_volts")
    value = read_answer_number(raw, asked)
    if not asked.is_right(value):
        for slipped, says, code in answers.variant.slips:
            if abs(value - slipped) <= ROUNDED * slipped:
                raise WrongAnswer(f"{value:.4g} V", hint=says, misconception=code)
    return judge_number(
        asked.name, {asked.name: raw}, AnswerKey({asked.name: asked}), points=SINGLE
    )


kc2_answer = _question("KC2_answer", "KC2: what to do about the missing speed.", points=TIER)
kc2_reason = _question("KC2_reason", "KC2: why it is missing.", points=TIER)
kc3_answer = _question("KC3_answer", "KC3: what to do when the loaded arm sinks.", points=TIER)
kc3_reason = _question("KC3_reason", "KC3: why the arm sinks.", points=TIER)


def _decision(row: Row) -> Check[Answers]:
    """A check of one row's decision."""

    def look(answers: Answers) -> str | None:
        raw = answers.given.get(row.name)
        found = read_choice(raw, DECISIONS, also=ALSO)
        if found != row.decision and row.argues(found, _argued(row, answers)):
            return "Accepted: with that reason, your choice may be the better one."

        def why(_: str) -> tuple[str, str]:
            return f"{row.ask} Choose one of: {', '.join(DECISIONS)}.", ""

        check_choice(raw, row.decision, DECISIONS, why=why, also=ALSO)
        return None

    look.__name__ = f"decision_{row.name}"
    look.__doc__ = f"Whether to characterize it: {row.name}."
    return check(points=1)(look)


def _reason(row: Row) -> Check[Answers]:
    """A check of one row's reason, which has to carry the decision it stands beside."""

    def look(answers: Answers) -> None:
        chosen = _argued(row, answers, asked=True)
        try:
            decided = read_choice(answers.given.get(row.name), DECISIONS, also=ALSO)
        except WrongAnswer:
            raise NotReachedError("checked together with the decision") from None
        if chosen in row.reasons or row.argues(decided, chosen):
            return
        own, code = WRONG.get(chosen, ("", ""))
        other = f"this is no reason for '{decided}' here: {row.told}. {row.ask}"
        raise WrongAnswer(f'"{REASONS[chosen]}"', hint=own or other, misconception=code)

    look.__name__ = f"reason_{row.name}"
    look.__doc__ = f"The reason: {row.name}."
    return check(points=1)(look)


def _argued(row: Row, answers: Answers, *, asked: bool = False) -> str:
    """The reason that was given, a key of ``REASONS``; empty if none was, unless it is asked."""
    raw = answers.given.get(f"{row.name}_reason")
    letters = answers.variant.reasons
    text = raw.strip().strip(".)").lower() if isinstance(raw, str) else ""
    if text in letters:
        return letters[text]
    if not asked:
        return ""
    seen = "nothing yet" if raw is None or raw == "" else f"{shorten(raw)}, which is none of them"
    ask = "Write the letter of a reason: the list is at the end of your questions.md."
    raise WrongAnswer(seen, hint=ask)


# The loader finds checks by the names of this module, in the order they are written.
for _row in ROWS:
    globals()[f"decision_{_row.name}"] = _decision(_row)
    globals()[f"reason_{_row.name}"] = _reason(_row)
