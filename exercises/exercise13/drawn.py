"""A swerve drive for each learner, with one wheel that is worn."""

import numpy as np

from grader.answers.wrong_number import are_distinguishable
from grader.student_data.variant import cache_draws, choose, draw_until, make_student_rng

from .drive import MODULES, Variant
from .slips import list_lookalikes

BUILT = (  # motor, ratios, wheel radii [m]: as sold
    ("krakenX60", (5.36, 5.9, 6.12, 6.75, 7.36), (0.0508, 0.0476)),
    ("falcon500", (6.12, 6.75, 7.36), (0.0508, 0.0476)),
    ("neoVortex", (5.9, 6.12, 6.75), (0.0508, 0.0476)),
)
TRACKWIDTH = (0.50, 0.62)  # [m]
MASS = (46.0, 66.0)  # [kg] with battery and bumpers
GYRATION = (0.36, 0.46)  # [of the trackwidth] radius at which all the mass would turn as hard
WORN = (0.94, 0.965)  # [share] of the radius that is left of the worn wheel
APART = 0.045  # [share] that two slips with other advice are apart


@cache_draws
def draw(student: str) -> Variant:
    """A learner's drive, always the same one; drawn again until each slip shows as what it is."""
    return draw_until(
        lambda attempt: _draw_variant(make_student_rng(student, "exercise13", draw=attempt)),
        _is_clear,
    )


def _draw_variant(rng: np.random.Generator) -> Variant:
    motor, ratios, radii = choose(BUILT, rng)
    radius = choose(radii, rng)
    trackwidth = round(float(rng.uniform(*TRACKWIDTH)), 3)
    mass = round(float(rng.uniform(*MASS)), 1)
    gyration = float(rng.uniform(*GYRATION)) * trackwidth * 2.0**0.5
    return Variant(
        motor=motor,
        ratio=choose(ratios, rng),
        radius=radius,
        trackwidth=trackwidth,
        mass=mass,
        inertia=mass * gyration**2,
        wheel_inertia=float(rng.uniform(0.0009, 0.0016)),
        friction=float(rng.uniform(0.13, 0.22)),
        drag=float(rng.uniform(0.0, 0.05)),
        scrub=float(rng.uniform(3.0, 6.0)),
        grip=float(rng.uniform(1.0, 1.25)),
        worn=choose(MODULES, rng),
        worn_radius=radius * float(rng.uniform(*WORN)),
        turns=float(rng.integers(5, 11)) + round(float(rng.uniform(0.0, 0.9)), 2),
        seed=int(rng.integers(2**31)),
    )


def _is_clear(variant: Variant) -> bool:
    """Whether no known mistake earns points, and different mistakes give different numbers."""
    for name, looks in list_lookalikes(variant).items():
        asked = variant.asked[name]
        partial = 1.2 * asked.band.widths(asked.expected)[1]
        if any(abs(one.value - asked.expected) <= partial for one in looks):
            return False
        if not are_distinguishable(looks, apart=APART, by=lambda slip: slip.says):
            return False
    return True
