"""A learner's own numbers, and the order in which the options stand for them."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from grader.answers.asked_number import AskedNumber, Band
from grader.answers.wrong_number import Lookalike, Slips
from grader.student_data.variant import cache_draws, make_student_rng

from .question import LETTERS, Option, letter_options
from .questions import QUESTIONS, REASONS

KS, KV = (0.08, 0.16), (0.070, 0.125)  # [V], [V·s/rot] of two Kraken X60 on wheels of many ratios
TARGETS = (3000, 3500, 4000, 4500, 5000)  # [rpm]
SHORT = (0.02, 0.035)  # [share] that it stays below
KS_BEFORE, KS_MORE = (0.12, 0.18), (0.40, 0.55)  # [V] of a good drivetrain; what drags on top
FRAMES = {20: 0.52, 50: 0.235}  # [ms] between readings -> kA / true of SysId's recipe at 5 ms
KA_DRIVE = (0.18, 0.32)  # [V·s²/m] of a drivetrain
KA_SPREAD, KA_ERROR = (0.05, 0.09), 0.002  # [share] to either side; [V·s²/m] of one recording
HOTTER = (40, 50, 60)  # [°C] above the tests; copper takes 20 % more volts at 50
TIRED, MOST_VOLTS = (11.2, 11.9), 10  # [V] of the battery; that the code sends at most
VOLTS = Band(0.003, 0.006)  # it is arithmetic; kS alone is 0.8 % of it and more
SLIPS = Slips(Path(__file__).with_name("slips.toml"))


@dataclass(frozen=True)
class Variant:
    """The numbers, options and reasons in one learner's questions.

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
    def slips(self) -> tuple[Lookalike, ...]:
        """The wrong voltages [V] that known slips give."""
        ks, kv, rpm = (self.numbers[name] for name in ("ks", "kv", "target"))
        return SLIPS.list_lookalikes(
            (
                ("no-ks", kv * rpm / 60.0),
                ("reached", ks + kv * self.numbers["reached"] / 60.0),
                ("minutes", ks + kv * rpm),
                ("minutes", kv * rpm),
                ("minutes", 60.0 * ks + kv * rpm),
                ("extra-ka", ks + (kv + 0.003) * rpm / 60.0),
            )
        )


def _draw_everyday_numbers(rng: np.random.Generator) -> dict[str, float]:
    """The numbers of the questions about repeated readings, three recordings, and heat."""
    frame = int(rng.choice(tuple(FRAMES)))
    of_mass, middle = (float(rng.uniform(*KA_DRIVE)) for _ in range(2))
    spread = float(rng.uniform(*KA_SPREAD)) * middle
    kas = [middle + float(share) * spread for share in rng.permutation((-1.0, 0.1, 1.0))]
    return {
        "frame": frame,
        "ka_mass": round(of_mass, 3),
        "ka_frames": round(FRAMES[frame] * of_mass, 3),
        **dict(zip(("ka_first", "ka_second", "ka_third"), kas, strict=True)),
        "ka_error": KA_ERROR,
        "hotter": int(rng.choice(HOTTER)),
        "tired": round(float(rng.uniform(*TIRED)), 1),
        "most": MOST_VOLTS,
    }


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
    numbers |= _draw_everyday_numbers(rng)
    letters = {
        name: letter_options(one.options, rng.permutation(len(one.options)))
        for name, one in QUESTIONS.items()
    }
    order = rng.permutation(len(REASONS))
    names = tuple(REASONS)
    reasons = {LETTERS[place]: names[index] for place, index in enumerate(order)}
    return Variant(numbers, letters, reasons)
