"""One round of the selection: a model, and the candidates tried on top of it."""

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
        candidate: the model, and the effect that was added to it; empty for the base.
        gap: of the model, on runs to which it was not fitted.
        without: the model without that effect: first that of the round before; after the search,
            the last model, refitted without it. The base itself, for the base.
        gap_without: the gap of ``without``.
        rivals: effects that would have explained as much.
        seeds: parameters of the candidates that were likelier than nothing, of all rounds so far.
        candidates: the candidates of the next round, with their models.
    """

    candidate: Candidate
    gap: Gap
    without: Candidate
    gap_without: Gap
    rivals: tuple[str, ...] = ()
    seeds: Seeds = field(default_factory=dict)
    candidates: tuple[WeighedCandidate, ...] = ()

    @classmethod
    def make_base(cls, candidate: Candidate, gap: Gap) -> "SelectionRound":
        """The first round, of the model without effects."""
        return cls(candidate, gap, candidate, gap)

    @property
    def tried(self) -> tuple[TriedCandidate, ...]:
        """The candidates of the next round, as they are told."""
        return tuple(one.report for one in self.candidates)
