"""The result of reconcile: verdict, findings, and the gap at each step."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from numpy import bool_
from numpy.typing import NDArray

from sim.core.log import Array, Log
from sim.gap.place import Place
from sim.physics.model import Model
from sim.reconcile.probability import JudgedEffect

NOTHING_MISSING, EXPLAINED = "nothing-missing", "explained"
AMBIGUOUS, UNEXPLAINED = "ambiguous", "unexplained"


@dataclass(frozen=True)
class ParameterEstimate:
    """A parameter, as found, in the owner's unit.

    Args:
        value: of it.
        error: one standard error, infinite if the log does not determine the parameter; None where
            a start chose it and nothing was searched.
        unit: of both.
    """

    value: float
    error: float | None
    unit: str


@dataclass(frozen=True)
class Finding:
    """One thing that was missing in the model, or wrong with the record.

    Args:
        effect: its name, of an effect or a fault.
        kind: ``effect`` or ``fault``.
        size: ``major`` or ``minor``.
        ambiguous_with: other effects that would explain as much.
        parameters: name -> estimate.
        gap_before: [owner's unit/s] RMS velocity error of the simulation without it.
        gap_after: the same with it.
        sentence: what it is and does, for a person.
        inspect: what to look at on the robot.
        separating_test: which test tells it from what it is ambiguous with; empty if it is not.
        probability: [1] that the effect, or one that it is ambiguous with, is missing in the base
            model; 1 for a fault, which an inspection found.
    """

    effect: str
    kind: str
    size: str
    ambiguous_with: tuple[str, ...]
    parameters: Mapping[str, ParameterEstimate]
    gap_before: float
    gap_after: float
    sentence: str
    inspect: str
    separating_test: str
    probability: float = 1.0


@dataclass(frozen=True)
class TriedCandidate:
    """A candidate of one round.

    Args:
        effect: its name.
        improvement: [of -2 log L] by which it would make the BIC smaller; negative: larger.
        gap_ratio: [1] gap of the validation over the one before, below 1 if it shrinks; nan if it
            was not computed.
        admitted: whether it passed every gate.
        why: the gate that it did not pass; empty if it passed all.
    """

    effect: str
    improvement: float
    gap_ratio: float
    admitted: bool
    why: str


@dataclass(frozen=True, eq=False)
class Chapter:
    """One round: a model, what was tried on top of it, and how its simulation follows the log.

    Args:
        added: the effect that made this model of the one before; empty for the base.
        model: with it.
        tried: the candidates of the next round, the likeliest first.
        gap: [owner's unit/s] RMS velocity error on the shown log.
        tracks: a run of the shown log -> (n, 2) simulated position and velocity, SI.
    """

    added: str
    model: Model
    tried: tuple[TriedCandidate, ...]
    gap: float
    tracks: tuple[Array, ...]


@dataclass(frozen=True, eq=False)
class Story:
    """The result of reconcile: verdict, findings, and the gap after each round.

    Args:
        verdict: ``nothing-missing``, ``explained``, ``ambiguous`` or ``unexplained``.
        findings: what was missing or wrong, the most telling first.
        remainder: something is left that no effect of the catalogue explains.
        remains: a sentence about it; empty if nothing remains.
        noise_floor: [owner's unit/s] RMS noise of the shown velocity, at least ``LEAST_FLOOR`` of
            the top speed. Gaps are told in multiples of it.
        gap_before: [owner's unit/s] RMS velocity error of the base model on the shown log.
        gap_after: the same of the last model.
        where: where the base model disagrees most.
        chapters: the base first, then a model for each effect added.
        shown: the log that was held out; or what stood in for it.
        how: how the logs were used, in a sentence.
        notes: other things a person should know.
        compared: a run of ``shown`` -> (n,) which of its samples count; empty: all of them.
        judged: effects of the last model that might have been findings, and how likely each is.
    """

    verdict: str
    findings: tuple[Finding, ...]
    remainder: bool
    remains: str
    noise_floor: float
    gap_before: float
    gap_after: float
    where: tuple[Place, ...]
    chapters: tuple[Chapter, ...]
    shown: Log
    how: str
    notes: tuple[str, ...] = ()
    compared: tuple[NDArray[bool_], ...] = ()
    judged: tuple[JudgedEffect, ...] = ()

    @property
    def model(self) -> Model:
        """The last model."""
        return self.chapters[-1].model

    def to_json(self) -> dict[str, Any]:
        """As ``sysid reconcile --json`` prints it."""
        return {
            "verdict": self.verdict,
            "findings": [_finding(one) for one in self.findings],
            "remainder": self.remainder,
            "noise_floor": self.noise_floor,
            "gap_before": _finite(self.gap_before),
            "gap_after": _finite(self.gap_after),
            "where": [
                {
                    "what": one.what,
                    "where": one.where,
                    "signal": one.signal,
                    "error": _finite(one.error),
                    "sure": one.sure,
                }
                for one in self.where
            ],
            "how": self.how,
            "notes": [*self.notes, *([self.remains] if self.remains else [])],
        }


def _finite(number: float | None) -> float | None:
    """The number; None where it is not finite, which JSON cannot say."""
    return number if number is not None and math.isfinite(number) else None


def _finding(one: Finding) -> dict[str, Any]:
    return {
        "effect": one.effect,
        "kind": one.kind,
        "size": one.size,
        "probability": one.probability,
        "ambiguous_with": list(one.ambiguous_with),
        "parameters": {
            name: {"value": p.value, "error": _finite(p.error), "unit": p.unit}
            for name, p in one.parameters.items()
        },
        "gap_before": _finite(one.gap_before),
        "gap_after": _finite(one.gap_after),
        "separating_test": one.separating_test,
        "sentence": one.sentence,
        "inspect": one.inspect,
    }
