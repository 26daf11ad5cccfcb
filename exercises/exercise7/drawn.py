"""Twelve logs for each learner: some sound, most damaged, each so that its damage can be found."""

from dataclasses import dataclass, replace

import numpy as np

from grader.student_data.draw_cache import cache_generated_data
from grader.student_data.variant import cache_draws, draw_until, make_student_rng
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.errors import Refusal
from sim.core.log import Log
from sim.inspect.contaminate import contaminate
from sim.inspect.detect_faults import inspect
from sim.inspect.fault import LogInterval
from sim.inspect.faults import FAULTS

LOGS = 12
SOUND = (2, 3)  # this many of them are sound: two or three, so that nobody can count them off
RAMP, STEP, TIMEOUT, PERIOD = 1.0, 4.0, 5.0, 0.02  # [V/s], [V], [s], [s]: short logs
GENTLE = 1.8  # [V] a drivetrain's step: four Krakens spin the wheels above 2.2 V
TICKS = 1e6  # [1/s] a .wpilog counts microseconds
SEVERITY = (0.6, 2.0)  # [1] 1 is an ordinary bad day; equally likely per factor
KINDS = ("drivetrain", "shooter", "intake", "turret")  # gravity would look like a fault to many
LESSON = ("encoder-slip", "brownout", "hard-stop", "loop-overrun")  # the four that the lesson names
ALWAYS = ("wheel-slip", "stale-samples")  # what two of the four are taken for
OTHERS = (
    "command-logged",
    "unit-error",
    "sign-flip",
    "mislabelled-test",
    "noisy-standstill",
    "voltage-dropout",
    "stuck-sensor",
)
TWICE = ("encoder-slip", "brownout", "stuck-sensor")  # one of these, and gaps in another test
PLAIN, ORDINARY, WEAK = (1.0, 2.0), SEVERITY, (0.6, 1.0)  # severities of mysteries
SINGLE = tuple((name,) for name in (*LESSON, *ALWAYS, *OTHERS))
PAIRS = tuple((name, "loop-overrun") for name in TWICE)
LEVELS: tuple[tuple[tuple[tuple[str, ...], ...], tuple[float, float]], ...] = (
    (tuple((name,) for name in LESSON), PLAIN),
    (SINGLE, PLAIN),
    ((*SINGLE, (), ()), ORDINARY),
    ((*SINGLE, (), (), *PAIRS), ORDINARY),
    ((*SINGLE, (), (), *PAIRS), WEAK),
)
"""What a mystery of each level may have wrong with it, and how badly."""

NEAR = 0.5  # [shared over covered time] what the bench's own detective must reach


@dataclass(frozen=True, eq=False)
class Damaged:
    """One fault of a log: what it is, and where.

    Args:
        fault: its name.
        where: the damaged parts.
        whole: it spoils whole tests, so that only the tests count.
    """

    fault: str
    where: tuple[LogInterval, ...]
    whole: bool


@dataclass(frozen=True, eq=False)
class Case:
    """One of a learner's logs, and the truth about it.

    Args:
        log: as the learner gets it.
        damage: none, one or two.
    """

    log: Log
    damage: tuple[Damaged, ...]


@cache_draws
@cache_generated_data
def draw(student: str) -> tuple[Case, ...]:
    """A learner's logs, always the same ones."""
    rng = make_student_rng(student, "exercise7")
    return tuple(draw_case(faults, rng) for faults in _plan_faults(rng))


def _plan_faults(rng: np.random.Generator) -> list[tuple[str, ...]]:
    """The faults of each log; the first log has one that the lesson names."""
    first, *lesson = (str(name) for name in rng.permutation(LESSON))
    sound = int(rng.choice(SOUND))
    twice = str(rng.choice(TWICE))
    left = LOGS - len(LESSON) - len(ALWAYS) - sound - 1
    others = (str(name) for name in rng.choice(OTHERS, left, replace=False))
    rest = [(name,) for name in (*lesson, *ALWAYS, *others)]
    rest += [(twice, "loop-overrun"), *[()] * sound]
    return [(first,), *(rest[int(index)] for index in rng.permutation(len(rest)))]


def draw_case(
    faults: tuple[str, ...],
    rng: np.random.Generator,
    *,
    severity: tuple[float, float] = SEVERITY,
) -> Case:
    """A log with these faults, drawn until the bench's own detective finds them and no others.

    Args:
        faults: none, one or two names.
        rng: the source of chance.
        severity: least and largest; 1 is an ordinary bad day.
    """
    return draw_until(lambda _: _draw_log(faults, rng, severity), _is_solvable)


def _draw_log(
    faults: tuple[str, ...], rng: np.random.Generator, bounds: tuple[float, float]
) -> Case | None:
    kinds = ("drivetrain",) if "wheel-slip" in faults else KINDS
    mechanism = MECHANISMS[str(rng.choice(kinds))].draw(rng)
    grips = mechanism.name == "drivetrain" and "wheel-slip" not in faults
    routine = Routine(ramp=RAMP, step=GENTLE if grips else STEP, timeout=TIMEOUT)
    log = simulate(mechanism, routine, rng=rng, period=PERIOD)
    damage: list[Damaged] = []
    for name in faults:
        low, high = bounds
        severity = float(low * (high / low) ** rng.random())
        try:
            spoilt = contaminate(log, name, severity=severity, rng=rng)
        except Refusal:  # it would not show there
            return None
        if len(spoilt.where) > 1 and not FAULTS[name].whole:  # one place is asked for
            return None
        log = spoilt.log
        damage.append(Damaged(name, spoilt.where, FAULTS[name].whole))
    struck = [{part.run for part in one.where} for one in damage]
    if len(struck) > 1 and set.intersection(*struck):
        return None
    return Case(_round_as_written(log), tuple(damage))


def _round_as_written(log: Log) -> Log:
    """The log with its times as the file holds them, so that faults are found in both."""
    runs = (replace(run, time=np.round(run.time * TICKS) / TICKS) for run in log.runs)
    return replace(log, runs=tuple(runs))


def _is_solvable(case: Case) -> bool:
    """Whether the faults, no others, are found in the record, each in its place."""
    found = inspect(case.log)
    if found.is_clean and not case.damage:
        return True
    if {one.fault for one in found.damages} != {one.fault for one in case.damage}:
        return False
    return all(
        any(
            part.overlap(other.where) >= NEAR for other in found.damages if other.fault == one.fault
        )
        for one in case.damage
        for part in one.where
    ) and len(found.damages) == sum(len(one.where) for one in case.damage)
