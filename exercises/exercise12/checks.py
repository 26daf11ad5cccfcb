"""Exercise 12: what is missing in a model, named, sized, and shown on runs nobody fitted."""

import math
import re
from collections.abc import Sequence
from contextlib import suppress
from functools import cached_property, lru_cache

import numpy as np

from grader.answers.asked_number import AskedNumber, Band
from grader.answers.number_answer import read_answer_number
from grader.answers.submission import StudentAnswers
from grader.checks.check import NotReachedError, WrongAnswer, check
from grader.exercise.mystery import Mystery
from grader.student_data.student_files import Made, format_log
from sim.core.units import find_unit
from sim.estimation.likelihood import Estimate
from sim.physics.effects import EFFECTS
from sim.physics.model import Part
from sim.reconcile.by_hand import HandSearch
from sim.support.student_names import make_folder_name

from .drawn import FLOOR, HIDDEN, Variant, draw, draw_solvable, make_search
from .patch import find_parameter_at_limit, read_names, read_parts

__all__ = ["draw", "make_folder_name", "read_names"]  # what try_it.py uses, too

Effects = tuple[tuple[str, tuple[tuple[str, float], ...]], ...]  # names, each with its parameters

FILES = ("answers.toml",)
ANSWER_NAMES = ("effects", "gap_before", "gap_after")

SHRINK = 0.6  # [share of what can be shrunk] for partial marks
WORSE = 1.05  # [of the base's gap] beyond it, effects do harm
SURE = 20.0  # [BIC] odds of about twenty thousand to one
NARROWER = 0.985  # [of the gap without] what a refit by chance does not do
LEAST_GAP = 0.5  # [times the noise] noise alone leaves more
SAME = 1.1  # [1] ratio up to which two gaps are the same: rounding, and a search from elsewhere
NARROW = 0.95  # [of the gap with gains alone] above which effects do nothing for the held-out log
REPORTED = 0.5  # points for the two gaps
REMEMBERED = 16  # fits that are kept while this runs


class Answers(StudentAnswers):
    """The object that the checks read: the answers, and the learner's mechanism."""

    names_only = False  # whether only names are asked for, as in a mystery

    @property
    def names(self) -> tuple[str, ...]:
        """The effects, in order; raises WrongAnswer."""
        return read_names(self.given.get("effects"))

    @property
    def parts(self) -> list[Part]:
        """The effects with their parameters; raises WrongAnswer."""
        return read_parts(self.names, self.given, find_unit(self.variant.log.units))

    @cached_property
    def search(self) -> HandSearch:
        """The search for effects in the learner's logs."""
        return make_search(self.variant)

    @property
    def validation_count(self) -> int:
        """Number of samples of the validation log."""
        return sum(len(run) for run in self.variant.validation.runs)

    def measure_gap(self, parts: Sequence[Part], log: str = "validation") -> float:
        """The gap of a log with some of the answer's effects [times the noise]."""
        effects = tuple((one.effect, tuple(one.parameters.items())) for one in parts)
        return _measure_gap(self.search, effects, log)


class MysteryAnswers(Answers):
    """The answer to a mystery."""

    names_only = True


@lru_cache(maxsize=REMEMBERED)
def _fit_gains(search: HandSearch, effects: Effects) -> Estimate:
    """The gains of the model with effects, as the answer states them."""
    return search.fit_gains([Part(name, dict(values)) for name, values in effects])


@lru_cache(maxsize=4 * REMEMBERED)
def _measure_gap(search: HandSearch, effects: Effects, log: str) -> float:
    """The gap of a log with effects, and with gains fitted to the other logs."""
    return search.measure_gap(_fit_gains(search, effects), log)


@lru_cache(maxsize=REMEMBERED)
def _measure_floor(variant: Variant) -> float:
    """The gap that the true model leaves on the held-out log; the noise is at least 1."""
    search = make_search(variant)
    truth = search.evaluate_model(variant.mechanism.model)
    return max(1.0, search.measure_gap(truth, "held_out"))


def list_answer_table_names() -> tuple[str, ...]:
    """The names of all effects, each also with ``_`` for ``-``: ``velocity-filter.lag = 0.02``."""
    return tuple({name: None for one in EFFECTS for name in (one, one.replace("-", "_"))})


def make_files(student: str) -> dict[str, Made]:
    """The learner's logs."""
    variant = draw(student)
    logs = {"log": variant.log, "validation": variant.validation, "held-out": variant.held_out}
    return {
        f"{name}{suffix}": format_log(log)
        for name, log in logs.items()
        for suffix in (".wpilog", ".csv")
    }


def draw_mystery(rng: np.random.Generator, *, level: int) -> Mystery:
    """One to three hidden effects, more at higher levels; the answer is their names.

    Args:
        rng: the source of chance.
        level: from 1.
    """
    count = min((level + 1) // 2, max(len(effects) for _, effects in HIDDEN))
    variant = draw_solvable(rng, [one for one in HIDDEN if len(one[1]) == count])
    return Mystery(
        logs={"log": variant.log, "validation": variant.validation},
        task=(
            f"The model kS, kV, kA lacks {count} effect{'s' if count > 1 else ''}. Which? Write "
            f"{'the most important one first' if count > 1 else 'its name'}; sysid effects lists "
            "the names. Put the names that you try after try_it.py"
        ),
        tool="python exercises/exercise12/try_it.py --logs {folder}",
        example=", ".join(("delay", "backlash", "cogging")[:count]),
        solution=", ".join(variant.hidden),
        checks=(first_effect, all_effects),
        read=lambda text: MysteryAnswers({"effects": _split_names(text)}, variant, ""),
    )


def _split_names(text: str) -> list[str]:
    """The names in one line, between commas or spaces."""
    return [one for one in re.split(r"[,\s]+", text) if one]


@check(points=3)
def first_effect(answers: Answers) -> None:
    """The first effect is the one that matters most."""
    first = answers.names[0]
    if first == answers.variant.hidden[0]:
        _require_narrower(answers)
        return
    hint = "another effect alone makes the gap of the validation smaller than this one does"
    if first in answers.variant.hidden:
        hint = f"it is one of the hidden effects, but {hint}"
    raise WrongAnswer(f'"{first}"', hint=f"{hint}{_describe_gap_with_first_effect(answers)}")


def _require_narrower(answers: Answers) -> None:
    """Names count only with parameters that make the gap of the held-out log smaller.

    Raises:
        NotReachedError: the parameters cannot be read.
        WrongAnswer: the gap does not get smaller.
    """
    if answers.names_only:
        return
    try:
        after = answers.measure_gap(answers.parts, "held_out")
    except WrongAnswer as wrong:
        raise NotReachedError(f"counts only with parameters: {wrong.seen}") from None
    before = answers.measure_gap([], "held_out")
    if after > NARROW * before:
        raise WrongAnswer(
            ", ".join(answers.names),
            hint="names count only if their effects make the gap of the held-out log smaller. "
            f"With your parameters it goes from {before:.3g} to {after:.3g} times the noise. Write "
            "the parameters that try_it.py prints for your own log",
        )


def _describe_gap_with_first_effect(answers: Answers) -> str:
    """The gap with the first effect alone, in the size that the learner chose."""
    try:
        part = answers.parts[0]
    except WrongAnswer:
        return ""
    before, after = answers.measure_gap([]), answers.measure_gap([part])
    return (
        f". With {part.effect} alone, as you give it, that gap goes from {before:.3g} to "
        f"{after:.3g} times the noise"
    )


@check(points=2)
def all_effects(answers: Answers) -> None:
    """All effects that are missing are named, and no others."""
    named, hidden = {*answers.names}, {*answers.variant.hidden}
    if named == hidden:
        _require_narrower(answers)
        return
    hint = "each of these is right, but something is still missing: look at the remaining gap"
    if named > hidden:
        hint = (
            "all hidden effects are in your list, but it also has others. Which of them does"
            " not make the gap smaller?"
        )
    elif not named < hidden:
        hint = (
            "not all of these are right. Two effects can look alike, and then the wrong one "
            "helps a little, too. Try the effects that look like yours, and keep the one with "
            "the smallest gap of the validation"
        )
    earned = 0.0
    if named > hidden or named < hidden:
        with suppress(WrongAnswer, NotReachedError):
            _require_narrower(answers)
            earned = 1.0
    raise WrongAnswer(", ".join(answers.names), hint=hint, earned=earned)


@check(points=3)
def held_out(answers: Answers) -> str | None:
    """The model predicts the held-out log, which nothing was fitted to."""
    floor = _measure_floor(answers.variant)
    before, after = (answers.measure_gap(some, "held_out") for some in ([], answers.parts))
    seen = f"the gap goes from {before:.3g} to {after:.3g} times the noise"
    if after <= FLOOR * floor:
        _check_reported(answers, before=before, after=after)
        return seen
    shrunk = (before - after) / (before - floor)
    if shrunk >= SHRINK:
        hint = "you are close. Is an effect missing, or is a parameter not yet right?"
        raise WrongAnswer(seen, hint=hint, earned=2.0)
    hint = (
        "a large gap remains. Are the parameters those of your own log, in its units? Or is an "
        "effect missing, or another one that looks alike?"
    )
    if after > WORSE * before:
        hint = (
            "on runs that it was not fitted to, your model is worse than gains alone. Are the "
            "parameters those that try_it.py prints for your own log, in the same units? If "
            "they are, leave out effects that do not make the gap of the validation smaller"
        )
    raise WrongAnswer(seen, hint=hint)


def _check_reported(answers: Answers, *, before: float, after: float) -> None:
    """Refuse reported gaps that this model does not have.

    Raises:
        WrongAnswer: one of them is another number.
    """
    rows = (("gap_before", before, after, []), ("gap_after", after, before, answers.parts))
    for name, expected, other, parts in rows:
        asked = AskedNumber(name, expected, "", Band(0.0, 0.0))
        try:
            value = read_answer_number(answers.given.get(name), asked)
            if not _is_same(value, expected):
                raise _explain_gap(value, other=other, validation=answers.measure_gap(parts))
        except WrongAnswer as wrong:
            wrong.seen, wrong.earned = f"{name}: {wrong.seen}", 3.0 - REPORTED
            raise


def _explain_gap(value: float, *, other: float, validation: float) -> WrongAnswer:
    """The other gap that a wrong number may be.

    Args:
        value: as the learner wrote it.
        other: the other of the two gaps of the held-out log.
        validation: this gap of the validation log.
    """
    if _is_same(value, validation):
        hint = (
            "this is about the gap of the log or of the validation log. Which log did nobody use "
            "to fit or to choose effects?"
        )
        return WrongAnswer(f"{value:g}", hint=hint, misconception="M-HELD-OUT")
    hint = (
        "this is not the gap of your model on the held-out log, in times the noise. Write what "
        "try_it.py prints with --held-out"
    )
    if _is_same(value, other):
        hint = "is this the other gap? gap_before is with gains alone, gap_after with effects"
    return WrongAnswer(f"{value:g}", hint=hint)


def _is_same(value: float, expected: float) -> bool:
    """Whether two gaps are the same: up to rounding, or both no more than noise."""
    noise = LEAST_GAP < value <= 1.0 and expected <= 1.0
    return noise or expected / SAME <= value <= SAME * expected


@check(points=2)
def justified(answers: Answers) -> None:
    """Each effect makes the gap of the validation smaller, and no parameter is at its limit."""
    try:
        parts = answers.parts
    except WrongAnswer:
        raise NotReachedError("checked after you write effects and their parameters") from None
    for part in parts:
        if stuck := find_parameter_at_limit(part):
            raise WrongAnswer(
                f"{part.effect}.{stuck} is at its limit",
                hint="there the effect does nothing, or stands in for another. If the fit of your "
                "own log ends there, leave the effect out",
            )
    whole = answers.measure_gap(parts)
    for part in parts:
        without = answers.measure_gap([one for one in parts if one is not part])
        if not _is_worth(part, whole=whole, without=without, count=answers.validation_count):
            raise WrongAnswer(
                part.effect,
                hint=f"the gap of the validation is {without:.3g} times the noise without it, and "
                f"{whole:.3g} with it. So it does not help, or its parameters are not those of "
                "your log. More effects mostly fit the fitted log better, but may predict other "
                "runs worse",
            )


def _is_worth(part: Part, *, whole: float, without: float, count: int) -> bool:
    """Whether an effect lowers the BIC of runs that its parameters were not fitted to."""
    if not whole <= NARROWER * without:  # a simulation that diverged is not narrower, either
        return False
    return 2.0 * count * math.log(without / whole) - len(part.parameters) * math.log(count) >= SURE
