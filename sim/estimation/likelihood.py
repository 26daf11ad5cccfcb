"""The likelihood of a model structure's parameters, given the measurements of all runs.

    -2 log L = N·log det Σ + Σ (start/noise)² + Σ (δ/τ)²    Σ covariance (2, 2) of the innovations

A run may begin a little beside where its first sample was seen; that is priced as noise. So is what
it rubs more or less than the others: kS of a run is kS + δ (``friction.py``).
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from sim.data.log import Array
from sim.estimation.kalman import steady_state_gain
from sim.estimation.measurements import SensorNoise, estimate_noise
from sim.estimation.model_structure import ModelStructure
from sim.estimation.random_friction import friction_prior, friction_sd
from sim.estimation.run_nuisance import RunNuisance
from sim.estimation.run_records import RunRecord
from sim.physics.engine import EXPECTED, NO_TRUST, RunBatch, Track, follow
from sim.physics.model import Model

LOOSE = 2.0  # [noises of a position] by which a run may begin beside its first sample
TOP = 0.98  # quantile that stands for the largest, so that one bad sample does not
NUDGE = 1e-3  # [of a value's size] for a derivative
COARSE_NUDGE = 0.02  # [of it] where what it does comes in steps, as the samples do
STEPWISE = ("band",)  # parameters of that kind
FARTHEST = 1e100  # [1] that an innovation is off: the square of it is a number


@dataclass(frozen=True, eq=False)
class Estimate:
    """Parameter values of a model structure, and how well they fit.

    Args:
        structure: what is believed.
        values: name -> value.
        nuisance: how each run begins.
        process_noise: [unit²/s³] size of what pushes at random.
        kalman_gain: (2, 2) by how much a measurement corrects.
        innovations: (n, 2) innovations, nan where nothing is compared.
        innovation_cov: (2, 2) covariance of these.
        cost: -2 log L, up to a constant.
    """

    structure: ModelStructure
    values: Mapping[str, float]
    nuisance: RunNuisance
    process_noise: float
    kalman_gain: Array
    innovations: Array
    innovation_cov: Array
    cost: float

    @cached_property
    def whitening(self) -> Array:
        """(2, 2) that makes innovations independent and of size one."""
        return np.asarray(np.linalg.inv(np.linalg.cholesky(self.innovation_cov)))


@dataclass(frozen=True, eq=False)
class PredictionErrorProblem:
    """The measurements of some runs, and the likelihood of parameters given them.

    Args:
        records: the runs.
        noise: of their samples, measured without a model.
        most_q: [unit²/s³] beyond which nothing pushes at random.
    """

    records: tuple[RunRecord, ...]
    noise: SensorNoise
    most_q: float = math.inf

    @classmethod
    def of(cls, records: Sequence[RunRecord]) -> "PredictionErrorProblem":
        """The problem of these runs, with the noise that they show."""
        return cls(tuple(records), estimate_noise(tuple(record.measurements for record in records)))

    @cached_property
    def edges(self) -> NDArray[np.intp]:
        """(runs + 1,) where each run begins among all samples."""
        return np.concatenate(
            ([0], np.cumsum([record.measurements.time.size for record in self.records]))
        )

    @cached_property
    def course(self) -> RunBatch:
        """The runs as the engine follows them."""
        seen = [record.measurements for record in self.records]
        return RunBatch(
            self.edges.astype(np.float64),
            np.concatenate([one.time for one in seen], dtype=np.float64),
            np.concatenate([one.voltage for one in seen], dtype=np.float64),
            np.ascontiguousarray(self.measured, dtype=np.float64),
            np.array([one.position for one in seen], dtype=np.float64),
            np.array([one.velocity for one in seen], dtype=np.float64),
            np.array([record.low for record in self.records], dtype=np.float64),
            np.array([record.high for record in self.records], dtype=np.float64),
            np.array([record.clock for record in self.records], dtype=np.float64),
            np.array([record.memory for record in self.records], dtype=np.float64),
        )

    @cached_property
    def measured(self) -> Array:
        """(n, 2) positions and velocities of all runs."""
        return np.concatenate([record.measurements.measured for record in self.records])

    @cached_property
    def telling(self) -> NDArray[np.bool_]:
        """(n,) samples that are compared: not the first of a run, from which it starts."""
        telling = np.concatenate([record.measurements.telling for record in self.records])
        telling[self.edges[:-1]] = False
        return telling & ~np.isnan(self.measured).all(axis=1)

    @cached_property
    def untold(self) -> NDArray[np.bool_]:
        """(n, 2) what is not compared."""
        return np.isnan(self.measured) | ~self.telling[:, None]

    @cached_property
    def told(self) -> tuple[int, int, int]:
        """How many positions are compared, how many velocities, and how often both."""
        x, v = ~self.untold.T
        positions, velocities, both = (int(np.count_nonzero(one)) for one in (x, v, x & v))
        return max(positions, 1), max(velocities, 1), max(both, 1)

    @cached_property
    def moving(self) -> NDArray[np.bool_]:
        """(n,) samples at which it moved."""
        return np.concatenate([record.measurements.moving for record in self.records])

    @cached_property
    def count(self) -> int:
        """How many samples are compared."""
        return int(np.count_nonzero(self.telling))

    @cached_property
    def period(self) -> float:
        """[s] between samples."""
        return float(
            np.median(
                np.concatenate([np.diff(record.measurements.time) for record in self.records])
            )
        )

    @cached_property
    def top(self) -> float:
        """[unit/s] the fastest it moves, a few samples left out."""
        speeds = np.abs(self.measured[self.telling, 1])
        speeds = speeds[~np.isnan(speeds)]
        return float(np.quantile(speeds, TOP)) if speeds.size else 0.0

    @cached_property
    def loose(self) -> float:
        """[unit] by which a run may begin beside its first sample."""
        return LOOSE * self.noise.position

    # -- simulate --------------------------------------------------------------------------------

    def track(self, model: Model, nuisance: RunNuisance, trust: Array = NO_TRUST) -> Track:
        """All runs, one after another.

        Args:
            model: what moves.
            nuisance: how each run begins.
            trust: (2, 2) by how much a measurement corrects; not at all, if it is not given.
        """
        return Track.of(self._followed(model, nuisance, trust, self.course))

    def ahead(
        self, model: Model, nuisance: RunNuisance, trust: Array, clocks: Array | None = None
    ) -> Array:
        """(n, 2) innovations: measured less expected; 0 where nothing is compared.

        Args:
            model: what moves.
            nuisance: how each run begins.
            trust: (2, 2) by how much a measurement corrects.
            clocks: (runs,) [s] when each run begins, if not when it did.
        """
        course = self.course if clocks is None else replace(self.course, clocks=clocks)
        ahead = self.measured - self._followed(model, nuisance, trust, course)[:, EXPECTED:]
        np.copyto(ahead, 0.0, where=self.untold)
        return np.asarray(ahead)

    def _followed(
        self, model: Model, nuisance: RunNuisance, trust: Array, course: RunBatch
    ) -> Array:
        return follow(
            model, course, trust=trust,
            beside=nuisance.position_offset, meshed=nuisance.backlash_phase,
            rubs=nuisance.friction_offset,
        )  # fmt: skip

    def at(
        self,
        structure: ModelStructure,
        values: Mapping[str, float],
        nuisance: RunNuisance,
        q: float,
    ) -> Estimate:
        """The point of these values; its cost is infinite where they are no physics."""
        if not structure.plays:
            nuisance = nuisance.unmeshed
        nowhere = Estimate(
            structure, values, nuisance, q, NO_TRUST, np.empty((0, 2)), np.eye(2), math.inf
        )
        if not (values["kV"] > 0.0 and values["kA"] > 0.0):
            return nowhere
        if not self.count:
            return nowhere
        model = structure.model(values)
        with np.errstate(over="ignore", invalid="ignore"):  # what flies off costs without end
            trust = steady_state_gain(model, noise=self.noise, q=q, period=self.period)
            ahead = self.ahead(model, nuisance, trust)
            spread = self.spread(ahead)
            own = float(np.sum((nuisance.position_offset / self.loose) ** 2))
            cost = self._cost(spread) + own + friction_prior(values, nuisance)
        if not math.isfinite(cost):
            return nowhere
        return Estimate(structure, values, nuisance, q, trust, ahead, spread, cost)

    # -- compare ---------------------------------------------------------------------------------

    def spread(self, ahead: Array) -> Array:
        """(2, 2) covariance of innovations, never quite nothing."""
        x, v = ahead.T.copy()
        positions, velocities, both = self.told
        xx, vv = float(x @ x) / positions, float(v @ v) / velocities
        most = 0.99 * math.sqrt(xx * vv)
        xv = min(max(float(x @ v) / both, -most), most)
        fine, finer = self.noise.grain
        return np.array([[xx + fine**2, xv], [xv, vv + finer**2]])

    def _cost(self, spread: Array) -> float:
        (xx, xv), (_, vv) = spread.tolist()
        size = xx * vv - xv * xv
        return self.count * math.log(size) if size > 0.0 and math.isfinite(size) else math.inf

    def white(self, point: Estimate, table: Array) -> Array:
        """(2 n,) made independent and of size one by the spread at a point.

        What flies off is large, and its squares can still be summed.
        """
        with np.errstate(over="ignore", invalid="ignore"):
            white = np.asarray((table @ point.whitening.T).ravel())
            if math.isfinite(float(white @ white)):
                return white
        near = np.clip(np.nan_to_num(table, nan=FARTHEST), -FARTHEST, FARTHEST)
        return np.asarray((near @ point.whitening.T).ravel())

    def columns(self, point: Estimate) -> Array:
        """(2 n, searched + 2 runs) change of white innovations with each value, start and friction.

        Raises:
            ValueError: the point follows nothing.
        """
        structure = point.structure
        values = [self.white(point, self._by_value(point, name)) for name in structure.searched]
        moved = self._with(
            point, point.nuisance.moved(np.full(len(self.records), self.noise.position))
        )
        starts = (moved - point.innovations) / self.noise.position
        return np.column_stack(
            [
                *values,
                self._by_run(self.white(point, starts)),
                self.by_frictions(point),
            ]
        )

    def by_frictions(self, point: Estimate) -> Array:
        """(2 n, runs) change of the white innovations with each run's own friction."""
        by = np.full(len(self.records), friction_sd(point.values))
        more, less = (self._with(point, point.nuisance.rubbing(one)) for one in (by, -by))
        return self._by_run(self.white(point, (more - less) / (2.0 * by[0])))

    def _with(self, point: Estimate, nuisance: RunNuisance) -> Array:
        return self.ahead(point.structure.model(point.values), nuisance, point.kalman_gain)

    def _by_value(self, point: Estimate, name: str) -> Array:
        structure, value = point.structure, point.values[name]
        coarse = name.partition(".")[2] in STEPWISE
        step = (COARSE_NUDGE if coarse else NUDGE) * structure.size(name, value)
        if structure.within(name, value + step) != value + step:
            step = -step
        model = structure.model({**point.values, name: value + step})
        with np.errstate(over="ignore", invalid="ignore"):  # what flies off is no way to go
            return np.asarray(
                (self.ahead(model, point.nuisance, point.kalman_gain) - point.innovations) / step
            )

    def _by_run(self, change: Array) -> Array:
        """(2 n, runs): all runs are moved at once, and each is the business of its own column.

        A run is not moved without those before it, which may have heated what it found warm.
        """
        table = np.zeros((change.size, len(self.records)))
        for number, (first, last) in enumerate(pairwise((2 * self.edges).tolist())):
            table[first:last, number] = change[first:last]
        return table
