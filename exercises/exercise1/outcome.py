"""What a learner's volts would do: the speed they bring beside the speed that was wanted.

At a steady speed the mechanism begins at rest and gets the volts. Where it speeds up or brakes, it
begins at the moment's velocity, and gets in addition what kV takes of the change since: only what
the learner's number lacks is left to see.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from grader.answers.number_answer import read_answer_number
from grader.check import WrongAnswer
from grader.consequence import Consequence, Picture

from .budget import MOMENTS, Variant

BATTERY = 12.0  # [V]
STEPS = 200  # of each motion
LONG = 6.0  # [timescales kA/kV] until it is as fast as it gets
SHARE = 0.6  # [share of its velocity] that it loses at most while it brakes
HARDLY = 0.05  # [share of the speed wanted] below which it hardly moves


@dataclass(frozen=True)
class Motion:
    """What one answer does.

    Args:
        name: of the moment.
        time: (n,) [s].
        wanted: (n,) velocity that was wanted.
        found: (n,) velocity that comes.
    """

    name: str
    time: tuple[float, ...]
    wanted: tuple[float, ...]
    found: tuple[float, ...]


def outcome(given: Mapping[str, object], variant: Variant) -> Consequence | None:
    """What the wrong ones of the four numbers would do; None where none is both there and wrong."""
    motions = []
    for name in MOMENTS:
        asked = variant.asked(name)
        try:
            value = read_answer_number(given.get(name), asked)
        except WrongAnswer:
            continue
        if not asked.is_right(value):
            motions.append(_moved(name, value, variant))
    if not motions:
        return None
    words = " ".join(_words(one, variant) for one in motions)

    def draw() -> Picture:
        from sim.plot import consequence as plot  # noqa: PLC0415 - only who draws waits for it

        ylabel, done = f"velocity [{variant.symbol}/s]", "what it does"
        shown = [
            plot.Trace(one.name, ylabel, one.time, one.wanted, {done: one.found}) for one in motions
        ]
        return plot.plot_consequence(shown, words=words)

    return Consequence(words, draw)


def _moved(name: str, volts: float, variant: Variant) -> Motion:
    from sim.feedback.response import MovingPlant, Plant  # noqa: PLC0415 - numpy only where it is needed

    at, gains = variant.moments[name], variant.gains
    lasts, begin = LONG * gains["kA"] / gains["kV"], 0.0
    if at.acceleration:
        lasts = min(lasts, SHARE * abs(at.velocity / at.acceleration))
        begin = at.velocity
    step = lasts / STEPS
    time = tuple(step * k for k in range(STEPS + 1))
    wanted = tuple(at.velocity + at.acceleration * t for t in time)
    moving = MovingPlant(Plant("simple", gains), step=step, start=0.0, speed=begin)
    for t in time[:-1]:
        change = gains["kV"] * at.acceleration * (t + step / 2.0)
        moving.apply_voltage(min(max(volts + change, -BATTERY), BATTERY))
    return Motion(name, time, wanted, tuple(moving.speed))


def _words(one: Motion, variant: Variant) -> str:
    """What is to be seen in the end, with one digit: it is a picture, not a measurement."""
    wanted, found = one.wanted[-1], one.found[-1]
    at = variant.moments[one.name]
    told = f"{one.name.capitalize()}, with your volts: it"
    if abs(found) <= HARDLY * abs(wanted):
        return f"{told} hardly moves."
    if found * wanted < 0.0:
        return f"{told} goes the other way."
    off = (found - wanted) * math.copysign(1.0, wanted)
    size = f"about {float(f'{abs(off):.1g}'):g} {variant.symbol}/s"
    if not at.acceleration:
        return f"{told} gets {size} too {'fast' if off > 0.0 else 'slow'}."
    after = f"after {float(f'{1000.0 * one.time[-1]:.1g}'):g} ms"
    return f"{told} is {size} too {'fast' if off > 0.0 else 'slow'} {after}."
