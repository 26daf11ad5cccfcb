"""Inertia change: for a while there is more, or less, to accelerate.

    kA + extra from ``onset`` to ``until``

A game piece taken up, a load that comes off, a second stage that is picked up. What joins may have
been at rest: then momentum is shared, and the velocity drops. What leaves takes its own along.
"""

import math
from collections.abc import Iterator, Mapping

import numpy as np

from sim.physics.effect import LATER, MOMENT, Effect, Parameter, Scale
from sim.physics.voltage_residual import VoltageResidual, list_run_start_times

RAMP = 0.5  # [V/s] of an ordinary quasistatic test
PARTS = 12  # moments of a run that are tried
SHOWN = 2  # of them that are worth a start
MOST = 2  # starts of the whole log that are
FEWEST = 20  # samples of a run that tell which change of velocity is usual
SHARPEST = 4  # of them: breaking away is as sharp
SHARP, LEFT = 6.0, 0.3  # [robust standard deviations] of a drop beyond it; [1] of the speed left
EARLY = 0.25  # [samples] after the last one before a drop: a search looks around from there
ROBUST, TINY = 1.4826, 1e-12  # standard deviations in a median absolute deviation; [unit/s] none


def added_inertia(clock: float, extra: float, onset: float, until: float) -> float:
    """[V·s²/unit] inertia beyond kA."""
    return extra if onset <= clock < until else 0.0


def impact(shared: float) -> float:
    """[1] 1 if the joining inertia was at rest, 0 if it already moved along."""
    return shared


def next_change(clock: float, onset: float, until: float) -> float:
    """[s] of the clock at which it begins or ends."""
    if clock < onset:
        return onset
    return until if clock < until else math.inf


def ordinary_parameters(scale: Scale, size: float) -> Mapping[str, float]:
    """Parameters of a given size; size 1 is half of kA more, from about the first step test on."""
    ramps = 2.0 * min(10.0, math.sqrt(2.0 * scale.reach * scale.kv / RAMP)) + 2.0
    onset = ramps + 0.3 * scale.reach / scale.speed
    return {"extra": 0.5 * scale.ka * size, "onset": onset, "until": LATER, "shared": 1.0}


def find_start_values(seen: VoltageResidual) -> Iterator[Mapping[str, float]]:
    """Start values: the moments of the largest change, in each run and in the whole log.

    Before them, those at which velocity drops from one sample to the next: what joins at rest.
    """
    yield from _drops(seen)
    chosen: list[tuple[float, float, float, float]] = []
    for_good = []
    for began, ended in _runs(seen):
        moments = began + (ended - began) * (np.arange(PARTS) + 0.5) / PARTS
        within = [_tried(seen, onset, ended + MOMENT) for onset in (began, *moments)]
        chosen += sorted(within, reverse=True)[:SHOWN]
        for_good += [_tried(seen, onset, LATER) for onset in (began, *moments)]
    chosen += sorted(for_good, reverse=True)[:SHOWN]
    chosen.sort(reverse=True)
    least = -0.8 * seen.gains["kA"]
    for place, (_, extra, onset, until) in enumerate(chosen[:MOST]):
        for shared in (0.0, 1.0) if place < SHOWN else (0.0,):
            size = max(extra, least)
            yield {"extra": size, "onset": onset, "until": until, "shared": shared}


def _drops(seen: VoltageResidual) -> Iterator[Mapping[str, float]]:
    """The sharpest drop of each run that has one, to its end and for good; the clearest first."""
    found = []
    for number, (began, ended) in enumerate(_every_run(seen)):
        run = seen.log.runs[number]
        change = np.diff(run.velocity) * np.sign(run.velocity[1:])
        if change.size < FEWEST:
            continue
        usual = float(np.median(change))
        spread = ROBUST * float(np.median(np.abs(change - usual)))
        place = int(np.argmin(change))
        before, after = abs(run.velocity[place]), abs(run.velocity[place + 1])
        sharp = (usual - change[place]) / max(spread, TINY)
        if sharp > SHARP and after > LEFT * before:
            extra = seen.gains["kA"] * (before / after - 1.0)
            step = run.time[place + 1] - run.time[place]
            between = run.time[place] + EARLY * step - run.time[0]
            found.append((sharp, extra, began + float(between), ended + MOMENT))
    for _, extra, onset, ended in sorted(found, reverse=True)[:SHARPEST]:
        for until in (ended, LATER):
            yield {"extra": extra, "onset": onset, "until": until, "shared": 1.0}


def _tried(seen: VoltageResidual, onset: float, until: float) -> tuple[float, float, float, float]:
    """What a change at that moment explains [V²], its size, and the moments."""
    during = (seen.clock >= onset) & (seen.clock < until)
    extra, gained = seen.fit_one_column(np.where(during, seen.acceleration, 0.0))
    return gained, extra, onset, until


def _runs(seen: VoltageResidual) -> Iterator[tuple[float, float]]:
    """[s] of the log's clock at which runs began and ended, of those that tell accelerations."""
    told = set(seen.run.tolist())
    yield from (one for number, one in enumerate(_every_run(seen)) if number in told)


def _every_run(seen: VoltageResidual) -> Iterator[tuple[float, float]]:
    """The same of all runs."""
    for began, run in zip(list_run_start_times(seen.log).tolist(), seen.log.runs, strict=True):
        yield began, began + float(run.time[-1] - run.time[0])


EFFECT = Effect(
    name="inertia-change",
    kind="term",
    summary="inertia that changes at one moment (a game piece taken up)",
    formula="kA + extra from onset to until",
    parameters=(
        Parameter("extra", "inertia added to kA", "V·s²/{u}", power=1, least=-1e6, most=1e6),
        Parameter(
            "onset", "when it changes, after the start of the log", "s", most=1e6, searched=False
        ),
        Parameter(
            "until",
            "when it changes back",
            "s",
            most=1e6,
            neutral=LATER,
            searched=False,
            counts=False,
        ),
        Parameter(
            "shared",
            "1: the new load was at rest before, 0: it already moved along",
            "1",
            most=1.0,
            searched=False,
            counts=False,
        ),
    ),
    fingerprint="kA changes from one value to another at one moment.",
    inspect="Check which load the mechanism carried, and what you changed between the tests.",
    apart={
        "velocity-filter": (
            "Look at the position. A filter does not change it, another inertia does."
        ),
        "heating": (
            "Repeat the first test at the end. A motor gets warm slowly, a load changes at one "
            "moment."
        ),
    },
    example=ordinary_parameters,
    start_values=find_start_values,
    hooks={"added_inertia": added_inertia, "impact": impact, "next_change": next_change},
)
