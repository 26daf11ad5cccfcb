"""A learner's own numbers, and the order in which the options stand for them."""

from collections.abc import Mapping
from dataclasses import dataclass

from grader.answer import AskedNumber, Band
from grader.variant import cache_draws, make_student_rng

from .knowledge import CHECKS
from .question import LETTERS, Option, lettered
from .questions import EVERYDAY
from .table import REASONS

KS, KV = (0.08, 0.16), (0.070, 0.125)  # [V], [V·s/rot] of two Kraken X60 on wheels of many ratios
TARGETS = (3000, 3500, 4000, 4500, 5000)  # [rpm]
SHORT = (0.02, 0.035)  # [share] that it stays below
KS_BEFORE, KS_MORE = (0.12, 0.18), (0.40, 0.55)  # [V] of a good drivetrain; what drags on top
VOLTS = Band(0.003, 0.006)  # it is arithmetic; kS alone is 0.8 % of it and more
QUESTIONS = {one.name: one for one in (*EVERYDAY, *CHECKS)}


@dataclass(frozen=True)
class Variant:
    """What one learner gets.

    Args:
        numbers: field of a question's text -> number.
        letters: question -> letter -> option.
        reasons: letter -> key of ``REASONS``.
    """

    numbers: Mapping[str, float]
    letters: Mapping[str, Mapping[str, Option]]
    reasons: Mapping[str, str]

    @property
    def volts(self) -> AskedNumber:
        """The voltage that the shooter's feedforward asks for."""
        ks, kv, rpm = (self.numbers[name] for name in ("ks", "kv", "target"))
        return AskedNumber("KC2_volts", ks + kv * rpm / 60.0, "V", VOLTS)

    @property
    def slips(self) -> tuple[tuple[float, str, str], ...]:
        """What slips would make of it [V], a sentence, and the misconception."""
        ks, kv, rpm = (self.numbers[name] for name in ("ks", "kv", "target"))
        says = "your kV is for rotations in a second, and rpm are rotations in a minute"
        return (
            (kv * rpm / 60.0, "kS is missing. The wheel has friction at every speed", ""),
            (
                ks + kv * self.numbers["reached"] / 60.0,
                "this is for the speed it reached. Use the target speed",
                "",
            ),
            (ks + kv * rpm, says, "M-UNITS"),
            (kv * rpm, says, "M-UNITS"),
            (60.0 * ks + kv * rpm, says, "M-UNITS"),
            (
                ks + (kv + 0.003) * rpm / 60.0,
                "the term kA·a is too much here. What is a at a steady speed?",
                "",
            ),
        )


@cache_draws
def draw(student: str) -> Variant:
    """A learner's questions, always the same."""
    rng = make_student_rng(student, "exercise11")
    target = int(rng.choice(TARGETS))
    before = round(float(rng.uniform(*KS_BEFORE)), 2)
    numbers = {
        "ks": round(float(rng.uniform(*KS)), 2),
        "kv": round(float(rng.uniform(*KV)), 3),
        "target": target,
        "reached": 10 * round(target * (1.0 - float(rng.uniform(*SHORT))) / 10),
        "ks_before": before,
        "ks_today": round(before + float(rng.uniform(*KS_MORE)), 2),
    }
    letters = {
        name: lettered(one.options, rng.permutation(len(one.options)))
        for name, one in QUESTIONS.items()
    }
    order = rng.permutation(len(REASONS))
    names = tuple(REASONS)
    reasons = {LETTERS[place]: names[index] for place, index in enumerate(order)}
    return Variant(numbers, letters, reasons)
