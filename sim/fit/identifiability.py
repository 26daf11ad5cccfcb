"""Say which gains a log cannot identify, and name the test that would."""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from sim.core.advice import Action
from sim.core.doubt import Doubt
from sim.core.errors import NotIdentifiable
from sim.core.log import Log
from sim.core.units import convert_gains, find_unit
from sim.estimation.measurements import RunMeasurements
from sim.fit.open_loop_fallback import OpenLoopReplay
from sim.fit.result import format_gain_unit
from sim.support.printable import join_names

LARGEST_ERROR = 0.08  # [share of a gain] standard error; three of them are a quarter of the gain
LEAST_R2 = 0.5  # [share of the velocity's variance] that a simulation must explain
REBOUND = 0.02  # [share of the moving samples] in which a stop throws a mechanism back
ACCEPTED = {"kS": 0.35, "kG": 0.2}  # [V] a smaller standard error is accepted for any gain
TEST_FOR = {  # gain -> the test that would determine it
    "kS": "Add a slow ramp that begins at rest.",
    "kV": "Let it run longer at a steady speed: a quasistatic test.",
    "kA": "Add a dynamic test with a larger step: only a change of speed shows inertia.",
    "kG": "Add slow ramps over the whole travel.",
}
OTHER_WAY = {  # the same for a log of one direction
    "kS": "Add the other direction, and a slow ramp that begins at rest.",
    "kG": "Add the other direction: weight helps one way and hinders the other.",
}
OTHER_WAY_FOR_BOTH = (
    "Add the other direction: on the way up gravity and friction add, on the way down "
    "they act against each other."
)


def moves_both_ways(measured: Sequence[RunMeasurements]) -> bool:
    """Whether the mechanism is driven in both directions; a rebound does not count."""
    speeds = np.concatenate([run.measured[run.moving, 1] for run in measured])
    up, down = int(np.count_nonzero(speeds > 0.0)), int(np.count_nonzero(speeds < 0.0))
    return min(up, down) >= REBOUND * (up + down)


def doubt_undetermined(
    gains: Mapping[str, float],
    errors: Mapping[str, float],
    *,
    log: Log,
    type: str,  # noqa: A002 - the field's own word
    both_ways: bool,
    hint: Action | None = None,
) -> tuple[Doubt, ...]:
    """A warning about gains that the log does not determine, if it determines kV.

    Args:
        gains: gain -> value, in SI.
        errors: gain -> one standard error, in SI.
        log: the log.
        type: ``simple``, ``elevator`` or ``arm``.
        both_ways: whether the mechanism moves in both directions.
        hint: advice that replaces the suggested test, or None.

    Raises:
        NotIdentifiable: kV is not determined, or only kV is; the message names the gains and the
            test that would determine them.
    """
    unknown = [
        name
        for name in TEST_FOR
        if name in gains
        and not errors[name] <= max(LARGEST_ERROR * abs(gains[name]), ACCEPTED.get(name, 0.0))
    ]
    if not unknown:
        return ()
    per = find_unit(log.units)
    sizes = convert_gains(errors, factor=per.si)
    each = [
        f"{name} (± {sizes[name]:.2g} {format_gain_unit(name, per)})"
        if math.isfinite(sizes[name])
        else name
        for name in unknown
    ]
    said = join_names(each)
    tests = TEST_FOR if both_ways else {**TEST_FOR, **OTHER_WAY}
    pair = {"kS", "kG"} <= set(unknown) and type != "simple" and not both_ways
    advice = hint or (OTHER_WAY_FOR_BOTH if pair else tests[unknown[-1]])
    if "kV" in unknown or len(unknown) > 1:
        raise NotIdentifiable(
            f"this log does not determine {said}", where=log.source, advice=advice
        )
    message = f"{log.source}: this log does not determine {said}. The other gains are known."
    action = advice if isinstance(advice, Action) else None
    text = message if action else f"{message} {advice}"
    return (Doubt("gain-unknown", text, action=action, gains=tuple(unknown)),)


def refuse_unrelated(replay: OpenLoopReplay, *, log: Log, hint: Action | None = None) -> None:
    """Refuse gains whose simulation explains too little of the log.

    Args:
        replay: open-loop replay of the fit.
        log: the log.
        hint: advice that replaces that to inspect the log, or None.

    Raises:
        NotIdentifiable: R² of the velocity is below ``LEAST_R2``.
    """
    if replay.r2 >= LEAST_R2:
        return
    per = find_unit(log.units)
    error = per.format_speed(replay.rmse) if math.isfinite(replay.rmse) else "any amount"
    raise NotIdentifiable(
        "no gains describe this log: the velocity error of the best simulation is "
        f"{error}, with a top speed of {per.format_speed(log.top_speed)}",
        where=log.source,
        advice=hint or Action("inspect-and-reconcile", before="Check the type and the units."),
    )
