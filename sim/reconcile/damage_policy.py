"""Decide which detected damage is cut out and which is only reported."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from sim.estimation.run_records import ExcludedInterval
from sim.reconcile.damage import DamagedInterval
from sim.reconcile.thresholds import DAMAGED

FOR_GOOD = ("hard-stop",)
"""Faults after which a run tells nothing more: it leans on a stop."""

OF_THE_RECORD = ("encoder-slip", "voltage-dropout", "stuck-sensor", "sign-flip")
"""Other faults whose intervals are cut out before anything is fitted. What is left looks like
missing physics (a soft joint oscillates as a slipping wheel does), and the fit decides on it."""

WHOLE = ("sign-flip",)
"""Faults of a whole run. Two such runs are no fault: voltage and motion do not belong together."""


@dataclass(frozen=True)
class DamageDecision:
    """Which damage is excluded from the fit, and which is only reported.

    Args:
        excluded: which log -> stretches that are left out.
        reported: what is reported as a finding, one of each fault.
    """

    excluded: Mapping[str, tuple[ExcludedInterval, ...]] = field(default_factory=dict)
    reported: tuple[DamagedInterval, ...] = ()

    def list_excluded(self, name: str) -> tuple[ExcludedInterval, ...]:
        """The intervals of a log that are left out of the fit."""
        return self.excluded.get(name, ())


def judge_damage(damages: Mapping[str, Sequence[DamagedInterval]]) -> DamageDecision:
    """Decide about the damage that an inspection found in each log."""
    cut: dict[str, list[ExcludedInterval]] = {}
    found: dict[str, DamagedInterval] = {}
    for name, every in damages.items():
        turned = {one.run for one in every if one.fault in WHOLE}
        for one in every:
            if not _is_damage_to_record(one) or (one.fault in WHOLE and len(turned) > 1):
                continue
            if one.run is not None:
                stretch = ExcludedInterval(one.run, one.start, one.end, one.fault in FOR_GOOD)
                cut.setdefault(name, []).append(stretch)
            if name != "held_out" and one.confidence > _confidence(found.get(one.fault)):
                found[one.fault] = one
    return DamageDecision({name: tuple(some) for name, some in cut.items()}, tuple(found.values()))


def _confidence(one: DamagedInterval | None) -> float:
    return -1.0 if one is None else one.confidence


def _is_damage_to_record(one: DamagedInterval) -> bool:
    """Whether it is cut out: surely damage, or a stop, beyond which a run says nothing anyway."""
    return one.fault in FOR_GOOD or (one.fault in OF_THE_RECORD and one.confidence >= DAMAGED)
