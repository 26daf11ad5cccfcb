"""The likelihood of gains and process noise, given the measurements (prediction-error method).

-2 log L = N·log det Σ        Σ the covariance (2, 2) of the innovations
"""

import math
import os
from collections.abc import Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from functools import cache

import numpy as np

from sim.data.log import Array
from sim.estimation.kalman import model_from_values, run_innovations, steady_state_gain
from sim.estimation.measurements import RunMeasurements, SensorNoise
from sim.physics.engine import NO_TRUST
from sim.physics.model import Model

ROBUST = 1.4826  # standard deviations in a median absolute deviation
ASIDE = 0.02  # [m or rad] that slack in a gear or a chain lets a start be from where it is seen
TICKS = 10.0  # [1] times the noise of a position that it may be, where that is more
STRAY = 6.0  # [standard deviations] farther than this no noise goes
STARTS = 0.1  # [s] of a motion in which nothing is left out
AROUND_STRAY = 2  # samples on both sides of one that strays
SHORTEST = 0.02  # [sample periods] a shorter kA/kV leaves no trace, and takes ever finer steps
LARGE = 10_000  # [samples] from which runs are simulated side by side
NUDGE = 1e-4  # [of a gain's own size] by which it is moved for a derivative
LEAST = {"kS": 0.02, "kG": 0.05, "level": 0.05, "upright": 0.05, "window": 0.004, "lag": 0.004}
FLOOR = {"kS": 0.0, "window": 0.0, "lag": 0.0}
POSITIVE = ("kV", "kA")


def _unasked() -> Array:
    """Jacobian not computed yet."""
    return np.empty((0, 0))


@dataclass(frozen=True, eq=False)
class Estimate:
    """Values of the parameters, and how well they fit.

    Args:
        values: name -> value.
        position_offsets: (runs,) [unit] true position at a run's first sample, minus the measured
            one.
        process_noise: size of the random disturbance.
        kalman_gain: (2, 2) by how much a measurement corrects, which follows from values and q.
        innovations: (n, 2) innovations.
        innovation_cov: (2, 2) their covariance, never quite nothing.
        cost: -2 log L, up to a constant.
        jacobian: (2 n, values + runs) by how much the white innovations change with values and
            starts, here or close by; none until it is asked.
        fine: whether those are of this very point, and from both sides.
        begun: (n, 2) by how much the innovations of each run change with its own start.
    """

    values: Mapping[str, float]
    position_offsets: Array
    process_noise: float
    kalman_gain: Array
    innovations: Array
    innovation_cov: Array
    cost: float
    jacobian: Array = field(default_factory=_unasked)
    fine: bool = False
    begun: Array = field(default_factory=_unasked)


@dataclass(frozen=True, eq=False)
class PredictionErrorProblem:
    """The measurements of a log, and the likelihood of parameters given them.

    Args:
        type: ``simple``, ``elevator`` or ``arm``.
        runs: the runs.
        noise: of the measurements, measured without a model.
        period: [s] between samples.
        held: names of values that are not searched.
    """

    type: str
    runs: tuple[RunMeasurements, ...]
    noise: SensorNoise
    period: float
    held: tuple[str, ...] = ()

    @property
    def aside(self) -> float:
        """[m or rad] about how far from what is seen a start may be, beside the measurements."""
        return max(ASIDE, TICKS * self.noise.position)

    def at(self, values: Mapping[str, float], starts: Array, q: float) -> Estimate:
        """The point of these values; its cost is infinite where they are no physics."""
        quick = values["kA"] < SHORTEST * self.period * values["kV"]
        if quick or any(not values[name] > 0.0 for name in POSITIVE):
            return Estimate(values, starts, q, NO_TRUST, np.empty((0, 2)), np.eye(2), math.inf)
        model = model_from_values(self.type, values)
        trust = steady_state_gain(model, noise=self.noise, q=q, period=self.period)
        ahead = self._ahead(model, starts, trust)
        spread, count = self._spread(ahead)
        cost = _cost(spread, count) + float(np.sum(np.square(starts / self.aside)))
        return Estimate(values, starts, q, trust, ahead, spread, cost)

    def _ahead(self, model: Model, starts: Array, trust: Array) -> Array:
        """(n, 2) the innovations of every run, one after another."""

        def one(run: RunMeasurements, start: float) -> Array:
            return run_innovations(model, run, start=start, trust=trust)

        if sum(run.time.size for run in self.runs) > LARGE:  # compiled code runs beside other
            return np.concatenate(list(_threads().map(one, self.runs, starts.tolist())))
        return np.concatenate(list(map(one, self.runs, starts.tolist())))

    def without_strays(self, point: Estimate) -> "PredictionErrorProblem":
        """The same without the samples that no noise explains, and those around them.

        A stop that was hit, a tooth that slipped, a voltage that was not applied: one such moment
        may weigh more than all the rest. Their measurements still keep the simulation on course.
        """
        there = ~np.isnan(point.innovations).all(axis=0)
        size = np.full(2, math.inf)
        size[there] = ROBUST * np.nanmedian(np.abs(point.innovations[:, there]), axis=0)
        strays = np.abs(point.innovations) > STRAY * np.maximum(size, self.noise.grain)
        far = strays[:, 0] | strays[:, 1]
        kept, first = [], 0
        for run in self.runs:
            mine = far[first : first + run.time.size].copy()
            first += run.time.size
            # a start is what shows inertia: there a stray is more likely the model's
            begins = run.time[int(np.argmax(run.moving))]
            mine[run.time < begins + STARTS] = False
            wide = np.convolve(mine, np.ones(2 * AROUND_STRAY + 1), mode="same") > 0.0
            kept.append(replace(run, telling=run.telling & ~wide[: run.time.size]))
        same = all(
            np.array_equal(a.telling, b.telling) for a, b in zip(kept, self.runs, strict=True)
        )
        return self if same else replace(self, runs=tuple(kept))

    def sloped(self, point: Estimate, *, fine: bool = False, starts: bool = True) -> Estimate:
        """The point with its slopes.

        Args:
            point: where; what its starts do is taken over from a point close by, unless gravity
                depends on the place.
            fine: from both sides, so that values that do the same are seen to do the same.
            starts: whether with theirs.
        """
        parts = [self._by_value(point, name, fine=fine) for name in point.values]
        begun = point.begun
        if starts:
            again = fine or not begun.size or self.type == "arm"
            begun = self._by_start(point) if again else begun
            parts += self._apart(begun)
        return replace(point, jacobian=whiten(point, np.stack(parts)).T, fine=fine, begun=begun)

    def _apart(self, begun: Array) -> Iterator[Array]:
        """(n, 2) for each run: what its own start does, and nothing elsewhere."""
        first = 0
        for run in self.runs:
            part = np.zeros_like(begun)
            mine = slice(first, first + run.time.size)
            part[mine] = begun[mine]
            first = mine.stop
            yield part

    def _by_value(self, point: Estimate, name: str, *, fine: bool) -> Array:
        if name in self.held:
            return np.zeros_like(point.innovations)
        value = point.values[name]
        step = NUDGE * max(abs(value), LEAST.get(name, 0.0))
        model = model_from_values(self.type, {**point.values, name: value + step})
        more = self._ahead(model, point.position_offsets, point.kalman_gain)
        if not fine or value - step < FLOOR.get(name, -math.inf):
            return np.asarray((more - point.innovations) / step)
        model = model_from_values(self.type, {**point.values, name: value - step})
        return np.asarray(
            (more - self._ahead(model, point.position_offsets, point.kalman_gain)) / (2.0 * step)
        )

    def _by_start(self, point: Estimate) -> Array:
        step = self.noise.position
        moved = self._ahead(
            model_from_values(self.type, point.values),
            point.position_offsets + step,
            point.kalman_gain,
        )
        return np.asarray((moved - point.innovations) / step)

    def _spread(self, ahead: Array) -> tuple[Array, int]:
        """(2, 2) covariance of innovations, and how many samples were measured at all."""
        there = ~np.isnan(ahead)
        first, second = there[:, 0], there[:, 1]
        x, v = np.where(first, ahead[:, 0], 0.0), np.where(second, ahead[:, 1], 0.0)
        both = max(int(np.count_nonzero(first & second)), 1)
        xx = float(x @ x) / max(int(np.count_nonzero(first)), 1)
        vv = float(v @ v) / max(int(np.count_nonzero(second)), 1)
        most = 0.99 * math.sqrt(xx * vv)
        xv = min(max(float(x @ v) / both, -most), most)
        spread = np.array([[xx, xv], [xv, vv]])
        return spread + np.diag(np.square(self.noise.grain)), int(np.count_nonzero(first | second))


def _cost(spread: Array, count: int) -> float:
    """-2 log L of innovations, up to a constant: of each sample what was measured there."""
    size = float(spread[0, 0] * spread[1, 1] - spread[0, 1] ** 2)
    return count * math.log(size) if size > 0.0 and math.isfinite(size) else math.inf


@cache
def _threads() -> ThreadPoolExecutor:
    """As many as there are cores, for logs that are worth it."""
    return ThreadPoolExecutor(os.cpu_count(), thread_name_prefix="fit")


def whiten(point: Estimate, table: Array) -> Array:
    """(..., 2 n) of (..., n, 2): positions and velocities made independent, with unit variance."""
    inverse = np.linalg.inv(np.linalg.cholesky(point.innovation_cov))
    return np.asarray((np.nan_to_num(table) @ inverse.T).reshape(*table.shape[:-2], -1))
