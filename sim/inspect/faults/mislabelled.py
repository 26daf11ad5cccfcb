"""Mislabelled test: a run is filed under the name of another test.

On a robot: two buttons are bound to each other's command, or somebody renamed the wrong part.

To the gains: a ramp taken for a step has no peak of acceleration to start from, and a step taken
for a ramp keeps every sample; kA suffers most. Two directions that change their names change
nothing in the regression, which sees signs, but everything in "forward and reverse".

Fingerprint: what the voltage does says which test it is. It rises with time or it stands, and it
pushes the way the mechanism goes; a voltage against the motion is another fault, ``sign-flip``.
"""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from sim.core.log import FOUR_TESTS, Log, Run
from sim.inspect.fault import Damage, DamagedLog, Fault, FaultStrike, LogInterval
from sim.inspect.log_features import LogFeatures

ALL = 2.0  # [severity] from which no test keeps its name
CONFIDENCE = 0.95  # a ramp cannot look like a step; a team's own forward may be another's reverse


def spoil(log: Log, blow: FaultStrike, rng: np.random.Generator) -> DamagedLog:
    """Let the struck run change names with another one; from severity 2 on, all of them move on."""
    runs = list(log.runs)
    names = [run.test for run in runs]
    others = [i for i, run in enumerate(runs) if run.test in FOUR_TESTS and i != blow.run]
    others = [i for i in others if names[i] != names[blow.run]]
    if others and blow.severity < ALL:
        moved = [blow.run, int(rng.choice(others))]
    else:
        moved = [blow.run, *(int(i) for i in rng.permutation(others))]
    for place, source in zip(moved, np.roll(moved, 1), strict=True):
        runs[place] = replace(runs[place], test=names[int(source)])
    where = [_whole(i, runs[i]) for i in sorted(moved) if runs[i].test != names[i]]
    return DamagedLog(replace(log, runs=tuple(runs)), tuple(where))


def detect(features: LogFeatures) -> Iterable[Damage]:
    """Compare every run's name with what its voltage does."""
    for index, (run, seems) in enumerate(
        zip(features.log.runs, features.recognized_tests, strict=True)
    ):
        if seems != run.test:
            yield Damage(
                fault="mislabelled-test",
                where=_whole(index, run),
                confidence=CONFIDENCE,
                evidence=f"Filed as {run.test}, it looks like {seems}: {_voltage(run)}.",
                advice=f"Rename the run to {seems}, and check which button runs which test.",
            )


def _voltage(run: Run) -> str:
    """What the voltage does, and how far the mechanism went."""
    start, middle, end = np.percentile(run.voltage, (2, 50, 98))
    if abs(start) > abs(end):
        start, end = end, start
    return (
        f"half of its voltages are {'below' if middle > 0 else 'above'} {middle:.2f} V on the way "
        f"from {start:.2f} to {end:.2f} V, and the position changes by "
        f"{run.position[-1] - run.position[0]:.3g}"
    )


def _whole(index: int, run: Run) -> LogInterval:
    return LogInterval(index, run.test, float(run.time[0]), float(run.time[-1]))


FAULT = Fault(
    name="mislabelled-test",
    summary="a run is filed under the name of another test",
    ordinary="two runs have changed names; from severity 2 on, all of them",
    spoil=spoil,
    detect=detect,
    whole=True,
)
