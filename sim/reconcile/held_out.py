"""The held-out log and each model's simulation of it."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from sim.core.errors import NotIdentifiable
from sim.core.log import Log
from sim.core.units import find_unit
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.model_structure import ModelStructure
from sim.estimation.run_nuisance import RunNuisance
from sim.gap import Place
from sim.reconcile.backlash_phase import estimate_backlash_phase
from sim.reconcile.cross_validation import compute_open_loop_errors, compute_rms_gap
from sim.reconcile.recordings import Recordings
from sim.reconcile.residual_map import map_residuals
from sim.reconcile.search_effort import ROUNDS
from sim.reconcile.selection_round import SelectionRound
from sim.reconcile.story import Chapter
from sim.reconcile.thresholds import VISIBLE_FLOORS

PLACES_SHOWN = 5  # largest differences that are listed
LOG_USES: Mapping[str, str] = {
    "held_out": "The gap is shown on the held-out log, which was not used for any fit.",
    "validation": (
        "No held-out log was given: the gap is shown on the validation log, which was also used "
        "to choose the effects."
    ),
    "log": "No validation log was given: an effect is accepted if it helps to predict each run "
    "from the others. The gap is shown on the fitted runs themselves.",
}
PHASE_NOTE = (
    "Where in its free play each run began is estimated from that run itself, because no log "
    "contains it."
)
REPEAT_WARNINGS: Mapping[str, str] = {
    "log": "The log contains a run twice. Its copy is predicted well by any model.",
    "validation": "The validation repeats runs of the log, so it confirms nothing.",
    "held_out": "The held-out log repeats runs that were fitted, so the gap on it proves nothing.",
}


@dataclass(frozen=True, eq=False)
class HeldOutLog:
    """The log that is kept for showing the gap.

    Args:
        log: the runs.
        problem: what is compared of them.
        usage: a sentence about how it was used.
        doubts: what a person should know of the logs.
        held_out: whether nothing was fitted to it.
    """

    log: Log
    problem: PredictionErrorProblem
    usage: str
    doubts: tuple[str, ...]
    held_out: bool

    @classmethod
    def choose(cls, recordings: Recordings) -> "HeldOutLog":
        """The log that was used least: held out, else validation, else the log itself.

        Raises:
            NotIdentifiable: none of its samples can be compared.
        """
        name = next(one for one in LOG_USES if one in recordings.logs_by_name)
        problem = recordings.make_shown_problem(name)
        if not problem.informative.any():
            raise NotIdentifiable(
                "after the damaged parts are cut out, nothing is left to show the gap on",
                where=recordings.logs_by_name[name].source,
                advice="Inspect the log, and record it again.",
            )
        # numbers of one story have one unit
        log = replace(recordings.logs_by_name[name], units=recordings.log.units)
        again = _describe_repeats(recordings)
        others = [text for other, text in again.items() if other != name]
        return cls(
            log,
            problem,
            again.get(name, LOG_USES[name]),
            (*others, *_collect_doubts(recordings)),
            name == "held_out" and name not in again,
        )

    def notes(self, last: Chapter, fitted: float) -> tuple[str, ...]:
        """Remarks about the logs, for people.

        Args:
            last: the last model, on this log.
            fitted: [unit/s] its gap on the runs that were fitted or chosen by.
        """
        gap = last.gap * find_unit(self.log.units).si
        said = (*self.doubts, *((PHASE_NOTE,) if _has_backlash(last) else ()))
        least = max(fitted, self.problem.velocity_floor)
        if not self.held_out or gap <= VISIBLE_FLOORS * least:
            return said
        far = (
            f"The last model misses the held-out log by {gap / least:.0f} times "
            "as much as it misses the others: make sure that it is of the same mechanism, in "
            "the same units, and that nothing was changed in between."
        )
        return (far, *said)

    @property
    def noise_floor(self) -> float:
        """[owner's unit/s] noise of its velocity."""
        return self.problem.velocity_floor / find_unit(self.log.units).si

    @property
    def compared_samples(self) -> tuple[NDArray[np.bool_], ...]:
        """Per run, (n,) which samples are compared: it moves, and nothing is excluded."""
        return tuple(one.measurements.informative for one in self.problem.records)

    def find_gap_places(self, base: Chapter) -> tuple[Place, ...]:
        """Places where the base model's velocity is wrong, the most significant first."""
        noise = self.problem.velocity_floor
        found = map_residuals(self.log, base.tracks, compared=self.compared_samples, floor=noise)
        return found.find_places(PLACES_SHOWN, signal="velocity") if found else ()

    def chapters(self, done: Sequence[SelectionRound]) -> tuple[Chapter, ...]:
        """Each model's gap and simulated runs."""
        return tuple(map(self._chapter, done))

    def measure_gaps_without(self, done: Sequence[SelectionRound]) -> dict[str, float]:
        """[owner's unit/s] effect -> the gap of the last model without this effect.

        If the model diverges without an effect, the gap of the model before it.
        """
        found = {}
        for before, one in pairwise(done):
            gap = self._gap(one.without.estimate)
            gap = gap if math.isfinite(gap) else self._gap(before.candidate.estimate)
            found[one.candidate.effect] = gap
        return found

    def _gap(self, point: Estimate, nuisance: RunNuisance | None = None) -> float:
        nuisance = self._initial_nuisance(point) if nuisance is None else nuisance
        errors = compute_open_loop_errors(self.problem, point, nuisance)
        return compute_rms_gap(errors).velocity / find_unit(self.log.units).si

    def _chapter(self, one: SelectionRound) -> Chapter:
        point = one.candidate.estimate
        model = point.structure.model(point.values)
        nuisance = self._initial_nuisance(point)
        gap = self._gap(point, nuisance)
        track = self.problem.simulate(model, nuisance).sensor_readings
        runs = tuple(track[first:last] for first, last in pairwise(self.problem.run_edges.tolist()))
        return Chapter(one.candidate.effect, model, one.tried, gap, runs)

    def _initial_nuisance(self, point: Estimate) -> RunNuisance:
        """How its runs begin: where they were first seen, and where in free play they say."""
        seen = self.problem.initial_nuisance
        here = self.problem.evaluate(point.structure, point.values, seen, point.process_noise)
        for _ in range(ROUNDS):
            here = estimate_backlash_phase(self.problem, here)
        return here.nuisance


def _has_backlash(chapter: Chapter) -> bool:
    """Whether motor and load of its model have free play."""
    names = tuple(part.effect for part in chapter.model.parts)
    return ModelStructure(chapter.model.type, names).has_backlash


def _describe_repeats(recordings: Recordings) -> dict[str, str]:
    """A log that repeats runs of those before it -> what that means."""
    return {
        name: REPEAT_WARNINGS[name]
        for name in REPEAT_WARNINGS
        if recordings.count_repeated_runs(name)
    }


def _collect_doubts(recordings: Recordings) -> tuple[str, ...]:
    """What reading the logs left to say, each once; the log that was used least first."""
    logs = [recordings.logs_by_name[name] for name in LOG_USES if name in recordings.logs_by_name]
    return tuple(dict.fromkeys(doubt.message for log in logs for doubt in log.doubts))
