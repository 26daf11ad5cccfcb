"""The learner's own function, tried on five hidden logs.

It runs apart (``grader.isolation``): it gets the columns of each log, and returns three numbers.
"""

import tempfile
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

import numpy as np

from grader.answers.asked_number import AskedNumber, ask_gains
from grader.answers.number_answer import UNIT_ASSUMED, diagnose_number, judge_number
from grader.answers.submission import read_text
from grader.answers.wrong_number import AnswerKey
from grader.checks.check import NotReachedError, NotRunError, WrongAnswer
from grader.isolation import CallResult, FunctionCall, Limits, SandboxOutcome, run_functions
from grader.student_data.variant import (
    cache_draws,
    derive_student_seed,
    draw_until,
    make_student_rng,
)
from sim.bench.mechanism import Mechanism
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.log import Array, Log
from sim.core.units import convert_gains, find_unit

from .scene import ASSUMED, USUAL, make_columns, make_scene

NAME, FUNCTION = "fit.py", "fit"
RAMP, TIMEOUT = 0.5, 10.0  # [V/s], [s]
USUAL_STEP = 3.5  # [V]
STEPS = {"drivetrain": 1.8}  # [V] other than usual: four Krakens spin the wheels above 2.2 V
SECONDS = 10.0  # for all five; the solution takes a tenth of one
ROOM = 0.6  # [share of the band] an honest fit stays within: there are many honest ways to fit
FOUR_STEPS = (
    "Check four steps: take the tests one by one, divide by the difference of the times, leave out "
    "the rows that stand still, and put the noisiest column on the left side of the fit"
)
REMEMBERED = 32  # answers whose numbers are kept, for a file that is graded again as it was
PRINTED = 120  # [characters] of a learner's own prints that are shown


@dataclass(frozen=True)
class Recipe:
    """The settings of one hidden log, and its purpose.

    Args:
        kind: the mechanism.
        period: [s] between two samples.
        noise: times the ordinary noise of the velocity.
        without: a test that was not run.
        note: what to look at if nothing else explains a wrong number.
        misconception: its code, or empty.
    """

    kind: str
    period: float
    noise: float
    without: str = ""
    note: str = ""
    misconception: str = ""

    @property
    def noisy(self) -> bool:
        """Whether a fit that explains the voltage must fail here."""
        return self.noise > 1.0


RECIPES = (
    Recipe("drivetrain", 0.02, 1.0),
    Recipe("intake", 0.005, 1.0, note="Its samples are 0.005 s apart, not 0.02 s"),
    Recipe(
        "turret",
        0.02,
        3.0,
        note=(
            "Its velocity is noisy: which quantity is on the left side of your fit, and in "
            "which rows does it stand still"
        ),
        misconception="M-NOISE-AVERAGES",
    ),
    Recipe("shooter", 0.008, 0.5, note="Its samples are 0.008 s apart, not 0.02 s"),
    Recipe(
        "drivetrain",
        0.01,
        0.7,
        without="quasistatic-forward",
        note=(
            "Its quasistatic-forward test is missing. The other three are enough: use them all; "
            "loop over the tests that the log has"
        ),
    ),
)


@dataclass(frozen=True)
class Hidden:
    """One hidden log, and its right gains."""

    recipe: Recipe
    data: Mapping[str, Array]
    key: AnswerKey


@cache_draws
def draw_hidden(student: str) -> tuple[Hidden, ...]:
    """The five logs of a learner."""
    return tuple(_draw_log(student, number, one) for number, one in enumerate(RECIPES, start=1))


def _draw_log(student: str, number: int, recipe: Recipe) -> Hidden:
    unit = find_unit(MECHANISMS[recipe.kind].units)
    routine = Routine(ramp=RAMP, step=STEPS.get(recipe.kind, USUAL_STEP), timeout=TIMEOUT)

    def draw(attempt: int) -> tuple[Mechanism, Log, dict[str, AskedNumber]]:
        rng = make_student_rng(student, f"exercise9, log {number}", draw=attempt)
        built = MECHANISMS[recipe.kind].draw(rng)
        noise = built.sensor.velocity_noise * recipe.noise
        built = replace(built, sensor=replace(built.sensor, velocity_noise=noise))
        log = simulate(built, routine, rng=rng, period=recipe.period)
        log = replace(log, runs=tuple(run for run in log.runs if run.test != recipe.without))
        gains = convert_gains(built.gains, factor=unit.si)
        return built, log, ask_gains(gains, position=unit.symbol)

    built, log, asked = draw_until(
        draw, lambda drawn: _is_fair(*drawn[1:], si=unit.si, noisy=recipe.noisy), most=100
    )
    scene = make_scene(built, log, asked, ramp=RAMP, period=recipe.period)
    scene = replace(scene, computed=True)  # a function knows only the log
    return Hidden(recipe, _make_table(log, si=unit.si), AnswerKey(asked, scene))


def _is_fair(log: Log, asked: Mapping[str, AskedNumber], *, si: float, noisy: bool) -> bool:
    """Whether an honest fit finds the gains with room to spare, and the naive one does not."""
    known, voltage = make_columns(log, si=si)
    naive, *_ = np.linalg.lstsq(known, voltage, rcond=None)
    sign, v, a = known.T
    (alpha, beta, gamma), *_ = np.linalg.lstsq(np.column_stack((v, voltage, sign)), a, rcond=None)
    honest = (-gamma / beta, -alpha / beta, 1.0 / beta)
    room = all(
        abs(value - one.expected) <= ROOM * one.band.widths(one.expected)[0]
        for value, one in zip(honest, asked.values(), strict=True)
    )
    caught = not all(map(AskedNumber.is_right, asked.values(), naive.tolist()))
    return room and (caught or not noisy)


def _make_table(log: Log, *, si: float) -> dict[str, Array]:
    """The columns of ``log.csv``, all tests one after another."""
    runs = log.runs
    return {
        "time": np.concatenate([run.time for run in runs]),
        "voltage": np.concatenate([run.voltage for run in runs]),
        "position": np.concatenate([run.position / si for run in runs]),
        "velocity": np.concatenate([run.velocity / si for run in runs]),
        "test": np.concatenate([np.full(len(run), run.test) for run in runs]),
    }


@lru_cache(maxsize=REMEMBERED)
def _run_function(text: bytes, student: str, _seed: int) -> SandboxOutcome:
    """Run a function on all five logs; the same text gives the same numbers."""
    calls = [FunctionCall(FUNCTION, one.data) for one in draw_hidden(student)]
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder, NAME)
        source.write_bytes(text)
        return run_functions(source, calls=calls, limits=Limits(seconds=SECONDS))


def judge_function(path: Path, *, student: str, points: float, run: bool) -> str | None:
    """Try the function on the five logs.

    Args:
        path: the learner's file.
        student: whose.
        points: for all five.
        run: whether it may be run.

    Returns:
        What it printed, if it did.

    Raises:
        WrongAnswer: at least one log came out wrong; what may be behind it.
        NotReachedError: there is no file.
        NotRunError: there is one, and it may not be run.
    """
    if not path.is_file():
        raise NotReachedError(
            f"there is no {NAME} next to your answers; copy it from the exercise's folder"
        )
    text = read_text(path).encode()
    if not run:
        raise NotRunError(
            f"not run: this machine runs no code of students, and the grader cannot judge {NAME} "
            "by reading it"
        )
    of = derive_student_seed(student, "exercise9")
    logs, outcome = draw_hidden(student), _run_function(text, student, of)
    wrong = [found for found in map(_judge_log, logs, outcome.answers) if found]
    same = _explain_same_gains([answer.numbers for answer in outcome.answers])
    printed = _format_print(outcome.printed)
    if not wrong:
        return printed or None
    told = same or _choose_feedback(wrong)
    right = len(logs) - len(wrong)
    told.seen = f"{right} of {len(logs)} logs right; {told.seen}"
    told.hint += f". {printed}" if printed else ""
    told.earned = points * right / len(logs)
    raise told


def _explain_same_gains(returned: Sequence[Mapping[str, float]]) -> WrongAnswer | None:
    """Feedback on a function that returns the same gains for every log; else None."""
    if not returned[0] or any(numbers != returned[0] for numbers in returned):
        return None
    return WrongAnswer(
        "the same gains for every log",
        hint="Each log is of another mechanism. Compute the gains from the columns that your "
        "function gets",
    )


@dataclass(frozen=True)
class Miss:
    """One wrong number of one log.

    Args:
        log: which.
        why: what is said about it.
        judged: whether there was a number at all.
        slips: what would explain it.
    """

    log: Hidden
    why: WrongAnswer
    judged: bool = False
    slips: frozenset[str] = frozenset()


def _choose_feedback(wrong: Sequence[Sequence[Miss]]) -> WrongAnswer:
    """The feedback to give: the slip that explains most logs, else the first fault."""
    logs = Counter(slip for log in wrong for slip in {slip for one in log for slip in one.slips})
    misses = [miss for log in wrong for miss in log]
    often = [slip for slip, count in logs.most_common() if count > 1 or len(wrong) == 1]
    if often:  # a slip that fits one of many is chance
        named = [miss for miss in misses if often[0] in miss.slips]
        return min(named, key=lambda miss: len(miss.slips)).why
    told, recipe = misses[0], misses[0].log.recipe
    if told.judged and recipe.note:
        verdict = told.why.hint if told.why.hint.startswith(("outside", "close")) else ""
        told.why.hint = ". ".join(part for part in (verdict, recipe.note) if part)
        if len(wrong) == 1:  # it is this log's own difficulty
            told.why.misconception = recipe.misconception
    elif told.judged and told.why.hint:
        told.why.hint += f"{'' if told.why.hint.endswith(('.', '?')) else '.'} {FOUR_STEPS}"
    return told.why


def _judge_log(log: Hidden, answer: CallResult) -> list[Miss]:
    """The faults of the numbers for one log."""
    where = f"{log.recipe.kind}, every {log.recipe.period:g} s"
    if answer.reason:
        hint = "Try it on your own log first: python exercises/exercise9/fit.py"
        return [Miss(log, WrongAnswer(f"{where}: {answer.reason}", hint=hint))]
    misses = (_judge_gain(name, log, answer) for name in log.key.asked)
    found = [miss for miss in misses if miss]
    for miss in found:
        miss.why.seen = f"{where}: {miss.why.seen.partition(UNIT_ASSUMED)[0]}"
    return found


def _judge_gain(name: str, log: Hidden, answer: CallResult) -> Miss | None:
    if name in answer.refused:
        hint = f"Return one number for {name}: float(...) makes one of a single value"
        if answer.refused[name] == "None":
            hint = f"Your function does not find {name} yet: it returns None"
        return Miss(log, WrongAnswer(f"{name} = {answer.refused[name]}", hint=hint))
    if name not in answer.numbers:
        listed = ", ".join((*answer.numbers, *answer.refused)) or "nothing"
        hint = 'Return all three under these names: {"kS": ..., "kV": ..., "kA": ...}'
        return Miss(log, WrongAnswer(f"no {name}; your function returned {listed}", hint=hint))
    one, value, period = log.key.asked[name], answer.numbers.get(name), log.recipe.period
    # a kA of 0.02 s is too large by as much as samples are closer
    if value and name == "kA" and period != USUAL and one.is_right(value * period / USUAL):
        why = WrongAnswer(f"{name} = {value:.4g} {one.unit}", hint=ASSUMED.says)
        return Miss(log, why, judged=True, slips=frozenset({ASSUMED.code}))
    try:
        judge_number(name, answer.numbers, log.key, points=0.0)
    except WrongAnswer as why:
        why.seen = f"{name} = {why.seen}"
        slips = diagnose_number(name, answer.numbers, log.key)
        judged = answer.numbers.get(name) is not None
        return Miss(log, why, judged=judged, slips=frozenset(slip.code for slip in slips))
    return None


def _format_print(text: str) -> str:
    """The printed text, shortened to one line."""
    line = " ".join(text.split())
    short = line if len(line) <= PRINTED else f"{line[:PRINTED]}…"
    return f"It printed: {short}" if line else ""
