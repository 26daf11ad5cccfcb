"""Exercise 8: what to cut from a damaged log, graded by the fit of the rest."""

import math
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from grader.answers.submission import NamedAnswers, read_answers
from grader.checks.check import NotReachedError, WrongAnswer, check, make_check
from grader.student_data.student_files import Made, format_log
from sim.core.errors import Refusal
from sim.core.log import FOUR_TESTS, Log
from sim.core.units import find_unit

from .blame import blame
from .coverage import Coverage, measure_coverage
from .drawn import Variant, draw
from .preparation import (
    POINTS,
    Preparation,
    fit_prepared,
    judge_gain,
    read_preparation,
)

FILES = ("answers.toml",)
ANSWER_NAMES = (*(test.replace("-", "_") for test in FOUR_TESTS), "threshold", "median")
LATE = 0.15  # [s] after a careful cut before a stop: who cuts by eye may be so late


@dataclass(frozen=True)
class Answers:
    """The object that the checks read: the answers, and the learner's log."""

    preparation: Preparation | WrongAnswer
    variant: Variant


def make_files(student: str) -> dict[str, Made]:
    """The learner's log."""
    return dict.fromkeys(("log.wpilog", "log.csv"), format_log(draw(student).log))


def read(path: Path, *, student: str) -> Answers:
    """The answers, with the learner's log and its reference.

    Raises:
        UnreadableFile: the file cannot be read.
    """
    given = NamedAnswers(read_answers(path))
    variant = draw(student)
    unit = find_unit(variant.mechanism.units)
    try:
        preparation = read_preparation(given, symbol=unit.symbol, si=unit.si)
        _require_samples(preparation, variant.log)
    except WrongAnswer as wrong:
        return Answers(wrong, variant)
    return Answers(preparation, variant)


def _require_samples(preparation: Preparation, log: Log) -> None:
    """Refuse times between which a test has no sample.

    Raises:
        WrongAnswer: they are the times of the log, say, and not since the test began.
    """
    for run in log.runs:
        if not len(preparation.kept(run)):
            first, last = preparation.keep[run.test]
            raise WrongAnswer(
                f"{run.test}: nothing is recorded from {first:g} to {last:g} s",
                hint=f"This test lasts {run.time[-1] - run.time[0]:.2f} s. Count the times from "
                "its beginning.",
            )


@check(points=2)
def kept(answers: Answers) -> None:
    """At least 60 % of the good samples of each test are kept."""
    if isinstance(answers.preparation, WrongAnswer):
        raise answers.preparation
    short = [one for one in _measure_coverage(answers) if not one.enough]
    if not short:
        return
    hint = (
        "Cut only samples in which something other than the motor moves or holds the mechanism, "
        "and choose a threshold just above the noise. A fit averages out the noise of good samples."
    )
    raise _refuse_tests("too little is left of", short, hint)


@check(points=2)
def reach(answers: Answers) -> None:
    """The fast end of each ramp is kept, and the first rise of each step."""
    short = [one for one in _measure_coverage(answers) if not one.reaches]
    if not short:
        return
    needs = {
        "quasi": "The fast samples of a ramp determine kV: without them a little noise changes the "
        "slope of the line.",
        "dynam": "A step contains kA only in its first rise, right after the voltage jumps.",
    }
    hints = dict.fromkeys(needs[one.test[:5]] for one in short)
    raise _refuse_tests("cut off in", short, " ".join(hints))


def _refuse_tests(seen: str, short: list[Coverage], hint: str) -> WrongAnswer:
    """Explain which tests lost samples; the others earn their points."""
    tests = ", ".join(one.test for one in short)
    earned = 2 * (1 - len(short) / len(FOUR_TESTS))
    return WrongAnswer(f"{seen} {tests}", hint=hint, misconception="M-TRIM-PRETTY", earned=earned)


def _read_preparation(answers: Answers) -> Preparation:
    if isinstance(answers.preparation, WrongAnswer):
        raise NotReachedError("checked after all six lines can be read")
    return answers.preparation


def _measure_coverage(answers: Answers) -> tuple[Coverage, ...]:
    """The part of each test that is left, if both stops are cut."""
    _require_stops_cut(answers)
    preparation, variant = _read_preparation(answers), answers.variant
    return measure_coverage(variant.log, preparation, valid=variant.valid, clean=variant.clean)


def _require_stops_cut(answers: Answers) -> None:
    """Refuse answers that do not cut both stops: keeping everything is no choice.

    Raises:
        NotReachedError: a test is kept longer than until its mechanism hits a stop.
    """
    windows = _read_preparation(answers).keep
    for test, (_, end) in answers.variant.reference.keep.items():
        if windows.get(test, (0.0, math.inf))[1] > end + LATE:
            raise NotReachedError("checked after you cut off the two ends at which it hits a stop")


def _find_luck(answers: Answers) -> WrongAnswer | None:
    """Why a right gain would be luck: a stop is kept, or what matters is cut; else None."""
    try:
        if all(one.reaches for one in _measure_coverage(answers)):
            return None
    except NotReachedError:
        return WrongAnswer(
            "you keep a part in which the mechanism hits its stop",
            hint="Look at the last second of each test: where does the velocity fall although the "
            "voltage stays on? Keep what is before",
        )
    return WrongAnswer(
        "a test lost its fast end or its first rise",
        hint="Of a quasistatic test keep the fast end, of a dynamic test the first rise. Cut only "
        "where a test hits its stop",
        misconception="M-TRIM-PRETTY",
    )


def _judge_gain(name: str, answers: Answers) -> None:
    preparation, variant = _read_preparation(answers), answers.variant
    try:
        found = fit_prepared(variant.log, preparation)
    except Refusal:
        says, code = blame(name, variant, preparation)
        seen = "no fit: too little is left of your log"
        raise WrongAnswer(seen, hint=says, misconception=code) from None
    value, asked = found.gains[name], variant.asked[name]
    score = judge_gain(value, asked)
    luck = _find_luck(answers)
    if score == POINTS and luck:
        luck.seen = f"{value:.4g} {asked.unit} is right, but only by luck: {luck.seen}"
        raise luck
    if score == POINTS:
        return
    says, code = blame(name, variant, preparation)
    score = 0.0 if luck else score
    close = "Close. " if score else ""
    raise WrongAnswer(
        f"{value:.4g} {asked.unit} comes out, with an acceleration R² of "
        f"{found.acceleration_r2:.3f}",
        hint=f"{close}{says}",
        misconception=code,
        earned=score,
    )


gains = tuple(
    make_check(
        name, f"The fit of what you kept finds {name}.", partial(_judge_gain, name), points=POINTS
    )
    for name in ("kS", "kV", "kA")
)
