"""Exercise 9: the gains of a learner's own mechanism, and a function that finds anybody's."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from itertools import permutations
from pathlib import Path

import numpy as np

from grader.answers.asked_number import AskedNumber, Band, ask_gains
from grader.answers.number_answer import judge_number, read_answer_number
from grader.answers.submission import NamedAnswers, read_answers
from grader.answers.wrong_number import AnswerKey
from grader.checks.check import WrongAnswer, check, make_check
from grader.checks.consequence import Consequence
from grader.student_data.student_files import Made, format_log
from grader.student_data.variant import cache_draws, choose, draw_until, make_student_rng
from sim.bench.mechanism import Mechanism
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.log import Log
from sim.core.units import convert_gains, find_unit
from sim.fit import Fit, fit

from .outcome import find_outcome
from .scene import make_columns, make_scene
from .unseen import NAME, RAMP, STEPS, TIMEOUT, USUAL_STEP, judge_function

FILES = ("answers.toml",)
BESIDE = (NAME,)
KINDS = ("drivetrain", "shooter")
PERIOD = 0.02  # [s]

METRICS = ("acceleration_r2", "simulated_velocity_r2")
ANSWER_NAMES = ("kS", "kV", "kA", *METRICS)
PERFECT = "An R² of 1 would mean a model without any error. Write the digits that your fit prints."
PRINTED = "sysid fit --method sysid prints both; its R² are SysId's own."
TEXTBOOK = (
    "Is that the R² of textbooks? SysId's simulated velocity R² is 1 − RMSE / (root mean square of "
    "v), as lesson 7 computes it."
)
METRIC_BANDS = {"acceleration_r2": 0.05, "simulated_velocity_r2": 0.02}  # one way to compute each


@dataclass(frozen=True)
class Variant:
    """One learner's mechanism: the truth about it, its log, and a fit that shows it is solvable."""

    mechanism: Mechanism
    log: Log
    fit: Fit
    asked: Mapping[str, AskedNumber]


@dataclass(frozen=True)
class Answers:
    """The object that the checks read: the answers, and the learner's log."""

    given: Mapping[str, object]
    key: AnswerKey
    variant: Variant
    student: str
    function: Path
    run: bool = True


@cache_draws
def draw(student: str) -> Variant:
    """A learner's mechanism, always the same one; drawn again until SysId's own recipe finds it."""
    return draw_solvable(student, "exercise9", _draw_mechanism)


def _draw_mechanism(rng: np.random.Generator) -> Mechanism:
    return MECHANISMS[choose(KINDS, rng)].draw(rng)


def draw_solvable(
    student: str,
    exercise: str,
    draw_mechanism: Callable[[np.random.Generator], Mechanism],
    *,
    step: float | None = None,
) -> Variant:
    """Draw mechanisms until SysId's own recipe finds the gains of one.

    Args:
        student: for whom.
        exercise: for what: ``exercise9``.
        draw_mechanism: draws one.
        step: [V] of the dynamic tests; None takes what is usual for the mechanism.
    """

    def draw_variant(attempt: int) -> Variant:
        rng = make_student_rng(student, exercise, draw=attempt)
        mechanism = draw_mechanism(rng)
        volts = step or STEPS.get(mechanism.name, USUAL_STEP)
        routine = Routine(ramp=RAMP, step=volts, timeout=TIMEOUT)
        log = simulate(mechanism, routine, rng=rng, period=PERIOD)
        found = fit(log, type=mechanism.type, method="sysid").in_units(mechanism.units)
        unit = find_unit(mechanism.units)
        gains = convert_gains(mechanism.gains, factor=unit.si)
        return Variant(mechanism, log, found, ask_gains(gains, position=unit.symbol))

    return draw_until(draw_variant, _is_solvable, most=100)


def _is_solvable(variant: Variant) -> bool:
    """Whether the fit finds all gains, and no two of them could change places unseen."""
    asked, found = variant.asked, variant.fit.gains
    return all(one.is_right(found[name]) for name, one in asked.items()) and not any(
        one.is_right(other.expected) for one, other in permutations(asked.values(), 2)
    )


def make_files(student: str) -> dict[str, Made]:
    """The learner's log."""
    return dict.fromkeys(("log.wpilog", "log.csv"), format_log(draw(student).log))


def read(path: Path, *, student: str, run: bool = True) -> Answers:
    """The answers, with the learner's log and the right gains.

    Args:
        path: the file with the answers.
        student: whose they are.
        run: whether the learner's function may be run.

    Raises:
        UnreadableFile: the file cannot be read.
    """
    variant = draw(student)
    scene = make_scene(variant.mechanism, variant.log, variant.asked, ramp=RAMP, period=PERIOD)
    return Answers(
        NamedAnswers(read_answers(path)),
        AnswerKey(variant.asked, scene),
        variant,
        student,
        path.with_name(NAME),
        run,
    )


def consequence(answers: Answers) -> Consequence | None:
    """The motion that the learner's gains would cause."""
    of = answers.variant.mechanism
    symbol = find_unit(of.units).symbol
    return find_outcome(answers.given, answers.key.asked, kind=of.name, symbol=symbol)


def _judge_gain(name: str, points: float, answers: Answers) -> str | None:
    """Judge one gain; without a known slip, say how far the learner's model misses the log."""
    try:
        return judge_number(name, answers.given, answers.key, points=points)
    except WrongAnswer as wrong:
        if "outside" in wrong.hint:
            wrong.hint += _describe_miss(answers)
        raise


gain_checks = tuple(
    make_check(name, description, partial(_judge_gain, name, points), points=points)
    for name, description, points in (
        ("kS", "kS, the voltage that friction takes.", 1.0),
        ("kV", "kV, volts for each unit of velocity.", 1.5),
        ("kA", "kA, volts for each unit of acceleration.", 1.5),
    )
)


@check(points=1)
def metrics(answers: Answers) -> None:
    """The acceleration R² and the simulated velocity R² of your fit."""
    wrong: list[WrongAnswer] = []
    for name in METRICS:
        try:
            _check_metric(name, answers)
        except WrongAnswer as why:
            why.seen = f"{name}: {why.seen}"
            wrong.append(why)
    if wrong:
        wrong[0].earned = 1 - len(wrong) / len(METRICS)
        raise wrong[0]


@check(points=5)
def function(answers: Answers) -> str | None:
    """Your own function, on five logs that you have not seen."""
    return judge_function(answers.function, student=answers.student, points=5, run=answers.run)


def explain_r2(value: float, asked: AskedNumber) -> str:
    """The cause of a wrong R²; empty if it is right."""
    if value > 1:
        return "R² is at most 1: write a fraction, not percent."
    if value == 1 and round(asked.expected, 2) < 1:
        return PERFECT
    textbook = 1 - (1 - asked.expected) ** 2  # of the velocity, whose mean is about 0
    off = abs(value - asked.expected)
    if asked.name == METRICS[1] and abs(value - textbook) < off / 2:
        return TEXTBOOK
    return "" if asked.is_right(value) else PRINTED


def _check_metric(name: str, answers: Answers) -> None:
    expected = {one: float(getattr(answers.variant.fit, one)) for one in METRICS}
    asked = {
        one: AskedNumber(one, expected[one], "", Band(0, 0, METRIC_BANDS[one], METRIC_BANDS[one]))
        for one in METRICS
    }
    value = read_answer_number(answers.given.get(name), asked[name])
    hint = explain_r2(value, asked[name])
    (other,) = set(METRICS) - {name}
    if hint and value < 1 and asked[other].is_right(value):
        hint = f"Is that the {other}? Did you swap the two?"
    if hint:
        raise WrongAnswer(f"{value:.4g}", hint=hint, misconception="M-R2")


def _describe_miss(answers: Answers) -> str:
    """The voltage error of the learner's model, compared with that of a good one."""
    variant, asked = answers.variant, answers.key.asked
    try:
        gains = [read_answer_number(answers.given.get(name), one) for name, one in asked.items()]
    except WrongAnswer:
        return ""
    known, voltage = make_columns(variant.log, si=find_unit(variant.mechanism.units).si)
    good = [variant.fit.gains[name] for name in asked]
    with np.errstate(over="ignore"):  # a number may be as large as a file can hold
        mine, best = (
            float(np.sqrt(np.mean((voltage - known @ np.array(g)) ** 2))) for g in (gains, good)
        )
    if not np.isfinite(mine) or mine <= best:  # noise: it says nothing about these gains
        return ""
    return (
        f". With your three gains, the voltage error in the log is {_format_volts(mine)} (RMS); "
        f"with a good fit it is {_format_volts(best)}"
    )


def _format_volts(value: float) -> str:
    """Two digits, and no powers of ten: a learner reads this."""
    return f"{value:.2g} V" if value < 10.0 else f"{value:.0f} V"
