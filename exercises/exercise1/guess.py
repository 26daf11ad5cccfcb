"""What slips would make of a voltage: one at a time, or two, term by term."""

import math
from dataclasses import dataclass
from itertools import product

from grader.answers.wrong_number import MANY, WrongNumber

from .budget import MOMENTS, SHOWN, Variant

ALIKE, ROUNDED = 0.004, 0.006  # [share], [V] of a slip's own voltage; two decimals are written
ALIKE_TWO = 0.001  # [share] for two slips at once: there are many pairs, and one may fit by chance
MOST = 2  # slips at once; more than two explain any number


@dataclass(frozen=True)
class Guess:
    """What one slip, or two, would give."""

    volts: float
    slips: tuple[WrongNumber, ...]

    def fits(self, value: float) -> bool:
        """Whether a voltage looks like this."""
        alike = ALIKE if len(self.slips) == 1 else ALIKE_TWO
        return abs(value - self.volts) <= max(ROUNDED, alike * abs(self.volts))


def guesses(variant: Variant, name: str) -> list[Guess]:
    """What slips would give at a moment: one at a time, or two."""
    found = []
    ways = (_frictions(variant, name), _speeds(variant, name), _pushes(variant, name))
    for terms in product(*ways):
        slips = {slip.code: slip for _, slip in terms if slip}
        if 1 <= len(slips) <= MOST:
            found.append(Guess(sum(volts for volts, _ in terms), tuple(slips.values())))
    return found + _wholes(variant, name)


Way = tuple[float, WrongNumber | None]


def _frictions(variant: Variant, name: str) -> list[Way]:
    volts = variant.terms(name)[0]
    says = (
        "kS·sgn(v) has the sign of v: the voltage against friction points in the direction "
        "of motion"
    )
    if name == "braking":
        says = "did you use sgn(a)? It must be sgn(v): it depends on the direction of motion"
    if name == "backward":
        says = (
            "friction opposes the motion: moving backward, sgn(v) is -1, so kS·sgn(v) is negative "
            "as kV·v is"
        )
    turned = WrongNumber("sgn", says)
    missing = (
        "kS is missing. Friction needs its voltage at every speed, as long as the mechanism moves"
    )
    return [(volts, None), (0.0, WrongNumber("no-ks", missing)), (-volts, turned)]


_BACKWARD = WrongNumber(
    "backward",
    "the sign is wrong. Moving backward, v is negative: check sgn(v) and kV·v",
)


def _speeds(variant: Variant, name: str) -> list[Way]:
    volts = variant.terms(name)[1]
    says = "the velocity has the wrong sign. Forward is positive, even while it brakes"
    turned = _BACKWARD if name == "backward" else WrongNumber("v-sign", says)
    missing = "kV·v is missing. Every speed needs its voltage, even while the speed changes"
    return [
        (volts, None),
        (0.0, WrongNumber("no-kv", missing)),
        (-volts, turned),
        *((volts * times, slip) for times, slip in _units(variant, name)),
    ]


def _pushes(variant: Variant, name: str) -> list[Way]:
    volts = variant.terms(name)[2]
    if volts:
        way = "getting slower, a is negative" if name == "braking" else "getting faster, it is not"
        return [
            (volts, None),
            (
                0.0,
                WrongNumber(
                    "no-ka", "kA·a is missing. The speed changes here, and that takes volts"
                ),
            ),
            (-volts, WrongNumber("a-sign", f"a has the wrong sign. Moving forward and {way}")),
            *((volts * times, slip) for times, slip in _units(variant, name)),
        ]
    extra = WrongNumber(
        "extra-ka", ("the term kA·a is too much here. What is a at a steady speed?")
    )
    others = [one.acceleration for one in variant.moments.values() if one.acceleration]
    return [(0.0, None), *((variant.gains["kA"] * a, extra) for a in others)]


def _units(variant: Variant, name: str) -> list[tuple[float, WrongNumber]]:
    """Factors that a velocity is off by, in another unit than kV's."""
    (shown, times), right = SHOWN[variant.kind], f"{variant.symbol}/s"
    raw = f"this speed is given in {shown}, and your kV is made for {right}. Convert it first"
    turned = f"from {shown} to {right}, did you multiply where you have to divide?"
    changed = (
        f"this speed is already in {right}, the unit of your kV. Did you convert it into {shown}?"
    )
    found = [(times, changed), (1 / times, changed)]
    if name == "forward":
        found = [(times, raw), (times * times, turned)]
    if variant.kind == "drivetrain":
        found.append((60.0, "one minute has 60 seconds. Is your velocity per minute?"))
    else:
        turn = "2π = 6.28. Did you mix up radians and rotations?"
        found += [(2 * math.pi, turn), (0.5 / math.pi, turn)]
    return [(factor, WrongNumber(f"unit {factor:.3g}", says, "M-UNITS")) for factor, says in found]


def _wholes(variant: Variant, name: str) -> list[Guess]:
    """Slips of the whole voltage."""
    volts = sum(variant.terms(name))
    duty = "12 V is a full battery. Write volts, not an output between -1 and 1"
    turned = [(-volts, _BACKWARD)] if name == "backward" else []
    found = [
        *turned,
        (volts / 12, WrongNumber("duty", duty, "M-DUTY")),
        (volts * 1000, WrongNumber("milli", "1 V is 1000 mV. Are these millivolts?", "M-UNITS")),
    ]
    if name != "backward":
        found.append((-volts, WrongNumber("sign", "the size is right, the sign is not")))
    at, gains = variant.moments[name], variant.gains
    if at.acceleration:
        crossed = variant.terms(name)[0] + gains["kV"] * at.acceleration + gains["kA"] * at.velocity
        says = "did you swap kV and kA? kV belongs to the velocity, kA to the acceleration"
        found.append((crossed, WrongNumber("crossed", says)))
    for other in MOMENTS:
        if other != name:
            says = f"that would be right for {other}. Did you swap two answers?"
            found.append((sum(variant.terms(other)), WrongNumber("swapped", says)))
    return [Guess(value, (slip,)) for value, slip in found]


def suspects(value: float, variant: Variant, name: str) -> tuple[tuple[WrongNumber, ...], ...]:
    """The slips, or pairs of them, that would give this voltage; the simplest only."""
    near = {
        tuple(slip.code for slip in guess.slips): guess.slips
        for guess in guesses(variant, name)
        if guess.fits(value)
    }
    alone = tuple(slips for slips in near.values() if len(slips) == 1)
    found = alone or tuple(near.values())
    return found if len(found) <= (MANY if alone else 1) else ()
