"""Stuck sensor: position and velocity do not change in the log while the mechanism moves.

On a robot: the CAN bus loses a device for a while, a connector is loose, or a sensor thread hangs.
The last reading is logged again and again, and then the readings jump to the true values.

Effect on the gains: the repeated samples have no acceleration, and SysId removes most of them. The
jump at the end looks like a large acceleration. kA and kS are wrong, kV a little.

Fingerprint: for much longer than readings usually repeat, the velocity is not zero and the position
does not change. Then the position jumps by the distance of that time. A mechanism that is held by
friction or by a hard stop has a velocity of zero, and continues where it was.
"""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from sim.core.log import MOVING, Log, Run
from sim.core.units import Unit, find_unit
from sim.inspect.fault import (
    Damage,
    DamagedLog,
    Fault,
    FaultStrike,
    LogInterval,
    replace_run,
)
from sim.inspect.log_features import LogFeatures, find_held_samples

ORDINARY = 0.15  # [share of the run] that is frozen at severity 1
ROOM = 0.9  # [share of the rest of the run] longest freeze, so that the readings return
FEWEST = 5  # [samples] shortest freeze; a shorter one is a late frame
SHORTEST = 0.06  # [s] shortest freeze: three status frames of 20 ms
UNUSUAL = 2.5  # [times] the usual length of a repeated reading, at least
FAR = 5.0  # [smallest steps of the position] distance during a freeze, at least
WENT = 0.4  # [share] of the distance predicted from the speeds, which the jump must have


def spoil(log: Log, strike: FaultStrike, rng: np.random.Generator) -> DamagedLog:  # noqa: ARG001 - the contract
    """Freeze the readings for a share of the run; no damage if the mechanism does not move."""
    run = log.runs[strike.run]
    left = float(run.time[-1] - run.time[0]) - strike.start
    lasts = min(ORDINARY * strike.severity * float(np.ptp(run.time)), ROOM * left)
    first = int(np.searchsorted(run.time, run.time[0] + strike.start))
    last = int(np.searchsorted(run.time, run.time[0] + strike.start + lasts))
    last = max(min(last, len(run) - 2), min(first + FEWEST, len(run) - 1))
    frozen = np.arange(len(run))
    frozen[first : last + 1] = first
    hidden = float(np.abs(run.position[first : last + 1] - run.position[first]).max())
    if last - first < FEWEST or hidden <= FAR * LogFeatures(log).position_step:
        return DamagedLog(log, ())
    stuck = replace(run, position=run.position[frozen], velocity=run.velocity[frozen])
    where = LogInterval.of_samples(strike.run, run, first, last)
    return DamagedLog(replace_run(log, strike.run, stuck), (where,))


def detect(features: LogFeatures) -> Iterable[Damage]:
    """Find long intervals of motion in which neither reading changes."""
    for index, run in enumerate(features.log.runs):
        together = np.stack((run.position, run.velocity))
        changed = np.any(np.diff(together, axis=1) != 0.0, axis=0)
        starts, lengths = find_held_samples(np.concatenate(([0], np.cumsum(changed))).astype(float))
        shortest = max(FEWEST, UNUSUAL * _measure_usual_hold(run))
        for first, length in zip(starts[lengths >= shortest], lengths[lengths >= shortest]):  # noqa: B905 - both have the same mask
            last = int(first + length - 1)
            if last + 1 >= len(run) or run.time[last + 1] - run.time[first] < SHORTEST:
                continue
            hidden = _compute_hidden_distance(run, int(first), last, step=features.position_step)
            if hidden > 0.0:
                yield _describe_damage(
                    index, run, int(first), last, hidden, unit=find_unit(features.log.units)
                )


def _measure_usual_hold(run: Run) -> float:
    """[samples] usual length of a repeated reading in motion, of the slower signal; 1 if none."""
    usual = [1.0]
    for values in (run.position, run.velocity):
        starts, lengths = find_held_samples(values)
        if run.moving[starts].any():
            usual.append(float(np.median(lengths[run.moving[starts]])))
    return max(usual)


def _compute_hidden_distance(run: Run, first: int, last: int, *, step: float) -> float:
    """[m or rad] distance during a freeze; 0 if the mechanism may have been at rest."""
    frozen = abs(float(run.velocity[first]))
    predicted = frozen * float(run.time[last] - run.time[first])
    jump = abs(float(run.position[last + 1] - run.position[last]))
    moved = frozen > MOVING * run.top_speed and predicted > FAR * step and jump > WENT * predicted
    return predicted if moved else 0.0


def _describe_damage(
    index: int, run: Run, first: int, last: int, hidden: float, *, unit: Unit
) -> Damage:
    """The damage of a freeze from sample ``first`` to ``last``, with its distance [m or rad]."""
    where = LogInterval.of_samples(index, run, first, last)
    return Damage(
        where=where,
        confidence=0.95,
        evidence=f"For {where.end - where.start:.2f} s the sensor repeats one reading (position "
        f"{run.position[first] / unit.si:.4g} {unit.symbol}, velocity "
        f"{run.velocity[first] / unit.si:.4g} {unit.symbol}/s), and then jumps. The mechanism "
        f"moved by {hidden / unit.si:.3g} {unit.symbol} in that time, and the log does not show "
        "it.",
        advice="Check the sensor's plug and the CAN error counters, and run this test again. "
        "Until then, cut the run where the sensor starts to repeat.",
    )


FAULT = Fault(
    name="stuck-sensor",
    summary="position and velocity do not change for a while, although the mechanism moves",
    ordinary="position and velocity do not change for 15 % of the run",
    spoil=spoil,
    detect=detect,
)
