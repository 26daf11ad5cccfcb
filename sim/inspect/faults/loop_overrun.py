"""Loop overrun: the robot program misses its beat, and samples are lost.

On a robot: a loop that should take 20 ms waits for a camera, a file or the garbage collector. While
it hangs nothing is logged; then time has jumped by 40 to 300 ms.

To the gains: SysId divides every difference of velocity by the mean period of the test, so a jump
reads as an acceleration that never was. kA comes out too large (5 % of gaps of 100 ms: by 9 %),
kS too small; kV hardly moves.

Fingerprint: a step between two times of at least 1.75 usual ones, and of a run's
time more than a hundredth lost in them. A robot's own jitter is a few percent of a loop.
"""

from collections.abc import Iterable

import numpy as np

from sim.core.log import Log
from sim.inspect.fault import (
    Damage,
    DamagedLog,
    Fault,
    FaultStrike,
    LogInterval,
    replace_run,
    select_samples,
)
from sim.inspect.log_features import LogFeatures

SHORTEST, LONGEST = 0.04, 0.3  # [s] a stall; shorter ones are jitter, longer ones trip a watchdog
SPREAD = 1.5  # [s] over which stalls come at severity 1, one about every quarter of a second
BETWEEN = 0.25  # [s]
LATE = 1.75  # [usual steps] what is no jitter any more
GAP = 0.035  # [s] a shorter step in time does no harm, however fast the log
TOGETHER = 1.0  # [s] stalls no further apart than this are one stretch of trouble
PROOF = 2.0  # [usual steps] lost in all: one might be a hiccup, ten are none
HARMLESS = 0.01  # [share of the run's time] 5 % of such gaps make kA 9 % too large; this, 2 %


def spoil(log: Log, strike: FaultStrike, rng: np.random.Generator) -> DamagedLog:
    """Remove the samples of a few stalls of the robot program."""
    run = log.runs[strike.run]
    start = float(run.time[0]) + strike.start
    end = min(start + SPREAD * strike.severity, float(run.time[-1]))
    keep = np.ones(len(run), dtype=bool)
    stalls = []
    moment = start
    while moment < end:
        until = moment + rng.uniform(
            2.0 * SHORTEST, LONGEST * min(1.0, 0.5 + 0.25 * strike.severity)
        )
        lost = (run.time > moment) & (run.time < until)
        lost[-1] = False  # the test ends when it ends, and its last sample says so
        if lost.any():
            keep &= ~lost
            stalls.append(np.flatnonzero(lost))
        moment = until + rng.uniform(0.5, 1.5) * BETWEEN
    if not stalls:
        return DamagedLog(log, ())
    where = LogInterval.of_samples(strike.run, run, stalls[0][0] - 1, stalls[-1][-1] + 1)
    spoilt = replace_run(log, strike.run, select_samples(run, keep))
    return DamagedLog(spoilt, (where,))


def detect(features: LogFeatures) -> Iterable[Damage]:
    """Find gaps between samples that jitter does not explain."""
    for index, run in enumerate(features.log.runs):
        step = np.diff(run.time)
        if step.size < 2:  # noqa: PLR2004 - of one step nobody can say that it is unusual
            continue
        usual = float(np.median(step))
        late = np.flatnonzero((step > LATE * usual) & (step > GAP))
        if float(np.sum(step[late] - usual)) <= HARMLESS * float(np.ptp(run.time)):
            continue
        for gaps in np.split(late, np.flatnonzero(np.diff(run.time[late]) > TOGETHER) + 1):
            lost = float(np.sum(step[gaps] / usual - 1.0))
            yield Damage(
                fault="loop-overrun",
                where=LogInterval.of_samples(index, run, gaps[0], gaps[-1] + 1),
                confidence=1.0 - 0.5 ** (1.0 + lost / PROOF),
                evidence=f"{_times(gaps.size)} in the samples, the longest "
                f"{step[gaps].max() * 1000.0:.0f} ms (normal: {usual * 1000.0:.3g} ms):"
                f" about {lost:.0f} samples are lost.",
                advice="Find the part of the program that takes too long (the Driver Station's "
                "console prints loop overruns), and run this test again. Until then, do "
                "not trust kA.",
            )


def _times(count: int) -> str:
    return "1 gap" if count == 1 else f"{count} gaps"


FAULT = Fault(
    name="loop-overrun",
    summary="the robot program is too slow: samples are missing",
    ordinary="the loop stalls about five times within 1.5 s, for 80 to 225 ms each time",
    spoil=spoil,
    detect=detect,
    about="time",
)
