"""One round of the selection: a model, and the candidates tried on top of it."""

import math
from dataclasses import dataclass, field

from sim.estimation.likelihood import Estimate
from sim.reconcile.candidates import Candidate, Seeds
from sim.reconcile.cross_validation import Gap
from sim.reconcile.story import Tried


@dataclass(frozen=True, eq=False)
class WeighedCandidate:
    """A candidate with its cross-validated gap.

    Args:
        candidate: the model with it.
        gap: outside of what was fitted.
        tried: the same, as it is told.
    """

    candidate: Candidate
    gap: Gap
    tried: Tried


@dataclass(frozen=True, eq=False)
class SelectionRound:
    """A model, and the candidates tried on top of it.

    Args:
        candidate: the model, and the effect that made it of the one before; empty for the base.
        gap: outside of what was fitted.
        before: the gap without that effect; the same for the base.
        rivals: effects that would have explained as much.
        tried: the candidates of the next round.
        quiet: effects of the model that make the log likelier and hardly narrow the gap.
        plain: the model before the first of those; None if there are none.
        seeds: parameters of the candidates that were likelier than nothing, of all rounds so far.
        lost: [of -2 log L] what the last model would lose without this effect; nan if not asked.
        bare: the gap of the last model without this effect; None if not asked.
        candidates: the candidates of the next round, with their models.
    """

    candidate: Candidate
    gap: Gap
    before: Gap
    rivals: tuple[str, ...] = ()
    tried: tuple[Tried, ...] = ()
    quiet: int = 0
    plain: Candidate | None = None
    seeds: Seeds = field(default_factory=dict)
    lost: float = math.nan
    bare: Gap | None = None
    candidates: tuple[WeighedCandidate, ...] = ()


def reported_estimate(one: SelectionRound) -> Estimate:
    """The estimate of a round that is shown to people."""
    plain = one.plain if one.plain and not one.plain.effect else None
    return (plain or one.candidate).point
