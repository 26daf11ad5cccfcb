"""Refuse gains that a log cannot identify, and name the test that would."""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from sim.core.errors import NotIdentifiable
from sim.core.log import Log
from sim.core.units import Unit, convert_gains, find_unit
from sim.estimation.measurements import RunMeasurements
from sim.fit.open_loop_fallback import OpenLoopReplay
from sim.fit.result import format_gain_unit

TELLS = 0.08  # [share of a gain] of a larger standard error, three are a quarter: no answer
FOLLOWS = 0.5  # [share of the velocity's variance] a simulation of less is of something else
REBOUND = 0.02  # [share of what moves] that a stop throws back
LEAST = {
    "kS": 0.35,
    "kG": 0.2,
}  # [V] an error smaller than this is no matter, however small the gain
SETTLES = {
    "kS": "Add the other direction, and a slow ramp that begins at rest.",
    "kV": "Let it run longer at a steady speed: a quasistatic test.",
    "kA": "Add a dynamic test: only a change of speed shows inertia.",
    "kG": "Add the other direction: weight helps one way and hinders the other.",
}
TOGETHER = (
    "Add the other direction: on the way up gravity and friction add, on the way down "
    "they act against each other."
)


def moves_both_ways(seen: Sequence[RunMeasurements]) -> bool:
    """Whether the mechanism is driven in both directions; a rebound does not count."""
    speeds = np.concatenate([run.measured[run.moving, 1] for run in seen])
    up, down = int(np.count_nonzero(speeds > 0.0)), int(np.count_nonzero(speeds < 0.0))
    return min(up, down) >= REBOUND * (up + down)


def refuse_unidentifiable(
    gains: Mapping[str, float],
    errors: Mapping[str, float],
    *,
    log: Log,
    type: str,  # noqa: A002 - the field's own word
    hint: str = "",
) -> None:
    """Refuse gains that the log does not determine.

    Args:
        gains: name -> value.
        errors: one standard error of each.
        log: where they come from.
        type: ``simple``, ``elevator`` or ``arm``.
        hint: better advice than another test, if there is one.

    Raises:
        NotIdentifiable: naming the gains and the test that would settle them.
    """
    unknown = [
        name
        for name in SETTLES
        if name in gains and not errors[name] <= max(TELLS * abs(gains[name]), LEAST.get(name, 0.0))
    ]
    if not unknown:
        return
    per = find_unit(log.units)
    sizes = convert_gains(errors, factor=per.si)
    each = [
        f"{name} (± {sizes[name]:.2g} {format_gain_unit(name, per)})"
        if math.isfinite(sizes[name])
        else name
        for name in unknown
    ]
    said = " and ".join(filter(None, [", ".join(each[:-1]), each[-1]]))
    pair = {"kS", "kG"} <= set(unknown) and type != "simple"
    raise NotIdentifiable(
        f"this log does not determine {said}",
        where=log.source,
        advice=hint or (TOGETHER if pair else SETTLES[unknown[-1]]),
    )


def refuse_unrelated(followed: OpenLoopReplay, *, log: Log, hint: str = "") -> None:
    """Refuse gains whose simulation has little to do with the log.

    Args:
        followed: how it follows.
        log: where they come from.
        hint: better advice than to inspect it, if there is one.

    Raises:
        NotIdentifiable: the model lacks what matters most.
    """
    if followed.r2 >= FOLLOWS:
        return
    per = find_unit(log.units)
    raise NotIdentifiable(
        "no gains describe this log: the velocity error of the best simulation is "
        f"{_size(followed.rmse, per)}, with a top speed of {_size(followed.top_speed, per)}",
        where=log.source,
        advice=hint
        or "Run `sysid inspect` to look for faults, check the type and the units, then run `sysid "
        "reconcile` to find the missing effect.",
    )


def _size(speed: float, per: Unit) -> str:
    """A speed [m/s or rad/s] in the unit of the log's owner."""
    return f"{speed / per.si:.3g} {per.symbol}/s" if math.isfinite(speed) else "any amount"
