"""The questions of ``answer_key.toml``, and seven mechanisms: is measuring worth it, and why?"""

from dataclasses import dataclass
from pathlib import Path

from grader.checks.texts import read_texts

from .question import Option, Question

DECISIONS = ("always", "recommended", "optional", "usually not")


@dataclass(frozen=True)
class Row:
    """A mechanism in the table of a question.

    Args:
        name: as in the answer file.
        told: what it does on the robot.
        decision: the one of ``DECISIONS`` most teams should take.
        reasons: keys of ``REASONS`` that go with it.
        ask: what to think about, after a wrong decision.
        argued: other decisions, each with the reason that carries it.
    """

    name: str
    told: str
    decision: str
    reasons: list[str]
    ask: str
    argued: tuple[list[str], ...] = ()

    def is_justified_exception(self, decision: str, reason: str) -> bool:
        """Whether a decision that is not the usual one comes with a reason that carries it."""
        return [decision, reason] in [*self.argued]


_TEXTS = read_texts(Path(__file__).with_name("answer_key.toml"))
STORIES: dict[str, str] = _TEXTS["stories"]
QUESTIONS = {
    one["name"]: Question(
        one["name"], one["asks"], tuple(Option(**option) for option in one["options"])
    )
    for one in _TEXTS["questions"]
}
REASONS: dict[str, str] = _TEXTS["reasons"]
WRONG_REASONS: dict[str, dict[str, str]] = _TEXTS["wrong_reasons"]
ROWS = tuple(Row(**one) for one in _TEXTS["rows"])
