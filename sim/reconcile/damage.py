"""Damaged intervals of a log, and which of them are excluded from the fit."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from sim.estimation.run_records import ExcludedInterval
from sim.reconcile.thresholds import DAMAGED

FOR_GOOD = ("hard-stop",)
"""Faults after which a run tells nothing more: it leans on a stop."""

OF_THE_RECORD = ("encoder-slip", "voltage-dropout", "stuck-sensor", "sign-flip")
"""Other faults whose intervals are excluded before anything is fitted. The remaining faults look
like missing physics (a soft joint oscillates as a slipping wheel does), and the fit decides."""

WHOLE = ("sign-flip",)
"""Faults of a whole run. Two such runs are no fault: voltage and motion do not belong together."""


@dataclass(frozen=True)
class DamagedInterval:
    """An interval of a run that a fault has damaged, as an inspection reports it.

    Args:
        run: which one, from 0; None concerns the whole log.
        start: [s] on the run's own clock.
        end: [s].
        fault: its name.
        confidence: [1] 0 to 1.
        sentence: what was seen.
        advice: what to do.
    """

    run: int | None
    start: float
    end: float
    fault: str
    confidence: float
    sentence: str
    advice: str


@dataclass(frozen=True)
class DamageDecision:
    """Which damage is excluded from the fit, and which is only reported.

    Args:
        excluded: log name -> intervals that are excluded.
        reported: what is reported as a finding, one of each fault.
    """

    excluded: Mapping[str, tuple[ExcludedInterval, ...]] = field(default_factory=dict)
    reported: tuple[DamagedInterval, ...] = ()


def judge_damage(damages: Mapping[str, Sequence[DamagedInterval]]) -> DamageDecision:
    """Decide about the damage that an inspection found in each log.

    An interval is excluded if it is surely damaged, or a stop, after which a run tells nothing
    anyway.
    """
    excluded: dict[str, list[ExcludedInterval]] = {}
    found: dict[str, DamagedInterval] = {}
    for name, every in damages.items():
        turned = {one.run for one in every if one.fault in WHOLE}
        for one in every:
            damaged = one.fault in OF_THE_RECORD and one.confidence >= DAMAGED
            if not (damaged or one.fault in FOR_GOOD) or (one.fault in WHOLE and len(turned) > 1):
                continue
            if one.run is not None:
                interval = ExcludedInterval(one.run, one.start, one.end, one.fault in FOR_GOOD)
                excluded.setdefault(name, []).append(interval)
            best = found.get(one.fault)
            if name != "held_out" and (best is None or one.confidence > best.confidence):
                found[one.fault] = one
    return DamageDecision(
        {name: tuple(some) for name, some in excluded.items()}, tuple(found.values())
    )
