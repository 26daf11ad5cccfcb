"""Exercise 9: the gains of a learner's own mechanism, and a function that finds anybody's."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from grader.answers.number_answer import (
    AnswerKey,
    AskedNumber,
    Band,
    ask_gains,
    judge_number,
    read_answer_number,
)
from grader.answers.submission import read_answers
from grader.check import WrongAnswer, check
from grader.consequence import Consequence
from grader.student_data.student_files import format_log, write_student_files
from grader.student_data.variant import derive_student_seed, make_student_rng

from .outcome import outcome
from .scene import columns, scene
from .unseen import NAME, RAMP, STEPS, TIMEOUT, USUAL_STEP, judge_function

if TYPE_CHECKING:
    import numpy as np

    from sim.bench.mechanism import Mechanism
    from sim.core.log import Log
    from sim.fit import Fit

FILES = ("answers.toml",)
BESIDE = (NAME,)
FILES_MADE = ("log.wpilog", "log.csv")
HERE = Path(__file__).resolve().parent

KINDS = ("drivetrain", "shooter")
PERIOD = 0.02  # [s]
REMEMBERED = 32  # learners whose logs are kept while this runs: it takes time to draw one
MOST_DRAWS = 100  # so many mechanisms in a row that cannot be fitted would be our fault

METRICS = ("acceleration_r2", "simulated_velocity_r2")
ANSWER_NAMES = ("kS", "kV", "kA", *METRICS)
PERFECT = "An R² of 1 would mean a model without any error. Write the digits that your fit prints."
METRIC_BANDS = {"acceleration_r2": 0.05, "simulated_velocity_r2": 0.02}  # one way to compute each


@dataclass(frozen=True)
class Variant:
    """One learner's mechanism: the truth about it, its log, and a fit that shows it is solvable."""

    mechanism: "Mechanism"
    log: "Log"
    fit: "Fit"
    asked: Mapping[str, AskedNumber]


@dataclass(frozen=True)
class Answers:
    """What the checks look at."""

    given: Mapping[str, object]
    key: AnswerKey
    variant: Variant
    student: str
    function: Path
    run: bool = True


def draw(student: str) -> Variant:
    """A learner's mechanism, always the same one; drawn again until SysId's own recipe finds it."""
    return _drawn(student, derive_student_seed(student, "exercise9"))


@lru_cache(maxsize=REMEMBERED)
def _drawn(student: str, _seed: int) -> Variant:
    return draw_solvable(student, "exercise9", _draw_mechanism)


def _draw_mechanism(rng: "np.random.Generator") -> "Mechanism":
    from sim.bench.mechanisms import MECHANISMS  # noqa: PLC0415 - numpy only where it is needed

    return MECHANISMS[KINDS[int(rng.integers(len(KINDS)))]].draw(rng)


def draw_solvable(
    student: str,
    exercise: str,
    draw_mechanism: "Callable[[np.random.Generator], Mechanism]",
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
    from sim.bench.routine import Routine  # noqa: PLC0415 - the same
    from sim.bench.simulate import simulate  # noqa: PLC0415 - the same
    from sim.core.units import convert_gains, find_unit  # noqa: PLC0415 - the same
    from sim.fit import fit  # noqa: PLC0415 - numpy only where it is needed

    for attempt in range(MOST_DRAWS):
        rng = make_student_rng(student, exercise, draw=attempt)
        mechanism = draw_mechanism(rng)
        volts = step or STEPS.get(mechanism.name, USUAL_STEP)
        routine = Routine(ramp=RAMP, step=volts, timeout=TIMEOUT)
        log = simulate(mechanism, routine, rng=rng, period=PERIOD)
        found = fit(log, type=mechanism.type, method="sysid").in_units(mechanism.units)
        per = find_unit(mechanism.units)
        gains = convert_gains(mechanism.gains, factor=per.si)
        asked = ask_gains(gains, position=per.symbol)
        found_all = all(one.is_right(found.gains[name]) for name, one in asked.items())
        if found_all and not _alike(asked):
            return Variant(mechanism, log, found, asked)
    raise RuntimeError(f"no solvable mechanism for {student!r}")


def _alike(asked: Mapping[str, AskedNumber]) -> bool:
    """Whether two gains could change places unseen."""
    return any(
        one.is_right(other.expected)
        for one in asked.values()
        for other in asked.values()
        if one is not other
    )


def prepare(student: str, *, say: Callable[[str], None]) -> None:
    """Make the learner's log, where it is not there as it was made."""
    made = dict.fromkeys(FILES_MADE, format_log(draw(student).log))
    write_student_files(made, exercise=HERE, student=student, what="log", say=say)


def read(path: Path, *, student: str, run: bool = True) -> Answers:
    """The answers, and what they are held against.

    Args:
        path: the file with the answers.
        student: whose they are.
        run: whether the learner's function may be run.

    Raises:
        UnreadableFile: the file cannot be read.
    """
    given = {name.lower(): value for name, value in read_answers(path).items()}
    variant = draw(student)
    names = (*variant.asked, *METRICS)
    around = scene(variant.mechanism, variant.log, variant.asked, ramp=RAMP, period=PERIOD)
    return Answers(
        {name: given.get(name.lower()) for name in names},
        AnswerKey(variant.asked, around),
        variant,
        student,
        path.with_name(NAME),
        run,
    )


def consequence(answers: Answers) -> Consequence | None:
    """What the learner's gains would do on their mechanism."""
    from sim.core.units import find_unit  # noqa: PLC0415 - numpy only where it is needed

    of = answers.variant.mechanism
    symbol = find_unit(of.units).symbol
    return outcome(answers.given, answers.key.asked, kind=of.name, symbol=symbol)


@check(points=1)
def ks(answers: Answers) -> str | None:
    """kS, the voltage that friction takes."""
    return _gain("kS", answers, points=1)


@check(points=1.5)
def kv(answers: Answers) -> str | None:
    """kV, volts for each unit of velocity."""
    return _gain("kV", answers, points=1.5)


@check(points=1.5)
def ka(answers: Answers) -> str | None:
    """kA, volts for each unit of acceleration."""
    return _gain("kA", answers, points=1.5)


@check(points=1)
def metrics(answers: Answers) -> None:
    """The acceleration R² and the simulated velocity R² of your fit."""
    wrong: list[WrongAnswer] = []
    for name in METRICS:
        try:
            _metric(name, answers)
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


def is_measured_r2(value: float, asked: AskedNumber) -> bool:
    """Whether an R² is right: near the expected one, and 1 only where two digits make it 1."""
    return asked.is_right(value) and (value < 1 or round(asked.expected, 2) >= 1)


def _metric(name: str, answers: Answers) -> None:
    expected = {one: float(getattr(answers.variant.fit, one)) for one in METRICS}
    asked = {
        one: AskedNumber(one, expected[one], "", Band(0, 0, METRIC_BANDS[one], METRIC_BANDS[one]))
        for one in METRICS
    }
    value = read_answer_number(answers.given[name], asked[name])
    if is_measured_r2(value, asked[name]):
        return
    (other,) = set(METRICS) - {name}
    if value > 1:
        hint = "R² is at most 1: write a fraction, not percent."
    elif value == 1:
        hint = PERFECT
    elif asked[other].is_right(value):
        hint = f"That is the {other}. Did you swap the two?"
    else:
        hint = "sysid fit --method sysid prints both; its R² are SysId's own."
    raise WrongAnswer(f"{value:.4g}", hint=hint, misconception="M-R2")


def _gain(name: str, answers: Answers, *, points: float) -> str | None:
    """Judge one gain; where no slip explains it, say how far the three miss the log."""
    try:
        return judge_number(name, answers.given, answers.key, points=points)
    except WrongAnswer as wrong:
        if "outside" in wrong.hint:
            wrong.hint += _missed(answers)
        raise


def _missed(answers: Answers) -> str:
    """How far the learner's model misses the voltage in the log, beside how far a good one does."""
    import numpy as np  # noqa: PLC0415 - numpy only where it is needed

    from sim.core.units import find_unit  # noqa: PLC0415 - the same

    try:
        gains = [
            read_answer_number(answers.given[name], one) for name, one in answers.key.asked.items()
        ]
    except WrongAnswer:
        return ""
    known, voltage = columns(answers.variant.log, si=find_unit(answers.variant.mechanism.units).si)
    good = [answers.variant.fit.gains[name] for name in answers.key.asked]
    with np.errstate(over="ignore"):  # a number may be as large as a file can hold
        mine, best = (
            float(np.sqrt(np.mean((voltage - known @ np.array(g)) ** 2))) for g in (gains, good)
        )
    if not np.isfinite(mine) or mine <= best:  # noise: it says nothing about these gains
        return ""
    return (
        f". With your three gains, the voltage error in the log is {_volts(mine)} (RMS); with a "
        f"good fit it is {_volts(best)}"
    )


def _volts(value: float) -> str:
    """Two digits, and no powers of ten: a learner reads this."""
    return f"{value:.2g} V" if value < 10.0 else f"{value:.0f} V"
