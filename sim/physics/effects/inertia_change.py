"""Inertia change: inertia that differs from kA during an interval.

    kA + extra from ``onset`` to ``until``

Causes are a game piece that is picked up or dropped, and a second stage that joins. Added inertia
may have been at rest: then momentum is shared, and the velocity drops. Removed inertia takes its
momentum along.
"""

import math
from collections.abc import Iterator, Mapping

import numpy as np

from sim.core.units import ROBUST
from sim.physics.effect import LATER, MOMENT, Effect, Parameter, Scale
from sim.physics.voltage_residual import VoltageResidual, list_run_start_times

RAMP = 0.5  # [V/s] of an ordinary quasistatic test
PARTS = 12  # onsets that are tried in each run
PER_RUN = 2  # best onsets of a run that are compared with those of other runs
PER_LOG = 2  # best onsets of a log that become start values
MIN_SAMPLES = 20  # samples of a run in which a drop of velocity is looked for
DROPS = 4  # sharpest drops that become start values: breakaway gives sharp ones, too
SHARP = 6.0  # [robust standard deviations] from which a change of velocity is a drop
REMAINING = 0.3  # [share of the speed] that is left after a drop, at least
EARLY = 0.25  # [samples] after the last one before a drop: the onset of the start values
TINY = 1e-12  # [unit/s] none


def added_inertia(clock: float, extra: float, onset: float, until: float) -> float:
    """[V·s²/unit] inertia beyond kA."""
    return extra if onset <= clock < until else 0.0


def impact(shared: float) -> float:
    """[1] 1 if the added inertia was at rest, 0 if it already moved along."""
    return shared


def next_change(clock: float, onset: float, until: float) -> float:
    """[s] next time on the clock at which the inertia changes."""
    if clock < onset:
        return onset
    return until if clock < until else math.inf


def ordinary_parameters(scale: Scale, size: float) -> Mapping[str, float]:
    """Parameters of a given size; size 1 is half of kA more, from about the first step test on."""
    ramps = 2.0 * min(10.0, math.sqrt(2.0 * scale.reach * scale.kv / RAMP)) + 2.0
    onset = ramps + 0.3 * scale.reach / scale.speed
    return {"extra": 0.5 * scale.ka * size, "onset": onset, "until": LATER, "shared": 1.0}


def find_start_values(residual: VoltageResidual) -> Iterator[Mapping[str, float]]:
    """Start values: drops of velocity, then the onsets that explain most of the residual.

    A drop of velocity from one sample to the next shows added inertia that was at rest.
    """
    yield from _find_drops(residual)
    chosen: list[tuple[float, float, float, float]] = []
    permanent = []
    for began, ended in _list_moving_runs(residual):
        moments = began + (ended - began) * (np.arange(PARTS) + 0.5) / PARTS
        within = [_fit_change(residual, onset, ended + MOMENT) for onset in (began, *moments)]
        chosen += sorted(within, reverse=True)[:PER_RUN]
        permanent += [_fit_change(residual, onset, LATER) for onset in (began, *moments)]
    chosen += sorted(permanent, reverse=True)[:PER_RUN]
    chosen.sort(reverse=True)
    least = -0.8 * residual.gains["kA"]
    for _, extra, onset, until in chosen[:PER_LOG]:
        for shared in (0.0, 1.0):
            size = max(extra, least)
            yield {"extra": size, "onset": onset, "until": until, "shared": shared}


def _find_drops(residual: VoltageResidual) -> Iterator[Mapping[str, float]]:
    """Start values from the sharpest drop of each run; the sharpest of all first."""
    found = []
    for number, (began, ended) in enumerate(_list_runs(residual)):
        run = residual.log.runs[number]
        change = np.diff(run.velocity) * np.sign(run.velocity[1:])
        if change.size < MIN_SAMPLES:
            continue
        usual = float(np.median(change))
        spread = ROBUST * float(np.median(np.abs(change - usual)))
        place = int(np.argmin(change))
        before, after = abs(run.velocity[place]), abs(run.velocity[place + 1])
        sharp = (usual - change[place]) / max(spread, TINY)
        if sharp > SHARP and after > REMAINING * before:
            extra = residual.gains["kA"] * (before / after - 1.0)
            step = run.time[place + 1] - run.time[place]
            between = run.time[place] + EARLY * step - run.time[0]
            found.append((sharp, extra, began + float(between), ended + MOMENT))
    for _, extra, onset, ended in sorted(found, reverse=True)[:DROPS]:
        for until in (ended, LATER):
            yield {"extra": extra, "onset": onset, "until": until, "shared": 1.0}


def _fit_change(
    residual: VoltageResidual, onset: float, until: float
) -> tuple[float, float, float, float]:
    """Sum of squares [V²] that a change of inertia explains, its size, and its onset and end."""
    during = (residual.clock >= onset) & (residual.clock < until)
    extra, gained = residual.fit_one_column(np.where(during, residual.acceleration, 0.0))
    return gained, extra, onset, until


def _list_moving_runs(residual: VoltageResidual) -> Iterator[tuple[float, float]]:
    """[s] start and end of each run that has samples of the residual."""
    moving = set(residual.run.tolist())
    yield from (one for number, one in enumerate(_list_runs(residual)) if number in moving)


def _list_runs(residual: VoltageResidual) -> Iterator[tuple[float, float]]:
    """[s] start and end of each run, on the log's clock."""
    for began, run in zip(
        list_run_start_times(residual.log).tolist(), residual.log.runs, strict=True
    ):
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
    },
    example=ordinary_parameters,
    start_values=find_start_values,
    hooks={"added_inertia": added_inertia, "impact": impact, "next_change": next_change},
)
