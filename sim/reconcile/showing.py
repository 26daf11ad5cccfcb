"""The log on which the gap is shown, and each model's simulation of it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from sim.engine import NO_TRUST
from sim.gap import Place
from sim.log import Log
from sim.reconcile.aside import Aside
from sim.reconcile.gates import errors_of, rms
from sim.reconcile.lanes import lanes
from sim.reconcile.problem import Problem
from sim.reconcile.rounds import Round
from sim.reconcile.story import Chapter
from sim.reconcile.where import map_of
from sim.units import unit

TOLD = 5  # places
HOW: Mapping[str, str] = {
    "held_out": "The gap is shown on a log that nothing was fitted to.",
    "validation": "No held-out log was given: the gap is shown on the validation's, by which the "
    "effects were chosen.",
    "log": "Only one log was given: an effect is admitted if the other runs, fitted with it, "
    "predict each run better; the gap is shown on the log that was fitted.",
}


@dataclass(frozen=True, eq=False)
class Shown:
    """A log that is shown.

    Args:
        log: the runs.
        problem: what is compared of them.
        how: a sentence about how it was used.
    """

    log: Log
    problem: Problem
    how: str

    @classmethod
    def of(cls, logs: Mapping[str, Log | None], aside: Aside) -> "Shown":
        """The one that was used least: held out, else validation, else the log itself."""
        name = next(name for name in HOW if logs.get(name) is not None)
        log = logs[name]
        if log is None:
            raise KeyError(name)
        return cls(log, Problem.of(lanes(log, aside=aside.of(name))), HOW[name])

    @property
    def noise_floor(self) -> float:
        """[owner's unit/s] noise of its velocity."""
        return self.problem.noise.velocity / unit(self.log.units).si

    @property
    def compared(self) -> tuple[NDArray[np.bool_], ...]:
        """A run -> (n,) its samples that count: where it moves, and nothing was set aside."""
        return tuple(one.seen.telling for one in self.problem.lanes)

    def places(self, base: Chapter) -> tuple[Place, ...]:
        """Where the base model's velocity is off, the surest first."""
        noise = self.problem.noise.velocity
        found = map_of(self.log, base.tracks, compared=self.compared, floor=noise)
        return found.places(TOLD, signal="velocity") if found else ()

    def chapters(self, done: Sequence[Round]) -> tuple[Chapter, ...]:
        """Each model's gap and simulated runs."""
        return tuple(map(self._chapter, done))

    def _chapter(self, one: Round) -> Chapter:
        point = one.suspect.point
        model = point.hypothesis.model(point.values)
        at_seen = np.zeros(len(self.problem.lanes))
        gap = rms(errors_of(self.problem, point, at_seen)).velocity / unit(self.log.units).si
        track = self.problem.track(model, at_seen, NO_TRUST)[:, [0, 3]]
        runs = tuple(track[first:last] for first, last in pairwise(self.problem.edges.tolist()))
        return Chapter(one.suspect.effect, model, one.tried, gap, runs)
