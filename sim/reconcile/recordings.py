"""The logs that are reconciled with a model, and what follows from them before any fit."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from sim.core.errors import Refusal
from sim.core.log import Log, Run
from sim.core.units import Unit, find_unit
from sim.estimation.initial_guess import guess_gains
from sim.estimation.likelihood import PredictionErrorProblem
from sim.estimation.run_records import (
    RunRecord,
    compute_session_length,
    join_records,
    make_run_records,
)
from sim.fit import Fit, fit
from sim.reconcile.damage import DamageDecision
from sim.reconcile.thresholds import LEAST_FLOOR, MOST_WANDERING, NOISE_ALONE

FRAME_AGE = 1.0 / math.sqrt(3.0)  # [periods] RMS age of a frame that is up to one period old
ORDER = ("log", "validation", "held_out")  # in which they were recorded


@dataclass(frozen=True, eq=False)
class Recordings:
    """The logs of one mechanism that are reconciled with a model.

    Args:
        log: runs to fit.
        validation: runs by which effects are chosen, if given.
        held_out: runs on which the gap is shown, if given.
        type: the base model: ``simple``, ``elevator`` or ``arm``.
        damage: excluded intervals of each of these logs, by its name.
    """

    log: Log
    validation: Log | None
    held_out: Log | None
    type: str
    damage: DamageDecision = field(default_factory=DamageDecision)

    @property
    def logs_by_name(self) -> Mapping[str, Log]:
        """Name -> log, in the order in which the logs were recorded."""
        logs = zip(ORDER, (self.log, self.validation, self.held_out), strict=True)
        return {name: log for name, log in logs if log is not None}

    @cached_property
    def unit(self) -> Unit:
        """The unit of all results: that of the first log."""
        return find_unit(self.log.units)

    @cached_property
    def initial_gains(self) -> Mapping[str, float]:
        """First estimates of the base model's gains, as ``guess_gains`` makes them.

        Raises:
            NotIdentifiable: nothing moves for long enough, or the voltage never changes.
        """
        return guess_gains(self.log, type=self.type)

    @cached_property
    def fitted(self) -> Fit | None:
        """What ``sysid fit`` finds in the log; None if the log is damaged or the fit refuses it."""
        if self.damage.excluded.get("log"):
            return None
        try:
            return fit(self.log, type=self.type).in_units(self.unit.name)
        except Refusal:
            return None

    @cached_property
    def fitted_runs(self) -> Log:
        """The runs that the last fit uses: those of the log and of the validation log."""
        return self.log if self.validation is None else join_records(self.log, self.validation)

    def make_problem(self) -> PredictionErrorProblem:
        """The problem of all runs that may be fitted, without damaged intervals."""
        fitted = [name for name in self.logs_by_name if name != "held_out"]
        return self._make_problem(
            [one for n, name in enumerate(fitted) for one in self._make_records(name, session=n)]
        )

    def make_shown_problem(self, name: str) -> PredictionErrorProblem:
        """The problem of one log alone, on which a gap can be shown."""
        return self._make_problem(self._make_records(name))

    def count_repeated_runs(self, name: str) -> int:
        """Number of a log's runs that were recorded before, in it or in an earlier log."""
        if name not in self.logs_by_name:
            return 0
        known = [run for log in self._list_logs_before(name) for run in log.runs]
        count = 0
        for run in self.logs_by_name[name].runs:
            count += any(_is_same_run(run, other) for other in known)
            known.append(run)
        return count

    def _list_logs_before(self, name: str) -> list[Log]:
        """The logs that were recorded before one."""
        return [
            log for one, log in self.logs_by_name.items() if ORDER.index(one) < ORDER.index(name)
        ]

    def _make_records(self, name: str, *, session: int = 0) -> tuple[RunRecord, ...]:
        """The runs of one log, whose clock continues where the log before it ended."""
        return make_run_records(
            self.logs_by_name[name],
            session=session,
            since=compute_session_length(*self._list_logs_before(name)),
            aside=self.damage.excluded.get(name, ()),
        )

    def _make_problem(self, records: Sequence[RunRecord]) -> PredictionErrorProblem:
        """The estimation problem of some runs, with limits of velocity noise and process noise.

        A velocity that a device averages is so smooth that hardly any noise is measured in it. With
        so little noise, random acceleration would explain the motion better than the voltage does.
        """
        problem = PredictionErrorProblem.from_records(records)
        top = problem.top_speed
        noise = replace(problem.noise, velocity=max(problem.noise.velocity, LEAST_FLOOR * top))
        return replace(
            problem,
            noise=noise,
            max_process_noise=(MOST_WANDERING * top) ** 2,
            lag_sd=FRAME_AGE * problem.period if self._has_frames(problem.velocity_floor) else 0.0,
        )

    def _has_frames(self, floor: float) -> bool:
        """Whether lags that differ from run to run explain the log, as where devices send frames.

        They must leave noise alone, or they may only imitate a missing effect, such as backlash.

        Args:
            floor: [m/s or rad/s] noise floor of the velocity.
        """
        found = self.fitted
        if found is None or not found.lag_differs:
            return False
        return found.simulated_velocity_rmse * self.unit.si <= NOISE_ALONE * floor


def _is_same_run(one: Run, other: Run) -> bool:
    return bool(
        one.test == other.test
        and np.array_equal(one.velocity, other.velocity)
        and np.array_equal(one.voltage, other.voltage)
    )
