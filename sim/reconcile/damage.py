"""Damaged intervals of a log, and which of them are excluded from the fit."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from sim.estimation.run_records import ExcludedInterval
from sim.reconcile.thresholds import DAMAGED, LEAST_PROBABILITY

STOP_FAULTS = ("hard-stop",)
"""Faults after which the rest of a run is useless: the mechanism leans on a stop."""

RECORD_FAULTS = ("encoder-slip", "voltage-dropout", "stuck-sensor", "sign-flip")
"""Other faults whose intervals are excluded before anything is fitted. The remaining faults look
like missing physics (a soft joint oscillates as a slipping wheel does), and the fit decides."""

WHOLE_RUN_FAULTS = ("sign-flip",)
"""Faults of a whole run. They are ignored if two runs of a log have one: its voltage and motion do
not belong together then."""


LEFT_OUT = "left-out"
"""In place of a fault: the user left the interval out. It is excluded, and not reported."""


@dataclass(frozen=True)
class DamagedInterval:
    """An interval of a run that a fault has damaged, as an inspection reports it.

    Args:
        run: its index, from 0; None concerns the whole log.
        start: [s] on the run's own clock.
        end: [s].
        fault: name of the fault, or ``LEFT_OUT``.
        confidence: [1] 0 to 1.
        sentence: what the inspection found.
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
        reported: the surest interval of each fault, which is reported as a finding.
        suspected: the same of faults that look like missing physics. They are reported if
            something remains that no effect explains.
    """

    excluded: Mapping[str, tuple[ExcludedInterval, ...]] = field(default_factory=dict)
    reported: tuple[DamagedInterval, ...] = ()
    suspected: tuple[DamagedInterval, ...] = ()


def judge_damage(damages: Mapping[str, Sequence[DamagedInterval]]) -> DamageDecision:
    """Decide about the damage that an inspection found in each log.

    An interval is excluded if the user left it out, if it is at a hard stop, or if its fault is one
    of ``RECORD_FAULTS`` with a confidence of at least ``DAMAGED``. Any other fault of a run is
    suspected if its confidence is at least ``LEAST_PROBABILITY``.
    """
    excluded: dict[str, tuple[ExcludedInterval, ...]] = {}
    found: dict[str, DamagedInterval] = {}
    suspected: dict[str, DamagedInterval] = {}
    for name, every in damages.items():
        flipped = {one.run for one in every if one.fault in WHOLE_RUN_FAULTS}
        for one in every:
            stopped, left_out = one.fault in STOP_FAULTS, one.fault == LEFT_OUT
            sure = stopped or (one.fault in RECORD_FAULTS and one.confidence >= DAMAGED)
            if one.fault in WHOLE_RUN_FAULTS and len(flipped) > 1:
                continue
            if (sure or left_out) and one.run is not None:
                interval = ExcludedInterval(one.run, one.start, one.end, stopped)
                excluded[name] = (*excluded.get(name, ()), interval)
            if name == "held_out" or left_out:
                continue
            likely = one.run is not None and one.confidence >= LEAST_PROBABILITY
            if sure or likely:
                told = found if sure else suspected
                best = told.get(one.fault, one)
                told[one.fault] = max(best, one, key=lambda each: each.confidence)
    return DamageDecision(excluded, tuple(found.values()), tuple(suspected.values()))
