"""The last model with only some of its effects, so that each can be switched on and off."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace

from sim.core.doubt import Doubt
from sim.core.log import Array
from sim.estimation.likelihood import PredictionErrorProblem
from sim.fit import Fit
from sim.physics.model import Part
from sim.reconcile.backward_elimination import refit_without_effect
from sim.reconcile.candidates import Candidate
from sim.reconcile.gains import estimate_gains, replace_gains
from sim.reconcile.held_out import HeldOutLog
from sim.reconcile.recordings import Recordings
from sim.reconcile.story import ParameterEstimate


@dataclass(frozen=True, eq=False)
class ModelVariant:
    """A model with some of the effects that were found.

    Args:
        gains: kS, kV, kA (and kG, offset_rad), in the log's unit.
        parts: its effects.
        gap: [log's unit/s] RMS velocity error on the log that gaps are shown on.
        tracks: per run of the fitted log, (n, 2) simulated position and velocity [SI].
        doubts: warnings about its gains.
        narrows: whether its effects narrow the gap clearly.
    """

    gains: Mapping[str, ParameterEstimate]
    parts: tuple[Part, ...]
    gap: float
    tracks: tuple[Array, ...]
    doubts: tuple[Doubt, ...] = ()
    narrows: bool = False

    def apply_to(self, plain: Fit) -> Fit:
        """A fit in the log's unit, with the gains, effects and doubts of this model."""
        return replace_gains(plain, self.gains, self.parts, self.doubts, narrows=self.narrows)


@dataclass(frozen=True, eq=False)
class ModelVariants:
    """All models with some of the effects that were found.

    Args:
        recordings: all logs.
        problem: the measurements that the models are fitted to.
        last: the model with all found effects.
        shown: the log that gaps are shown on.
    """

    recordings: Recordings
    problem: PredictionErrorProblem
    last: Candidate
    shown: HeldOutLog

    def refit(self, effects: Collection[str]) -> ModelVariant:
        """The model with these effects, fitted again if others were left out."""
        chosen = self.last
        for effect in self.last.estimate.structure.effects:
            if effect not in effects:
                chosen = refit_without_effect(self.problem, chosen, effect)
        point = chosen.estimate
        problem = self.recordings.make_shown_problem("log")
        fitted = replace(self.shown, log=self.recordings.log, problem=problem)
        return ModelVariant(
            estimate_gains(self.problem, point, self.recordings.unit),
            point.model.parts,
            self.shown.simulate(point)[0],
            fitted.simulate(point)[1],
        )
