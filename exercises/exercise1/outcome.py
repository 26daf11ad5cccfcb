"""The speed that the learner's volts would cause, compared with the wanted speed.

At a steady speed the mechanism begins at rest and gets the volts. Where it speeds up or brakes, it
begins at the moment's velocity, and gets in addition what kV takes of the change since: only what
the learner's number lacks is left to see.
"""

import math
from collections.abc import Mapping
from typing import Any

from grader.answers.number_answer import read_answer_number
from grader.checks.check import WrongAnswer
from grader.checks.consequence import Consequence, show_motions
from sim.feedback.response import MovingPlant, Plant

from .budget import MOMENTS, Variant

BATTERY = 12.0  # [V]
STEPS = 200  # of each motion
LONG = 6.0  # [timescales kA/kV] until it is as fast as it gets
SHARE = 0.6  # [share of its velocity] that it loses at most while it brakes
HARDLY = 0.05  # [share of the speed wanted] below which it hardly moves


def find_outcome(given: Mapping[str, object], variant: Variant) -> Consequence | None:
    """The motion that the wrong ones of the four answers cause; None if no answer is wrong."""
    motions, words = [], []
    for name in MOMENTS:
        asked = variant.asked(name)
        try:
            value = read_answer_number(given.get(name), asked)
        except WrongAnswer:
            continue
        if not asked.is_right(value):
            motion, sentence = _simulate_moment(name, value, variant)
            motions.append(motion)
            words.append(sentence)
    return show_motions(motions, words=" ".join(words)) if motions else None


def _simulate_moment(name: str, volts: float, variant: Variant) -> tuple[tuple[Any, ...], str]:
    """The commanded and the simulated velocity, as a panel and in words."""
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
    after = f" after {float(f'{1000.0 * lasts:.1g}'):g} ms" if at.acceleration else ""
    words = _describe_end(wanted[-1], moving.speed[-1], variant.symbol, after=after)
    ylabel = f"velocity [{variant.symbol}/s]"
    motion = (name, ylabel, time, wanted, {"what it does": tuple(moving.speed)})
    return motion, f"{name.capitalize()}, with your volts: it {words}."


def _describe_end(wanted: float, found: float, symbol: str, *, after: str) -> str:
    """A sentence about the end of the picture, with numbers of one digit."""
    if abs(found) <= HARDLY * abs(wanted):
        return "hardly moves"
    if found * wanted < 0.0:
        return "goes the other way"
    off = (found - wanted) * math.copysign(1.0, wanted)
    size = f"about {float(f'{abs(off):.1g}'):g} {symbol}/s too {'fast' if off > 0.0 else 'slow'}"
    return f"is {size}{after}" if after else f"gets {size}"
