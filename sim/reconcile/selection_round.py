"""One round of the selection: a model, and the candidates tried on top of it."""

from dataclasses import dataclass, field

from sim.reconcile.candidates import Candidate, Seeds
from sim.reconcile.cross_validation import Gap
from sim.reconcile.story import TriedCandidate


@dataclass(frozen=True, eq=False)
class WeighedCandidate:
    """A candidate with its cross-validated gap.

    Args:
        candidate: the model with the effect.
        gap: cross-validated gap of the model.
        report: the line about it in the story.
    """

    candidate: Candidate
    gap: Gap
    report: TriedCandidate


@dataclass(frozen=True, eq=False)
class SelectionRound:
    """A model, and the candidates tried on top of it.

    Args:
        candidate: the model, and the name of the effect that was added last; empty for the base.
        gap: cross-validated gap of the model.
        without: the model without that effect: the one of the round before; after backward
            elimination, the last model refitted without it. For the base, the base.
        gap_without: the gap of ``without``.
        rivals: effects that would have explained as much.
        seeds: parameter values of the promising candidates of all rounds so far.
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
        """The lines about the candidates of the next round in the story."""
        return tuple(one.report for one in self.candidates)
