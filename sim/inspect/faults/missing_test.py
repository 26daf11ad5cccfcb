"""Missing test: one of the four tests was never recorded, or its part of the log was lost.

On a robot: a test was forgotten, the log was split, or the mechanism could not be moved back.

Effect on the gains: without a dynamic test kA is not determined, without a quasistatic one kS and
kV cannot be separated. Without one direction, a difference of friction is not noticed, and an
elevator's kG cannot be separated from its kS. SysId refuses such a log since 2025.

Fingerprint: one of the four tests is not in the log. A test with the name of another is not
missing, and a log with none of the four is not a SysId log.
"""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from sim.core.log import FOUR_TESTS, Log
from sim.inspect.fault import Damage, DamagedLog, Fault, FaultStrike, LogInterval
from sim.inspect.log_features import LogFeatures

CONFIDENCE = 0.98  # [1] the test may be in another log

_PURPOSE = {
    "quasistatic": "a ramp separates kS from kV",
    "dynamic": "only a step shows kA",
}


def spoil(log: Log, strike: FaultStrike, rng: np.random.Generator) -> DamagedLog:
    """Remove a test, and further ones beyond severity 1; one test always stays."""
    struck = log.runs[strike.run].test
    others = sorted({run.test for run in log.runs} - {struck})
    further = rng.permutation(len(others))[: max(0, min(round(strike.severity), len(others)) - 1)]
    lost = {struck, *(others[index] for index in further)} if others else set()
    kept = tuple(run for run in log.runs if run.test not in lost)
    return DamagedLog(
        replace(log, runs=kept), tuple(LogInterval(test=test) for test in sorted(lost))
    )


def detect(features: LogFeatures) -> Iterable[Damage]:
    """Find tests of which no run has the name or the voltage."""
    there = {run.test for run in features.log.runs} | set(features.recognized_tests)
    if not there & set(FOUR_TESTS):
        return
    for test in FOUR_TESTS:
        if test not in there:
            kind = test.partition("-")[0]
            yield Damage(
                where=LogInterval(test=test),
                confidence=CONFIDENCE,
                evidence=f"Only {len(there & set(FOUR_TESTS))} of the four tests are in the log,"
                f" and {test} is missing. You need it: {_PURPOSE[kind]}, and each direction has "
                "its own friction.",
                advice=f"Run {test}{_describe_other(features.log, kind)}, and pass its file "
                "together with this one. If the mechanism cannot do it, write that down next to "
                "the gains.",
            )


def _describe_other(log: Log, kind: str) -> str:
    """Half a sentence with the voltage of the other direction; empty if there is none."""
    volts = [float(np.abs(run.voltage).max(initial=0.0)) for run in log.runs if run.kind == kind]
    if not volts or not max(volts):
        return ""
    return f" with up to {max(volts):.1f} V, like the other direction"


FAULT = Fault(
    name="missing-test",
    summary="one of the four tests is not in the log",
    ordinary="one test is lost; at severity 2, two tests are lost, and at severity 3, three",
    spoil=spoil,
    detect=detect,
    whole=True,
)
