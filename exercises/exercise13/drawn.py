"""A swerve drive for each learner, with one wheel that is worn."""

from itertools import combinations
from typing import TYPE_CHECKING

from grader.student_data.variant import cache_draws, make_student_rng

from .drive import MODULES, Variant
from .slips import lookalikes

if TYPE_CHECKING:
    import numpy as np

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
MOST_DRAWS = 500  # a few are enough; so many would be our fault


@cache_draws
def draw(student: str) -> Variant:
    """A learner's drive, always the same one; drawn again until each slip shows as what it is."""
    for attempt in range(MOST_DRAWS):
        variant = _drawn(make_student_rng(student, "exercise13", draw=attempt))
        if _clear(variant):
            return variant
    raise RuntimeError(f"no clear numbers for {student!r}")


def _drawn(rng: "np.random.Generator") -> Variant:
    motor, ratios, radii = BUILT[int(rng.integers(len(BUILT)))]
    radius = float(radii[int(rng.integers(len(radii)))])
    trackwidth = round(float(rng.uniform(*TRACKWIDTH)), 3)
    mass = round(float(rng.uniform(*MASS)), 1)
    gyration = float(rng.uniform(*GYRATION)) * trackwidth * 2.0**0.5
    return Variant(
        motor=motor,
        ratio=float(ratios[int(rng.integers(len(ratios)))]),
        radius=radius,
        trackwidth=trackwidth,
        mass=mass,
        inertia=mass * gyration**2,
        wheel_inertia=float(rng.uniform(0.0009, 0.0016)),
        friction=float(rng.uniform(0.13, 0.22)),
        drag=float(rng.uniform(0.0, 0.05)),
        scrub=float(rng.uniform(3.0, 6.0)),
        grip=float(rng.uniform(1.0, 1.25)),
        worn=MODULES[int(rng.integers(len(MODULES)))],
        worn_radius=radius * float(rng.uniform(*WORN)),
        turns=float(rng.integers(5, 11)) + round(float(rng.uniform(0.0, 0.9)), 2),
        seed=int(rng.integers(2**31)),
    )


def _clear(variant: Variant) -> bool:
    """Whether no slip earns points, and no two slips with other advice look alike."""
    for name, looks in lookalikes(variant).items():
        asked = variant.asked[name]
        _, partial = asked.band.widths(asked.expected)
        if any(abs(one.value - asked.expected) <= 1.2 * partial for one in looks):
            return False
        if any(
            abs(one.value / other.value - 1.0) < APART
            for one, other in combinations(looks, 2)
            if one.slip.says != other.slip.says
        ):
            return False
    return True
