"""A log for each learner, damaged so that it can be mended, and in no other way than by looking."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from grader.answers.asked_number import AskedNumber, ask_gains
from grader.student_data.draw_cache import cache_generated_data
from grader.student_data.variant import cache_draws, draw_until, make_student_rng
from sim.bench.mechanism import Mechanism
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.errors import Refusal
from sim.core.log import Array, Log
from sim.core.units import convert_gains, find_unit
from sim.inspect.contaminate import contaminate
from sim.inspect.log_features import Flags

from .coverage import measure_coverage
from .damage import add_hard_stops, add_spikes, find_valid_samples, measure_noise_at_rest
from .preparation import LONGEST, POINTS, Preparation, sum_points

RAMP, STEP, TIMEOUT, PERIOD = 0.5, 4.0, 8.0, 0.02  # [V/s], [V], [s], [s]
STEPS = {"drivetrain": 1.8}  # [V] other than usual: four Krakens spin the wheels above 2.2 V
TREMBLES = {  # [severity] of the noise at rest; a shooter's kS is too small to be told from it
    "drivetrain": (0.8, 1.2),  # 5 to 7 % of the top speed
    "turret": (0.35, 0.6),  # 2 to 4 %; it stands longer before it moves, so that less does as much
}

MEDIAN = 3  # [samples] is enough for spikes of one
ABOVE = 3.5  # [times the noise at rest] is a threshold that none of it passes
EARLY = 0.05  # [s] before the impact a careful person cuts
EARLIER = (0.0, 0.2)  # [s] and so much earlier others do; all of these must find the gains
ROUGHLY = (0.55, 1.0, 1.2)  # [times the threshold] that others choose, down to what just passes
BETWEEN = tuple(0.575 + 0.025 * step for step in range(18))  # [times the threshold] all of these
NOTHING = Preparation({}, 0.0, 1)
LACKING: tuple[tuple[str, dict[str, Any]], ...] = (  # what must cost a gain to leave out, or overdo
    ("kA", {"keep": {}}),
    ("kS", {"threshold": 0.0}),
    ("kA", {"median": 1}),
    ("kA", {"median": 15}),
)
SURELY = 1.3  # [times the bands] even if they were this much wider
SNUG = 0.9  # [times the bands] what is right must be so even if they were this much narrower
NEARLY = 0.98  # [times the bands] the same, for thresholds between two that were tried


@dataclass(frozen=True, eq=False)
class Variant:
    """One learner's log, with its true gains and its damage.

    Args:
        mechanism: the truth.
        log: as the learner gets it.
        asked: the gains that a fit ought to find.
        valid: per test, (n,) whether a sample tells of the mechanism: it moves, unharmed.
        clean: per test, (n,) [m/s or rad/s], the velocity without noise at rest and spikes.
        reference: a preparation that earns everything.
    """

    mechanism: Mechanism
    log: Log
    asked: dict[str, AskedNumber]
    valid: dict[str, Flags]
    clean: dict[str, Array]
    reference: Preparation


@cache_draws
@cache_generated_data
def draw(student: str) -> Variant:
    """A learner's log, always the same one."""
    rng = make_student_rng(student, "exercise8")
    kind = str(rng.choice(tuple(TREMBLES)))
    return draw_until(lambda _: _draw_variant(kind, rng), _is_solvable)


def _draw_variant(kind: str, rng: np.random.Generator) -> Variant | None:
    mechanism = MECHANISMS[kind].draw(rng)
    routine = Routine(ramp=RAMP, step=STEPS.get(kind, STEP), timeout=TIMEOUT)
    severity = float(rng.uniform(*TREMBLES[kind]))
    try:
        log, impacts = add_hard_stops(simulate(mechanism, routine, rng=rng, period=PERIOD), rng=rng)
        clean = {run.test: run.velocity for run in log.runs}
        trembles = contaminate(log, "noisy-standstill", severity=severity, rng=rng)
    except Refusal:  # it would not show there
        return None
    if any(len(one) != len(other) for one, other in zip(log.runs, trembles.log.runs, strict=True)):
        return None  # it hardly stands before it moves
    rests = {one.test: one.end for one in trembles.where}
    valid = {run.test: find_valid_samples(run, impacts, rests) for run in log.runs}
    spiky = tuple(
        add_spikes(run, valid[run.test], impacts.get(run.test), rng) for run in trembles.log.runs
    )
    unit = find_unit(mechanism.units)
    return Variant(
        mechanism,
        replace(log, runs=spiky),
        ask_gains(convert_gains(mechanism.gains, factor=unit.si), position=unit.symbol),
        valid,
        clean,
        Preparation(
            {test: (0.0, at - EARLY) for test, at in impacts.items()},
            ABOVE * measure_noise_at_rest(spiky, rests),
            MEDIAN,
        ),
    )


def _is_solvable(variant: Variant) -> bool:
    """Whether rough cuts earn all points, and none do without cut, threshold or median."""
    log, asked, reference = variant.log, variant.asked, variant.reference
    full = POINTS * len(asked)
    if (
        sum_points(log, reference, asked, wider=SNUG) < full
        or sum_points(log, NOTHING, asked) >= full / 2
    ):
        return False
    by_eye = [_cut_earlier(reference, early, times) for early in EARLIER for times in ROUGHLY]
    remaining = measure_coverage(log, by_eye[-1], valid=variant.valid, clean=variant.clean)
    return (
        all(part.enough and part.reaches for part in remaining)
        and all(sum_points(log, one, asked) == full for one in by_eye)
        and all(
            sum_points(log, _cut_earlier(reference, EARLIER[1] / 2, times), asked, wider=NEARLY)
            == full
            for times in BETWEEN
        )
        and all(
            sum_points(log, replace(one, **part), {gain: asked[gain]}, wider=SURELY) < POINTS
            for one in by_eye
            for gain, part in LACKING
        )
        and all(
            sum_points(log, Preparation({}, threshold, median), asked) < full
            for threshold in (0.0, reference.threshold)
            for median in range(1, LONGEST + 1, 2)  # a filter alone never is enough
        )
    )


def _cut_earlier(reference: Preparation, early: float, times: float) -> Preparation:
    """The reference preparation, with earlier cuts [s] and a multiple of its threshold."""
    keep = {test: (begin, end - early) for test, (begin, end) in reference.keep.items()}
    return replace(reference, keep=keep, threshold=times * reference.threshold)
