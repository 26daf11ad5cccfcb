"""The voltages that a learner gets with one slip, or with two, in the terms of the motor model."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from pathlib import Path

from grader.answers.wrong_number import MANY, Slips, WrongNumber

from .budget import MOMENTS, SHOWN, Variant

ALIKE, ROUNDED = 0.004, 0.006  # [share], [V] of a slip's own voltage; two decimals are written
ALIKE_TWO = 0.001  # [share] for two slips at once: there are many pairs, and one may fit by chance
MOST = 2  # slips at once; more than two explain any number
SLIPS = Slips(Path(__file__).with_name("slips.toml"))

Way = tuple[float, WrongNumber | None]  # the volts of a term, and the slip that makes them


@dataclass(frozen=True)
class Guess:
    """What one slip, or two, would give."""

    volts: float
    slips: tuple[WrongNumber, ...]

    def fits(self, value: float) -> bool:
        """Whether a voltage looks like this."""
        alike = ALIKE if len(self.slips) == 1 else ALIKE_TWO
        return abs(value - self.volts) <= max(ROUNDED, alike * abs(self.volts))


def list_guesses(variant: Variant, name: str) -> list[Guess]:
    """What slips would give at a moment: one at a time, or two."""
    found = []
    for terms in product(*_list_ways(variant, name)):
        slips = {slip.code: slip for _, slip in terms if slip}
        if 1 <= len(slips) <= MOST:
            found.append(Guess(sum(volts for volts, _ in terms), tuple(slips.values())))
    return found + [Guess(volts, (slip,)) for volts, slip in _list_whole_slips(variant, name)]


def _list_ways(variant: Variant, name: str) -> tuple[list[Way], ...]:
    """For each of the three terms, its right volts and its volts after slips."""
    friction, speed, push = variant.terms(name)
    backward, units = name == "backward", list(_list_unit_slips(variant, name))
    sgn = f"sgn-{name}" if name in {"braking", "backward"} else "sgn"
    frictions = [(0.0, SLIPS.name("no-ks")), (-friction, SLIPS.name(sgn))]
    speeds = [
        (0.0, SLIPS.name("no-kv")),
        (-speed, SLIPS.name("backward" if backward else "v-sign")),
        *((speed * times, slip) for times, slip in units),
    ]
    pushes = [
        (variant.gains["kA"] * one.acceleration, SLIPS.name("extra-ka"))
        for one in variant.moments.values()
        if one.acceleration
    ]
    if push:
        pushes = [
            (0.0, SLIPS.name("no-ka")),
            (-push, SLIPS.name(f"a-sign-{name}")),
            *((push * times, slip) for times, slip in units),
        ]
    return [(friction, None), *frictions], [(speed, None), *speeds], [(push, None), *pushes]


def _list_unit_slips(variant: Variant, name: str) -> Iterator[tuple[float, WrongNumber]]:
    """Factors that a velocity is off by, in another unit than kV's."""
    shown, times = SHOWN[variant.kind]
    found = [("changed", times), ("changed", 1 / times)]
    if name == "forward":
        found = [("raw", times), ("turned", times * times)]
    turn = [("turns", 2 * math.pi), ("turns", 0.5 / math.pi)]
    found += [("minutes", 60.0)] if variant.kind == "drivetrain" else turn
    if shown == "deg/s":
        found += [("half-circle", 2.0), ("half-circle", 0.5)]
    for code, factor in found:
        yield factor, SLIPS.name(code, shown=shown, right=f"{variant.symbol}/s")


def _list_whole_slips(variant: Variant, name: str) -> Iterator[tuple[float, WrongNumber]]:
    """Slips of the whole voltage."""
    volts, at, gains = sum(variant.terms(name)), variant.moments[name], variant.gains
    yield -volts, SLIPS.name("backward" if name == "backward" else "sign")
    yield volts / 12, SLIPS.name("duty")
    yield volts * 1000, SLIPS.name("milli")
    if at.acceleration:
        yield volts - 2.0 * sum(variant.terms(name)[:2]), SLIPS.name("v-sign")  # sgn(v) follows v
        crossed = variant.terms(name)[0] + gains["kV"] * at.acceleration + gains["kA"] * at.velocity
        yield crossed, SLIPS.name("crossed")
    for other in MOMENTS:
        if other != name:
            yield sum(variant.terms(other)), SLIPS.name("swapped", other=other)


def _list_rarer_guesses(variant: Variant, name: str) -> Iterator[Guess]:
    """Slips that are suspected only where no other slip alone gives the voltage."""
    terms = variant.terms(name)
    whole = sum(terms)
    parts = (("this", whole), *zip(("kS", "kV·v", "kA·a"), terms, strict=True))
    slips = [("decimal", 10.0, what, volts) for what, volts in parts if volts]
    if variant.kind == "drivetrain":
        slips.append(("inches", 12.0, "kV·v", terms[1]))
    for code, factor, what, volts in slips:
        for times, way in ((factor, "large"), (1.0 / factor, "small")):
            slip = SLIPS.name(code, what=what, way=way)
            yield Guess(whole + (times - 1.0) * volts, (slip,))


def find_suspects(value: float, variant: Variant, name: str) -> tuple[tuple[WrongNumber, ...], ...]:
    """The slips, or pairs of them, that would give this voltage; the simplest only."""
    near = {
        tuple(slip.code for slip in guess.slips): guess.slips
        for guess in list_guesses(variant, name)
        if guess.fits(value)
    }
    alone = tuple(slips for slips in near.values() if len(slips) == 1) or tuple(
        guess.slips for guess in _list_rarer_guesses(variant, name) if guess.fits(value)
    )
    found = alone or tuple(near.values())
    return found if len(found) <= (MANY if alone else 1) else ()
