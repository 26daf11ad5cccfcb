"""Run every fault detector on a log and combine their results.

    inspect(log).damages

All detectors of ``faults/`` use the same features. If two faults explain the same interval, the one
that explains more of it is kept.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from sim.core.doubt import Doubt
from sim.core.log import Log
from sim.inspect.diagnostics import diagnose_log
from sim.inspect.fault import Damage, Fault
from sim.inspect.faults import FAULTS
from sim.inspect.log_features import LogFeatures
from sim.io.motion import COPIED, leave_out_falls, mend_motion

FASTEST, SLOWEST = 1e-4, 1.0  # [s] sample periods; outside of them the times are not in seconds
CERTAIN = 1e-3  # [1] least doubt of a detection when two are compared


@dataclass(frozen=True)
class Inspection:
    """The result of an inspection: damage and doubts.

    Args:
        damages: in the order of time, those of the whole log first. Ordinary damage is no fault,
            and is included because a fit has to know it.
        doubts: warnings that are not about a known fault.
    """

    damages: tuple[Damage, ...]
    doubts: tuple[Doubt, ...] = ()

    @property
    def faults(self) -> tuple[Damage, ...]:
        """The damage that is a fault, in the order of time; ordinary damage is left out."""
        return tuple(damage for damage in self.damages if not damage.ordinary)

    @property
    def is_clean(self) -> bool:
        """Whether there is no fault, and no grave warning."""
        return not self.faults and not any(doubt.grave for doubt in self.doubts)

    def group_by_kind(self) -> tuple[tuple[Damage, ...], ...]:
        """The faults grouped by kind, the worst kind first, and in each the worst fault first.

        A fault is worse if it damages more seconds, weighted by its confidence; faults of the whole
        log are worst.
        """
        kinds: dict[str, list[Damage]] = {}
        for damage in self.faults:
            kinds.setdefault(damage.fault, []).append(damage)
        sorted_within = (
            tuple(sorted(kind, key=_rate_harm, reverse=True)) for kind in kinds.values()
        )
        return tuple(sorted(sorted_within, key=lambda kind: -sum(map(_rate_harm, kind))))

    def to_json(self) -> dict[str, Any]:
        """The inspection as data for JSON, as ``sysid inspect --json`` prints it."""
        return {
            "faults": [
                {
                    "fault": damage.fault,
                    "run": damage.where.run,
                    "test": damage.where.test,
                    "start_s": damage.where.start,
                    "end_s": damage.where.end,
                    "confidence": round(damage.confidence, 3),
                    "evidence": damage.evidence,
                    "advice": str(damage.advice),
                }
                for damage in self.faults
            ],
            "clean": self.is_clean,
            "doubts": [
                {"code": one.code, "message": one.text, "grave": one.grave} for one in self.doubts
            ],
        }


def inspect(log: Log) -> Inspection:
    """Look for every known fault in a log, of a robot or of the bench.

    Args:
        log: a log with any number of runs.

    Returns:
        The faults and warnings. A confidence is 0 to 1: the share of the anomaly that the fault
        explains, less if another cause is possible. Above 0.5 the fault is likelier than not.

    Examples:
        >>> import numpy as np
        >>> from sim.bench.mechanisms import MECHANISMS
        >>> from sim.bench.routine import Routine
        >>> from sim.bench.simulate import simulate
        >>> log = simulate(MECHANISMS["drivetrain"], Routine(), rng=np.random.default_rng(0))
        >>> inspect(log).is_clean
        True
    """
    log = leave_out_falls(log)
    mended = mend_motion(log)
    if not any(doubt.code == COPIED for doubt in mended.doubts):  # that one is a fault
        log = mended
    features = LogFeatures(log)
    if features.period < FASTEST or features.period > SLOWEST:
        return Inspection((), (*log.doubts, _doubt_clock(features.period)))
    # huge numbers may overflow; the detectors then find nothing
    with np.errstate(all="ignore"):
        found = [damage for fault in FAULTS.values() for damage in _run_detector(fault, features)]
        damages = tuple(sorted(_drop_explained(found), key=_start_of))
        return Inspection(
            damages, (*log.doubts, *_doubt_ordinary(damages), *diagnose_log(features))
        )


def inspect_together(logs: Sequence[Log]) -> Inspection:
    """Look for every known fault in several logs of one mechanism.

    A log with quasistatic and dynamic tests is inspected alone, because its gains may differ from
    those of the others. Logs with a part of the tests are inspected together with all others, and
    missing tests are looked for in all logs together.

    Args:
        logs: at least one log; run indices count through all of them.

    Raises:
        BadRequest: one measures a length, the other an angle.
    """
    first, *others = logs
    if not others:
        return inspect(first)
    joined = first
    for log in others:
        joined = joined.join(log)
    together = inspect(joined)
    damages = [one for one in together.damages if _is_absence(one)]
    doubts: dict[Doubt, list[str]] = {}  # doubt without a file name -> its files
    offset = 0
    for log in logs:
        runs = range(offset, offset + len(log.runs))
        if log.has_ramps_and_steps:
            alone = inspect(log)
            damages += [
                _renumber_run(one, log, offset) for one in alone.damages if not _is_absence(one)
            ]
            for doubt in alone.doubts:
                message = doubt.message.removeprefix(f"{log.source}: ")
                doubts.setdefault(replace(doubt, message=message), []).append(log.source)
        else:
            damages += [one for one in together.damages if one.where.run in runs]
        offset = runs.stop
    if not any(log.has_ramps_and_steps for log in logs):
        damages += [
            one for one in together.damages if one.where.run is None and not _is_absence(one)
        ]
    if not all(log.has_ramps_and_steps for log in logs):
        doubts |= {doubt: [] for doubt in together.doubts}
    named = tuple(_name_files(doubt, sources) for doubt, sources in doubts.items())
    return Inspection(tuple(sorted(damages, key=_start_of)), named)


def _name_files(doubt: Doubt, sources: Iterable[str]) -> Doubt:
    """A doubt whose message begins with the names of its files."""
    files = ", ".join(filter(None, sources))
    return replace(doubt, message=f"{files}: {doubt.message}") if files else doubt


def _is_absence(damage: Damage) -> bool:
    """Whether a damage is a missing test."""
    return damage.where.run is None and bool(damage.where.test)


def _renumber_run(damage: Damage, log: Log, offset: int) -> Damage:
    """A damage of one log of several, with the run index among the runs of all logs."""
    if damage.where.run is None:
        evidence = f"{log.source}: {damage.evidence}" if log.source else damage.evidence
        return replace(damage, evidence=evidence)
    return replace(damage, where=replace(damage.where, run=damage.where.run + offset))


def _doubt_ordinary(damages: Iterable[Damage]) -> tuple[Doubt, ...]:
    """A warning for each kind of ordinary damage, about the most certain one."""
    ordinary = sorted((one for one in damages if one.ordinary), key=lambda one: one.confidence)
    by_fault = {damage.fault: damage for damage in ordinary}
    return tuple(Doubt(name, f"{one.evidence} {one.advice}") for name, one in by_fault.items())


def _run_detector(fault: Fault, features: LogFeatures) -> list[Damage]:
    """The damages that one detector finds; none if its equations have no solution."""
    try:
        return [replace(damage, fault=fault.name) for damage in fault.detect(features)]
    except np.linalg.LinAlgError:
        return []


def _doubt_clock(period: float) -> Doubt:
    """A grave warning about times that are not in seconds."""
    return Doubt(
        "odd-clock",
        f"The samples are {period:.3g} s apart, where a robot logs every 0.001 to 0.1 s: nothing "
        "was inspected. Give times in seconds.",
        grave=True,
    )


def _drop_explained(found: Iterable[Damage]) -> list[Damage]:
    """The damages without those whose interval another fault explains better.

    Faults of whole runs, and those of time, do not compete with faults of the motion.
    """
    kept: list[Damage] = []
    for damage in sorted(found, key=_weigh_evidence, reverse=True):
        if not any(_are_rivals(damage, other) for other in kept):
            kept.append(damage)
    return kept


def _weigh_evidence(damage: Damage) -> float:
    """Weight of a damage, like a log likelihood: its length [s] times -log(1 - confidence)."""
    left = max(1.0 - damage.confidence, CERTAIN)
    return (damage.where.end - damage.where.start) * -math.log(left)


def _are_rivals(one: Damage, other: Damage) -> bool:
    """Whether two damages are different explanations of the same interval."""
    mine, others = FAULTS[one.fault], FAULTS[other.fault]
    if mine is others or mine.about != others.about or mine.whole or others.whole:
        return False
    shared = min(one.where.end, other.where.end) - max(one.where.start, other.where.start)
    return one.where.run == other.where.run and shared >= 0.0  # one sample is enough


def _rate_harm(damage: Damage) -> float:
    """[s] length of a damage times its confidence; infinite for the whole log."""
    if damage.where.run is None:
        return math.inf
    return (damage.where.end - damage.where.start) * damage.confidence


def _start_of(damage: Damage) -> tuple[int, float, str]:
    """Sort key: run, start and name; damage of the whole log comes first."""
    run = damage.where.run
    return (-1 if run is None else run, damage.where.start, damage.fault)
