"""Noisy standstill: the velocity is noisy although nothing moves.

On a robot: the velocity is the slope of an analog or absolute encoder, a gyro is used in place of a
wheel, or the frame shakes. A counting encoder at rest reads exactly zero.

Effect on the gains: SysId separates motion from rest by a threshold that it computes from the
noise, and about a third of the noisy samples exceeds it. These rows have a voltage and no motion.
kS becomes too small and kA too large, most for an elevator, which is at rest longest (kA becomes
several times too large). A threshold that is set by hand corrects it.

Fingerprint: at the beginning of a ramp the position does not change, and the velocity is not zero.
"""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from sim.core.log import Array, Log
from sim.core.units import find_unit
from sim.fit.sysid_rows import estimate_noise_floor
from sim.inspect.fault import Damage, DamagedLog, Fault, FaultStrike, LogInterval
from sim.inspect.log_features import LogFeatures

ORDINARY = 0.06  # [share of the log's top speed] standard deviation at severity 1
LOUD = 0.014  # [share of the log's top speed] less noise is a doubt, not a fault
FEWEST = 8  # [samples] at rest; fewer do no harm
SURE = 3.0  # [times LOUD] noise at which the confidence is 0.95


def spoil(log: Log, strike: FaultStrike, rng: np.random.Generator) -> DamagedLog:
    """Add noise to the velocity at rest, in every quasistatic test."""
    ramps = [i for i, run in enumerate(log.runs) if run.kind == "quasistatic"]
    still = LogFeatures(log).rest_lengths
    runs = list(log.runs)
    size = ORDINARY * strike.severity * log.top_speed
    where = []
    for index in ramps:
        run = runs[index]
        if still[index] >= FEWEST:
            velocity = run.velocity.copy()
            velocity[: still[index]] += size * rng.standard_normal(still[index])
            runs[index] = replace(run, velocity=velocity)
            where.append(LogInterval.of_samples(index, run, last=still[index] - 1))
    return DamagedLog(replace(log, runs=tuple(runs)), tuple(where))


def detect(features: LogFeatures) -> Iterable[Damage]:
    """Find velocity noise at the start of ramps, while the position does not change."""
    top, unit = features.log.top_speed, find_unit(features.log.units)
    rests = {}
    for index, run in enumerate(features.log.runs):
        still = features.rest_lengths[index] if run.kind == "quasistatic" else 0
        if still >= FEWEST:
            rests[index] = run.velocity[:still]
    noise = _measure_noise(list(rests.values()))
    if not noise > LOUD * top:
        return
    confidence = 1.0 - 0.5 * 10.0 ** (-noise / (SURE * LOUD * top))
    for index, rest in rests.items():
        run = features.log.runs[index]
        threshold = estimate_noise_floor(run.velocity)
        passed = int(np.sum(np.abs(rest) >= threshold))
        speeds = (f"{v / unit.si:.3g} {unit.symbol}/s" for v in (noise, threshold, 3.0 * noise))
        shown, own, wanted = speeds
        yield Damage(
            where=LogInterval.of_samples(index, run, last=rest.size - 1),
            confidence=confidence,
            evidence=f"The position does not change for {rest.size} samples, but the velocity "
            f"reads about ±{shown}. In {passed} of these samples the velocity is above {own}, "
            "SysId's own threshold for this test, so SysId thinks that the mechanism moves.",
            advice=f"Set the velocity threshold by hand, to about {wanted}, or cut what "
            "comes before the motion.",
        )


def _measure_noise(rests: list[Array]) -> float:
    """[m/s or rad/s] standard deviation of the noise at rest, without drift; 0 if nothing rests."""
    steps = np.concatenate([np.diff(rest) for rest in rests] or [np.zeros(1)])
    return float(np.sqrt(np.mean(steps**2) / 2.0))


FAULT = Fault(
    name="noisy-standstill",
    summary="the velocity is noisy while nothing moves",
    ordinary="the noise at rest is 6 % of the top speed, in both quasistatic tests",
    spoil=spoil,
    detect=detect,
    kinds=("quasistatic",),
    whole=True,
)
