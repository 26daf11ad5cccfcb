"""A learner's own mechanism and what is hidden in it: three logs, and the truth about them."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from grader.student_data.draw_cache import cache_generated_data
from grader.student_data.variant import cache_draws, make_student_rng

from .gap import gap, noise, with_effects

if TYPE_CHECKING:
    import numpy as np

    from sim.bench.mechanism import Mechanism
    from sim.core.log import Log

Recipe = tuple[str, tuple[tuple[str, float], ...]]  # a mechanism; its effects with their sizes

FOUR = ("quasistatic", "dynamic")
HIDDEN: tuple[Recipe, ...] = (
    ("drivetrain", (("velocity-filter", 1.5),)),
    ("drivetrain", (("cogging", 1.2),)),
    ("drivetrain", (("velocity-filter", 1.5), ("stribeck", 0.8))),
    ("drivetrain", (("asymmetric-back-emf", 1.2), ("drag", 0.8))),
    ("drivetrain", (("cogging", 1.2), ("velocity-filter", 0.8))),
    ("drivetrain", (("velocity-filter", 1.5), ("drag", 0.8), ("stribeck", 0.6))),
    ("drivetrain", (("asymmetric-back-emf", 1.2), ("drag", 1.2), ("stribeck", 0.6))),
    ("shooter", (("velocity-filter", 2.0),)),
    ("shooter", (("velocity-filter", 2.0), ("drag", 1.0))),
    ("shooter", (("asymmetric-back-emf", 1.2), ("drag", 0.8))),
)
"""Mechanism, and its effects with their sizes. In each of them the first effect alone narrows the
gap more than any other of the catalogue alone does, and all of them together bring it to the noise.
"""

SIZES = (0.9, 1.1)  # [1] by which a size differs from learner to learner
TESTS = {  # ramp [V/s] and step [V] of the log and of the validation, step [V] of the held-out log
    "drivetrain": ((0.5, 3.5), (0.5, 2.5), 3.0),
    "shooter": ((0.5, 3.5), (1.0, 6.0), 5.0),
}
"""The drivetrain's steps are below what 120 A in the stator let through (3.9 V from rest). The
shooter's of 5 and 6 V are not: their first moments are cut, and the log holds what was applied.
120 A is the default of CurrentLimitsConfigs in https://pypi.org/project/phoenix6/26.3.0/.
"""

FLOOR = 1.3  # [of the gap that the truth leaves on the held-out log] for full marks
SNUG = 0.9  # [of FLOOR] within which the fit of the right effects must be
MISSED = 1.07  # [of the validation's gap] by which it is wider without any one of the effects
SEEN = 1.08  # [noises] of a gap in which something is visibly missing
MOST_DRAWS = 50  # so many in a row that cannot be determined would be our fault
TIMEOUT = 8.0  # [s] of a test of the validation and of the held-out log


@dataclass(frozen=True)
class Variant:
    """One learner's mechanism.

    Args:
        mechanism: with all that is hidden in it.
        log: the four tests, to fit.
        validation: other runs, to choose effects by.
        held_out: more runs, to show the gap on and nothing else.
    """

    mechanism: "Mechanism"
    log: "Log"
    validation: "Log"
    held_out: "Log"

    @property
    def hidden(self) -> tuple[str, ...]:
        """The effects that are hidden, the one that matters most first."""
        return tuple(part.effect for part in self.mechanism.hidden)


@cache_draws
@cache_generated_data
def draw(student: str) -> Variant:
    """A learner's mechanism, always the same one."""
    return draw_determined(make_student_rng(student, "exercise12"), HIDDEN)


def draw_determined(rng: "np.random.Generator", among: Sequence[Recipe]) -> Variant:
    """A mechanism whose hidden effects its logs determine.

    Args:
        rng: the source of chance.
        among: what may be hidden, as in ``HIDDEN``.
    """
    for _ in range(MOST_DRAWS):
        variant = _one(rng, among)
        if _determined(variant):
            return variant
    raise RuntimeError("no mechanism that can be determined")


def _determined(variant: Variant) -> bool:
    """Whether the right effects predict the held-out log, and each is missed if it is left out."""
    truth, shown, validation = variant.mechanism.model, variant.held_out, variant.validation
    found = with_effects(variant.log, variant.hidden, like=truth)
    if gap(found, shown) > SNUG * FLOOR * max(noise(shown), gap(truth, shown)):
        return False
    least = max(MISSED * gap(found, validation), SEEN * noise(validation))
    for name in variant.hidden:
        rest = [other for other in variant.hidden if other != name]
        if rest and gap(with_effects(variant.log, rest, like=found), validation) < least:
            return False
    return True


def _one(rng: "np.random.Generator", among: Sequence[Recipe]) -> Variant:
    """Any mechanism, and its logs."""
    from sim.bench.mechanisms import MECHANISMS  # noqa: PLC0415 - numpy only where it is needed
    from sim.bench.routine import Routine  # noqa: PLC0415 - the same
    from sim.bench.simulate import simulate  # noqa: PLC0415 - the same

    kind, effects = among[int(rng.integers(len(among)))]
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
