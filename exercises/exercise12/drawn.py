"""A learner's own mechanism and what is hidden in it: three logs, and the truth about them."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from grader.student_data.draw_cache import cache_generated_data
from grader.student_data.variant import cache_draws, choose, draw_until, make_student_rng
from sim.bench.mechanism import Mechanism
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.errors import BadRequest
from sim.core.log import Log
from sim.physics.effects import list_look_alikes
from sim.physics.model import Part
from sim.reconcile.by_hand import HandSearch

Recipe = tuple[str, tuple[tuple[str, float], ...]]  # a mechanism; its effects with their sizes

FOUR = ("quasistatic", "dynamic")
HIDDEN: tuple[Recipe, ...] = (
    ("drivetrain", (("velocity-filter", 1.5),)),
    ("drivetrain", (("cogging", 1.2),)),
    ("drivetrain", (("velocity-filter", 1.5), ("stribeck", 0.8))),
    ("drivetrain", (("asymmetric-back-emf", 1.2), ("drag", 0.8))),
    ("drivetrain", (("velocity-filter", 0.8), ("cogging", 0.6))),
    ("drivetrain", (("velocity-filter", 1.5), ("drag", 0.8), ("stribeck", 0.6))),
    ("drivetrain", (("compliance", 1.0),)),
    ("drivetrain", (("backlash", 1.5),)),
    ("drivetrain", (("velocity-filter", 0.8), ("deadband", 1.5))),
    ("drivetrain", (("velocity-scale", 1.2), ("stribeck", 1.0))),
    ("drivetrain", (("heating", 2.0),)),
    ("drivetrain", (("wheel-slip", 1.0),)),
    ("shooter", (("velocity-filter", 2.0), ("drag", 1.0))),
    ("shooter", (("asymmetric-back-emf", 1.2), ("drag", 0.8))),
    ("shooter", (("voltage-limit", 1.5), ("drag", 1.0))),
    ("shooter", (("current-limit", 1.5), ("velocity-filter", 1.0))),
    ("shooter", (("drag", 1.0), ("battery-sag", 1.0))),
    ("turret", (("spring", 1.0),)),
    ("turret", (("compliance", 1.0),)),
    ("turret", (("backlash", 1.0),)),
    ("turret", (("velocity-filter", 0.5), ("cogging", 1.0))),
    ("turret", (("gravity-cosine", 1.0), ("stribeck", 1.0))),
)
"""Mechanism, and its effects with their sizes. In each of them the first effect alone narrows the
gap more than any other of the catalogue alone does, and all of them together bring it to the noise.
"""

SIZES = (0.9, 1.1)  # [1] by which a size differs from learner to learner
TESTS = {  # ramp [V/s] and step [V] of the log and of the validation, step [V] of the held-out log
    "drivetrain": ((0.5, 3.5), (0.5, 2.5), 3.0),
    "shooter": ((0.5, 3.5), (1.0, 6.0), 5.0),
    "turret": ((0.5, 3.5), (0.5, 2.5), 3.0),
}
"""The drivetrain's steps are below what 120 A in the stator let through (3.9 V from rest). The
shooter's of 5 and 6 V are not: their first moments are cut, and the log holds what was applied.
120 A is the default of CurrentLimitsConfigs in https://pypi.org/project/phoenix6/26.3.0/.
"""

FLOOR = 1.3  # [of the gap that the truth leaves on the held-out log] for full marks
SNUG = 0.9  # [of FLOOR] within which the fit of the right effects must be
MISSED = 1.07  # [of a gap] by which it is wider without an effect, or with a look-alike
SEEN = 1.08  # [noises] of a gap in which something is visibly missing
CLEAR = 1.15  # [1] by which the gap without the first effect is wider than without any other
SEARCHES_KEPT = 4  # while this runs: a search takes some megabytes
TIMEOUT = 8.0  # [s] of a test of the validation and of the held-out log


@dataclass(frozen=True, eq=False)  # so that it can be a key of a cache
class Variant:
    """One learner's mechanism.

    Args:
        mechanism: with all that is hidden in it.
        log: the four tests, to fit.
        validation: other runs, to choose effects by.
        held_out: more runs, to show the gap on and nothing else.
    """

    mechanism: Mechanism
    log: Log
    validation: Log
    held_out: Log

    @property
    def hidden(self) -> tuple[str, ...]:
        """The effects that are hidden, the one that matters most first."""
        return tuple(part.effect for part in self.mechanism.hidden)


@lru_cache(maxsize=SEARCHES_KEPT)
def make_search(variant: Variant) -> HandSearch:
    """The search for effects in its logs, whose gaps are those of ``sysid reconcile``.

    What does not depend on an answer is fitted once.
    """
    return HandSearch(variant.log, validation=variant.validation, held_out=variant.held_out)


@cache_draws
@cache_generated_data
def draw(student: str) -> Variant:
    """A learner's mechanism, always the same one."""
    return draw_solvable(make_student_rng(student, "exercise12"), HIDDEN)


def draw_solvable(rng: np.random.Generator, among: Sequence[Recipe]) -> Variant:
    """A mechanism whose hidden effects its logs determine.

    Args:
        rng: the source of chance.
        among: what may be hidden, as in ``HIDDEN``.
    """
    return draw_until(lambda _: draw_recipe(rng, among), is_solvable, most=50)


def is_solvable(variant: Variant) -> bool:
    """Whether a fit passes, and the gap widens without each effect, most without the first.

    Alone, the first must also narrow the gap more than any effect that looks like it: a learner
    adds the one that narrows it most.
    """
    search, truth = make_search(variant), variant.mechanism.model
    tried = search.fit(variant.hidden)
    found = search.fit_gains(tried.structure.model(tried.values).parts)  # as it is graded
    floor = max(1.0, search.measure_gap(search.evaluate_model(truth), "held_out"))
    if search.measure_gap(found, "held_out") > SNUG * FLOOR * floor:
        return False

    def measure_gap_alone(effect: str) -> float:
        try:
            return search.measure_gap(search.fit([effect]))
        except BadRequest:  # nothing in the log looks like it
            return math.inf

    first = variant.hidden[0]
    if min(map(measure_gap_alone, list_look_alikes(first))) < MISSED * measure_gap_alone(first):
        return False

    def measure_gap_with(*parts: Part) -> float:
        return search.measure_gap(search.fit_near(replace(truth, parts=parts)))

    without = [measure_gap_with(*(o for o in truth.parts if o is not part)) for part in truth.parts]
    least = max(MISSED * search.measure_gap(found), SEEN)
    return min(without) >= least and without[0] >= CLEAR * max(without[1:], default=0.0)


def draw_recipe(rng: np.random.Generator, among: Sequence[Recipe]) -> Variant:
    """A random mechanism of one of the recipes, and its logs."""
    kind, effects = choose(among, rng)
    mechanism = MECHANISMS[kind].draw(rng)
    for effect, size in effects:
        mechanism = mechanism.hide(effect, size * float(rng.uniform(*SIZES)))
    (ramp, step), (other_ramp, other_step), held_out = TESTS[kind]
    routines = (
        Routine(ramp=ramp, step=step, kinds=FOUR),
        Routine(other_ramp, other_step, timeout=TIMEOUT, kinds=(*FOUR, "multistep")),
        Routine(step=held_out, timeout=TIMEOUT, kinds=("coast", "triangle", "chirp")),
    )
    return Variant(mechanism, *(simulate(mechanism, routine, rng=rng) for routine in routines))
