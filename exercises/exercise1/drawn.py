"""A mechanism and four moments for each learner, drawn until every slip can be told apart."""

from itertools import combinations
from typing import TYPE_CHECKING

from grader.student_data.variant import make_student_rng

from .budget import MOMENTS, NEAR, SHOWN, Moment, Variant
from .guess import ALIKE, ROUNDED, guesses

if TYPE_CHECKING:
    import numpy as np

UNITS = {"drivetrain": "meters", "intake": "rotations", "shooter": "rotations", "turret": "radians"}
SPEED = {  # [V] that the speed takes at each moment: few enough for kS to be noticed
    "forward": (2.2, 5.0),
    "accelerating": (1.2, 3.0),
    "braking": (1.8, 4.0),
    "backward": (2.0, 5.0),
}
RATIOS = ((0.4, 0.75), (1.35, 1.9))  # kA·a over kV·v where the speed, or the acceleration, leads
GRIP = 9.0  # [m/s²] a drivetrain's wheels on carpet: 0.9·g, below a friction of 1.0 to 1.2
LEAST = 0.8  # [V] below, 2 % are less than a learner's rounding
APART = 1.3  # [bands] no slip may come nearer to the key than this
MOST_DRAWS = 2000  # a drivetrain needs two draws, a shooter, with its little friction, twelve
DIGITS = 3


def draw(student: str) -> Variant:
    """A learner's mechanism, always the same one; drawn until every slip can be told apart."""
    rng = make_student_rng(student, "exercise1")
    kind = tuple(SHOWN)[int(rng.integers(len(SHOWN)))]
    for _ in range(MOST_DRAWS):
        variant = _drawn(kind, rng)
        if _grips(variant) and all(_clear(variant, name) for name in MOMENTS):
            return variant
    raise RuntimeError(f"no clear numbers for {student!r}")


def _drawn(kind: str, rng: "np.random.Generator") -> Variant:
    from sim.bench.mechanisms import MECHANISMS  # noqa: PLC0415 - numpy only where it is needed
    from sim.core.units import convert_gains, find_unit  # noqa: PLC0415 - the same

    per = find_unit(UNITS[kind])
    found = convert_gains(MECHANISMS[kind].draw(rng).gains, factor=per.si)
    gains = {name: _rounded(found[name]) for name in ("kS", "kV", "kA")}
    moments = {}
    for name, volts in SPEED.items():
        speed = rng.uniform(*volts)
        push = speed * rng.uniform(*RATIOS[int(rng.integers(2))])
        push *= {"accelerating": 1.0, "braking": -1.0}.get(name, 0.0)
        velocity = _rounded(speed / gains["kV"]) * (-1.0 if name == "backward" else 1.0)
        shown, shown_unit = velocity, f"{per.symbol}/s"
        if name == "forward":
            shown_unit, times = SHOWN[kind]
            shown = _rounded(velocity * times)
            velocity = shown / times
        moments[name] = Moment(name, velocity, _rounded(push / gains["kA"]), shown, shown_unit)
    largest_at = ("accelerating", "braking")[int(rng.integers(2))]
    return Variant(kind, per.symbol, gains, moments, largest_at)


def _grips(variant: Variant) -> bool:
    """Whether a drivetrain's wheels can give these accelerations without slipping."""
    pushes = (abs(at.acceleration) for at in variant.moments.values())
    return variant.kind != "drivetrain" or max(pushes) <= GRIP


def _rounded(value: float) -> float:
    return float(f"{value:.{DIGITS}g}")


def _clear(variant: Variant, name: str) -> bool:
    """Whether no slip passes for the answer, and no slip for another one."""
    asked = variant.asked(name)
    if abs(asked.expected) < LEAST:
        return False
    band = APART * NEAR.full * abs(asked.expected)
    alone = [guess for guess in guesses(variant, name) if len(guess.slips) == 1]
    return all(abs(guess.volts - asked.expected) > band for guess in alone) and all(
        abs(one.volts - other.volts) > 2 * max(ROUNDED, ALIKE * abs(one.volts))
        for one, other in combinations(alone, 2)
        if one.slips[0].code != other.slips[0].code
    )
