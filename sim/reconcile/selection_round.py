"""One round of the selection: a model, and the candidates tried on top of it."""

import math
from dataclasses import dataclass, field

from sim.reconcile.candidates import Candidate, Seeds
from sim.reconcile.cross_validation import Gap
from sim.reconcile.story import TriedCandidate


@dataclass(frozen=True, eq=False)
class WeighedCandidate:
    """A candidate with its cross-validated gap.

    Args:
        candidate: the model with it.
        gap: outside of what was fitted.
        report: the same, as it is told.
    """

    candidate: Candidate
    gap: Gap
    report: TriedCandidate


@dataclass(frozen=True, eq=False)
class SelectionRound:
    """A model, and the candidates tried on top of it.

    Args:
        candidate: the model, and the effect that made it of the one before; empty for the base.
        gap: outside of what was fitted.
        gap_before: the gap without that effect; the same for the base.
        rivals: effects that would have explained as much.
        seeds: parameters of the candidates that were likelier than nothing, of all rounds so far.
        removal_cost: [of -2 log L] what the last model would lose without this effect; nan if not
            asked.
        without: the last model, refitted without this effect; None if not asked.
        gap_without: the gap of that; None if not asked.
        candidates: the candidates of the next round, with their models.
    """

    candidate: Candidate
    gap: Gap
    gap_before: Gap
    rivals: tuple[str, ...] = ()
    seeds: Seeds = field(default_factory=dict)
    removal_cost: float = math.nan
    without: Candidate | None = None
    gap_without: Gap | None = None
    candidates: tuple[WeighedCandidate, ...] = ()

    @property
    def tried(self) -> tuple[TriedCandidate, ...]:
        """The candidates of the next round, as they are told."""
        return tuple(one.report for one in self.candidates)
