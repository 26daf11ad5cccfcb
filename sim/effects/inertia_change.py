"""Inertia change: from one moment on there is more, or less, to accelerate.

    kA + extra from ``onset`` on

A game piece taken up, a load that comes off, a second stage that is picked up. What joins was at
rest, so momentum is shared; what leaves takes its own along.
"""

import math
from collections.abc import Iterator, Mapping

import numpy as np

from sim.effect import Effect, Parameter, Scale
from sim.evidence import Evidence

RAMP = 0.5  # [V/s] of an ordinary quasistatic test


def heft(clock: float, extra: float, onset: float) -> float:
    """[V·s²/unit] beyond kA."""
    return extra if clock >= onset else 0.0


def ordinary(scale: Scale, size: float) -> Mapping[str, float]:
    """Half as much again, from about the first dynamic test of a routine on, for size 1."""
    ramps = 2.0 * min(10.0, math.sqrt(2.0 * scale.reach * scale.kv / RAMP)) + 2.0
    return {"extra": 0.5 * scale.ka * size, "onset": ramps + 0.3 * scale.reach / scale.speed}


def starts(seen: Evidence) -> Iterator[Mapping[str, float]]:
    """The best of the moments at which a run began, or was a quarter, a half on."""
    found = []
    for number, run in enumerate(seen.log.runs):
        length = float(run.time[-1] - run.time[0])
        mine = seen.run == number
        if not mine.any():
            continue
        began = float(seen.clock[mine][0] - seen.since[mine][0])
        for part in (0.0, 0.1, 0.25, 0.5):
            onset = began + part * length
            after = np.where(seen.clock >= onset, seen.acceleration, 0.0)
            if after.any() and (seen.clock < onset).any():
                (extra,) = seen.share(after)
                found.append((float(np.sum((extra * after) ** 2)), float(extra), onset))
    least = -0.8 * seen.gains["kA"]
    for _, extra, onset in sorted(found, reverse=True)[:3]:
        yield {"extra": max(extra, least), "onset": onset}


EFFECT = Effect(
    name="inertia-change",
    kind="term",
    summary="inertia that changes at one moment (a game piece taken up)",
    formula="kA + extra from onset on",
    parameters=(
        Parameter("extra", "inertia beyond kA", "V·s²/{u}", power=1, least=-1e6, most=1e6),
        Parameter("onset", "moment, since the log began", "s", most=1e6),
    ),
    fingerprint="Before one moment one kA fits, after it another.",
    inspect="What the mechanism carried, and what was changed between tests.",
    apart={
        "velocity-filter": "Look at the position: a filter does not change it.",
        "heating": "Repeat the first test at the end: heat grows slowly, a load comes at once.",
    },
    example=ordinary,
    starts=starts,
    acts={"heft": heft},
)
