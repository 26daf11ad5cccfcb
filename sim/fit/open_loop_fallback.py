"""Fit the open-loop velocity where the model does not follow the log.

Where something is missing from a model, the likeliest innovations are those of a model that is
corrected at every sample, and such a one says little about gains: inertia can pass for anything.
What gains are for is to say a velocity ahead, so then the velocities of whole runs are compared.
"""

import math
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.optimize import levenberg_marquardt
from sim.fit.search import TRACKING

STRAYS = 2.0  # [1] open-loop velocity error over the sensor's noise, from which a model strays
SMALL = 0.0125  # [share of the top speed] error that is small whatever the noise
HOLDS = 0.05  # [1/s] q over the variance of a velocity: a model that needs more lacks something
STEPS = 30  # of the search
LAGS = ("velocity-filter.window", "delay.lag")


@dataclass(frozen=True, eq=False)
class OpenLoopReplay:
    """An open-loop simulation and its log, sample by sample.

    Args:
        velocity: (n,) measured [m/s or rad/s].
        error: (n,) measured less simulated.
        moving: (n,) where either moves.
        noise: of the velocity, measured without a model.
        velocity_only: whether the likeliest gains strayed, and these only hide it better.
        change: (m,) [unit/s²] between two measured velocities, as long as it moves.
        simulated_change: (m,) the same of the simulated ones.
    """

    velocity: Array
    error: Array
    moving: NDArray[np.bool_]
    noise: float
    velocity_only: bool = False
    change: Array = field(default_factory=lambda: np.empty(0))
    simulated_change: Array = field(default_factory=lambda: np.empty(0))

    @cached_property
    def rmse(self) -> float:
        """[m/s or rad/s] RMS velocity error while it moves."""
        return float(np.sqrt(np.mean(self.error[self.moving] ** 2))) if self.moving.any() else 0.0

    @property
    def excess(self) -> float:
        """[m/s or rad/s] RMS velocity error beyond the noise."""
        return math.sqrt(max(self.rmse**2 - self.noise**2, 0.0))

    @property
    def r2(self) -> float:
        """Share of the velocity's variance that the simulation explains."""
        seen = self.velocity[self.moving]
        spread = float(np.sum((seen - seen.mean()) ** 2)) if seen.size else 0.0
        return 1.0 - float(np.sum(self.error[self.moving] ** 2)) / max(spread, 1e-300)

    @property
    def acceleration_scores(self) -> tuple[float, float]:
        """R² and RMSE [unit/s²] of the changes of velocity."""
        if not self.change.size:
            return 0.0, 0.0
        left = float(np.mean((self.change - self.simulated_change) ** 2))
        return 1.0 - left / max(float(np.var(self.change)), 1e-300), math.sqrt(left)

    @cached_property
    def top_speed(self) -> float:
        """[m/s or rad/s] speed that hardly any sample exceeds."""
        return float(np.quantile(np.abs(self.velocity), 0.98)) if self.velocity.size else 0.0

    @property
    def has_misfit(self) -> bool:
        """Whether the velocity error exceeds the noise by more than a little."""
        small = 0.0 if self.velocity_only else SMALL * self.top_speed
        return self.rmse > max(STRAYS * self.noise, small)


def replay_open_loop(
    problem: PredictionErrorProblem, point: Estimate, *, velocity_only: bool = False
) -> OpenLoopReplay:
    """Simulate every run from its first sample, without correction.

    The start offsets of an estimate with process noise may lie anywhere, and do not count here; the
    lags of the runs do.

    Args:
        problem: measurements.
        point: the values.
        velocity_only: as of ``OpenLoopReplay``.
    """
    nuisance = problem.initial_nuisance.add_lag(point.nuisance.lag_offset)
    track = problem.simulate(point.structure.model(point.values), nuisance)
    both = np.column_stack([problem.measured[:, 1], track.seen])
    fresh = ~np.isnan(both[:, 0])
    changes = []
    for record, first in zip(problem.records, problem.run_edges, strict=False):
        run = record.measurements
        going = np.flatnonzero(fresh[first : first + run.time.size] & run.moving)
        times = run.time[going]
        changes.append(np.diff(both[first + going], axis=0) / np.diff(times)[:, None])
    change, told = np.concatenate(changes).T
    measured, simulated = both[fresh].T
    return OpenLoopReplay(
        measured, measured - simulated, (problem.moving | (track.velocity != 0.0))[fresh],
        noise=problem.noise.velocity, velocity_only=velocity_only, change=change,
        simulated_change=told,
    )  # fmt: skip


def fit_velocity_only(
    problem: PredictionErrorProblem, point: Estimate, before: OpenLoopReplay
) -> tuple[PredictionErrorProblem, Estimate, OpenLoopReplay]:
    """Fit the open-loop velocity alone.

    Lags stay: how late a velocity is shows beside the position, and alone it passes for inertia.

    Args:
        problem: what was searched.
        point: the likeliest point.
        before: how that follows.

    Returns:
        All as they were if the model holds, or if nothing comes closer; and if the likeliest point
        is pardoned next to nothing, for then it is a simulation already, of the position too.
    """
    if point.process_noise <= TRACKING * problem.noise.velocity**2 or not before.has_misfit:
        return problem, point, before
    records = []
    for record in problem.records:
        measured = record.measurements.measured.copy()
        measured[:, 0] = np.nan
        run = replace(record.measurements, measured=measured)
        records.append(replace(record, measurements=run))
    blind = replace(problem, records=tuple(records), lag_sd=0.0)
    structure = replace(point.structure, fixed=LAGS)
    nuisance = blind.initial_nuisance.add_lag(point.nuisance.lag_offset)
    found = levenberg_marquardt(
        blind,
        blind.evaluate(structure, point.values, nuisance, 0.0),
        steps=STEPS,
        enough=0.01,
    )
    after = replay_open_loop(problem, found, velocity_only=True)
    # samples that were left out may weigh more than all that was gained
    return (blind, found, after) if after.rmse < before.rmse else (problem, point, before)
