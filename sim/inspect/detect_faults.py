"""Run every fault detector on a log and combine their results.

    inspect(log).damages

Each fault of ``faults/`` looks at the same features. Where two of them explain the same moment, the
one that explains more of it is kept: damage at one moment has one cause.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from sim.core.doubt import Doubt
from sim.core.log import Log
from sim.inspect.diagnostics import diagnose_log
from sim.inspect.fault import Damage, Fault
from sim.inspect.faults import FAULTS
from sim.inspect.log_features import LogFeatures

FASTEST, SLOWEST = 1e-4, 1.0  # [s] between samples; other clocks do not tell seconds
CERTAIN = 1e-3  # [1] nothing is surer than this, for all that two explanations are compared


@dataclass(frozen=True)
class Inspection:
    """The result of an inspection: damage and doubts.

    Args:
        damages: in the order of time; those that concern the whole log first. Those that are
            ordinary are no faults, and come here because a fit has to know of them.
        doubts: what is odd and no known fault: about the file, and about what it holds.
    """

    damages: tuple[Damage, ...]
    doubts: tuple[Doubt, ...] = ()

    @property
    def faults(self) -> tuple[Damage, ...]:
        """The damage that is a fault, in the order of time; ordinary damage is left out."""
        return tuple(damage for damage in self.damages if not damage.ordinary)

    @property
    def is_clean(self) -> bool:
        """Whether no fault was found, and nothing that would hide one."""
        return not self.faults and not any(doubt.grave for doubt in self.doubts)

    def group_by_kind(self) -> tuple[tuple[Damage, ...], ...]:
        """The faults of each kind together, the worst kind first, and the worst of a kind first.

        Worse is what spoils more seconds, weighted by its confidence; what concerns the whole log
        is worst.
        """
        kinds: dict[str, list[Damage]] = {}
        for damage in self.faults:
            kinds.setdefault(damage.fault, []).append(damage)
        sorted_within = (tuple(sorted(kind, key=_harm, reverse=True)) for kind in kinds.values())
        return tuple(sorted(sorted_within, key=lambda kind: -sum(map(_harm, kind))))

    def to_json(self) -> dict[str, Any]:
        """The inspection as plain data, as ``sysid inspect --json`` prints it."""
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
                    "advice": damage.advice,
                }
                for damage in self.faults
            ],
            "clean": self.is_clean,
            "doubts": [asdict(doubt) for doubt in self.doubts],
        }


def inspect(log: Log) -> Inspection:
    """Look for every known fault in a log, of a robot or of the bench.

    Args:
        log: with any number of runs.

    Returns:
        What was found. A confidence is 0 to 1: the share of what is odd in that stretch which this
        fault alone would explain, less where the same could be an accident. Above 0.5 it is
        likelier than not.

    Examples:
        >>> import numpy as np
        >>> from sim.bench.mechanisms import MECHANISMS
        >>> from sim.bench.routine import Routine
        >>> from sim.bench.simulate import simulate
        >>> log = simulate(MECHANISMS["drivetrain"], Routine(), rng=np.random.default_rng(0))
        >>> inspect(log).is_clean
        True
    """
    features = LogFeatures(log)
    if features.period < FASTEST or features.period > SLOWEST:
        return Inspection((), (*log.doubts, _doubt_clock(features.period)))
    # numbers at the edge of what a double holds overflow somewhere, and then say nothing
    with np.errstate(all="ignore"):
        found = [damage for fault in FAULTS.values() for damage in _run_detector(fault, features)]
        damages = tuple(sorted(_drop_explained(found), key=_start_of))
        return Inspection(damages, (*log.doubts, *_ordinary(damages), *diagnose_log(features)))


def inspect_together(logs: Sequence[Log]) -> Inspection:
    """Look for every known fault in several logs of one mechanism.

    A log with tests of both kinds is inspected alone, since its gains and its faults are its own.
    Logs that hold a part of the tests are inspected together with all others. Which tests are
    missing is asked of all logs together.

    Args:
        logs: at least one; runs are counted through all of them.

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
    doubts: dict[Doubt, list[str]] = {}  # without the name of a file -> of which files
    offset = 0
    for log in logs:
        runs = range(offset, offset + len(log.runs))
        if log.has_ramps_and_steps:
            alone = inspect(log)
            damages += [_of_file(one, log, offset) for one in alone.damages if not _is_absence(one)]
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
    """A doubt that begins with the files it is about."""
    files = ", ".join(filter(None, sources))
    return replace(doubt, message=f"{files}: {doubt.message}") if files else doubt


def _is_absence(damage: Damage) -> bool:
    """Whether a damage is that a test is not in the log."""
    return damage.where.run is None and bool(damage.where.test)


def _of_file(damage: Damage, log: Log, offset: int) -> Damage:
    """A damage of one log, as one of several: with its run's number among all runs."""
    if damage.where.run is None:
        evidence = f"{log.source}: {damage.evidence}" if log.source else damage.evidence
        return replace(damage, evidence=evidence)
    return replace(damage, where=replace(damage.where, run=damage.where.run + offset))


def _ordinary(damages: Iterable[Damage]) -> tuple[Doubt, ...]:
    """What is ordinary, each kind said once."""
    ordinary = sorted((one for one in damages if one.ordinary), key=lambda one: one.confidence)
    once = {damage.fault: damage for damage in ordinary}
    return tuple(Doubt(name, f"{one.evidence} {one.advice}") for name, one in once.items())


def _run_detector(fault: Fault, features: LogFeatures) -> list[Damage]:
    """What one detector finds; nothing where the log leaves its equations without a solution."""
    try:
        return list(fault.detect(features))
    except np.linalg.LinAlgError:
        return []


def _doubt_clock(period: float) -> Doubt:
    return Doubt(
        "odd-clock",
        f"The samples are {period:.3g} s apart, where a robot logs every 0.001 to 0.1 s: nothing "
        "was inspected. Give times in seconds.",
        grave=True,
    )


def _drop_explained(found: Iterable[Damage]) -> list[Damage]:
    """The damages without those whose moment another fault explains better.

    What spoils whole runs, or the time, stands beside what happens to the motion in a moment.
    """
    kept: list[Damage] = []
    for damage in sorted(found, key=_evidence_weight, reverse=True):
        if not any(_are_rivals(damage, other) for other in kept):
            kept.append(damage)
    return kept


def _evidence_weight(damage: Damage) -> float:
    """How much a damage explains, as a likelihood counts: its length, and what it leaves over."""
    left = max(1.0 - damage.confidence, CERTAIN)
    return (damage.where.end - damage.where.start) * -math.log(left)


def _are_rivals(one: Damage, other: Damage) -> bool:
    """Whether two damages are different explanations of one moment."""
    mine, others = FAULTS[one.fault], FAULTS[other.fault]
    if mine is others or mine.about != others.about or mine.whole or others.whole:
        return False
    shared = min(one.where.end, other.where.end) - max(one.where.start, other.where.start)
    return one.where.run == other.where.run and shared > 0.0


def _harm(damage: Damage) -> float:
    """[s] of the log that a damage spoils, weighted by its confidence."""
    if damage.where.run is None:
        return math.inf
    return (damage.where.end - damage.where.start) * damage.confidence


def _start_of(damage: Damage) -> tuple[int, float, str]:
    run = damage.where.run
    return (-1 if run is None else run, damage.where.start, damage.fault)
