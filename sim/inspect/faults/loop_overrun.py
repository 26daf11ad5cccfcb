"""Loop overrun: the loop of the robot program takes too long, and samples are lost.

On a robot: a loop that should take 20 ms waits for a camera, a file or the garbage collector. In
the meantime nothing is logged, and the next sample is 40 to 300 ms later.

Effect on the gains: SysId divides every difference of velocity by the mean period of the test, so a
gap looks like a large acceleration. kA becomes too large (by 9 % with 5 % of gaps of 100 ms), kS
too small; kV hardly changes.

Fingerprint: gaps of at least 1.75 usual sample periods, in which more than 1 % of the run's time is
lost. The jitter of a robot program is a few percent of a period.
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
)
from sim.inspect.log_features import LogFeatures

SHORTEST, LONGEST = 0.04, 0.3  # [s] a stall; shorter ones are jitter, longer ones trip a watchdog
SPREAD = 1.5  # [s] in which the stalls of severity 1 happen
BETWEEN = 0.25  # [s] mean time between two stalls
LATE = 1.75  # [usual periods] least length of a gap
GAP = 0.035  # [s] least length of a gap: shorter ones do no harm
TOGETHER = 1.0  # [s] gaps closer than this are reported together
PROOF = 2.0  # [usual periods] lost time that halves the doubt
HARMLESS = 0.01  # [share of the run's time] less lost time makes kA at most 2 % too large


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
        lost[-1] = False  # the last sample of the test stays
        if lost.any():
            keep &= ~lost
            stalls.append(np.flatnonzero(lost))
        moment = until + rng.uniform(0.5, 1.5) * BETWEEN
    if not stalls:
        return DamagedLog(log, ())
    where = LogInterval.of_samples(strike.run, run, stalls[0][0] - 1, stalls[-1][-1] + 1)
    spoilt = replace_run(log, strike.run, run.select(keep))
    return DamagedLog(spoilt, (where,))


def detect(features: LogFeatures) -> Iterable[Damage]:
    """Find gaps between samples that jitter does not explain."""
    for index, run in enumerate(features.log.runs):
        step = np.diff(run.time)
        if step.size < 2:  # noqa: PLR2004 - one step has no usual length
            continue
        usual = float(np.median(step))
        late = np.flatnonzero((step > LATE * usual) & (step > GAP))
        if float(np.sum(step[late] - usual)) <= HARMLESS * float(np.ptp(run.time)):
            continue
        for gaps in np.split(late, np.flatnonzero(np.diff(run.time[late]) > TOGETHER) + 1):
            lost = float(np.sum(step[gaps] / usual - 1.0))
            yield Damage(
                where=LogInterval.of_samples(index, run, gaps[0], gaps[-1] + 1),
                confidence=1.0 - 0.5 ** (1.0 + lost / PROOF),
                evidence=f"{gaps.size} gap{'s' * (gaps.size > 1)} in the samples, the longest "
                f"{step[gaps].max() * 1000.0:.0f} ms (normal: {usual * 1000.0:.3g} ms):"
                f" about {lost:.0f} samples are lost.",
                advice="Find the part of the program that takes too long (the Driver Station's "
                "console prints loop overruns), and run this test again. Until then, do "
                "not trust kA.",
            )


FAULT = Fault(
    name="loop-overrun",
    summary="the robot program is too slow: samples are missing",
    ordinary="the loop stalls about five times within 1.5 s, for 80 to 225 ms each time",
    spoil=spoil,
    detect=detect,
    about="time",
)
