"""Mislabelled test: a run has the name of another test.

On a robot: two buttons start each other's test, or a run was renamed wrongly.

Effect on the gains: a ramp that is called a step has no peak of acceleration at which SysId could
start, and a step that is called a ramp keeps every sample; kA is affected most. Exchanged
directions change nothing in the regression, but everything that is reported per direction.

Fingerprint: the voltage shows which test it is. It rises with time or is constant, and its sign is
the direction of the motion; a voltage against the motion is another fault, ``sign-flip``.
"""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from sim.core.log import FOUR_TESTS, Log, Run
from sim.inspect.fault import Damage, DamagedLog, Fault, FaultStrike, LogInterval
from sim.inspect.log_features import RAMP, LogFeatures, find_driven_samples

ALL = 2.0  # [severity] from which on no test keeps its name
CONFIDENCE = 0.95  # [1] a ramp cannot look like a step, but forward is a convention


def spoil(log: Log, strike: FaultStrike, rng: np.random.Generator) -> DamagedLog:
    """Exchange the names of two runs; from severity 2 on, shift the names of all runs."""
    runs = list(log.runs)
    names = [run.test for run in runs]
    others = [i for i, run in enumerate(runs) if run.test in FOUR_TESTS and i != strike.run]
    others = [i for i in others if names[i] != names[strike.run]]
    if others and strike.severity < ALL:
        moved = [strike.run, int(rng.choice(others))]
    else:
        moved = [strike.run, *(int(i) for i in rng.permutation(others))]
    for place, source in zip(moved, np.roll(moved, 1), strict=True):
        runs[place] = replace(runs[place], test=names[int(source)])
    where = [LogInterval.of_samples(i, runs[i]) for i in sorted(moved) if runs[i].test != names[i]]
    return DamagedLog(replace(log, runs=tuple(runs)), tuple(where))


def detect(features: LogFeatures) -> Iterable[Damage]:
    """Find runs whose name does not match their voltage."""
    if _are_directions_exchanged(features):
        return
    for index, (run, seems) in enumerate(
        zip(features.log.runs, features.recognized_tests, strict=True)
    ):
        if seems != run.test:
            yield Damage(
                where=LogInterval.of_samples(index, run),
                confidence=CONFIDENCE,
                evidence=f"The run has the name {run.test}, but it looks like {seems}: "
                f"{_describe_run(run)}.",
                advice=f"Rename the run to {seems}, and check which button starts which test.",
            )


def _are_directions_exchanged(features: LogFeatures) -> bool:
    """Whether all tests have the other direction: then it is a convention, not a fault."""
    pairs = [
        (run.test, seems)
        for run, seems in zip(features.log.runs, features.recognized_tests, strict=True)
        if run.test in FOUR_TESTS
    ]
    other = {"forward": "reverse", "reverse": "forward"}
    return len({name for name, _ in pairs}) > 1 and all(
        name.split("-") == [seems.split("-")[0], other[seems.split("-")[1]]]
        for name, seems in pairs
    )


def _describe_run(run: Run) -> str:
    """Half a sentence about the voltage and the distance of a run."""
    driven = run.voltage[find_driven_samples(run)]
    first, last = (float(np.median(part)) for part in np.array_split(driven, 2))
    does = "rises" if abs(first) < RAMP * abs(last) else "stays"
    return (
        f"its voltage {does} (about {first:.2f} V in the first half, {last:.2f} V in the second), "
        f"and the position changes by {run.position[-1] - run.position[0]:.3g}"
    )


FAULT = Fault(
    name="mislabelled-test",
    summary="a run has the name of another test",
    ordinary="two runs have each other's names; from severity 2 on, all runs have wrong names",
    spoil=spoil,
    detect=detect,
    whole=True,
)
