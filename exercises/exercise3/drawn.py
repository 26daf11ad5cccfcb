"""A learner's own elevator and arm, drawn so that nobody's are harder than another's."""

import math

import numpy as np

from grader.answers.asked_number import BANDS, AskedNumber, Band
from grader.student_data.variant import cache_draws, draw_until, make_student_rng

from .holds import Hold, Variant
from .slips import are_slips_named

# Draws: the bench's elevator and arm come to these, and so do teams' own.
KG = {"elevator": (0.9, 2.4), "arm": (0.8, 2.2)}  # [V]
KS = (0.15, 0.40)  # [V]
OFFSET = (28.0, 42.0)  # [deg] either way: the cosine forgives less, and 45 is halfway to vertical
READINGS = range(-25, 90, 5)  # [deg] three of these, with 0 and 90; mirrored for the other way
CLEAR = 17.0  # [deg] no row is nearer to horizontal: its middle would pass for kG
READING_ERROR = 0.005  # [V] of who turns the voltage up and watches
OFFSET_BAND = Band(0.0, 0.0, full_size=2.0, partial_size=5.0)


@cache_draws
def draw(student: str) -> Variant:
    """A learner's numbers, always the same; drawn again until each slip shows as what it is."""
    return draw_until(
        lambda attempt: _draw_variant(make_student_rng(student, "exercise3", draw=attempt)),
        lambda variant: _is_solvable(variant) and are_slips_named(variant),
    )


def _draw_variant(rng: np.random.Generator) -> Variant:
    truth = {f"{name}_kG": float(rng.uniform(*KG[name])) for name in KG}
    truth |= {f"{name}_kS": float(rng.uniform(*KS)) for name in KG}
    tilt, way = float(rng.uniform(*OFFSET)), int(rng.choice((-1, 1)))
    readings = sorted(-way * reading for reading in _draw_readings(tilt, rng))
    level, ks = truth["arm_kG"], truth["arm_kS"]
    return Variant(
        _read_hold(truth["elevator_kG"], truth["elevator_kS"], reading=0, rng=rng),
        tuple(
            _read_hold(level * math.cos(math.radians(one + way * tilt)), ks, reading=one, rng=rng)
            for one in readings
        ),
        {name: AskedNumber(name, volts, "V", BANDS[name[-2:]]) for name, volts in truth.items()},
        AskedNumber("arm_offset", way * tilt, "deg", OFFSET_BAND),
    )


def _read_hold(gravity: float, friction: float, *, reading: int, rng: np.random.Generator) -> Hold:
    """The two hold voltages for a gravity voltage [V] and a friction voltage [V]."""
    lower, upper = (
        round(float(gravity + edge + rng.normal(0.0, READING_ERROR)), 2) + 0.0  # never -0.00
        for edge in (-friction, friction)
    )
    return Hold(lower, upper, reading)


def _draw_readings(tilt: float, rng: np.random.Generator) -> list[int]:
    """Where the arm was held [deg], for an encoder that reads this much [deg] when it is level."""
    clear = [one for one in READINGS if one and abs(one - tilt) >= CLEAR]
    return [0, 90, *(int(one) for one in rng.choice(clear, 3, replace=False))]


def _is_solvable(variant: Variant) -> bool:
    """Whether two rows of the table are enough."""
    found = variant.found
    return variant.offset.is_right(found["arm_offset"]) and all(
        one.is_right(found[name]) for name, one in variant.asked.items()
    )
