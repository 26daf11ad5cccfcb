"""Fit the open-loop velocity if the likeliest model does not reproduce the log.

The likeliest process noise of an incomplete model is large: the filter corrects the state at every
sample, and the innovations then say little about the gains, above all about kA. A feedforward has
to predict velocities, so in this case the gains are those with the smallest open-loop velocity
error.
"""

import math
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.optimize import levenberg_marquardt
from sim.estimation.run_nuisance import LAG
from sim.fit.search import TRACKING

MISFIT = 2.0  # [1] open-loop velocity error over the sensor noise; more is a misfit
SMALL = 0.0125  # [share of the top speed] an error below it is no misfit for any noise
HOLDS = 0.05  # [1/s] q over the velocity variance; a model that needs more is incomplete
STEPS = 30  # of the search, at most
LAGS = ("velocity-filter.window", "delay.lag")


@dataclass(frozen=True, eq=False)
class OpenLoopReplay:
    """An open-loop simulation and its log, sample by sample.

    Args:
        velocity: (n,) [m/s or rad/s] measured velocity.
        error: (n,) [m/s or rad/s] measured minus simulated velocity.
        moving: (n,) whether the mechanism moves, in the log or in the simulation.
        noise: [m/s or rad/s] standard deviation of the velocity, estimated without a model.
        velocity_only: whether the gains were fitted to the velocity only, because the likeliest
            ones had a misfit.
        change: (m,) [unit/s²] slope between two measured velocities in motion.
        simulated_change: (m,) [unit/s²] the same of the simulated velocities.
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
        measured = self.velocity[self.moving]
        spread = float(np.sum((measured - measured.mean()) ** 2)) if measured.size else 0.0
        return 1.0 - float(np.sum(self.error[self.moving] ** 2)) / max(spread, 1e-300)

    @property
    def acceleration_scores(self) -> tuple[float, float]:
        """R² and RMSE [unit/s²] of the slopes between velocities."""
        if not self.change.size:
            return 0.0, 0.0
        left = float(np.mean((self.change - self.simulated_change) ** 2))
        return 1.0 - left / max(float(np.var(self.change)), 1e-300), math.sqrt(left)

    @cached_property
    def top_speed(self) -> float:
        """[m/s or rad/s] top speed: the 0.98 quantile of the measured speeds."""
        return float(np.quantile(np.abs(self.velocity), 0.98)) if self.velocity.size else 0.0

    @property
    def has_misfit(self) -> bool:
        """Whether the velocity error is clearly larger than the noise, and not small."""
        small = 0.0 if self.velocity_only else SMALL * self.top_speed
        return self.rmse > max(MISFIT * self.noise, small)


def replay_open_loop(
    problem: PredictionErrorProblem, point: Estimate, *, velocity_only: bool = False
) -> OpenLoopReplay:
    """Simulate every run from its first sample, without correction.

    The start offsets of an estimate with process noise are hardly determined and are not used; the
    lags of the runs are.

    Args:
        problem: the measurements.
        point: the estimate.
        velocity_only: as in ``OpenLoopReplay``.
    """
    nuisance = problem.initial_nuisance.add(LAG, point.nuisance.lag_offset)
    track = problem.simulate(point.model, nuisance)
    both = np.column_stack([problem.measured[:, 1], track.seen])
    fresh = ~np.isnan(both[:, 0])
    changes = []
    for record, first in zip(problem.records, problem.run_edges, strict=False):
        run = record.measurements
        going = np.flatnonzero(fresh[first : first + run.time.size] & run.moving)
        times = run.time[going]
        changes.append(np.diff(both[first + going], axis=0) / np.diff(times)[:, None])
    change, simulated_change = np.concatenate(changes).T
    measured, simulated = both[fresh].T
    return OpenLoopReplay(
        measured, measured - simulated, (problem.moving | (track.velocity != 0.0))[fresh],
        noise=problem.noise.velocity, velocity_only=velocity_only, change=change,
        simulated_change=simulated_change,
    )  # fmt: skip


@dataclass(frozen=True, eq=False)
class Solution:
    """The measurements, the best estimate so far, and its open-loop replay.

    Args:
        problem: the measurements.
        point: the estimate.
        velocity_only: as in ``OpenLoopReplay``.
    """

    problem: PredictionErrorProblem
    point: Estimate
    velocity_only: bool = False

    @cached_property
    def replay(self) -> OpenLoopReplay:
        """The open-loop replay of the estimate."""
        return replay_open_loop(self.problem, self.point, velocity_only=self.velocity_only)

    def needs_noise(self, q: float) -> bool:
        """Whether the process noise is more than ``q`` [1/s] times the velocity's variance."""
        return self.point.process_noise > q * self.problem.noise.velocity**2

    @property
    def is_incomplete(self) -> bool:
        """Whether so much is missing that lags and small effects would only imitate it."""
        return self.needs_noise(TRACKING) and self.replay.has_misfit


def fit_velocity_only(found: Solution) -> Solution:
    """Fit the open-loop velocity alone, if the likeliest estimate is incomplete.

    The lags are kept: a delay of the velocity shows in comparison with the position. Without the
    position it could not be told from inertia.

    Args:
        found: the likeliest estimate.

    Returns:
        The new estimate, of the problem without positions. ``found`` is returned if its process
        noise is so small that it fits the open-loop simulation already, if it has no misfit, or if
        the new RMS error is not smaller.
    """
    if not found.is_incomplete:
        return found
    problem, point = found.problem, found.point
    records = tuple(  # without positions
        record.change(measured=record.measurements.measured * [np.nan, 1.0])
        for record in problem.records
    )
    velocities = replace(problem, records=records, lag_sd=0.0)
    structure = replace(point.structure, fixed=LAGS)
    nuisance = velocities.initial_nuisance.add(LAG, point.nuisance.lag_offset)
    begin = velocities.evaluate(structure, point.values, nuisance, 0.0)
    other = levenberg_marquardt(velocities, begin, steps=STEPS, enough=0.01)
    after = Solution(velocities, other, velocity_only=True)
    # samples that are not compared count in the replay, so its error may have grown
    return after if after.replay.rmse < found.replay.rmse else found
