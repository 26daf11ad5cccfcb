"""Compare two fits that should agree: left and right, forward and reverse."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

from sim.core.doubt import Doubt
from sim.core.errors import NotIdentifiable
from sim.core.log import DIRECTIONS, Log
from sim.core.units import find_unit
from sim.fit.output_error import fit_output_error
from sim.fit.physics.parts import SURELY, fit_in_si
from sim.fit.result import Fit, format_gain_unit
from sim.support.printable import format_with_error

APART = 0.05  # [share of a gain] by which two sides or directions may differ
NOTICED = 0.03  # [V] a smaller difference of kS or kG does not matter

SUSPECTS = {
    "kS": "a bearing, a chain, a brake, a ratchet or anything that rubs in one direction",
    "kV": "the ratio, wheel or position factor of each, and what rubs more at speed",
    "kA": "the weight each moves, wheel slip, and a current limit that works on one only",
    "kG": "a spring, a counterweight, or play in the gears",
}


def compare_parts(fits: Mapping[str, Fit], what: str) -> tuple[Doubt, ...]:
    """Doubts if equal parts of a robot differ, about the lowest and the highest value of each gain.

    Args:
        fits: name of each part -> its fit.
        what: kind of the parts, for the code of the doubt: ``side``, ``motor`` or ``file``.

    Raises:
        BadRequest: one measures a length, the other an angle.
    """
    first = fit_in_si(next(iter(fits.values())))
    alike = {name: one.in_units(first.units) for name, one in fits.items()}
    doubts: list[Doubt] = []
    for gain in SUSPECTS:
        having = [name for name, one in alike.items() if gain in one.gains]
        if len(having) > 1:
            low, *_, high = sorted(having, key=lambda name: alike[name].gains[gain])
            low, high = sorted((low, high), key=having.index)  # in the order of the parts
            doubts += _doubt_differing_gain(gain, alike[low], alike[high], (low, high), what)
    return tuple(doubts)


def compare_directions(log: Log, type: str) -> tuple[Doubt, ...]:  # noqa: A002 - SysId's word
    """Doubts if the gains of forward and reverse runs, each fitted alone, differ.

    There are none for an elevator: one direction does not separate friction from weight.

    Args:
        log: any runs of one mechanism.
        type: ``simple``, ``elevator`` or ``arm``.

    Raises:
        BadRequest: an arm whose position is not an angle.
    """
    fits = []
    for way in DIRECTIONS:
        runs = tuple(run for run in log.runs if run.direction == way)
        if not runs:
            return ()
        try:
            fits.append(fit_output_error(replace(log, runs=runs), type=type))
        except NotIdentifiable:
            return ()
    return tuple(
        doubt
        for gain in SUSPECTS
        if gain in fits[0].gains
        for doubt in _doubt_differing_gain(gain, fits[0], fits[1], DIRECTIONS, "direction")
    )


def _doubt_differing_gain(
    gain: str, one: Fit, other: Fit, names: tuple[str, ...], what: str
) -> Iterator[Doubt]:
    """A doubt if a gain differs significantly, and by more than ``APART`` and ``NOTICED``."""
    per, why = find_unit(one.log_units), SUSPECTS[gain]
    mirror = -1.0 if one.gains["kV"] * other.gains["kV"] < 0.0 else 1.0
    a, b = one.gains[gain], mirror * other.gains[gain]
    least = max(
        SURELY * math.hypot(one.errors[gain], other.errors[gain]),
        APART * 0.5 * abs(a + b),
        0.0 if gain in {"kV", "kA"} else NOTICED,
    )
    if abs(a - b) <= least:
        return
    size = per.si if gain in {"kV", "kA"} else 1.0
    if one.type != "simple" and what == "direction":  # a spring pulls one way
        why = f"a spring, a counterweight or tubing, then {why}"
    share = abs(a - b) / max(0.5 * abs(a + b), 1e-300)
    first = format_with_error(a * size, one.errors[gain] * size)
    second = format_with_error(b * size, other.errors[gain] * size)
    text = (
        f"{gain} is {first} {names[0]} and {second} {format_gain_unit(gain, per)} {names[1]}, "
        f"{share:.0%} apart; one gain for both is wrong for each: check {why}."
    )
    yield Doubt(f"{what}s-differ", text, gains=(gain,))
