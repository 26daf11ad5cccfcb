"""Stale samples: the log is written faster than the sensor's frames arrive.

On a robot: a motor controller sends its position and velocity every 20 ms, 50 ms or 100 ms, and
a faster loop logs the last ones it has, again and again.

Effect on the gains: if a reading repeats for n samples, SysId's three-point slope uses the two
samples at each jump and divides the jump by two periods instead of n; the others have no
acceleration and are removed. kA becomes about 2/n of its size, kS is wrong, kV hardly changes.

Fingerprint: readings repeat for several samples while the mechanism moves, and then jump by many
times the sensor's smallest step. A coarse sensor repeats readings as well, but its jumps *are* the
smallest step. Frames of 20 ms are the default of controllers, so a log that repeats them is
ordinary; slower ones are a fault. A controller may measure its velocity more slowly than it sends:
that is ordinary as well.
"""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from sim.core.log import Array, Log, Run
from sim.inspect.fault import Damage, DamagedLog, Fault, FaultStrike, LogInterval, damage_runs
from sim.inspect.log_features import Counts, Flags, LogFeatures, find_held_samples

ORDINARY = 3.0  # [samples] that repeat each reading at severity 1: 20 ms frames logged at 5 ms
JUMP = 4.0  # [smallest steps of the sensor] a smaller jump may be due to the resolution
FEWEST = 5  # [readings] with clear jumps, at least
FRAME = 0.025  # [s] ordinary frames: motor controllers send every 20 ms by default
VELOCITY_FRAME = 0.064  # [s] of a velocity: REV measures one every 32 ms, and a frame may miss one
STALE = 2  # [samples] median length of a repeated reading, at least


def spoil(log: Log, strike: FaultStrike, rng: np.random.Generator) -> DamagedLog:
    """Hold every reading of the sensor until its next frame."""
    held = max(STALE, 1 + round(ORDINARY * strike.severity))
    phases = rng.integers(held, size=len(log.runs))
    runs = [
        _repeat_samples(run, held, int(phase)) for run, phase in zip(log.runs, phases, strict=True)
    ]
    return damage_runs(log, dict(enumerate(runs)))


def detect(features: LogFeatures) -> Iterable[Damage]:
    """Find runs in which most readings are repeated for several samples during motion."""
    steps = {"velocity": features.velocity_step, "position": features.position_step}
    held = {
        name: [_count_held(getattr(run, name), run.moving, step=step) for run in features.log.runs]
        for name, step in steps.items()
    }
    for index, run in enumerate(features.log.runs):
        stale = {name: runs[index] for name, runs in held.items() if _is_stale(runs, index)}
        if stale:
            yield _describe_damage(index, run, stale)


def _count_held(values: Array, moving: Flags, *, step: float) -> Counts:
    """[samples] (m,) lengths of the repeated readings in motion between two clear jumps."""
    starts, lengths = find_held_samples(values)
    clear = np.abs(np.diff(values[starts])) > JUMP * step
    between = clear[:-1] & clear[1:] & moving[starts[1:-1]]
    return np.asarray(lengths[1:-1][between])


def _is_stale(runs: list[Counts], index: int) -> bool:
    """Whether a run's readings usually repeat; with few readings, those of the log decide."""
    own = runs[index]
    proof = own if own.size >= FEWEST else np.concatenate(runs)
    return (
        own.size > 0
        and proof.size >= FEWEST
        and min(float(np.median(own)), float(np.median(proof))) >= STALE
    )


def _describe_damage(index: int, run: Run, stale: dict[str, Counts]) -> Damage:
    """The damage of a run; ``stale`` is signal -> lengths of its repeated readings [samples]."""
    period = float(np.median(np.diff(run.time)))
    repeated = " and ".join(
        f"each {name} for {held.mean():.1f} samples" for name, held in stale.items()
    )
    longest = {name: float(np.median(held)) * period for name, held in stale.items()}
    usual = max(float(held.mean()) for held in stale.values()) * period
    readings = max(held.size for held in stale.values())
    ordinary = (
        longest.get("position", 0.0) <= FRAME and longest.get("velocity", 0.0) <= VELOCITY_FRAME
    )
    advice = (
        "This is not a fault. For a more accurate kA, raise the rate of the controller's status "
        "frames."
        if ordinary
        else "Raise the rate of the controller's status frames to 20 ms or faster, and record "
        "again. Until then, do not trust kA."
    )
    return Damage(
        where=LogInterval.of_samples(index, run),
        confidence=1.0 - 0.5 ** (1.0 + readings / FEWEST),
        evidence=f"The log repeats {repeated}. It has a sample every {period * 1000.0:.3g} ms, but "
        f"the sensor updates only every {usual * 1000.0:.0f} ms.",
        advice=advice,
        ordinary=ordinary,
    )


def _repeat_samples(run: Run, held: int, phase: int) -> Run:
    """The run with frames of ``held`` samples, the first one shorter by ``phase``."""
    count = np.arange(len(run))
    latest = np.maximum((count + phase) // held * held - phase, 0)
    return replace(run, position=run.position[latest], velocity=run.velocity[latest])


FAULT = Fault(
    name="stale-samples",
    summary="the sensor updates less often than the log is written, so values repeat",
    ordinary="every reading is held for 4 samples, as 20 ms frames in a 5 ms log",
    spoil=spoil,
    detect=detect,
    whole=True,
)
