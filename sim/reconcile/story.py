"""The result of reconcile: verdict, findings, and the gap at each step."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from numpy import bool_
from numpy.typing import NDArray

from sim.core.log import Array, Log
from sim.fit.replay import SENSOR_LAGS
from sim.gap.place import Place
from sim.physics.model import Model
from sim.reconcile.probability import JudgedEffect
from sim.reconcile.thresholds import MAJOR_UNEXPLAINED
from sim.support.printable import finite_or_none

if TYPE_CHECKING:
    from sim.reconcile.model_variant import ModelVariants

NOTHING_MISSING, EXPLAINED = "nothing-missing", "explained"
AMBIGUOUS, UNEXPLAINED = "ambiguous", "unexplained"


@dataclass(frozen=True)
class ParameterEstimate:
    """An estimated parameter, in the log's unit.

    Args:
        value: the estimate.
        error: one standard error, infinite if the log does not determine the parameter; None if it
            is a start value that no search changes.
        unit: symbol of the unit of both.
    """

    value: float
    error: float | None
    unit: str


@dataclass(frozen=True)
class Finding:
    """An effect that is missing in the base model, or a fault of the record.

    Args:
        effect: name of the effect or fault.
        kind: ``effect`` or ``fault``.
        size: ``major`` or ``minor``.
        probability: [1] that the effect, or one that it is ambiguous with, is missing in the base
            model; for a fault, the confidence of the inspection that found it.
        ambiguous_with: other effects that would explain as much.
        parameters: name -> estimate.
        gap_before: [log's unit/s] RMS velocity error of the simulation without it.
        gap_after: the same with it.
        separating_test: the tests that separate it from ``ambiguous_with``; empty if none is known.
        sentence: what it is and does, in plain words.
        inspect: what to inspect on the robot.
    """

    effect: str
    kind: str
    size: str
    probability: float
    ambiguous_with: tuple[str, ...]
    parameters: Mapping[str, ParameterEstimate]
    gap_before: float
    gap_after: float
    separating_test: str
    sentence: str
    inspect: str


@dataclass(frozen=True)
class TriedCandidate:
    """A candidate of one round.

    Args:
        effect: its name.
        improvement: [of -2 log L] decrease of the BIC by it.
        gap_ratio: [1] cross-validated velocity gap over the one before; nan if not computed.
        admitted: whether it may be added.
        why: why it may not; empty if it may.
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
        added: name of the effect that was added in this round; empty for the base.
        model: the model with it.
        tried: the candidates of the next round, the likeliest first.
        gap: [log's unit/s] RMS velocity error on the shown log.
        tracks: per run of the shown log, (n, 2) simulated position and velocity [SI].
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
        findings: sure faults, major effects, unsure faults, minor effects.
        remainder: whether something may remain that the last model does not explain.
        remains: a sentence about it; empty if nothing remains.
        noise_floor: [log's unit/s] RMS noise of the shown velocity, at least ``LEAST_FLOOR`` of
            the top speed. Texts give gaps as multiples of it.
        gap_before: [log's unit/s] RMS velocity error of the base model on the shown log.
        gap_after: the same of the last chapter's model.
        where: where the base model disagrees most.
        chapters: the base first, then a model per added effect, up to the last reported one.
        shown: the log that gaps are shown on: held out, else validation, else the fitted log.
        how: how the logs were used, in a sentence.
        notes: further remarks.
        compared: per run of ``shown``, (n,) which samples count; empty: all of them.
        gains: kS, kV, kA (and kG, offset_rad) of the last chapter's model; if no effect was found,
            those of ``sysid fit``.
        gains_without: the same gains in a model without the effects.
        judged: effects of the last model that may be findings, and how likely each is.
        complete: whether every effect was tried; False if the search was stopped.
        variants: refits the last model with only some of its effects; None for a story by hand.
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
    gains: Mapping[str, ParameterEstimate]
    gains_without: Mapping[str, ParameterEstimate]
    notes: tuple[str, ...] = ()
    compared: tuple[NDArray[bool_], ...] = ()
    judged: tuple[JudgedEffect, ...] = ()
    complete: bool = True
    variants: "ModelVariants | None" = None

    @property
    def model(self) -> Model:
        """The model of the last chapter."""
        return self.chapters[-1].model

    @property
    def added(self) -> frozenset[str]:
        """The effects that were added to the base model."""
        return frozenset(chapter.added for chapter in self.chapters[1:])

    @cached_property
    def gap_with_lags(self) -> float:
        """[log's unit/s] gap without the effects but the sensor's lags, which a fit has, too."""
        lags = self.added & SENSOR_LAGS
        return self.variants.refit(lags).gap if lags and self.variants else self.gap_before

    def narrows(self, gap: float) -> bool:
        """Whether a model of this gap misses clearly less than one of gains and sensor's lags."""
        return gap < MAJOR_UNEXPLAINED * self.gap_with_lags

    def to_json(self) -> dict[str, Any]:
        """The result as ``sysid reconcile --json`` prints it."""
        return {
            "verdict": self.verdict,
            "findings": [_convert_finding_to_json(one) for one in self.findings],
            "remainder": self.remainder,
            "complete": self.complete,
            "units": self.shown.units,
            **_convert_gains_to_json(self.gains),
            "without_effects": _convert_gains_to_json(self.gains_without),
            "noise_floor": self.noise_floor,
            "gap_before": finite_or_none(self.gap_before),
            "gap_after": finite_or_none(self.gap_after),
            "where": [
                {
                    "what": one.what,
                    "where": one.where,
                    "signal": "velocity",
                    "error": finite_or_none(one.error),
                    "sure": one.sure,
                }
                for one in self.where
            ],
            "how": self.how,
            "notes": [*self.notes, *([self.remains] if self.remains else [])],
        }


def _convert_gains_to_json(gains: Mapping[str, ParameterEstimate]) -> dict[str, Any]:
    """Gains and standard errors, with the keys of ``sysid fit --json``."""
    return {
        "gains": {name: one.value for name, one in gains.items()},
        "errors": {name: finite_or_none(one.error) for name, one in gains.items()},
    }


def _convert_finding_to_json(one: Finding) -> dict[str, Any]:
    """A finding with its fields as keys, in their order."""
    return {
        **vars(one),
        "ambiguous_with": list(one.ambiguous_with),
        "parameters": {
            name: {**vars(p), "error": finite_or_none(p.error)}
            for name, p in one.parameters.items()
        },
        "gap_before": finite_or_none(one.gap_before),
        "gap_after": finite_or_none(one.gap_after),
    }
