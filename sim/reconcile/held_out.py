"""The held-out log and each model's simulation of it."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from sim.core.errors import NotIdentifiable
from sim.core.log import Array, Log
from sim.core.units import find_unit
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.run_nuisance import LAG, RunNuisance
from sim.gap import Place, Residuals, find_gap_places
from sim.reconcile.backlash_phase import estimate_backlash_phase
from sim.reconcile.cross_validation import compute_open_loop_errors, compute_rms_gap
from sim.reconcile.recordings import Recordings
from sim.reconcile.search_effort import ROUNDS
from sim.reconcile.selection_round import SelectionRound
from sim.reconcile.story import Chapter
from sim.reconcile.thresholds import VISIBLE_FLOORS

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
    "No log contains where in its free play a run began. So this was estimated from the run itself."
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
        problem: their measurements.
        usage: a sentence about how the log was used.
        doubts: remarks about all logs.
        held_out: whether neither a fit nor a choice used it.
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
        # all results are in the unit of the first log
        log = replace(recordings.logs_by_name[name], units=recordings.log.units)
        repeats = {
            one: text
            for one, text in REPEAT_WARNINGS.items()
            if recordings.count_repeated_runs(one)
        }
        fresh = name == "held_out" and name not in repeats
        usage = repeats.pop(name, LOG_USES[name])
        logs = [recordings.logs_by_name[one] for one in LOG_USES if one in recordings.logs_by_name]
        doubts = dict.fromkeys(doubt.text for one in logs for doubt in one.doubts)
        return cls(log, problem, usage, (*repeats.values(), *doubts), fresh)

    def notes(self, last: SelectionRound, gap: float) -> tuple[str, ...]:
        """Remarks about the logs.

        Args:
            last: the last model.
            gap: [log's unit/s] its gap on this log.
        """
        structure = last.candidate.estimate.structure
        remarks = (*self.doubts, *((PHASE_NOTE,) if structure.has_backlash else ()))
        gap *= find_unit(self.log.units).si
        least = max(last.gap.velocity, self.problem.velocity_floor)
        if not self.held_out or gap <= VISIBLE_FLOORS * least:
            return remarks
        wide_gap = (
            f"The last model misses the held-out log by {gap / least:.0f} times "
            "as much as it misses the others: make sure that it is of the same mechanism, in "
            "the same units, and that nothing was changed in between."
        )
        return (wide_gap, *remarks)

    @property
    def noise_floor(self) -> float:
        """[log's unit/s] noise of its velocity."""
        return self.problem.velocity_floor / find_unit(self.log.units).si

    def find_gap_places(self, base: Chapter) -> tuple[Place, ...]:
        """Where the base model's velocity is wrong, the largest error first."""
        residuals = []
        for record, track in zip(self.problem.records, base.tracks, strict=True):
            run = record.measurements
            error = run.measured[:, 1] - track[:, 1]
            error[~run.informative | ~np.isfinite(track).all(axis=1)] = np.nan  # it diverged
            predicted = np.nan_to_num(track)
            residuals.append(Residuals(record.test, run.time, run.voltage, predicted, error))
        if not any(one.compared.any() for one in residuals):
            return ()
        return find_gap_places(residuals, noise=self.problem.velocity_floor)

    def make_chapters(self, rounds: Sequence[SelectionRound]) -> tuple[Chapter, ...]:
        """Each model's gap and simulated runs."""
        points = [one.candidate.estimate for one in rounds]
        return tuple(
            Chapter(one.candidate.effect, point.model, one.tried, *self.simulate(point))
            for one, point in zip(rounds, points, strict=True)
        )

    def measure_gaps_without(self, rounds: Sequence[SelectionRound]) -> dict[str, float]:
        """[log's unit/s] effect -> the gap of the last model without this effect.

        If the simulation diverges without the effect, the gap of the model before it was added.
        """
        found = {}
        for before, one in pairwise(rounds):
            gap = self._measure_gap(one.without.estimate)
            gap = gap if math.isfinite(gap) else self._measure_gap(before.candidate.estimate)
            found[one.candidate.effect] = gap
        return found

    def _measure_gap(self, point: Estimate) -> float:
        return measure_open_loop_gap(self.problem, point) / find_unit(self.log.units).si

    def simulate(self, point: Estimate) -> tuple[float, tuple[Array, ...]]:
        """[log's unit/s] gap of a model, and per run (n, 2) its position and velocity [SI]."""
        nuisance = estimate_initial_nuisance(self.problem, point)
        track = self.problem.simulate(point.model, nuisance).sensor_readings
        return self._measure_gap(point), tuple(track[rows] for rows in self.problem.run_slices)


def measure_open_loop_gap(problem: PredictionErrorProblem, point: Estimate) -> float:
    """[unit/s] The gap of a model on runs: the RMS error of the velocity, simulated open loop."""
    nuisance = estimate_initial_nuisance(problem, point)
    return compute_rms_gap(compute_open_loop_errors(problem, point, nuisance)).velocity


def estimate_initial_nuisance(problem: PredictionErrorProblem, point: Estimate) -> RunNuisance:
    """Initial values of each run: its first samples, and an estimated backlash phase."""
    found = problem.change(point, nuisance=problem.initial_nuisance)
    for _ in range(ROUNDS):
        found = estimate_backlash_phase(problem, found)
        if problem.lag_sd:
            found = _estimate_lags(problem, found)
    return found.nuisance


def _estimate_lags(problem: PredictionErrorProblem, point: Estimate) -> Estimate:
    """The estimate after a Gauss-Newton step of the lag of each run."""
    slopes = problem.compute_run_jacobian(point, LAG)
    lags, known = point.nuisance.lag_offset, 1.0 / problem.lag_sd**2
    gradient = slopes.T @ problem.whiten(point, point.innovations) + known * lags
    step = -gradient / (np.sum(np.square(slopes), axis=0) + known)
    found = problem.change(point, nuisance=point.nuisance.add(LAG, step))
    return min(point, found, key=lambda one: one.cost)
