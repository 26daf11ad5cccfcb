"""A learner's additions to the model: names in order, and the parameters of each."""

import difflib
import math
from collections.abc import Mapping

from grader.answers.asked_number import AskedNumber, Band
from grader.answers.number_answer import read_answer_number
from grader.checks.check import WrongAnswer, shorten
from sim.core.units import Unit
from sim.physics.effect import Parameter
from sim.physics.effects import EFFECTS, find_effect
from sim.physics.model import Part

GAINS = ("ks", "kv", "ka", "kg", "kp")
EDGE = 1e-4  # [share] a parameter this near to its bound is on it
NOTHING = 1e-9  # in SI: no effect is so small and still one
LIST = "sysid effects lists the names"


def read_names(raw: object) -> tuple[str, ...]:
    """The names of the effects, in the learner's order.

    Raises:
        WrongAnswer: there are none, or one that is none.
    """
    some = raw.split(",") if isinstance(raw, str) else raw
    if not isinstance(some, list) or not all(isinstance(one, str) for one in some):
        raise WrongAnswer(
            "not a list of names", hint=f'Write effects = ["delay", "backlash"]; {LIST}.'
        )
    names = [one.strip().lower().replace("_", "-").replace(" ", "-") for one in some]
    names = [one for one in names if one]
    if not names:
        raise WrongAnswer(
            "nothing yet", hint=f'Write effects = ["…"], the most important first; {LIST}.'
        )
    for name in names:
        _require_effect(name)
    if len({*names}) < len(names):
        raise WrongAnswer(f"{len(names)} names", hint="Name each effect once.")
    return tuple(names)


def _require_effect(name: str) -> None:
    if name in GAINS:
        raise WrongAnswer(
            f'"{name}"',
            hint="this is a gain, and the model has it already: its gains are fitted to your "
            "log as well as possible. A gain that is changed until one log fits hides the "
            f"missing effect, and fails on the next log; {LIST}",
        )
    if name not in EFFECTS:
        near = difflib.get_close_matches(name, EFFECTS, n=1)
        near = near or [one for one in EFFECTS if name and name in one.split("-")]
        also = f"Did you mean {near[0]}? " if near else ""
        raise WrongAnswer(f'"{name[:40]}", which is not an effect', hint=f"{also}{LIST}.")


def read_parts(names: tuple[str, ...], given: Mapping[str, object], unit: Unit) -> list[Part]:
    """The effects with their parameters, as the bench needs them.

    Args:
        names: of the effects.
        given: the answers.
        unit: the unit of position in which the learner writes.

    Raises:
        WrongAnswer: a parameter is missing, or is none.
    """
    parts = []
    for name in names:
        table = given.get(name, given.get(name.replace("-", "_")))
        known = find_effect(name).parameters
        if not isinstance(table, dict):
            lines = ", ".join(f"{name}.{one.name} = …" for one in known)
            raise WrongAnswer(f"no parameters of {name}", hint=f"Write a line for each: {lines}.")
        _require_parameters(name, table, [one.name for one in known])
        values = {one.name: _read_value(name, one, table.get(one.name), unit) for one in known}
        parts.append(Part(name, values))
    return parts


def _require_parameters(name: str, table: Mapping[str, object], known: list[str]) -> None:
    """Refuse a parameter that the effect does not have, and an effect that lacks one.

    Raises:
        WrongAnswer: there is one.
    """
    for other in table:
        if other not in known:
            own = " and ".join(f"{name}.{one}" for one in known)
            raise WrongAnswer(
                f"{name}.{shorten(other)}, which is not a parameter of {name}",
                hint=f"It has {own}. Copy the lines that try_it.py prints.",
            )
    for one in known:
        if table.get(one, "") == "":
            raise WrongAnswer(f"no {name}.{one}", hint=f"Write a line for it: {name}.{one} = …")


def _read_value(name: str, known: Parameter, raw: object, unit: Unit) -> float:
    """A parameter, in SI."""
    asked = AskedNumber(
        f"{name}.{known.name}", 0.0, known.unit.format(u=unit.symbol), Band(0.0, 0.0)
    )
    try:
        value = read_answer_number(raw, asked)
    except WrongAnswer as wrong:
        wrong.seen = f"{asked.name}: {wrong.seen}"
        raise
    si = value / unit.si**known.power
    if not known.least <= si <= known.most:
        raise WrongAnswer(
            f"{asked.name} = {value:g} {asked.unit}",
            hint=(
                f"for {known.what}, this is outside the range in which this course looks. Mind "
                "the sign and the unit"
            ),
        )
    return si


def find_parameter_at_limit(part: Part) -> str:
    """The parameter that has reached the limit of its range; empty if none has."""
    for one in find_effect(part.effect).parameters:
        value = part.parameters[one.name]
        for bound in (one.least, one.most):
            if math.isfinite(bound) and abs(value - bound) <= max(EDGE * abs(bound), NOTHING):
                return one.name
    return ""
